// SPDX-License-Identifier: Apache-2.0
// What struts that meet a plane do to the nodes of a grid in it (contour_struts.h), as vectors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "slice/contour_grid.h"

namespace msq {

/// A strut in coordinates u, v and along the normal of the plane, from its end a. One
/// cache line, since points meet them in any order.
struct alignas(64) PlaneStrut {
  double a_u, a_v, w;  ///< w: of the plane, from a
  double d_u, d_v, d_w;
  double radius;
  double inverse_length_squared;  ///< 0 for a point
};
/// The part of a strut's axis within the radius of the plane, in [0, 1].
struct AxisPart {
  double from, to;
};

/// Where crossings are, by edge.
struct CrossingTable {
  const uint64_t* bits;  ///< nodes inside
  size_t row_words;
  const EdgeWord *horizontal, *vertical;  ///< row by row
  uint32_t rows;
  /// u or v of each crossing, and its negative where the first node of the edge is inside. So both
  /// kinds are lowered by what struts propose.
  double* ends;
  uint32_t none;  ///< an end that belongs to no crossing: proposals for other edges go there
};

/// Where struts draw nodes.
struct NodeDrawing {
  uint64_t* bits;
  size_t row_words;
  std::vector<GridNode>& doubtful;  ///< with repetitions
};

/// Lowers the ends of the table to where lines of nodes enter and leave struts.
void propose_struts(const PlaneStrut* struts, const AxisPart* parts, size_t count,
                    const ContourGrid& grid, const CrossingTable& table);

/// Sets the bits of nodes that struts hold by the margin. Lists those nearer to a surface.
void draw_plane_struts(const PlaneStrut* struts, size_t count, double margin,
                       const ContourGrid& grid, const NodeDrawing& out);

}  // namespace msq
