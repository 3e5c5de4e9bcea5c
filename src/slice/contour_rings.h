// SPDX-License-Identifier: Apache-2.0
// The crossings of a section ring by ring, each ring as a run of an array. What follows reads them
// in that order, again and again, so each ring is followed through the section just once.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/borrowed.h"
#include "base/job.h"
#include "base/vec2.h"
#include "slice/contour_section.h"

namespace msq {

/// The edge of a crossing.
struct RingEdge {
  uint32_t column, row;
};

class ContourRings {
 public:
  explicit ContourRings(const ContourSection& section);

  /// Follows all rings of the section; its crossings then know the numbers of their rings. Calls
  /// visit() whenever there are some: then rings() and all else here tell of these alone.
  void follow_all(ContourSection& section, const Job* job, const std::function<void()>& visit);

  struct Ring {
    uint32_t first, end;  ///< its crossings
    uint32_t beside;      ///< the number among all rings of one that borders on the same; none if
                          ///< nothing is around both
    bool is_hole;
    bool is_closed;  ///< none of its crossings lies beyond the window
  };
  static constexpr uint32_t none = UINT32_MAX;
  /// In the order of their lowest rows.
  const std::vector<Ring>& rings() const { return rings_; }

  const ContourGrid& grid() const { return grid_; }
  double margin() const { return margin_; }
  uint32_t count() const { return count_; }
  Vec2 at(uint32_t i) const { return {memory_->x[i], memory_->y[i]}; }
  /// Coordinates of all crossings.
  const double* x() const { return memory_->x.data(); }
  const double* y() const { return memory_->y.data(); }

  bool is_horizontal(uint32_t i) const { return memory_->kinds[i] & horizontal; }
  /// Whether the first node of its edge is inside.
  bool starts_inside(uint32_t i) const { return memory_->kinds[i] & first_inside; }
  bool is_beyond(uint32_t i) const { return memory_->kinds[i] & beyond; }
  /// Whether it lies on an edge of the window.
  bool is_on_seam(uint32_t i) const { return memory_->kinds[i] & seam; }
  bool is_before_saddle(uint32_t i) const { return memory_->kinds[i] & saddle; }

  /// The cell that follows a crossing.
  struct Cell {
    Vec2 low, high;
  };
  Cell cell_of(uint32_t i) const;
  struct Ends {
    double low, high;
  };
  /// Of the edge.
  Ends ends(uint32_t i) const {
    const Axis& axis = axes_[axis_along(i)];
    const uint32_t n = place_along(i);
    if (axis.are_inner(n)) return {axis.inner_at(n), axis.inner_at(n + 1)};
    return {axis.at(n), axis.at(n + 1)};
  }
  /// Of the edge: 0 if it is horizontal, else 1.
  uint32_t axis_along(uint32_t i) const { return ~uint32_t{memory_->kinds[i]} & horizontal; }

  static constexpr uint64_t bytes_of_crossing = 2 * sizeof(double) + sizeof(RingEdge) + 1;

 private:
  enum : uint8_t { horizontal = 1, first_inside = 2, beyond = 4, seam = 8, saddle = 16 };
  static constexpr int first_inside_bit = 1;

  /// Nodes along an axis, by their columns or rows; what the grid says of them, but without calls.
  struct Axis {
    double first, pitch, low, high;
    uint32_t first_inner, beyond, edge,
        end;  // beyond and edge: the lower ones; end: the upper edge

    double at(uint32_t n) const { return n >= end ? high : n < first_inner ? low : inner_at(n); }
    double inner_at(uint32_t n) const {
      return first + static_cast<double>(static_cast<int32_t>(n - first_inner)) * pitch;
    }
    /// Whether a node and the next one lie between the edges. Nearly all do.
    bool are_inner(uint32_t n) const { return n >= first_inner && n + 1 < end; }
    bool is_edge(uint32_t n) const { return n == edge || n == end; }
    /// Of an edge of the grid, by its first node.
    bool is_beyond(uint32_t n) const { return n == beyond || n == end; }
  };

  /// Whether the ring is closed.
  bool follow(ContourSection& section, uint32_t id, uint32_t column, uint32_t row, const Job* job);
  uint32_t place_along(uint32_t i) const {
    const RingEdge& e = memory_->edges[i];
    return is_horizontal(i) ? e.column : e.row;
  }

  const ContourGrid& grid_;
  const Axis axes_[2];
  const double margin_;
  std::vector<Ring> rings_;
  uint32_t rings_before_ = 0;  // rings of earlier visits
  // Kept between calls: fresh memory of this size takes a while to get. May hold more than count_.
  struct Memory {
    std::vector<double> x, y;
    std::vector<RingEdge> edges;
    std::vector<uint8_t> kinds;
    size_t bytes() const {
      return (x.capacity() + y.capacity()) * sizeof(double) + edges.capacity() * sizeof(RingEdge) +
             kinds.capacity();
    }
  };
  const Borrowed<Memory> memory_;
  uint32_t count_ = 0;
};

}  // namespace msq
