// SPDX-License-Identifier: Apache-2.0
// Rays through solids that are made of others.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "base/ray.h"

namespace msq {

/// Follows a ray from `from`, where is_there(from) is false, and evaluates is_there before, at and
/// behind each place where a member of the solid changes. Sets t to the far side of the first
/// change of is_there, within `tolerance` of it. Returns false if there is none up to `to`.
/// next_change(at) returns the nearest change behind `at`, infinity if there is none, or nothing to
/// end the search. A member's change is known within the member's own tolerance, which is at most
/// `tolerance`. Stops early, by Error(cancelled), with the job.
template <class NextChange, class IsThere>
bool follow_changes(double from, double to, double tolerance, const Job* job,
                    NextChange&& next_change, IsThere&& is_there, double& t) {
  JobPoll poll(job);
  LeastStep least(tolerance, tolerance, from);
  for (double at = from; at < to;) {
    poll();
    const std::optional<double> change = next_change(at);
    if (!change) return false;
    const double nearest = *change < std::numeric_limits<double>::infinity() ? *change : to;
    const double behind = std::min(to, std::max(nearest + tolerance, at + least.of_step(at)));
    if (!(behind > at)) return false;  // steps vanish in rounding
    // Entries are found on their far side, ends of parts on their near one.
    for (const double place : {nearest - tolerance, nearest, behind}) {
      if (!(place > at && place <= behind)) continue;
      if (is_there(place)) {
        t = bisect(at, place, tolerance, is_there);
        return true;
      }
      at = place;
    }
  }
  return false;
}

}  // namespace msq
