// SPDX-License-Identifier: Apache-2.0
// Where the points may lie that contours have between two crossings, so that rings never meet:
// within the cell that holds both crossings, away from its sides.
//
// The boundary may leave that cell through a side that no crossing shows, with a corner or a bend.
// Then its points may lie in the cell beside too, if the boundary meets no edge of that cell at a
// node's scale (its nodes are alike), and no other piece has it. Both cells together are convex, so
// the lines between the points stay within them, also those that leave points out.
#pragma once

#include <cstdint>
#include <unordered_set>

#include "base/vec2.h"
#include "slice/contour_rings.h"

namespace msq {

class ContourRoom {
 public:
  using Cell = ContourRings::Cell;
  /// The cell across a side of a crossing's cell; none if `place` is 0.
  struct Beside {
    uint64_t place = 0;
    int axis = 0;  ///< across the side
    bool is_high = false;
  };

  /// `taken`: the cells beside that pieces have; kept for all rings of a layer.
  ContourRoom(const ContourRings& rings, std::unordered_set<uint64_t>& taken)
      : rings_(rings), taken_(taken) {}

  /// The cell across a side of the cell that follows a crossing; none if no point may lie there.
  Beside beside(uint32_t id, int axis, bool is_high) const;
  /// The cell that follows a crossing, with the one beside it.
  Cell cells(uint32_t id, const Beside& beside) const;
  /// Whether a point behind the crossing may lie at p.
  bool holds(uint32_t id, const Beside& beside, Vec2 p) const;
  /// For one piece. False if another one has it. True if there is none to take.
  bool take(const Beside& beside);
  uint64_t bytes() const { return taken_.size() * 6 * sizeof(uint64_t); }

 private:
  const ContourRings& rings_;
  std::unordered_set<uint64_t>& taken_;
};

}  // namespace msq
