// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/warped/warped_struts.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/job.h"

namespace msq {

namespace {

/// Struts in a part, about.
constexpr double struts_in_part = 4096, max_side = 16;

Id id_of(CellIndex cell, uint32_t number) {
  return {static_cast<uint32_t>(cell.x) | uint64_t{static_cast<uint32_t>(cell.y)} << 32,
          static_cast<uint32_t>(cell.z) | uint64_t{number} << 32};
}

}  // namespace

WarpedStruts::WarpedStruts(const PlacedGraph& graph, const Neighbourhood& grid,
                           const Parameter& radius, const StrutSelection& selection)
    : graph_(graph),
      grid_(grid),
      radius_(radius),
      selection_(selection),
      box_(selection.around(graph.max_factor() * radius.range().high)) {
  const auto per_cell = static_cast<double>(graph.struts().size());
  const auto fits = [&](double side) {
    return side <= max_side && side * side * side * per_cell <= struts_in_part;
  };
  while (fits(side_ + 1)) ++side_;
  graph.places().for_each_block(grid.to_grid(box_), [&](const CellBlock& cells) {
    if (cells.empty()) return;
    Block block{cells, parts_, {}};
    for (int axis = 0; axis < 3; ++axis) {
      const double low = cells.first[axis], high = cells.last[axis];
      if (!(low > -max_cell_index && high < max_cell_index))
        fail(Status::limit,
             "the box reaches from cell %g to cell %g along axis %d; the limit is %g cells from "
             "the grid's origin",
             low, high, axis, max_cell_index);
      block.parts[axis] = static_cast<uint64_t>(std::ceil((high - low + 1) / side_));
    }
    blocks_.push_back(block);
    parts_ += block.parts[0] * block.parts[1] * block.parts[2];
  });
}

void WarpedStruts::append(uint64_t part, StrutList& list) const {
  const auto block =
      std::prev(std::upper_bound(blocks_.begin(), blocks_.end(), part,
                                 [](uint64_t p, const Block& b) { return p < b.first_part; }));
  uint64_t index = part - block->first_part;
  CellBlock cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.first[axis] =
        block->cells.first[axis] + static_cast<double>(index % block->parts[axis]) * side_;
    cells.last[axis] = std::min(block->cells.last[axis], cells.first[axis] + side_ - 1);
    index /= block->parts[axis];
  }
  const size_t from = list.struts.size();
  const double max_radius = radius_.range().high;
  const auto meets = [&](const Box3& bounds) { return grid_.from_grid(bounds).overlaps(box_); };
  std::vector<Vec3> corners;
  const auto visit = [&](CellIndex cell) {
    check_cancelled();
    graph_.place(cell, corners);
    for (Vec3& corner : corners) corner = grid_.from_grid(corner);
    const std::vector<PlacedGraph::Strut>& struts = graph_.struts_of(cell);
    for (size_t n = 0; n < struts.size(); ++n) {
      const PlacedGraph::Strut& s = struts[n];
      Strut strut;
      strut.a = corners[s.a];
      strut.b = corners[s.b];
      if (!PlacedGraph::is_placed(corners, s)) continue;
      if (!selection_.selects(strut.a, strut.b, s.factor * max_radius)) continue;
      if (!graph_.is_in_graph(cell, n)) continue;
      const uint32_t corners_of[2] = {s.a, s.b};
      for (int end = 0; end < 2; ++end) {
        const PlacedGraph::Node node = graph_.node(cell, graph_.corners()[corners_of[end]]);
        strut.nodes[end] = id_of(node.cell, node.number);
      }
      strut.id = id_of(cell, s.edge);
      strut.cell = cell;
      strut.radii[0] = strut.radii[1] = s.factor * max_radius;
      list.add(strut, s.factor);
    }
  };
  graph_.places().for_each_cell_of(cells, meets, visit);
  if (!radius_.is_constant()) set_radii(radius_, from, list);
}

double WarpedStruts::radius_at(const Strut&, double factor, double, Vec3 p) const {
  return factor * radius_.at(p);
}

}  // namespace msq
