// SPDX-License-Identifier: Apache-2.0
// The seeds of a graded foam over a box of cells, straight from their definition.
#pragma once

#include <vector>

#include "structure/foam/seeds/graded_seeds.h"

namespace msq::test {

struct GradedSeed {
  Vec3 position;  ///< foam units, from the corner of cell 0
  GradedSeeds::Node leaf;
};

inline void append_leaves(const GradedSeeds& seeds, const GradedSeeds::Node& node,
                          std::vector<GradedSeed>& out) {
  if (seeds.splits(node)) {
    for (uint32_t octant = 0; octant < 8; ++octant) append_leaves(seeds, node.child(octant), out);
    return;
  }
  const Vec3 in_cell = seeds.in_leaf(node);
  const Vec3 cell{double(node.cell.x), double(node.cell.y), double(node.cell.z)};
  out.push_back({(cell + in_cell) * seeds.scale(), node});
}

/// Those of cells [low, high)^3, in order.
inline std::vector<GradedSeed> graded_cells(const GradedSeeds& seeds, int low, int high) {
  std::vector<GradedSeed> all;
  for (int z = low; z < high; ++z)
    for (int y = low; y < high; ++y)
      for (int x = low; x < high; ++x) append_leaves(seeds, {{x, y, z}}, all);
  return all;
}

}  // namespace msq::test
