// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/warped/placed_graph.h"

#include <algorithm>
#include <functional>

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

}  // namespace msq
