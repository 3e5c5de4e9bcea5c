// SPDX-License-Identifier: Apache-2.0
// Sorts that stop if the job is cancelled.
#pragma once

#include <algorithm>
#include <cstdint>

#include "base/job.h"

namespace msq {

/// As std::sort. If the current job is cancelled, throws Error(cancelled) within milliseconds; the
/// order is then unspecified.
template <class Iterator, class Less>
void polled_sort(Iterator first, Iterator last, Less less) {
  constexpr uint32_t between = 1u << 16;
  uint32_t compared = 0;
  std::sort(first, last, [&](const auto& a, const auto& b) {
    if (++compared % between == 0) check_cancelled();
    return less(a, b);
  });
}

}  // namespace msq
