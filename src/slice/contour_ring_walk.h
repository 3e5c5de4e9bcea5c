// SPDX-License-Identifier: Apache-2.0
// Follows rings from cell to cell of a section.
#pragma once

#include <cstddef>
#include <cstdint>

#include "slice/contour_ring_kind.h"
#include "slice/contour_section.h"

namespace msq {

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
  const uint64_t* divided;  ///< cells as bits, each that of its first node; null: none
};

/// Follows a ring from a place until its first crossing comes again, until `end` crossings are
/// there, or until the cell behind the next one is divided. Writes crossings from `n` on, and
/// returns the number of crossings then. Joins `inner_bits` by those of the cells.
uint32_t follow_ring(const RingWalk& walk, uint32_t number, uint32_t first_crossing, uint32_t n,
                     uint32_t end, RingPlace& place, uint64_t& inner_bits);

}  // namespace msq
