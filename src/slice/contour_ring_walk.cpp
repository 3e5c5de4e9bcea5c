// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slice/contour_ring_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "slice/cell_sides.h"
#include "slice/contour_ring_walk.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {

/// Two nodes of a row.
HWY_INLINE unsigned nodes_at(const uint64_t* nodes, uint64_t bit) {
  if constexpr (std::endian::native == std::endian::little) {
    uint16_t bits;
    std::memcpy(&bits, reinterpret_cast<const unsigned char*>(nodes) + bit / 8, sizeof bits);
    return bits >> (bit % 8) & 3;
  } else {
    const auto at = [&](uint64_t n) {
      return static_cast<unsigned>(nodes[n / 64] >> (n % 64) & 1);
    };
    return at(bit) | at(bit + 1) << 1;
  }
}

template <bool has_divided>
uint32_t follow_some(const RingWalk& walk, uint32_t number, uint32_t first_crossing, uint32_t n,
                     uint32_t end, RingPlace& place, uint64_t& inner_bits) {
  const ContourSection& section = walk.section;
  const size_t row_words = section.grid().row_words();
  const uint64_t *const nodes = section.grid().row(0), *const nodes_above = nodes + row_words;
  const double* const from_ends = section.ends();
  const EdgeWord* const edges[2] = {section.horizontal_edges(), section.vertical_edges()};
  const uint32_t horizontal_count = edges[1]->first;
  uint32_t* const rings = walk.rings;
  double* const ends = walk.ends;
  uint64_t* const cells = walk.cells;
  uint8_t* const kinds = walk.kinds;
  const RingSteps& steps = walk.steps;
  const InnerCells inner = walk.inner;
  uint64_t cell = place.cell, seen = inner_bits;
  // Of the cell's first node. The next cell depends on little but this.
  uint64_t bit = (cell >> 32) * row_words * 64 + static_cast<uint32_t>(cell);
  uint32_t id = place.crossing, side = place.side;
  while (n < end) {
    if constexpr (has_divided)
      if (walk.divided[bit / 64] >> (bit % 64) & 1) break;
    const unsigned around = nodes_at(nodes, bit) | nodes_at(nodes_above, bit) << 2;
    const RingStep* step = &steps.of[side][around];
    rings[std::min(id, horizontal_count)] = number;
    ends[n] = from_ends[id];
    cells[n] = cell;
    kinds[n] = step->kind;
    ++n;
    seen |= inner.bits(cell);
    if (step->is_saddle) {
      const ContourSection::Saddle& s =
          section.saddle_at(static_cast<uint32_t>(cell), static_cast<uint32_t>(cell >> 32));
      // As if one of the nodes ahead were not as it is.
      const uint32_t next = (side + (s.turns_right == s.is_rising ? 3 : 1)) % 4;
      step = std::find_if(steps.of[side], steps.of[side] + 16, [&](const RingStep& other) {
        return other.side == next && !other.is_saddle;
      });
    }
    side = step->side;
    const uint64_t edge = bit + step->bits_to_edge;
    bit += step->bits_to_cell;
    cell += step->to_cell;
    id = edges[side & 1][edge / 64].crossing(edge % 64);
    if (id == first_crossing) break;
  }
  place = {cell, id, side};
  inner_bits = seen;
  return n;
}

uint32_t follow_ring(const RingWalk& walk, uint32_t number, uint32_t first_crossing, uint32_t n,
                     uint32_t end, RingPlace& place, uint64_t& inner_bits) {
  return walk.divided ? follow_some<true>(walk, number, first_crossing, n, end, place, inner_bits)
                      : follow_some<false>(walk, number, first_crossing, n, end, place, inner_bits);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

RingSteps::RingSteps(size_t row_words) {
  using namespace ring_kind;
  using namespace cell_sides;
  // The inside is on the left, so a ring goes up and to the left where the first node of an edge is
  // inside.
  constexpr uint8_t kinds[4] = {horizontal, 0, horizontal | first_inside, first_inside};
  // Of the nodes ahead, the one to the left and the one to the right.
  constexpr unsigned ahead[4][2] = {{1, 0}, {3, 1}, {2, 3}, {0, 2}};
  constexpr uint64_t row_step = uint64_t{1} << 32;
  constexpr uint64_t to_cells[4] = {0 - row_step, 1, row_step, ~uint64_t{0}};
  const uint64_t row_bits = row_words * 64;
  const uint64_t bits_to_cells[4] = {0 - row_bits, 1, row_bits, ~uint64_t{0}};
  const uint64_t bits_to_edges[4] = {0, 1, row_bits, 0};
  for (uint32_t from = bottom; from <= left; ++from)
    for (unsigned nodes = 0; nodes < 16; ++nodes) {
      const bool is_left = nodes >> ahead[from][0] & 1, is_right = nodes >> ahead[from][1] & 1;
      const uint32_t to = (from + (is_left ? (is_right ? 3 : 0) : 1)) % 4;
      const bool is_saddle = !is_left && is_right;
      of[from][nodes] = {to_cells[to],
                         bits_to_cells[to],
                         bits_to_edges[to],
                         static_cast<uint8_t>(is_saddle ? kinds[from] | saddle : kinds[from]),
                         static_cast<uint8_t>(to),
                         is_saddle};
    }
}

namespace {

HWY_EXPORT(follow_ring);

}  // namespace

uint32_t follow_ring(const RingWalk& walk, uint32_t number, uint32_t first_crossing, uint32_t n,
                     uint32_t end, RingPlace& place, uint64_t& inner_bits) {
  return HWY_DYNAMIC_DISPATCH(follow_ring)(walk, number, first_crossing, n, end, place, inner_bits);
}

}  // namespace msq
#endif  // HWY_ONCE
