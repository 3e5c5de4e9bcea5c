// SPDX-License-Identifier: Apache-2.0
#include "query/ask_group.h"

#include <algorithm>

namespace msq {

namespace {

bool is_set(const Structure& structure, const QueryPlan& plan, uint64_t living) {
  if (plan.method != QueryMethod::automatic) return plan.method == QueryMethod::set;
  return living >= (plan.critical_count ? plan.critical_count : structure.critical_count());
}

}  // namespace

void ask_group(const Scale& scale, const QueryPlan& plan, const Vec3* points, uint8_t* alive,
               size_t count, Job* job) {
  const uint64_t living = static_cast<uint64_t>(std::count(alive, alive + count, 1));
  if (living == 0) return;
  if (is_set(*scale.structure, plan, living)) {
    scale.keep_points(points, alive, count);
    if (job) job->counts().add_group(living);
    return;
  }
  for (size_t i = 0; i < count; ++i) {
    if (i % 16 == 0) check_cancelled(job);
    if (alive[i]) alive[i] = scale.inside(points[i]);
  }
  if (job) job->counts().by_point += living;
}

}  // namespace msq
