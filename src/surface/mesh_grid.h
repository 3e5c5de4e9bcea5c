// SPDX-License-Identifier: Apache-2.0
// The grid of a mesh: nodes in a box, and one more layer of nodes on each side of it, all outside.
// The boundary of the model cut with the box crosses edges between unlike nodes only. Nodes beyond
// the box have the position of its faces: edges to them end there, and so do cells.
#pragma once

#include <cstdint>

#include "base/sample_grid.h"
#include "base/vec.h"

namespace msq {

/// See msq_surface_def.
struct MeshPlan {
  bool has_box = false;
  Box3 box;
  double pitch = 0;
  double length_scale = 0;
  uint32_t slab_layers = 0;
};

class MeshGrid {
 public:
  /// The box is not empty. Throws Error(limit) for 2^31 nodes along an axis, Error(argument) where
  /// rounding makes nodes coincide.
  MeshGrid(const Box3& box, double pitch);

  double pitch() const { return samples_.spacing.x; }
  const Box3& box() const { return box_; }
  /// The nodes in the box.
  const SampleGrid& samples() const { return samples_; }
  /// Nodes along an axis, those beyond the box included.
  uint32_t nodes(int axis) const {
    const uint64_t inner = axis == 0 ? samples_.nx : axis == 1 ? samples_.ny : samples_.nz;
    return static_cast<uint32_t>(inner) + 2;
  }
  /// Of a node, along an axis.
  double at(int axis, uint32_t node) const {
    if (node == 0) return box_.min[axis];
    if (node == nodes(axis) - 1) return box_.max[axis];
    return axis == 0   ? samples_.x(node - 1)
           : axis == 1 ? samples_.y(node - 1)
                       : samples_.z(node - 1);
  }
  /// Words of a row of nodes: node i is bit i % 64 of word i / 64.
  size_t row_words() const { return words_for(nodes(0)); }

  /// The part of a cell that holds its vertices, except for those on faces of the box. So vertices
  /// of different cells are apart.
  Box3 cell(uint32_t i, uint32_t j, uint32_t k) const;

 private:
  Box3 box_;
  SampleGrid samples_;
};

}  // namespace msq
