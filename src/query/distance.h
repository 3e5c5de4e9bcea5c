// SPDX-License-Identifier: Apache-2.0
// Set queries of signed distance. Each point's answer is Model::distance(), in parallel by chunks.
#pragma once

#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "model/model.h"
#include "query/point_array.h"

namespace msq {

/// All points must be finite.
void array_distance(const Model& model, const Scales& resolved, const PointArray& points,
                    double* distance, Job* job);

/// distance[i + nx (j + ny k)] is that of sample (i, j, k).
void grid_distance(const Model& model, const Scales& resolved, const SampleGrid& grid,
                   double* distance, Job* job);

}  // namespace msq
