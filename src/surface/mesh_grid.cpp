// SPDX-License-Identifier: Apache-2.0
#include "surface/mesh_grid.h"

#include <cmath>

#include "base/status.h"

namespace msq {

MeshGrid::MeshGrid(const Box3& box, double pitch) : box_(box) {
  constexpr double max_nodes = 0x1p31 - 256;
  samples_.spacing = {pitch, pitch, pitch};
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = box.max[axis] - box.min[axis];
    // So the nodes next to the faces are 1/4 to 3/4 of a pitch away from them.
    const double count = std::max(1.0, std::floor(extent / pitch + 0.5));
    if (!(count < max_nodes))
      fail(Status::limit, "%g nodes of a pitch of %g along %c; the limit is %.0f", count, pitch,
           "xyz"[axis], max_nodes);
    samples_.origin[axis] = box.min[axis] + 0.5 * (extent - (count - 1) * pitch);
    (axis == 0   ? samples_.nx
     : axis == 1 ? samples_.ny
                 : samples_.nz) = static_cast<uint64_t>(count);
    const double first = samples_.origin[axis], last = first + (count - 1) * pitch;
    // Vertices need some digits within a cell.
    const double digits = 0x1p-24 * pitch;
    const double far = std::max(std::abs(box.min[axis]), std::abs(box.max[axis]));
    if (!(first > box.min[axis]) || !(last < box.max[axis]) || far + digits == far)
      fail(Status::argument, "a pitch of %g along %c is too small at %g", pitch, "xyz"[axis], far);
  }
}

Box3 MeshGrid::cell(uint32_t i, uint32_t j, uint32_t k) const {
  const double margin = 0x1p-12 * pitch();
  const uint32_t index[3] = {i, j, k};
  Box3 cell;
  for (int axis = 0; axis < 3; ++axis) {
    const uint32_t n = index[axis];
    cell.min[axis] = at(axis, n) + margin;
    cell.max[axis] = at(axis, n + 1) - margin;
  }
  return cell;
}

}  // namespace msq
