// SPDX-License-Identifier: Apache-2.0
#include "structure/waves/knots.h"

#include <algorithm>
#include <cmath>

#include "base/pi.h"

namespace msq {

namespace {

/// The interpolation's error, above which more knots are used.
constexpr double enough = 2e-6;

/// The number of knots, a multiple of `step`; 0 if it is not below that of the samples.
size_t find_degree(const AxisWaves& waves, double half, size_t samples, size_t step,
                   double& error) {
  std::vector<double> terms(waves.count, 2 * waves.amplitude);
  for (size_t m = 1; m < samples; ++m) {
    error = 0;
    for (size_t i = 0; i < waves.count; ++i) {
      terms[i] *= two_pi / 2 * std::abs(waves.rates[i]) * half / static_cast<double>(m);
      error += terms[i];
    }
    error *= 1 + 0x1p-30;
    if (m % step == 0 && error < enough) return m;
  }
  return 0;
}

/// Chebyshev polynomials of degrees below m at the first `count` of the zeros of that of degree m:
/// [degree * count + zero].
std::vector<double> table_of(size_t m, size_t count, double half, std::vector<double>& offsets) {
  std::vector<double> table(m * count);
  for (size_t j = 0; j < count; ++j) {
    const double angle = (static_cast<double>(j) + 0.5) * pi / static_cast<double>(m);
    offsets.push_back(half * std::cos(angle));
    for (size_t k = 0; k < m; ++k) table[k * count + j] = std::cos(static_cast<double>(k) * angle);
  }
  return table;
}

/// Chebyshev polynomials of degrees below m at s, from -1 to 1.
void polynomials(size_t m, double s, double* t) {
  t[0] = 1;
  if (m > 1) t[1] = s;
  for (size_t k = 2; k < m; ++k) t[k] = 2 * s * t[k - 1] - t[k - 2];
}

}  // namespace

Knots knots_for(const AxisWaves& waves, const double* positions, size_t count) {
  Knots made;
  made.centre = 0.5 * (positions[0] + positions[count - 1]);
  const double half = 0.5 * (positions[count - 1] - positions[0]);
  const size_t m = find_degree(waves, half, count, 1, made.error);
  if (m == 0) {
    made.are_samples = true;
    made.error = 0;
    made.weights.assign(count * count, 0);
    for (size_t j = 0; j < count; ++j) {
      made.offsets.push_back(positions[j] - made.centre);
      made.weights[j * count + j] = 1;
    }
    return made;
  }
  const std::vector<double> table = table_of(m, m, half, made.offsets);
  made.weights.resize(count * m);
  made.constant = 0;
  for (size_t s = 0; s < count; ++s) {
    double t[max_knots];
    polynomials(m, std::clamp((positions[s] - made.centre) / half, -1.0, 1.0), t);
    double* const weights = made.weights.data() + s * m;
    double sum = 0;
    // By the discrete orthogonality of the polynomials.
    for (size_t j = 0; j < m; ++j) {
      double weight = 0.5;
      for (size_t k = 1; k < m; ++k) weight += t[k] * table[k * m + j];
      weights[j] = 2 * weight / static_cast<double>(m);
      sum += std::abs(weights[j]);
    }
    made.constant = std::max(made.constant, (1 + 0x1p-30) * sum);
  }
  made.spread = made.constant;
  return made;
}

Knots knot_pairs_for(const AxisWaves& waves, const double* positions, size_t count) {
  Knots made;
  made.centre = 0.5 * (positions[0] + positions[count - 1]);
  const double half = 0.5 * (positions[count - 1] - positions[0]);
  const size_t pairs = (count + 1) / 2;
  const size_t m = find_degree(waves, half, count, 2, made.error);
  const auto offset = [&](size_t pair) {
    return 0.5 * (positions[count / 2 + pair] - positions[(count - 1) / 2 - pair]);
  };
  if (m == 0) {
    made.are_samples = true;
    made.error = 0;
    made.spread = 2;
    made.weights.assign(pairs * 2 * pairs, 0);
    for (size_t p = 0; p < pairs; ++p) {
      made.offsets.push_back(offset(p));
      made.weights[p * 2 * pairs + p] = made.weights[(p * 2 + 1) * pairs + p] = 1;
    }
    return made;
  }
  const size_t n = m / 2;
  const std::vector<double> table = table_of(m, n, half, made.offsets);
  made.weights.resize(pairs * m);
  made.constant = made.spread = 0;
  for (size_t p = 0; p < pairs; ++p) {
    double t[max_knots];
    polynomials(m, std::min(offset(p) / half, 1.0), t);
    double* const even = made.weights.data() + p * m;
    double* const odd = even + n;
    double sum = 0, parts = 0;
    // As above, with the sum and the difference of the weights of a knot and its opposite.
    for (size_t j = 0; j < n; ++j) {
      double of_even = 0.5, of_odd = 0;
      for (size_t k = 1; k < m; k += 2) of_odd += t[k] * table[k * n + j];
      for (size_t k = 2; k < m; k += 2) of_even += t[k] * table[k * n + j];
      even[j] = 4 * of_even / static_cast<double>(m);
      odd[j] = 4 * of_odd / static_cast<double>(m);
      sum += std::max(std::abs(even[j]), std::abs(odd[j]));
      parts += std::abs(even[j]) + std::abs(odd[j]);
    }
    made.constant = std::max(made.constant, (1 + 0x1p-30) * sum);
    made.spread = std::max(made.spread, (1 + 0x1p-30) * parts);
  }
  return made;
}

}  // namespace msq
