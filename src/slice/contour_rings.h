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
#include "slice/contour_gaps.h"
#include "slice/contour_gates.h"
#include "slice/contour_points.h"
#include "slice/contour_ring_kind.h"
#include "slice/contour_ring_walk.h"
#include "slice/contour_section.h"

namespace msq {

class ContourRings {
 public:
  /// `has_struts`: whether struts decide membership. `accuracy`: of crossings in divided cells.
  ContourRings(const ContourSection& section, ContourGaps& gaps, bool has_struts, double accuracy);

  /// Follows all rings of the section; its crossings then know the numbers of their rings. Calls
  /// visit() whenever there are some: then rings() and all else here tell of these alone.
  void follow_all(ContourSection& section, ContourPoints& points,
                  const std::function<void()>& visit);

  struct Ring {
    uint32_t first, end;  ///< its crossings
    uint32_t beside;      ///< the number among all rings of one that borders on the same; none if
                          ///< nothing is around both
    bool is_hole;
    bool is_closed;  ///< none of its crossings lies beyond the window
    bool is_inner;   ///< none of its cells touches an edge of the window
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

  bool is_horizontal(uint32_t i) const { return memory_->kinds[i] & ring_kind::horizontal; }
  /// Whether the first node of its edge is inside.
  bool starts_inside(uint32_t i) const { return memory_->kinds[i] & ring_kind::first_inside; }
  bool is_beyond(uint32_t i) const { return memory_->kinds[i] & ring_kind::beyond; }
  /// Whether it lies on an edge of the window.
  bool is_on_seam(uint32_t i) const { return memory_->kinds[i] & ring_kind::seam; }
  /// Whether it leads into a cell with four crossings, or into a divided one.
  bool is_before_saddle(uint32_t i) const { return memory_->kinds[i] & ring_kind::saddle; }

  /// Whether it lies between the finer nodes of a divided cell.
  bool is_fine(uint32_t i) const { return memory_->kinds[i] & ring_kind::fine; }

  /// The cell that follows a crossing; between finer nodes, the part of a cell.
  struct Cell {
    Vec2 low, high;
  };
  Cell cell_of(uint32_t i) const;
  /// Its column, and its row in the upper 32 bits.
  uint64_t place_of_cell(uint32_t i) const { return memory_->cells[i]; }
  const ContourGaps& gaps() const { return gaps_; }

  /// Of the crossings of a ring, finds the places and the gates. Both have room for them and for
  /// max_simd_doubles more. What lies beyond the window has no gate.
  void find_gates(const Ring& ring, double tolerance, Vec2* at, LineGate* gates) const;

  /// Of a section with so many crossings.
  static uint64_t bytes(uint64_t crossings);
  /// What is taken besides for a crossing of divided cells.
  static constexpr uint64_t bytes_of_gap_crossing =
      3 * sizeof(double) + sizeof(uint64_t) + sizeof(uint8_t) + 2 * sizeof(GapCrossing);

 private:
  /// Nodes along an axis, by their columns or rows; what the grid says of them, but without calls.
  struct Axis {
    double first, pitch, low, high;
    uint32_t first_inner, beyond, edge,
        end;  // beyond and edge: the lower ones; end: the upper edge

    double at(uint32_t n) const { return n >= end ? high : n < first_inner ? low : inner_at(n); }
    double inner_at(uint32_t n) const {
      return first + static_cast<double>(static_cast<int32_t>(n - first_inner)) * pitch;
    }
    bool is_edge(uint32_t n) const { return n == edge || n == end; }
    /// Of an edge of the grid, by its first node.
    bool is_beyond(uint32_t n) const { return n == beyond || n == end; }
  };

  struct Edge {
    uint32_t along, across;  // places of its first node along its direction and across it
    uint32_t axis;           // of its direction
  };
  Edge edge_of(uint32_t i) const;
  std::vector<GapCrossing>::const_iterator gap_crossing_from(uint32_t id) const;
  /// The number of the ring that is followed.
  uint32_t next_number() const { return rings_before_ + static_cast<uint32_t>(rings_.size()); }
  template <class Add, class AddFromGap>
  uint32_t follow_row(const ContourSection& section, std::span<const ContourGaps::Joint> joints,
                      uint32_t row, uint32_t id, Add&& add, AddFromGap&& add_from_gap);
  /// Adds a ring that begins with a crossing on a horizontal edge.
  void follow(ContourSection& section, uint32_t id, uint32_t column, uint32_t row, uint32_t beside,
              const Job* job);
  /// Adds a ring that begins on a joint of divided cells.
  void follow_from_gap(ContourSection& section, const ContourGaps::Place& start, bool goes_up,
                       uint32_t beside, const Job* job);
  /// Follows a ring from a place until crossing `first` comes again; or, where `start` is given,
  /// from there until it comes again. Returns whether the ring is inner.
  bool go_around(ContourSection& section, RingPlace place, uint32_t first,
                 const ContourGaps::Place* start, const Job* job);
  /// Follows a ring through divided cells, to the place where it leaves them. False if `start`
  /// comes again before.
  bool go_through(const ContourSection& section, ContourGaps::Place at,
                  const ContourGaps::Place* start, RingPlace& place, const Job* job);
  void put_crossing(double end, uint64_t cell, int kind);
  void make_room();
  void place(ContourPoints& points);
  void place_at_edges(Ring& ring);

  const ContourGrid& grid_;
  ContourGaps& gaps_;
  const double accuracy_;
  const uint32_t at_once_;
  const Axis axes_[2];
  const double margin_;
  std::vector<Ring> rings_;
  uint32_t rings_before_ = 0;  // rings of earlier visits
  std::vector<GapCrossing> gap_crossings_;
  const RingNodes nodes_;
  const RingSteps steps_;
  // Kept between calls: fresh memory of this size takes a while to get. May hold more than count_,
  // and what vectors read and write beyond it.
  struct Memory {
    std::vector<double> x, y, ends;  // ends: as the section has them
    std::vector<uint64_t> cells;     // that follow crossings: see RingCrossings
    std::vector<uint8_t> kinds;      // see ring_kind
    void resize(size_t size) {
      x.resize(size);
      y.resize(size);
      ends.resize(size);
      cells.resize(size);
      kinds.resize(size);
    }
    size_t bytes() const {
      return (x.capacity() + y.capacity() + ends.capacity()) * sizeof(double) +
             cells.capacity() * sizeof(uint64_t) + kinds.capacity();
    }
  };
  const Borrowed<Memory> memory_;
  const uint32_t most_;
  uint32_t room_, count_ = 0;
};

}  // namespace msq
