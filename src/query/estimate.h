// SPDX-License-Identifier: Apache-2.0
// Fractions estimated from a stratified sample.
//
// With c hits among the n points of a stratum, c (n - c) / (n^2 (n - 1)) is an unbiased estimate of
// the variance of its fraction. The fractions of H equal strata are independent: the variance of
// their mean is the sum of those variances over H^2. Sums of c and of c (n - c) are integers, so
// estimates do not depend on threads. Source: Cochran, "Sampling Techniques", 1977, sections 5.3 to
// 5.5.
//
// The interval is Wilson's score interval (Wilson 1927) for the number of independent points that
// gives the same standard error. So it stays within 0 and 1, and has a positive length if all
// strata are wholly in or out.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/interval.h"

namespace msq {

struct Estimate {
  double value = 0, standard_error = 0;
  Interval interval;  ///< contains the true value with a probability of 95 %
};

/// Hits in strata of n points each.
class StrataTally {
 public:
  void add(uint64_t hits, uint64_t n) {
    hits_ += hits;
    spread_ += hits * (n - hits);
  }
  uint64_t hits() const { return hits_; }
  uint64_t spread() const { return spread_; }
  void add(const StrataTally& other) {
    hits_ += other.hits_;
    spread_ += other.spread_;
  }

  /// The estimate from all strata; n at least 2.
  Estimate estimate(uint64_t strata, uint64_t n) const {
    const double h = static_cast<double>(strata), per = static_cast<double>(n), all = h * per;
    Estimate e;
    e.value = static_cast<double>(hits_) / all;
    e.standard_error = std::sqrt(static_cast<double>(spread_) / (per - 1)) / all;
    const double variance = e.standard_error * e.standard_error;
    const double count = variance > 0 ? e.value * (1 - e.value) / variance : all;
    constexpr double z = 1.959963984540054;  // of the normal distribution, for 95 %
    const double z2 = z * z / count, middle = (e.value + z2 / 2) / (1 + z2);
    const double half =
        z / (1 + z2) * std::sqrt(e.value * (1 - e.value) / count + z2 / (4 * count));
    e.interval = {std::max(0.0, std::min(e.value, middle - half)),
                  std::min(1.0, std::max(e.value, middle + half))};
    return e;
  }

 private:
  uint64_t hits_ = 0;
  uint64_t spread_ = 0;  // sum of c (n - c)
};

}  // namespace msq
