// SPDX-License-Identifier: Apache-2.0
// Rows whose positions in the cell repeat.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace msq {

/// The least number of values after which all are within `same` of the first ones; 0 if there is
/// none of at most half of their count. At most 16 candidates are compared, so the time is linear.
inline uint64_t period_of(const double* values, size_t count, double same) {
  constexpr int max_tries = 16;
  int tries = 0;
  for (size_t period = 1; 2 * period <= count && tries < max_tries; ++period) {
    if (!(std::abs(values[period] - values[0]) <= same)) continue;
    ++tries;
    size_t i = period, first = 0;
    while (i < count && std::abs(values[i] - values[first]) <= same) {
      ++i;
      if (++first == period) first = 0;
    }
    if (i == count) return period;
  }
  return 0;
}

}  // namespace msq
