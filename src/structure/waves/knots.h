// SPDX-License-Identifier: Apache-2.0
// Where a sum of cosines is computed along an axis, and the weights that interpolate it at samples.
// Source of the bounds: Rivlin, "Chebyshev Polynomials", 1990.
//
// Knots are the zeros of a Chebyshev polynomial, of the lowest degree that serves. m knots on [-1,
// 1] interpolate f with an error of at most max |f^(m)| / (2^(m-1) m!). On an interval of
// half-length h, a cosine of amplitude a and rate k is one of rate k h, so its error is at most 2 a
// (k h / 2)^m / m!. Where samples are so far apart that no fewer knots serve, they are the knots,
// without error.
#pragma once

#include <cstddef>
#include <vector>

namespace msq {

/// Cosines of one amplitude, their rates in cycles per unit of length.
struct AxisWaves {
  const double* rates;
  size_t count;
  double amplitude;
};

/// At most this many samples.
constexpr size_t max_knots = 64;

struct Knots {
  double centre = 0;
  bool are_samples = false;
  std::vector<double> offsets;  ///< of the knots from the centre; of a pair the positive one
  /// Of each sample: one for each knot. Of each pair of samples, beginning at the middle ones: one
  /// for the even part of each pair of knots, then one for the odd part. The upper sample is their
  /// sum, the lower one their difference.
  std::vector<double> weights;
  double error = 0;     ///< bound on that of the interpolation
  double constant = 1;  ///< the largest sum of the magnitudes of the knots' weights for a sample
  double spread = 1;    ///< the same of the weights of parts

  size_t count() const { return offsets.size(); }
};

/// For `count` samples at any positions, ascending.
Knots knots_for(const AxisWaves& waves, const double* positions, size_t count);

/// For samples that are symmetric about their middle. Knots are symmetric about it, too: pairs with
/// a mean, the even part, and half a difference, the odd part. If there is one in the middle, it
/// makes a pair with itself.
Knots knot_pairs_for(const AxisWaves& waves, const double* positions, size_t count);

}  // namespace msq
