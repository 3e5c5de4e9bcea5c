// SPDX-License-Identifier: Apache-2.0
// How far the rings of a layer are from the topology of a mask that is finer than their grid. The
// mask has k x k samples to a cell of the grid, with nodes among them.
#pragma once

#include <cstdint>

#include "base/job.h"
#include "model/model.h"
#include "slice/contour_section.h"

namespace msq {

/// The steps from the rings to the mask: see contour_topology_cells.h. `samples`: k; 2, 4, 8 or 16.
/// `section` is traced.
uint64_t count_topology_steps(const Model& model, const Scales& resolved,
                              const ContourSection& section, uint32_t samples, const Job* job);

}  // namespace msq
