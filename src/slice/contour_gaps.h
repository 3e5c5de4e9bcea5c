// SPDX-License-Identifier: Apache-2.0
// Gaps that become narrower than the pitch: cells that get finer nodes of their own.
//
// The nodes of the grid lose a gap where it becomes narrower than the pitch: at the tip of a wedge
// between two struts or between a strut and a wall, and at a neck, where a gap is narrow for a
// while. A tip is a run of one or two nodes outside, with nodes inside at both ends and all along
// the next line of nodes. Membership on the edges around it tells whether the gap goes on between
// the nodes. If it does, the cells on both sides of these edges are divided, and so are all cells
// that the boundary then enters where their nodes do not show it. In divided cells, marching
// squares over finer nodes take the place of those over the four corners.
//
// Why rings fit: an edge between a divided cell and another one keeps the crossing that the grid
// has there, or none. So rings lead into divided cells and out of them as they would otherwise, and
// which cells are divided does not matter to the others. Cells along a window's edge are not
// divided, so windows share the points of a seam. Closed curves that meet no line of nodes along u
// are left out.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/borrowed.h"
#include "base/memory.h"
#include "base/vec2.h"
#include "slice/contour_gates.h"
#include "slice/contour_points.h"
#include "slice/contour_section.h"

namespace msq {

/// Nodes to a side of a divided cell, less one: pitch / parts is at most the tolerance, or parts is
/// max_gap_parts. 1: cells are not divided.
uint32_t gap_parts(double pitch, double tolerance, double margin);
inline constexpr uint32_t max_gap_parts = 16;

/// A crossing of an edge between finer nodes.
struct GapCrossing {
  uint32_t id;    ///< of the ring's crossings
  uint32_t cell;  ///< among the divided ones
  uint8_t i, j;   ///< the first node of the edge
  bool is_horizontal, starts_inside;
  uint8_t part_i, part_j;  ///< the part of the cell that follows
};

class ContourGaps {
 public:
  /// `section` is traced. `parts`: gap_parts().
  ContourGaps(const ContourSection& section, uint32_t parts) : section_(section), parts_(parts) {
    cells_.clear();
  }

  /// Finds the cells to divide, and their nodes.
  void find(ContourPoints& points);

  bool is_empty() const { return cells_.empty(); }
  uint32_t parts() const { return parts_; }
  /// Cells as bits, each that of its first node.
  const uint64_t* bits() const { return memory_->bits.data(); }
  bool holds(uint64_t place) const { return !is_empty() && index_.contains(place); }
  /// A bound on the number of crossings between finer nodes.
  uint64_t crossing_count() const { return crossing_count_; }
  /// Places where a gap goes on, but no more cells are divided.
  uint64_t unresolved() const { return unresolved_; }
  /// Divided cells with four crossings.
  uint64_t saddles() const { return saddles_; }

  /// A divided cell whose lower side is not the border of what is divided.
  struct Joint {
    uint32_t row, column, cell;
  };
  /// Of a row of nodes, in the order of columns.
  std::span<const Joint> joints(uint32_t row) const;
  /// Nodes of the lower side of a divided cell, as bits.
  uint32_t nodes_below(uint32_t cell) const { return cells_[cell].rows[0]; }
  /// The number of a cell, by its place: the column, and the row in the upper 32 bits.
  uint32_t cell_at(uint64_t place) const { return index_.at(place); }
  uint64_t place_of(uint32_t cell) const { return key(cells_[cell].column, cells_[cell].row); }

  /// A part of a divided cell that a ring enters, moving towards a side (see cell_sides.h).
  struct Place {
    uint32_t cell, i, j, side;
    friend bool operator==(const Place&, const Place&) = default;
  };
  /// Behind a crossing of the grid by which a ring enters a divided cell.
  Place enter(uint32_t cell, uint32_t side) const;
  /// Behind the crossing of part i of a joint.
  Place start(uint32_t cell, uint32_t i) const;
  /// Of the crossing before a place: its ring, if it is on a joint; else null.
  /// ContourSection::no_ring until ContourRings sets it.
  uint32_t* ring_before(const Place& place);
  /// The crossing before a place.
  GapCrossing crossing_before(const Place& place) const;
  /// Whether the part has four crossings.
  bool is_saddle(const Place& place) const;
  /// The corners of the part behind a crossing.
  void part_behind(const GapCrossing& crossing, Vec2& low, Vec2& high) const;
  /// Goes on to the next part; false if that is beyond the divided cells: then only `side` has
  /// changed.
  bool step(Place& place) const;

  /// Finds where crossings lie, within `accuracy`.
  void locate(std::span<const GapCrossing> crossings, double accuracy, ContourPoints& points,
              double* x, double* y) const;
  LineGate gate(const GapCrossing& crossing, Vec2 at, double tolerance) const;

  /// For msq_contours_report.topology_count: the steps from the rings to those without divided
  /// cells.
  uint64_t count_topology_steps(const Job* job) const;

 private:
  static constexpr uint32_t none = UINT32_MAX;
  static constexpr size_t edges_at_once = 1024;  // whose points are found together
  struct Cell {
    uint32_t column, row;
    uint32_t neighbours[4];
    uint32_t rows[max_gap_parts + 1];
    uint32_t rings[max_gap_parts];
  };
  /// An edge of the grid, by its first node, and to which side a gap may cross it.
  struct Edge {
    uint32_t row, column;
    bool is_horizontal, is_rising;
    bool is_fine;  ///< the gap is narrow already
  };

  static uint64_t key(uint32_t column, uint32_t row) { return column | uint64_t{row} << 32; }
  uint64_t most_cells() const;
  Vec2 node(const Cell& cell, uint32_t i, uint32_t j) const;
  void add(uint32_t column, uint32_t row);
  uint32_t edge_of(const Cell& cell, uint32_t side) const;
  void set_edge(Cell& cell, uint32_t side, uint32_t bits) const;
  std::vector<Edge> find_tips(const Job* job) const;
  std::vector<Edge> find_open(const std::vector<Edge>& edges, ContourPoints& points) const;
  void keep_open(std::vector<Edge>& edges, uint32_t parts, double beyond,
                 ContourPoints& points) const;
  void divide(ContourPoints& points);
  void look_at_sides(size_t first, ContourPoints& points);
  bool goes_on(const Cell& cell, uint32_t side) const;
  void close_border();
  void look_within(ContourPoints& points);
  uint32_t border_bits(const Cell& cell, uint32_t side) const;
  void finish();
  uint64_t left_out(const Job* job) const;
  void hold();

  const ContourSection& section_;
  const uint32_t parts_;
  Reservation held_;
  std::unordered_map<uint64_t, uint32_t> index_;
  std::vector<Joint> joints_;
  // Kept between calls: fresh memory of this size takes a while to get.
  struct Memory {
    std::vector<Cell> cells;
    std::vector<uint64_t> bits;
    size_t bytes() const {
      return cells.capacity() * sizeof(Cell) + bits.capacity() * sizeof(uint64_t);
    }
  };
  const Borrowed<Memory> memory_;
  std::vector<Cell>& cells_ = memory_->cells;
  uint64_t crossing_count_ = 0, unresolved_ = 0, saddles_ = 0;
};

}  // namespace msq
