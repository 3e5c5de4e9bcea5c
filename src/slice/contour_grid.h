// SPDX-License-Identifier: Apache-2.0
// The nodes that the contours of a layer are found from: a lattice of the plane, and the edges of a
// window, each node one bit.
//
// Nodes of the lattice lie at (k + 5/16) * pitch for whole k, whatever the window. A pitch has
// three binary digits, so these numbers are exact, and windows that overlap agree on them to the
// last bit. The shift keeps nodes off faces at round coordinates. The lattice lines within a
// quarter of a pitch of a window's edge are left out, and the edge itself is a line of nodes. So
// windows that share an edge share its nodes.
//
// Beyond each edge lies one more line of nodes at the same place, all outside: contours close along
// the edges.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/borrowed.h"
#include "base/job.h"
#include "base/vec.h"
#include "model/model.h"

namespace msq {

/// A plane normal to an axis. Its coordinates (u, v) are the other two, in their order.
struct LayerPlane {
  int axis = 2;
  double height = 0;  ///< in the model's unit
  /// The length that u and v count: a power of two, so coordinates have the same digits in any
  /// unit. Contours have one near the pitch: then products of many lengths, such as the eighth
  /// powers of find_bends(), neither overflow nor underflow.
  double unit = 1;

  int u_axis() const { return axis == 0 ? 1 : 0; }
  int v_axis() const { return axis == 2 ? 1 : 2; }
  Vec3 at(double u, double v) const {
    u *= unit;
    v *= unit;
    return axis == 0 ? Vec3{height, u, v} : axis == 1 ? Vec3{u, height, v} : Vec3{u, v, height};
  }
};

struct GridNode {
  uint32_t column, row;
};

/// Of an axis of the window: positions of its nodes.
class ContourAxis {
 public:
  /// Throws Error(limit) if there would be 2^31 nodes or more, or if the coordinates have too few
  /// digits for them.
  static void check(double low, double high, double pitch, const char* name);

  /// Of what check() passes, in any unit.
  ContourAxis(double low, double high, double pitch);

  double low() const { return low_; }
  double high() const { return high_; }
  /// Nodes of the lattice between the edges.
  uint64_t inner() const { return inner_; }
  double first() const { return first_; }
  /// The edge between nodes that holds a position, which lies between low() and high(): from node
  /// edge - 1 of the lattice to the next, or to an end.
  uint32_t edge_of(double at) const {
    const double i = (at - first_) * inverse_pitch_;
    return i < 0 ? 0 : static_cast<uint32_t>(std::min(i + 1, static_cast<double>(inner_)));
  }
  double pitch() const { return pitch_; }
  double inverse_pitch() const { return inverse_pitch_; }
  /// Which nodes of the lattice lie in a range, as whole numbers; false if none does.
  bool inner_between(double low, double high, double& first, double& last) const {
    if (inner_ == 0) return false;
    first = std::max(0.0, std::ceil((low - first_) * inverse_pitch_));
    last = std::min(static_cast<double>(inner_ - 1), std::floor((high - first_) * inverse_pitch_));
    return first <= last;
  }
  /// Calls visit(n, position) for the nodes from low to high: node 0 is the lower end.
  template <class Visit>
  void for_nodes(double low, double high, Visit&& visit) const {
    if (low <= low_ && low_ <= high) visit(0, low_);
    double from, to;
    if (inner_between(low, high, from, to))
      for (double i = from; i <= to; ++i) visit(static_cast<uint32_t>(i) + 1, first_ + i * pitch_);
    if (low <= high_ && high_ <= high) visit(static_cast<uint32_t>(inner_ + 1), high_);
  }
  double inner_at(uint64_t i) const { return first_ + static_cast<double>(i) * pitch_; }

 private:
  double low_, high_, pitch_, inverse_pitch_, first_ = 0;
  uint64_t inner_ = 0;
};

/// Edges of the grid that begin at the nodes of a word, all horizontal or all vertical ones.
struct EdgeWord {
  uint64_t bits;   ///< whether they lead from a node inside to one outside, or back
  uint32_t first;  ///< the number of the first crossing on them, or on later ones

