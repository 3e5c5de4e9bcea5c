// SPDX-License-Identifier: Apache-2.0
// Set queries of signed distance. Each point's distance is Model::distance(). Parts run in
// parallel.
#pragma once

#include <vector>

#include "base/job.h"
#include "model/model.h"
#include "query/point_set.h"

namespace msq {

/// Sets distance[i] to that of point i. All points must be finite.
void set_distance(const Model& model, const Scales& resolved, const PointSet& points,
                  double* distance, Job* job);

}  // namespace msq
