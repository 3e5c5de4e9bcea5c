// SPDX-License-Identifier: Apache-2.0
// The boundary of a layer as the grid of its nodes sees it: a crossing on each edge between a node
// inside and one outside, and what cells with four crossings connect.
// Source: marching squares, the plane case of Lorensen and Cline, "Marching cubes", 1987. Where
// four crossings meet in a cell, membership of its centre tells which two belong together (Nielson
// and Hamann, "The asymptotic decider", 1991, ask a bilinear function).
//
// Crossings are numbered as the grid is scanned, horizontal edges first, so that struts and
// ContourRings find them by edge.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "base/borrowed.h"
#include "slice/contour_grid.h"
#include "slice/contour_points.h"
#include "slice/contour_struts.h"

namespace msq {

class ContourSection {
 public:
  /// `margin`: from nodes, in model units.
  ContourSection(const ContourGrid& grid, double margin) : grid_(grid), margin_(margin) {}

  /// Counts crossings. Throws Error(limit) for 2^32 of them.
  uint64_t count_crossings(const Job* job);
  /// Finds where they are, within `accuracy`, and links them. After count_crossings(). `struts`: of
  /// the only structure, which `points` uses, too; `shape`: nodes in the shape alone. Or both null.
  void trace(ContourPoints& points, double accuracy, const PlaneStruts* struts,
             const ContourGrid* shape);

  const ContourGrid& grid() const { return grid_; }
  double margin() const { return margin_; }

  /// Horizontal ones come first, each kind row by row.
  uint32_t count() const { return crossing_count_; }
  /// On horizontal edges of a row, as bits; the edge of a bit leads from its node to the next one.
  uint64_t horizontal(uint32_t row, size_t w) const {
    const uint64_t* bits = grid_.row(row);
    const uint64_t beyond = w + 1 < grid_.row_words() ? bits[w + 1] << 63 : 0;
    return bits[w] ^ (bits[w] >> 1 | beyond);
  }
  /// On edges from a row to the next.
  uint64_t vertical(uint32_t row, size_t w) const {
    return grid_.row(row)[w] ^ grid_.row(row + 1)[w];
  }

  /// Row by row, and one row more without crossings.
  const EdgeWord* horizontal_edges() const { return memory_->edges.data(); }
  const EdgeWord* vertical_edges() const { return memory_->edges.data() + edge_words(); }
  bool is_horizontal(uint32_t id) const { return id < horizontal_count_; }
  /// The crossing of an edge, by its first node.
  uint32_t crossing_of(bool is_horizontal, uint32_t column, uint32_t row) const {
    const EdgeWord* const edges = is_horizontal ? horizontal_edges() : vertical_edges();
    return edges[row * grid_.row_words() + column / 64].crossing(column % 64);
  }
  /// By crossing on a horizontal edge: the number of its ring, which ContourRings sets; until then
  /// no_ring. One more number has no meaning.
  uint32_t* rings() { return memory_->rings.data(); }
  static constexpr uint32_t no_ring = UINT32_MAX;
  uint32_t ring(uint32_t id) const { return memory_->rings[id]; }
  /// u or v of each crossing, and its negative where the first node of the edge is inside. Struts
  /// give some that are nearer to a node than the margin, or beyond it. Those beyond the window
  /// have no meaning.
  const double* ends() const { return memory_->ends.data(); }
  /// Brings what is known of the crossings of a row of cells near the core.
  void prefetch(uint32_t row) const;

  /// A cell with four crossings.
  struct Saddle {
    uint32_t column, row;
    bool is_rising;    ///< the nodes at the lower left and the upper right are inside
    bool turns_right;  ///< bottom and right belong together, and top and left; else the others do
  };
  /// In the order of rows and columns.
  const std::vector<Saddle>& saddles() const { return saddles_; }
  const Saddle& saddle_at(uint32_t column, uint32_t row) const;

  /// Cells where one sample decided what belongs together, and those that a strut passes through
  /// without a node in it.
  uint64_t unresolved() const { return saddles_.size() + unseen_; }

  /// Bytes of a crossing.
  static constexpr uint64_t bytes_of_crossing = sizeof(uint32_t) + sizeof(double);
  /// Bytes of the edges of a grid.
  static uint64_t bytes_of_edges(const ContourGrid& grid) {
    return 2 * (grid.words() + grid.row_words()) * sizeof(EdgeWord);
  }

 private:
  struct Edge {
    uint32_t id, column, row;
    bool is_horizontal;
  };
  /// Of the horizontal edges, or of the vertical ones.
  size_t edge_words() const { return grid_.words() + grid_.row_words(); }
  void find_saddles(const Job* job);
  void settle_saddles(ContourPoints& points);
  void count_unseen(const PlaneStruts& struts, ContourPoints& points);
  void locate(ContourPoints& points, double accuracy, const PlaneStruts* struts,
              const ContourGrid* shape);
  template <class Take>
  void for_open_edges(const ContourGrid& shape, const Job* job, Take&& take) const;
  void locate_some(ContourPoints& points, const std::vector<Edge>& edges, double accuracy);

  const ContourGrid& grid_;
  const double margin_;
  uint32_t horizontal_count_ = 0, crossing_count_ = 0;
  // Kept between calls: fresh memory of this size takes a while to get. May hold more than count().
  struct Memory {
    std::vector<double> ends;
    std::vector<uint32_t> rings;
    std::vector<EdgeWord> edges;
    size_t bytes() const {
      return ends.capacity() * sizeof(double) + rings.capacity() * sizeof(uint32_t) +
             edges.capacity() * sizeof(EdgeWord);
    }
  };
  const Borrowed<Memory> memory_;
  std::vector<Saddle> saddles_;
  std::vector<uint32_t> saddle_rows_;  // the first saddle of each row
  uint64_t unseen_ = 0;
};

}  // namespace msq
