// SPDX-License-Identifier: Apache-2.0
// Finds the cells of a grid that the struts of edges come near.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace msq {

/// Ends of edges in single precision, coordinates below 16: x, y and z of one end, then of the
/// other.
class EdgeEnds {
 public:
  /// Makes room for that many edges, which the caller then sets.
  void resize(size_t count) {
    count_ = count;
    for (std::vector<float>& component : values_) component.resize(count + padding);
  }
  void set(size_t edge, const std::array<float, 3>& a, const std::array<float, 3>& b) {
    for (size_t axis = 0; axis < 3; ++axis) {
      values_[axis][edge] = a[axis];
      values_[axis + 3][edge] = b[axis];
    }
  }
  size_t count() const { return count_; }
  /// `padding` more values may be read.
  const float* values(size_t component) const { return values_[component].data(); }

 private:
  static constexpr size_t padding = 16;
  size_t count_ = 0;
  std::vector<float> values_[6];
};

/// Cells [first, first + count) along each axis, the corner of cell 0 at 0.
struct CellBox {
  float size[3];
  int first[3], count[3];
};

/// A cell that an edge comes near, by its number in the box, x first.
struct NearCell {
  uint32_t cell, edge;
};

/// Fills `found`, in the order of edges, with the cells to which segments come within `reach` along
/// each axis. It may add cells that are farther, but none that one of these planes separates from
/// the segment: a plane of the cell, or one along the segment and an axis.
void find_cells_near_edges(const EdgeEnds& edges, const CellBox& box, float reach,
                           std::vector<NearCell>& found);

}  // namespace msq
