// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/cell/unit_cell_faces.h"
#include "structure/lattice/mixed/mixed_lattice.h"

namespace msq {

double CellRange::count() const {
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) count *= last[axis] - first[axis] + 1;
  return count;
}

CellRange cells_of(const Neighbourhood& grid, const Box3& box) {
  constexpr double rounding = 1e-9;
  const Box3 extent = grid.to_grid(box);
  CellRange range;
  for (int axis = 0; axis < 3; ++axis) {
    range.first[axis] = std::floor(extent.min[axis] / grid.cell_size[axis] + rounding);
    range.last[axis] = std::max(range.first[axis],
                                std::ceil(extent.max[axis] / grid.cell_size[axis] - rounding) - 1);
  }
  return range;
}

MixedFaces MixedLattice::faces(const CellRange& range, Job* job) const {
  const size_t types = library_.size();
  std::vector<uint8_t> unmatched(3 * types * types);
  const auto is_unmatched = [&](size_t low, size_t high, int axis) -> uint8_t& {
    return unmatched[(low * types + high) * 3 + static_cast<size_t>(axis)];
  };
  for (size_t low = 0; low < types; ++low)
    for (size_t high = 0; high < types; ++high)
      for (int axis = 0; axis < 3; ++axis)
        is_unmatched(low, high, axis) =
            !unmatched_nodes(library_[low], axis, Side::high, library_[high]).empty() ||
            !unmatched_nodes(library_[high], axis, Side::low, library_[low]).empty();

  int64_t first[3];
  size_t counts[3];
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = static_cast<int64_t>(range.first[axis]);
    counts[axis] = static_cast<size_t>(range.last[axis] - range.first[axis] + 1);
  }
  std::vector<uint8_t> layer(counts[0] * counts[1]);  // types of the cells examined last
  MixedFaces found;
  for (size_t k = 0; k < counts[2]; ++k) {
    if (job) job->set_progress(static_cast<double>(k) / static_cast<double>(counts[2]));
    for (size_t j = 0; j < counts[1]; ++j) {
      check_cancelled(job);
      for (size_t i = 0; i < counts[0]; ++i) {
        const size_t here = j * counts[0] + i;
        const int32_t cell[3] = {static_cast<int32_t>(first[0] + static_cast<int64_t>(i)),
                                 static_cast<int32_t>(first[1] + static_cast<int64_t>(j)),
                                 static_cast<int32_t>(first[2] + static_cast<int64_t>(k))};
        const size_t type = type_of({cell[0], cell[1], cell[2]});
        const size_t indices[3] = {i, j, k};
        const size_t below[3] = {here - 1, here - counts[0], here};
        for (int axis = 0; axis < 3; ++axis) {
          if (indices[axis] == 0) continue;
          const size_t lower = layer[below[axis]];
          if (lower == type) continue;
          ++found.faces;
          if (!is_unmatched(lower, type, axis) || found.unmatched++) continue;
          int32_t at[3] = {cell[0], cell[1], cell[2]};
          --at[axis];
          found.cell = {at[0], at[1], at[2]};
          found.axis = axis;
          found.types[0] = lower;
          found.types[1] = type;
        }
        layer[here] = static_cast<uint8_t>(type);
      }
    }
  }
  return found;
}

}  // namespace msq
