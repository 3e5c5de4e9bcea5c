// SPDX-License-Identifier: Apache-2.0
// Sorts that stop if the job is cancelled.
#pragma once

#include <algorithm>

#include "base/job.h"

namespace msq {

/// As std::sort, and polls once per comparison. If the job is cancelled, throws Error(cancelled);
/// the order is then unspecified.
template <class Iterator, class Less>
void polled_sort(Iterator first, Iterator last, Less less, CancelPoll& poll) {
  std::sort(first, last, [&](const auto& a, const auto& b) {
    poll();
    return less(a, b);
  });
}

}  // namespace msq
