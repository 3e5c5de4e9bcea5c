// SPDX-License-Identifier: Apache-2.0
// The boundary of a layer as the grid of its nodes sees it: a crossing on each edge between a node
// inside and one outside, and for each crossing the next one along the boundary, with the inside on
// the left.
// Source: marching squares, the plane case of Lorensen and Cline, "Marching cubes", 1987. Where
// four crossings meet in a cell, membership of its centre tells which two belong together (Nielson
// and Hamann, "The asymptotic decider", 1991, ask a bilinear function).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "slice/contour_grid.h"
#include "slice/contour_points.h"

namespace msq {

/// On the edge from node (column, row) to the next one, along u where horizontal, else along v.
struct Crossing {
  uint32_t column, row;
  double at;  ///< u or v
};

class ContourSection {
 public:
  /// `margin`: from nodes, in model units.
  ContourSection(const ContourGrid& grid, double margin) : grid_(grid), margin_(margin) {}

  /// Counts crossings. Throws Error(limit) for 2^32 of them.
  uint64_t count_crossings(const Job* job);
  /// Finds where they are, within `accuracy`, and links them. After count_crossings().
  void trace(ContourPoints& points, double accuracy);

  const ContourGrid& grid() const { return grid_; }
  double margin() const { return margin_; }

  /// Horizontal ones come first, each kind row by row.
  uint32_t count() const { return static_cast<uint32_t>(crossings_.size()); }
  uint32_t horizontal_count() const { return horizontal_count_; }
  /// The first one of a row among the horizontal ones.
  uint32_t row_start(uint32_t row) const { return horizontal_start_[row]; }
  bool is_horizontal(uint32_t id) const { return id < horizontal_count_; }
  const Crossing& operator[](uint32_t id) const { return crossings_[id]; }
  uint32_t next(uint32_t id) const { return next_[id]; }

  bool is_beyond(uint32_t id) const {
    return grid_.is_beyond(is_horizontal(id), crossings_[id].column, crossings_[id].row);
  }
  /// Whether it lies on an edge of the window.
  bool is_on_seam(uint32_t id) const {
    const Crossing& c = crossings_[id];
    return is_horizontal(id) ? c.row == grid_.bottom_edge() || c.row == grid_.top_edge()
                             : c.column == ContourGrid::left_edge || c.column == grid_.right_edge();
  }
  Vec2 at(uint32_t id) const { return places_[id]; }
  /// Whether the first node of its edge is inside.
  bool starts_inside(uint32_t id) const {
    return grid_.inside(crossings_[id].column, crossings_[id].row);
  }
  /// Ends of its edge.
  double low(uint32_t id) const {
    const Crossing& c = crossings_[id];
    return is_horizontal(id) ? grid_.u(c.column) : grid_.v(c.row);
  }
  double high(uint32_t id) const {
    const Crossing& c = crossings_[id];
    return is_horizontal(id) ? grid_.u(c.column + 1) : grid_.v(c.row + 1);
  }

  /// A cell, by its lowest node, and the crossing where a piece of the boundary comes in.
  struct Saddle {
    uint32_t column, row;
    uint32_t ids[4];  ///< bottom, right, top, left
    bool is_rising;   ///< the nodes at the lower left and the upper right are inside
  };
  const std::vector<Saddle>& saddles() const { return saddles_; }

  static constexpr uint64_t bytes_of_crossing = sizeof(Crossing) + sizeof(Vec2) + sizeof(uint32_t);

 private:
  void list_crossings(const Job* job);
  void link(const Job* job);
  void settle_saddles(ContourPoints& points);
  void locate(ContourPoints& points, double accuracy);
  void locate_by_struts(const ContourPoints& points, const Structure& structure);
  void index_words();
  /// The crossing of an edge, if it has one that another solid has not nearer to the node inside.
  void propose(bool is_horizontal, uint32_t column, uint32_t row, bool enters, double at) {
    const size_t w = column / 64;
    const uint64_t edges = is_horizontal ? horizontal(row, w) : vertical(row, w);
    const uint64_t bit = uint64_t{1} << (column % 64);
    if (!(edges & bit)) return;
    const size_t word = row * grid_.row_words() + w;
    const uint32_t first = is_horizontal ? horizontal_index_[word] : vertical_index_[word];
    const uint32_t id = first + static_cast<uint32_t>(std::popcount(edges & (bit - 1)));
    if (starts_inside(id) == enters) return;
    double& known = crossings_[id].at;
    known = enters ? std::min(known, at) : std::max(known, at);
  }
  void place();
  void locate_some(ContourPoints& points, const uint32_t* ids, size_t count, double accuracy);

  /// Edges of a row that have crossings, as bits.
  uint64_t horizontal(uint32_t row, size_t w) const {
    const uint64_t* bits = grid_.row(row);
    const uint64_t beyond = w + 1 < grid_.row_words() ? bits[w + 1] << 63 : 0;
    return bits[w] ^ (bits[w] >> 1 | beyond);
  }
  uint64_t vertical(uint32_t row, size_t w) const {
    return grid_.row(row)[w] ^ grid_.row(row + 1)[w];
  }

  const ContourGrid& grid_;
  const double margin_;
  uint32_t horizontal_count_ = 0;
  std::vector<uint32_t> horizontal_start_, vertical_start_;  // by row
  std::vector<uint32_t> horizontal_index_, vertical_index_;  // first of each word
  std::vector<Crossing> crossings_;
  std::vector<Vec2> places_;
  std::vector<uint32_t> next_;
  std::vector<Saddle> saddles_;
};

}  // namespace msq
