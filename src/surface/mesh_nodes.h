// SPDX-License-Identifier: Apache-2.0
// Membership of the nodes of some layers of a mesh's grid, as bits, and the edges between unlike
// nodes.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "base/job.h"
#include "model/model.h"
#include "surface/mesh_grid.h"

namespace msq {

class MeshNodes {
 public:
  MeshNodes(const Model& model, const Scales& resolved, const MeshGrid& grid)
      : model_(model),
        resolved_(resolved),
        grid_(grid),
        row_words_(grid.row_words()),
        layer_words_(row_words_ * grid.nodes(1)) {}

  const MeshGrid& grid() const { return grid_; }
  size_t row_words() const { return row_words_; }
  /// Bytes of memory for so many layers of cells.
  uint64_t bytes(uint64_t layers) const;

  /// Finds the nodes of layers first to last. Layers from `first` on that are known stay.
  void load(uint32_t first, uint32_t last, const Job* job);

  const uint64_t* row(uint32_t layer, uint32_t row) const {
    return bits_.data() + (layer - first_) * layer_words_ + row * row_words_;
  }
  bool inside(uint32_t column, uint32_t row, uint32_t layer) const {
    return this->row(layer, row)[column / 64] >> (column % 64) & 1;
  }

  /// Rows of edges along an axis in a layer. Edges along z are those up from the layer.
  uint32_t edge_rows(int axis) const { return grid_.nodes(1) - (axis == 1); }
  /// Bit i: whether there is a crossing on the edge along an axis from node (i, row, layer).
  uint64_t edges(int axis, uint32_t layer, uint32_t row, size_t w) const {
    const uint64_t* nodes = this->row(layer, row);
    if (axis == 1) return nodes[w] ^ this->row(layer, row + 1)[w];
    if (axis == 2) return nodes[w] ^ this->row(layer + 1, row)[w];
    return nodes[w] ^ (nodes[w] >> 1 | (w + 1 < row_words_ ? nodes[w + 1] << 63 : 0));
  }

  /// Calls visit(i, corners) for each cell (i, j, k) with corners inside and outside, in order.
  template <class Visit>
  void for_each_cell(uint32_t j, uint32_t k, Visit&& visit) const {
    const uint64_t* rows[4] = {row(k, j), row(k, j + 1), row(k + 1, j), row(k + 1, j + 1)};
    for (size_t w = 0; w < row_words_; ++w) {
      uint64_t here[4], next[4];
      uint64_t any = 0, all = ~uint64_t{0};
      for (size_t r = 0; r < 4; ++r) {
        here[r] = rows[r][w];
        next[r] = here[r] >> 1 | (w + 1 < row_words_ ? rows[r][w + 1] << 63 : 0);
        any |= here[r] | next[r];
        all &= here[r] & next[r];
      }
      for (uint64_t rest = any & ~all; rest; rest &= rest - 1) {
        const unsigned bit = static_cast<unsigned>(std::countr_zero(rest));
        unsigned corners = 0;
        for (unsigned r = 0; r < 4; ++r)
          corners |= static_cast<unsigned>(here[r] >> bit & 1) << (2 * r) |
                     static_cast<unsigned>(next[r] >> bit & 1) << (2 * r + 1);
        visit(static_cast<uint32_t>(w * 64 + bit), corners);
      }
    }
  }

 private:
  const Model& model_;
  const Scales& resolved_;
  const MeshGrid& grid_;
  size_t row_words_, layer_words_;
  uint32_t first_ = 0, end_ = 0;  // layers that are known
  std::vector<uint64_t> bits_, raw_;
};

}  // namespace msq
