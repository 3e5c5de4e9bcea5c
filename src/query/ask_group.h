// SPDX-License-Identifier: Apache-2.0
// Evaluates a group of points with a scale: one by one, or as a set.
// Source: paper, section "Structured and Unstructured Set Queries" (critical number of points).
#pragma once

#include "base/job.h"
#include "model/scale.h"

namespace msq {

enum class QueryMethod : int32_t { automatic = 0, point = 1, set = 2 };

struct QueryPlan {
  QueryMethod method = QueryMethod::automatic;
  uint64_t critical_count = 0;  ///< 0: as Structure::critical_count()
  uint32_t group_parts = 0;     ///< 0: as Structure::group_parts()
};

/// As Scale::keep_points, by the method of the plan.
void ask_group(const Scale& scale, const QueryPlan& plan, const Vec3* points, uint8_t* alive,
               size_t count, Job* job);

}  // namespace msq
