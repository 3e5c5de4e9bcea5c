// SPDX-License-Identifier: Apache-2.0
// Blocks of cells of which the cache keeps data.
#pragma once

#include <cmath>

#include "base/job.h"
#include "base/vec.h"
#include "cell/neighbourhood.h"

namespace msq {

/// Calls visit(corner) for the blocks of side^3 cells that meet a box in grid coordinates. Corners
/// are at multiples of the side, less `lead` cells along each axis. Throws Error(cancelled) if the
/// job is cancelled.
template <class Visit>
void for_each_block(const Neighbourhood& grid, const Box3& box, int side, int lead, const Job* job,
                    Visit&& visit) {
  int64_t first[3], last[3];
  for (int axis = 0; axis < 3; ++axis) {
    const auto block = [&](double g) {
      return static_cast<int64_t>(std::floor((g / grid.cell_size[axis] + lead) / side));
    };
    first[axis] = block(box.min[axis]);
    last[axis] = block(box.max[axis]);
  }
  const auto corner_at = [&](int64_t block) { return static_cast<int32_t>(block * side - lead); };
  for (int64_t k = first[2]; k <= last[2]; ++k)
    for (int64_t j = first[1]; j <= last[1]; ++j)
      for (int64_t i = first[0]; i <= last[0]; ++i) {
        check_cancelled(job);
        visit(CellIndex{corner_at(i), corner_at(j), corner_at(k)});
      }
}

}  // namespace msq
