// SPDX-License-Identifier: Apache-2.0
#include "slice/turned_rows.h"

#include <bit>

namespace msq {

SampleGrid TurnedRows::turned_grid(const Part& part) const {
  const SampleGrid& grid = *block_.grid;
  SampleGrid out;
  uint64_t counts[3];
  for (int axis = 0; axis < 3; ++axis) {
    const int to = axes_[static_cast<size_t>(axis)];
    out.origin[to] = grid.origin[axis];
    out.spacing[to] = grid.spacing[axis];
    out.first[static_cast<size_t>(to)] = grid.first[static_cast<size_t>(axis)] + part.low[axis];
    counts[to] = part.count(axis);
  }
  out.nx = counts[0];
  out.ny = counts[1];
  out.nz = counts[2];
  if (!grid.heights) return out;
  if (axes_[2] == 2) {
    out.heights = grid.heights;
    return out;
  }
  out.origin[axes_[2]] = grid.z(part.low[2]);  // + 0 * spacing: exact
  out.first[static_cast<size_t>(axes_[2])] = 0;
  return out;
}

namespace {

/// Calls visit(i) for each bit of a row that is set, from `first` to `end` - 1.
template <class Visit>
void for_each_bit(const uint64_t* row, uint64_t first, uint64_t end, Visit&& visit) {
  for (uint64_t w = first / bits_per_word; w * bits_per_word < end; ++w)
    for (uint64_t rest = row[w]; rest; rest &= rest - 1) {
      const uint64_t i = w * bits_per_word + static_cast<uint64_t>(std::countr_zero(rest));
      if (i >= first && i < end) visit(i);
    }
}

}  // namespace

void TurnedRows::load(const Part& part, const RowBlock& turned) const {
  uint64_t at[3];
  for (uint64_t k = part.low[2]; k < part.high[2]; ++k)
    for (uint64_t j = part.low[1]; j < part.high[1]; ++j) {
      at[axes_[1]] = j - part.low[1];
      at[axes_[2]] = k - part.low[2];
      for_each_bit(block_.row(j, k), part.low[0], part.high[0], [&](uint64_t i) {
        at[axes_[0]] = i - part.low[0];
        turned.row(at[1], at[2])[at[0] / bits_per_word] |= uint64_t{1} << at[0] % bits_per_word;
      });
    }
}

void TurnedRows::store(const Part& part, const RowBlock& turned) const {
  for (uint64_t k = part.low[2]; k < part.high[2]; ++k)
    for (uint64_t j = part.low[1]; j < part.high[1]; ++j) {
      uint64_t* row = block_.row(j, k);
      for (uint64_t w = part.low[0] / bits_per_word; w * bits_per_word < part.high[0]; ++w) {
        uint64_t others = 0;  // samples of other parts
        if (w * bits_per_word < part.low[0])
          others |= ~(~uint64_t{0} << part.low[0] % bits_per_word);
        if ((w + 1) * bits_per_word > part.high[0])
          others |= ~uint64_t{0} << part.high[0] % bits_per_word;
        row[w] &= others;
      }
    }
  uint64_t at[3];
  for (at[2] = 0; at[2] < turned.z1; ++at[2])
    for (at[1] = 0; at[1] < turned.y1; ++at[1])
      for_each_bit(turned.row(at[1], at[2]), 0, turned.grid->nx, [&](uint64_t x) {
        at[0] = x;
        const uint64_t i = part.low[0] + at[axes_[0]];
        block_.row(part.low[1] + at[axes_[1]], part.low[2] + at[axes_[2]])[i / bits_per_word] |=
            uint64_t{1} << i % bits_per_word;
      });
}

}  // namespace msq
