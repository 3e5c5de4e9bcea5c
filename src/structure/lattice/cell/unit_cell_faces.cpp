// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/cell/unit_cell_faces.h"

#include <algorithm>

namespace msq {

std::vector<uint32_t> nodes_on_face(const UnitCell& cell, int axis, Side side) {
  std::vector<uint32_t> nodes;
  for (uint32_t i = 0; i < cell.nodes.size(); ++i)
    if (std::abs(cell.nodes[i][axis] - (side == Side::high)) <= same_node) nodes.push_back(i);
  return nodes;
}

std::vector<uint32_t> unmatched_nodes(const UnitCell& cell, int axis, Side side,
                                      const UnitCell& other) {
  const std::vector<uint32_t> across =
      nodes_on_face(other, axis, side == Side::low ? Side::high : Side::low);
  std::vector<uint32_t> nodes = nodes_on_face(cell, axis, side);
  std::erase_if(nodes, [&](uint32_t node) {
    return std::any_of(across.begin(), across.end(), [&](uint32_t candidate) {
      Vec3 apart = other.nodes[candidate] - cell.nodes[node];
      apart[axis] = 0;
      return max_magnitude(apart) <= same_node;
    });
  });
  return nodes;
}

}  // namespace msq
