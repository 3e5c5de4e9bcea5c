// SPDX-License-Identifier: Apache-2.0
// What the boundary does within a cell, where the line between its two crossings is too far from
// it: corners, and tight bends.
//
// ContourSuspects tells which pieces may be too far. Where the curvature through the crossings
// around is about even, and an arc with it would be far from its chord, the middle of the arc is
// taken if membership on both sides confirms it. Elsewhere membership beside the middle of the
// piece and its quarters tells whether it is near enough. If not, the point X where the lines
// through the points before and behind the piece meet is a corner where membership around X and
// around the middles of both sides says so. Otherwise the point on the boundary beside the piece's
// middle is found by bisection, and both halves are looked into likewise. The chord of one half
// then tells about the direction at the end of the other one: of several corners in a piece, each
// is found once there is only one in a half.
//
// All points found lie where ContourRoom says, so pieces of different cells never meet.
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "base/borrowed.h"
#include "base/memory.h"
#include "slice/contour_points.h"
#include "slice/contour_rings.h"
#include "slice/contour_room.h"
#include "slice/contour_suspects.h"

namespace msq {

/// A point that follows crossing `id` of a ring, before the next crossing. `order` is between 0
/// and 1.
struct DetailPoint {
  uint32_t id, next;  ///< `next`: the next crossing
  double order;
  Vec2 at;
};

class ContourDetails {
 public:
  /// `units`: coordinates will be multiplied by it and rounded; 0: they will not be rounded.
  /// `has_struts`: they give the crossings. `taken`: see ContourRoom.
  ContourDetails(const ContourRings& rings, double tolerance, double units, bool has_struts,
                 std::unordered_set<uint64_t>& taken)
      : rings_(rings),
        tolerance_(tolerance),
        units_(units),
        room_(rings, taken),
        suspects_(rings, tolerance, has_struts, room_) {
    memory_->pieces.clear();
    memory_->details.clear();
    memory_->runs.clear();
  }

  /// Takes its memory, and what the points found need afterwards, from the model's budget.
  void find(ContourPoints& points);

  /// In the order of crossings, and of points between two crossings.
  const std::vector<DetailPoint>& points() const { return memory_->details; }
  /// Cells where the boundary is farther than the tolerance from what was found.
  uint64_t unresolved() const { return unresolved_; }

 private:
  using Cell = ContourRings::Cell;
  using Beside = ContourRoom::Beside;
  using Piece = ContourPiece;
  struct Corner {
    bool is_possible = false;
    Vec2 at = {};
    Beside beside;  // if the piece's own cell does not hold the corner
  };
  struct Search {
    size_t piece;
    Vec2 same, other;  // membership as at the piece's middle, and not
    Beside beside;     // of the cells that `other` may lie in
    int axis;          // of the side where the normal leaves them
    bool is_high;
  };

  void settle(ContourPoints& points);
  void hold_memory();
  void take_arcs(ContourPoints& points);
  void find_sides(ContourPoints& points);
  void keep_bent(ContourPoints& points);
  void take_corners(ContourPoints& points);
  std::vector<Search> find_searches(ContourPoints& points);
  void bisect(std::vector<Search>& searches, ContourPoints& points) const;
  void split(ContourPoints& points);
  void begin_run();
  void merge_runs();
  size_t straighten(size_t first, size_t end);
  void finish_pieces();
  static bool do_lines_meet(const Piece& piece);
  Corner corner_of(const Piece& piece) const;
  Search search_of(size_t number, const Beside& beside) const;
  void keep_open(std::vector<Search>& searches, std::vector<Search>& closed,
                 ContourPoints& points) const;
  bool is_in_window(Vec2 p) const;
  Vec2 rounded(Vec2 p) const;

  const ContourRings& rings_;
  const double tolerance_, units_;
  ContourRoom room_;
  ContourSuspects suspects_;
  // Kept between calls: fresh memory of this size takes a while to get.
  struct Memory {
    std::vector<Piece> pieces, halves;
    std::vector<Corner> corners;  // of pieces
    std::vector<DetailPoint> details;
    std::vector<size_t> runs;  // where runs of details begin
    size_t bytes() const {
      return (pieces.capacity() + halves.capacity()) * sizeof(Piece) +
             corners.capacity() * sizeof(Corner) + details.capacity() * sizeof(DetailPoint);
    }
  };
  const Borrowed<Memory> memory_;
  Reservation held_;
  uint64_t unresolved_ = 0;
};

}  // namespace msq
