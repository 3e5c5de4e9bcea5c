// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/warped/placed_graph.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

namespace msq {

PlacedGraph::PlacedGraph(const UnitCell& cell, const CellPlaces& places)
    : places_(places), graph_({cell}) {
  const auto corner_of = [this](const LatticeGraph::End& end) {
    const auto known = std::find_if(corners_.begin(), corners_.end(), [&](const auto& other) {
      return other.node == end.node && other.offset == end.offset;
    });
    const auto number = static_cast<uint32_t>(known - corners_.begin());
    if (known == corners_.end()) corners_.push_back(end);
    return number;
  };
  for (size_t number = 0; number < struts_.size(); ++number) {
    const size_t ends[3] = {number % 3, number / 3 % 3, number / 9};
    std::vector<LatticeGraph::Use> uses;
    for (uint32_t back = 0; back < 8; ++back) {
      bool is_there = true;  // the cell that is so far before
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const auto end = static_cast<CellPlaces::End>(ends[axis]);
        const bool is_before = back >> axis & 1;
        if (end == (is_before ? CellPlaces::End::first : CellPlaces::End::last)) is_there = false;
      }
      if (!is_there) continue;
      const std::vector<LatticeGraph::Use>& own = graph_.uses(0, back);
      uses.insert(uses.end(), own.begin(), own.end());
    }
    LatticeGraph::merge(uses);
    for (const LatticeGraph::Use& use : uses) {
      const LatticeGraph::Edge& edge = graph_.edge(use.edge);
      const uint32_t a = corner_of(edge.a), b = corner_of(edge.b);
      struts_[number].push_back({a, b, use.edge, use.factor});
    }
    std::stable_sort(struts_[number].begin(), struts_[number].end(),
                     [](const Strut& s, const Strut& t) { return s.factor > t.factor; });
    for (const Strut& s : struts_[number]) factors_.push_back(s.factor);
  }
  std::sort(factors_.begin(), factors_.end(), std::greater<>());
  factors_.erase(std::unique(factors_.begin(), factors_.end()), factors_.end());
}

PlacedGraph::Node PlacedGraph::node(CellIndex cell, const LatticeGraph::End& corner) const {
  Node node{places_.canonical(
                {cell.x + corner.offset[0], cell.y + corner.offset[1], cell.z + corner.offset[2]}),
            corner.node, 0};
  const Vec3 at = graph_.node(node.number);
  node.folded_axes = places_.folded_axes(node.cell, at);
  if (node.folded_axes == 0) return node;
  if (node.folded_axes & 2) node.cell.y = 0;
  if (node.folded_axes & 4) node.cell.z = 0;
  const auto is_same = [&](Vec3 other) {
    for (int axis = 0; axis < 3; ++axis)
      if (!(node.folded_axes >> axis & 1) && other[axis] != at[axis]) return false;
    return true;
  };
  for (uint32_t other = 0; other < node.number; ++other)
    if (is_same(graph_.node(other))) node.number = other;
  return node;
}

void PlacedGraph::place(CellIndex cell, std::vector<Vec3>& corners) const {
  corners.resize(corners_.size());
  for (size_t i = 0; i < corners_.size(); ++i) {
    const Node at = node(cell, corners_[i]);
    Vec3 fraction = graph_.node(at.number);
    for (int axis = 0; axis < 3; ++axis)
      if (at.folded_axes >> axis & 1) fraction[axis] = 0;
    corners[i] = places_.place(at.cell, fraction);
  }
}

bool PlacedGraph::is_in_graph(CellIndex cell, size_t number) const {
  const auto ends_of = [this](CellIndex of, const Strut& s) {
    return std::pair(node(of, corners_[s.a]), node(of, corners_[s.b]));
  };
  const Strut& strut = struts_of(cell)[number];
  const auto [a, b] = ends_of(cell, strut);
  if (a == b) return false;
  if (a.folded_axes == 0 && b.folded_axes == 0) return true;
  // All cells around have a strut between two such nodes.
  const bool is_around = a.folded_axes != 0 && b.folded_axes != 0;
  if (is_around && cell.y != 0) return false;
  const auto order = [](const Strut& s, CellIndex of, size_t n) {
    return std::tuple(-s.factor, of.x, of.y, of.z, n);
  };
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = is_around ? 0 : -1; dy <= (is_around ? 0 : 1); ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const CellIndex other = places_.canonical({cell.x + dx, cell.y + dy, cell.z + dz});
        const std::vector<Strut>& struts = struts_of(other);
        for (size_t n = 0; n < struts.size(); ++n) {
          const auto [c, d] = ends_of(other, struts[n]);
          const bool is_same = (a == c && b == d) || (a == d && b == c);
          if (is_same && order(struts[n], other, n) < order(strut, cell, number)) return false;
        }
      }
  return true;
}

}  // namespace msq
