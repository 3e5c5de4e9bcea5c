// SPDX-License-Identifier: Apache-2.0
// Where the boundary crosses the edges of a mesh's grid, and its normals there: rays along the
// edges find both, as exactly as rays are.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/job.h"
#include "model/model.h"
#include "surface/cell_loops.h"
#include "surface/mesh_nodes.h"

namespace msq {

struct Crossing {
  double at;  ///< along the edge's axis
  Vec3 normal;
  uint32_t column, row;
  /// Of the four cells around the edge, by place_around_edge().
  std::array<uint32_t, 4> vertices;
};

class MeshEdges {
 public:
  MeshEdges(const Model& model, const Scales& resolved, const MeshNodes& nodes)
      : model_(model), resolved_(resolved), nodes_(nodes) {}

  /// Along one axis in a layer, row by row.
  struct Edges {
    std::vector<uint32_t> starts;  ///< of each row, and the end
    std::vector<Crossing> crossings;
  };

  /// Number of crossings that find() finds for a layer of cells.
  uint64_t count(uint32_t k) const;
  /// Finds those on the edges of the cells of layers [first, end), which are loaded. Forgets those
  /// of layers before them.
  void find(uint32_t first, uint32_t end, Job* job);

  const Edges& edges(int axis, uint32_t layer) const {
    return layers_[layer - first_][static_cast<size_t>(axis)];
  }
  Edges& edges(int axis, uint32_t layer) {
    return layers_[layer - first_][static_cast<size_t>(axis)];
  }
  Vec3 point(int axis, uint32_t layer, const Crossing& crossing) const;

  /// Calls visit(i, corners, loops, edges) for each cell of a row of a topology; `edges` has the
  /// crossings of the cell, where there are any.
  template <class Topology, class Visit>
  void for_each_cell(const Topology& topology, uint32_t j, uint32_t k, Visit&& visit);

 private:
  /// Finds the crossing at a column of a row of edges, for columns that ascend.
  class Row {
   public:
    Row() = default;
    Row(MeshEdges& all, int axis, uint32_t layer, uint32_t row)
        : nodes_(&all.nodes_),
          crossings_(all.edges(axis, layer).crossings.data()),
          id_(all.edges(axis, layer).starts[row]),
          axis_(axis),
          layer_(layer),
          row_(row),
          word_(nodes_->edges(axis, layer, row, 0)) {}
    /// At column 64 * w + bit, and `next` behind it: the one there, or the one behind the last
    /// before it.
    Crossing* at(size_t w, unsigned bit, unsigned next) {
      while (w_ < w) {
        id_ += static_cast<uint32_t>(std::popcount(word_));
        word_ = nodes_->edges(axis_, layer_, row_, ++w_);
      }
      const uint64_t below = (uint64_t{1} << bit) - 1;
      const uint64_t before = next ? below << 1 | 1 : below;
      return crossings_ + id_ + std::popcount(word_ & before);
    }

   private:
    const MeshNodes* nodes_ = nullptr;
    Crossing* crossings_ = nullptr;
    uint32_t id_ = 0;
    int axis_ = 0;
    uint32_t layer_ = 0, row_ = 0;
    size_t w_ = 0;
    uint64_t word_ = 0;
  };

  struct Part {
    int axis;
    uint32_t layer;
    uint64_t first;  // of the rays
  };
  void list(int axis, uint32_t layer);
  void locate(const std::vector<Part>& parts, uint64_t count, Job* job);

  const Model& model_;
  const Scales& resolved_;
  const MeshNodes& nodes_;
  uint32_t first_ = 0;
  std::vector<std::array<Edges, 3>> layers_;  // from first_ on
};

template <class Topology, class Visit>
void MeshEdges::for_each_cell(const Topology& topology, uint32_t j, uint32_t k, Visit&& visit) {
  // By edge of a cell; those that differ in x share a row.
  std::array<Row, 12> rows;
  for (unsigned e = 0; e < 12; ++e) {
    const std::array<uint8_t, 3> d = offset_of_edge(e);
    if (d[0] == 0) rows[e] = Row(*this, axis_of_edge(e), k + d[2], j + d[1]);
  }
  topology.for_each_cell(j, k, [&](uint32_t i, unsigned corners, const CellLoops& loops) {
    std::array<Crossing*, 12> crossings{};
    for (unsigned e = 0; e < 12; ++e) {
      if (loops.of_edge[e] == CellLoops::none) continue;
      const unsigned dx = offset_of_edge(e)[0];
      crossings[e] = rows[e - dx].at(i / 64, i % 64, dx);
    }
    visit(i, corners, loops, crossings);
  });
}

}  // namespace msq