  /// The number of the crossing on an edge, by its place in the word.
  uint32_t crossing(uint32_t bit) const {
    return first + static_cast<uint32_t>(std::popcount(bits & ((uint64_t{1} << bit) - 1)));
  }
};

class ContourPoints;
class PlaneStruts;

class ContourGrid {
 public:
  /// See ContourAxis::check().
  static void check(LayerPlane plane, const double window_min[2], const double window_max[2],
                    double pitch);

  /// The window and the pitch are in the plane's unit.
  ContourGrid(LayerPlane plane, const double window_min[2], const double window_max[2],
              double pitch);

  /// A grid with the same nodes, of which none is found yet.
  ContourGrid alike() const {
    const double low[2] = {u_.low(), v_.low()}, high[2] = {u_.high(), v_.high()};
    return ContourGrid(plane_, low, high, pitch_);
  }

  const LayerPlane& plane() const { return plane_; }
  double pitch() const { return pitch_; }

  /// Columns are bits of a row's words. The inner ones begin with a word.
  static constexpr uint32_t first_inner = 64, left_edge = 63, left_beyond = 62;
  static constexpr uint32_t bottom_row = 1, first_inner_row = 2;
  uint32_t right_edge() const { return static_cast<uint32_t>(first_inner + u_.inner()); }
  uint32_t bottom_edge() const { return bottom_row; }
  uint32_t top_edge() const { return static_cast<uint32_t>(2 + v_.inner()); }
  uint32_t rows() const { return top_edge() + 2; }
  size_t row_words() const { return row_words_; }
  uint64_t words() const { return row_words_ * rows(); }

  double u(uint32_t column) const {
    return column >= right_edge() ? u_.high()
           : column < first_inner ? u_.low()
                                  : u_.inner_at(column - first_inner);
  }
  double v(uint32_t row) const {
    return row >= top_edge() ? v_.high() : row < 2 ? v_.low() : v_.inner_at(row - 2);
  }
  /// Whether it lies beyond an edge, or between the edge and what is beyond it.
  bool is_beyond(bool horizontal, uint32_t column, uint32_t row) const {
    return horizontal ? column == left_beyond || column == right_edge()
                      : row == 0 || row == top_edge();
  }

  /// Whether all nodes of a cell are inner; the cell is named by its first one.
  bool is_inner_cell(uint32_t column, uint32_t row) const {
    return column >= first_inner && column + 1 < right_edge() && row >= first_inner_row &&
           row + 1 < top_edge();
  }

  /// Bytes of memory that find_nodes() takes, and what the grid then keeps.
  uint64_t bytes(const Model& model, const Scales& resolved) const;
  /// Finds which nodes are inside.
  void find_nodes(const Model& model, const Scales& resolved, const Job* job);
  /// The same for a model of one structure with struts and no skin. `shape`: the nodes in the shape
  /// alone. `points`: uses the struts.
  void find_nodes(const PlaneStruts& struts, const ContourGrid& shape, ContourPoints& points);
  const ContourAxis& u_nodes() const { return u_; }
  const ContourAxis& v_nodes() const { return v_; }

  const uint64_t* row(uint32_t row) const { return memory_->bits.data() + row * row_words_; }
  bool inside(uint32_t column, uint32_t row) const {
    return this->row(row)[column / 64] >> (column % 64) & 1;
  }

 private:
  /// Some nodes: `across` from u on, in a row; and so many rows from v on.
  struct Part {
    double u, v;
    uint64_t across, rows;
    uint32_t column, row;  // of the first
  };
  void find_part(const Model& model, const Scales& resolved, const Part& part, const Job* job);
  void put_row(const uint64_t* words, const Part& part, uint32_t row);

  LayerPlane plane_;
  ContourAxis u_, v_;
  double pitch_;
  size_t row_words_;
  // Kept between calls: fresh memory of this size takes a while to get.
  struct Memory {
    std::vector<uint64_t> bits;
    size_t bytes() const { return bits.capacity() * sizeof(uint64_t); }
  };
  const Borrowed<Memory> memory_;
};

}  // namespace msq
