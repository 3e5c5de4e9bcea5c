// SPDX-License-Identifier: Apache-2.0
// Kernels of rings: following them from cell to cell, and, in vectors, where their crossings lie
// and the gates about these (contour_line.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/vec2.h"
#include "slice/contour_section.h"

namespace msq {

/// What is known of a crossing besides its place.
namespace ring_kind {
enum : uint8_t {
  horizontal = 1,    ///< its edge
  first_inside = 2,  ///< the first node of its edge
  beyond = 4,        ///< it lies beyond the window
  seam = 8,          ///< it lies on an edge of the window
  saddle = 16        ///< the cell that follows has four crossings
};
}  // namespace ring_kind

/// Crossings one after the other.
struct RingCrossings {
  const uint64_t* cells;  ///< that follow them: the column, and the row in the upper 32 bits
  const uint8_t* kinds;
  size_t count;
};

/// Cells whose nodes are all inner. Columns and rows are below 2^31, so a difference with a greater
/// one sets its highest bit.
struct InnerCells {
  uint64_t first, last;

  /// Of several cells, the bits are joined by or.
  uint64_t bits(uint64_t cell) const { return (cell - first) | (last - cell); }
  static bool are_inner(uint64_t bits) { return (bits & 0x8000000080000000) == 0; }
};

/// The step from a cell to the next one of a ring. Bits number the nodes of a grid: columns of a
/// row, then the next row.
struct RingStep {
  uint64_t to_cell;
  uint64_t bits_to_cell, bits_to_edge;  ///< from the cell's first node
  uint8_t kind;                         ///< of the crossing before the cell
  uint8_t side;                         ///< see cell_sides.h
  bool is_saddle;
};
/// By the side of the cell before, and by which nodes of the cell are inside: bits 0 to 3 are the
/// lower left one, the lower right one, the upper left one and the upper right one.
struct RingSteps {
  explicit RingSteps(size_t row_words);
  RingStep of[4][16];
};

/// How far a ring is followed: a crossing, and the cell behind it.
struct RingPlace {
  uint64_t cell;
  uint32_t crossing;
  uint32_t side;  ///< of the cell before, by which the ring left it
};

/// What rings are followed by, and where their crossings go.
struct RingWalk {
  const ContourSection& section;
  const RingSteps& steps;
  InnerCells inner;
  uint32_t* rings;  ///< ContourSection::rings()
  double* ends;
  uint64_t* cells;
  uint8_t* kinds;
};

/// Follows a ring from a place until its first crossing comes again, or until `end` crossings are
/// there. Writes crossings from `n` on, and returns the number of crossings then. Joins
/// `inner_bits` by those of the cells.
uint32_t follow_ring(const RingWalk& walk, uint32_t number, uint32_t first_crossing, uint32_t n,
                     uint32_t end, RingPlace& place, uint64_t& inner_bits);

/// Nodes of the lattice between the edges of the window.
struct RingNodes {
  double first_u, first_v, pitch;
  uint32_t first_column, first_row;
  double margin;  ///< that crossings and gates keep from nodes
};

/// The ends of a crossing's gate as seen by who walks with the inside on the left.
struct LineGate {
  double left_x, right_x, left_y, right_y;
};

/// From u or v of crossings (see ContourSection::ends()) finds x and y, for edges between nodes of
/// the lattice. What it writes for others has no meaning. Writes up to max_simd_doubles elements
/// beyond the count, and reads as many.
void place_crossings(const RingCrossings& crossings, const RingNodes& nodes, const double* ends,
                     double* x, double* y);

/// Copies the places of crossings and finds their gates: what lies within `tolerance` of them on
/// their edges. Reads and writes as place_crossings() does.
void find_gates(const RingCrossings& crossings, const RingNodes& nodes, const double* x,
                const double* y, double tolerance, Vec2* at, LineGate* gates);

}  // namespace msq
