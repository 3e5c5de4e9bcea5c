// SPDX-License-Identifier: Apache-2.0
// The steps that lead from the rings of a layer to the topology of a mask that is finer than their
// grid.
//
// Solid samples of the mask are connected if they share a side or a corner, empty ones if they
// share a side. Samples on an edge belong to both of its cells, so all follows from the cells one
// by one.
//
// In a cell, the mask has curves between its parts: arcs that join transitions on the cell's sides,
// and closed ones. The rings have one transition on a side at most, and arcs that join them. Cells
// that share a side where the mask has more make a group, since the mask's curves may go there and
// back. Around a group both have the same transitions. Steps lead from the rings to the mask:
// 1. Closed curves within the group: one step for each that one of both has more, outer ones and
//    holes by themselves.
// 2. Arcs that join other transitions: of n arcs, n - c steps, where the arcs of both together make
//    c cycles. Each step cuts two arcs and joins their ends the other way.
// Each step changes the number of outer rings by one at most, and that of holes, too. So the number
// of steps bounds the difference, and is 0 only where both are alike in each group.
//
// Where cells of a group lie in a circle, cutting and joining is not free. There each pair of
// transitions more on a side is a step, each closed curve in a cell, and each arc of a cell but
// one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/job.h"

namespace msq {

/// The mask in one cell.
struct CellMask {
  uint32_t side;      ///< k
  uint32_t rows[17];  ///< k + 1 rows of k + 1 bits, from the lowest one on

  bool at(uint32_t i, uint32_t j) const { return rows[j] >> i & 1; }
};

/// Cells whose mask is not plainly as the rings have it.
class TopologyCells {
 public:
  /// Adds a cell; those of all cells that are not alike come row by row. `turns_right`: see
  /// ContourSection::Saddle. Sides on the window's edge are named by bits: bottom, right, top,
  /// left.
  void add(uint32_t column, uint32_t row, const CellMask& mask, bool turns_right,
           unsigned window_sides);
  /// After all cells.
  uint64_t steps(const Job* job);

  size_t bytes() const { return cells_.size() * (sizeof(Cell) + sizeof(uint32_t)) + arcs_.size(); }

 private:
  struct Cell {
    uint32_t column, row;
    size_t first;           // its transitions, counter-clockwise
    uint8_t starts[5];      // of sides, among them
    uint8_t main_arcs[4];   // by side: to which side the rings lead from there; 4: they do not
    uint8_t corners;        // bits: solid
    uint16_t outer, holes;  // closed curves
    uint32_t neighbours[4];

    uint32_t size(unsigned side) const { return starts[side + 1] - starts[side]; }
    uint32_t count() const { return starts[4]; }
    unsigned side_of(uint32_t n) const {
      unsigned side = 0;
      while (n >= starts[side + 1]) ++side;
      return side;
    }
  };
  /// A transition of a cell; of the rings: n is the side.
  struct Place {
    uint32_t cell, n;
  };
  struct Curves {
    uint64_t outer = 0, holes = 0;
  };

  void add_beyond(uint32_t inner, unsigned side);
  void link();
  uint64_t steps_of(const uint32_t* group, size_t count);
  uint64_t steps_of_circle(const uint32_t* group, size_t count) const;
  Place opposite(Place p) const;
  uint32_t from_least(const Cell& cell, unsigned side, uint32_t n) const;
  bool is_shared(const Cell& cell, unsigned side) const { return cell.size(side) > 1; }

  std::vector<Cell> cells_;
  std::vector<uint8_t> arcs_;    // by transition: the other one in its cell
  std::vector<uint32_t> group_;  // places of cells in their groups
  uint64_t alone_ = 0;           // steps of cells that share no side with more transitions
};

}  // namespace msq
