// SPDX-License-Identifier: Apache-2.0
// The error, u = 2^-24 and v = 2^-53. Let M bound the sum of the magnitudes of the products of the
// tape, before any cancel. For a product, the magnitudes of its parts' addition theorems multiply:
// each is |s C| + |c S| or |c C| + |s S|, at most 1. So the magnitudes of all coefficients times
// their functions sum to at most M, too.
//
// A coefficient is a sum of m products of a factor and d parts, each rounded once, of which each
// operation is rounded. So it is within (2 d + 1 + m) u of its share of M. Functions are rounded
// once, each product and each sum of t functions and the constant once: (t + 3) u M. Sines and
// cosines of the definition, its n operations, and the double precision of functions and parts
// depart by at most (8 n v + 2^-45) M. Factors of 5/4 cover squares of u.
#include "structure/functional/wave_products.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace msq {

namespace {

using Part = WaveProducts::Part;

/// Factors by the parts of products.
struct WaveSum {
  std::map<std::vector<Part>, double> products;
  double most = 0;
};

bool multiply(const WaveSum& a, const WaveSum& b, WaveSum& to) {
  for (const auto& [p, f] : a.products)
    for (const auto& [q, g] : b.products) {
      std::vector<Part> parts = p;
      parts.insert(parts.end(), q.begin(), q.end());
      std::sort(parts.begin(), parts.end());
      for (size_t i = 1; i < parts.size(); ++i)
        if (parts[i - 1] / 2 == parts[i] / 2) return false;  // of one wave
      if (parts.size() > WaveProducts::max_parts) return false;
      to.products[parts] += f * g;
    }
  to.most = a.most * b.most;
  return true;
}

}  // namespace

bool WaveProducts::Function::is_odd() const {
  return std::count_if(parts.begin(), parts.end(), [](Part part) { return part % 2 == 0; }) % 2;
}

std::optional<WaveProducts> WaveProducts::of(const Tape& tape, const std::vector<int>& parts,
                                             const std::vector<int>& frequencies) {
  constexpr size_t max_nodes = 256, max_products = 32;
  if (tape.nodes.size() > max_nodes || 2 * frequencies.size() > UINT16_MAX) return std::nullopt;
  std::vector<std::optional<WaveSum>> sums(tape.nodes.size());
  WaveProducts made;
  for (size_t i = 0; i < tape.nodes.size(); ++i) {
    const Node& node = tape.nodes[i];
    WaveSum sum;
    if (parts[i] >= 0) {
      sum = {{{{static_cast<Part>(parts[i])}, 1.0}}, 1};
    } else if (node.op == Op::constant) {
      sum = {{{{}, node.value}}, std::abs(node.value)};
    } else if (node.op == Op::add || node.op == Op::subtract) {
      if (!sums[node.a] || !sums[node.b]) continue;
      sum = *sums[node.a];
      const double sign = node.op == Op::add ? 1 : -1;
      for (const auto& [p, f] : sums[node.b]->products) sum.products[p] += sign * f;
      sum.most += sums[node.b]->most;
    } else if (node.op == Op::negate) {
      if (!sums[node.a]) continue;
      sum = *sums[node.a];
      for (auto& [p, f] : sum.products) f = -f;
    } else if (node.op == Op::multiply) {
      if (!sums[node.a] || !sums[node.b] || !multiply(*sums[node.a], *sums[node.b], sum)) continue;
    } else if (node.op == Op::absolute && i + 1 == tape.nodes.size()) {
      if (!sums[node.a]) continue;
      sum = *sums[node.a];
      made.is_absolute_ = true;
    } else {
      continue;
    }
    if (sum.products.size() <= max_products) sums[i] = std::move(sum);
  }
  if (!sums.back() || !(sums.back()->most < 1e9)) return std::nullopt;
  const WaveSum& sum = *sums.back();
  made.most_ = sum.most;
  made.operations_ = 8 * static_cast<double>(tape.nodes.size());
  std::map<std::vector<Part>, Function> functions;
  for (const auto& [p, factor] : sum.products) {
    if (p.empty()) {
      made.constant_ = factor;
      continue;
    }
    // sin(x + a) = sin x cos a + cos x sin a; cos(x + a) = cos x cos a - sin x sin a
    for (unsigned choice = 0; choice < 1u << p.size(); ++choice) {
      Product coefficient{factor, {}};
      Function function;
      for (size_t n = 0; n < p.size(); ++n) {
        const bool is_sine = choice >> n & 1, of_cosine = p[n] % 2;
        const int wave = p[n] / 2;
        function.parts.push_back(static_cast<Part>(2 * wave + !is_sine));
        coefficient.parts.push_back(static_cast<Part>(2 * wave + (of_cosine != is_sine)));
        if (of_cosine && is_sine) coefficient.factor = -coefficient.factor;
      }
      Function& known = functions[function.parts];
      known.parts = function.parts;
      known.coefficient.push_back(std::move(coefficient));
    }
  }
  if (functions.empty() || functions.size() > max_functions) return std::nullopt;
  for (auto& [parts_of, function] : functions) made.functions_.push_back(std::move(function));
  double highest = 0;
  for (const int frequency : frequencies)
    highest = std::max(highest, std::abs(static_cast<double>(frequency)));
  made.steep_ = made.most_ * static_cast<double>(max_parts) * highest;
  return made;
}

double WaveProducts::slack(double angle_error) const {
  constexpr double in_single = 0x1p-24, in_double = 0x1p-53;
  size_t most_summed = 0;
  for (const Function& function : functions_)
    most_summed = std::max(most_summed, function.coefficient.size());
  const double roundings =
      static_cast<double>(functions_.size() + 3 + 2 * max_parts + 1 + most_summed);
  return 1.25 * most_ * (roundings * in_single + operations_ * in_double + 0x1p-45) +
         1.25 * steep_ * angle_error + 0x1p-100;
}

}  // namespace msq
