// SPDX-License-Identifier: Apache-2.0
// Blocks of samples of a plane, row by row as bits.
#pragma once

#include <cstdint>
#include <functional>

#include "base/job.h"
#include "model/model.h"
#include "slice/contour_grid.h"

namespace msq {

/// Samples at (u + i * u_step, v + j * v_step).
struct SampleBlock {
  double u, v, u_step, v_step;
  uint64_t across, rows;
};

/// Calls visit(j, words) for the rows of a block in ascending order; bits beyond the row are 0.
void for_sample_rows(const Model& model, const Scales& resolved, const LayerPlane& plane,
                     const SampleBlock& block, const Job* job,
                     const std::function<void(uint64_t j, const uint64_t* words)>& visit);

}  // namespace msq
