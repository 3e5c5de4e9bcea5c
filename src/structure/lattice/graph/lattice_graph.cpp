// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/graph/lattice_graph.h"

#include <algorithm>
#include <cmath>

#include "base/job.h"
#include "field/field.h"

namespace msq {

namespace {

/// Struts in a block of cells, about.
constexpr int64_t struts_in_block = 4096, max_side = 16;

bool is_same(Vec3 a, Vec3 b) {
  return max_magnitude(a - b) <= same_node;
}

bool is_same(const LatticeGraph::End& a, const LatticeGraph::End& b) {
  return a.node == b.node && a.offset == b.offset;
}

int32_t floor_of(double x) {
  return static_cast<int32_t>(std::floor(x + same_node));
}

}  // namespace

LatticeGraph::LatticeGraph(const std::vector<UnitCell>& library) {
  uses_.resize(8 * library.size());
  std::vector<uint32_t> first_nodes;            // numbers of nodes that no earlier one equals
  std::vector<std::vector<uint32_t>> edges_of;  // by the first node of the edge
  for (size_t type = 0; type < library.size(); ++type) {
    const UnitCell& cell = library[type];
    std::vector<End> ends;  // of the nodes of this unit cell, seen from it
    for (const Vec3 p : cell.nodes) {
      End end{static_cast<uint32_t>(nodes_.size()), {floor_of(p.x), floor_of(p.y), floor_of(p.z)}};
      const Vec3 in_owner =
          p - Vec3{double(end.offset[0]), double(end.offset[1]), double(end.offset[2])};
      nodes_.push_back(in_owner);
      edges_of.emplace_back();
      const auto known = std::find_if(first_nodes.begin(), first_nodes.end(), [&](uint32_t number) {
        return is_same(nodes_[number], in_owner);
      });
      if (known == first_nodes.end())
        first_nodes.push_back(end.node);
      else
        end.node = *known;
      ends.push_back(end);
    }
    for (size_t strut = 0; strut < cell.struts.size(); ++strut) {
      Edge edge{ends[cell.struts[strut][0]], ends[cell.struts[strut][1]]};
      uint32_t back = 0;  // of the unit cell from the owner
      for (size_t axis = 0; axis < 3; ++axis) {
        const int32_t owner = std::min(edge.a.offset[axis], edge.b.offset[axis]);
        edge.a.offset[axis] -= owner;
        edge.b.offset[axis] -= owner;
        back |= static_cast<uint32_t>(owner) << axis;
      }
      const auto number = static_cast<uint32_t>(edges_.size());
      uint32_t known = number;
      for (const uint32_t node : {edge.a.node, edge.b.node})
        for (const uint32_t other : edges_of[node]) {
          const Edge& o = edges_[other];
          if ((is_same(o.a, edge.a) && is_same(o.b, edge.b)) ||
              (is_same(o.a, edge.b) && is_same(o.b, edge.a)))
            known = std::min(known, other);
        }
      if (known == number) edges_of[edge.a.node].push_back(number);
      edges_.push_back(edge);
      uses_[8 * type + back].push_back({known, cell.factor(strut)});
      max_factor_ = std::max(max_factor_, cell.factor(strut));
    }
  }
  for (uint32_t back = 0; back < 8; ++back)
    periodic_.insert(periodic_.end(), uses(0, back).begin(), uses(0, back).end());
  merge(periodic_);
}

void LatticeGraph::merge(std::vector<Use>& uses) {
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.factor > b.factor;
  });
  uses.erase(std::unique(uses.begin(), uses.end(),
                         [](const Use& a, const Use& b) { return a.edge == b.edge; }),
             uses.end());
}

LatticeStruts::LatticeStruts(const LatticeGraph& graph, const Neighbourhood& grid,
                             const Parameter& radius, const StrutSelection& selection)
    : graph_(graph),
      grid_(grid),
      radius_(radius),
      selection_(selection),
      cells_(grid, grid.to_grid(selection.around(graph.max_factor() * radius.range().high))) {
  const auto per_cell = static_cast<int64_t>(graph.edge_count());
  const auto fits = [&](int64_t side) {
    return side <= max_side && side * side * side * per_cell <= struts_in_block;
  };
  while (fits(side_ + 1)) ++side_;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t cells = std::max<int64_t>(0, cells_.last[axis] - cells_.first[axis] + 1);
    blocks_[axis] = static_cast<uint64_t>((cells + side_ - 1) / side_);
  }
}

std::unique_ptr<LatticeStruts::Finder> LatticeStruts::finder(const Block&) const {
  class Periodic final : public Finder {
   public:
    explicit Periodic(const std::vector<LatticeGraph::Use>& uses) : uses_(uses) {}
    const std::vector<LatticeGraph::Use>& find(int32_t, int32_t, int32_t) override { return uses_; }

   private:
    const std::vector<LatticeGraph::Use>& uses_;
  };
  return std::make_unique<Periodic>(graph_.periodic());
}

void LatticeStruts::append(uint64_t part, StrutList& list) const {
  Block block;
  uint64_t index = part;
  int64_t first[3];
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = cells_.first[axis] + static_cast<int64_t>(index % blocks_[axis]) * side_;
    block.size[axis] = static_cast<int32_t>(std::min(side_, cells_.last[axis] - first[axis] + 1));
    index /= blocks_[axis];
  }
  block.first = {static_cast<int32_t>(first[0]), static_cast<int32_t>(first[1]),
                 static_cast<int32_t>(first[2])};
  const std::unique_ptr<Finder> finder = this->finder(block);
  const size_t from = list.struts.size();
  const double max_radius = radius_.range().high;
  for (int32_t z = 0; z < block.size[2]; ++z)
    for (int32_t y = 0; y < block.size[1]; ++y) {
      check_cancelled();
      for (int32_t x = 0; x < block.size[0]; ++x) {
        const CellIndex cell{block.first.x + x, block.first.y + y, block.first.z + z};
        const auto place = [&](const LatticeGraph::End& end, Id& id) {
          const CellIndex owner{cell.x + end.offset[0], cell.y + end.offset[1],
                                cell.z + end.offset[2]};
          id = {static_cast<uint32_t>(owner.x) | uint64_t{static_cast<uint32_t>(owner.y)} << 32,
                static_cast<uint32_t>(owner.z) | uint64_t{end.node} << 32};
          const Vec3 corner{double(owner.x), double(owner.y), double(owner.z)};
          return grid_.from_grid((graph_.node(end.node) + corner) * grid_.cell_size);
        };
        for (const LatticeGraph::Use& use : finder->find(x, y, z)) {
          const LatticeGraph::Edge& edge = graph_.edge(use.edge);
          Strut strut;
          strut.a = place(edge.a, strut.nodes[0]);
          strut.b = place(edge.b, strut.nodes[1]);
          if (!selection_.selects(strut.a, strut.b, use.factor * max_radius)) continue;
          strut.id = {static_cast<uint32_t>(cell.x) | uint64_t{static_cast<uint32_t>(cell.y)} << 32,
                      static_cast<uint32_t>(cell.z) | uint64_t{use.edge} << 32};
          strut.cell = cell;
          strut.radii[0] = strut.radii[1] = use.factor * max_radius;
          list.add(strut, use.factor);
        }
      }
    }
  if (!radius_.is_constant()) set_radii(radius_, from, list);
}

double LatticeStruts::radius_at(const Strut&, double factor, double, Vec3 p) const {
  return factor * radius_.at(p);
}

}  // namespace msq
