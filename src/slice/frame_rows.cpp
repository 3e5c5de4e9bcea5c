// SPDX-License-Identifier: Apache-2.0
#include "slice/frame_rows.h"

#include <algorithm>

namespace msq {

SampleGrid FrameRows::turned_grid(const Part& part) const {
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

/// Bit c of word r becomes bit r of word c.
/// Source: Warren, "Hacker's Delight", 2nd edition, 2012, section 7-3.
void transpose(uint64_t (&words)[64]) {
  uint64_t mask = 0xffffffffu;
  for (unsigned j = 32; j > 0; j >>= 1, mask ^= mask << j)
    for (unsigned k = 0; k < 64; k = ((k | j) + 1) & ~j) {
      const uint64_t swapped = (words[k] >> j ^ words[k | j]) & mask;
      words[k] ^= swapped << j;
      words[k | j] ^= swapped;
    }
}

}  // namespace

template <class Copy>
void FrameRows::for_each_row(const Part& part, const RowBlock& turned, Copy&& copy) const {
  const uint64_t first = part.low[0] / bits_per_word;
  uint64_t at[3] = {};
  for (uint64_t k = part.low[2]; k < part.high[2]; ++k)
    for (uint64_t j = part.low[1]; j < part.high[1]; ++j) {
      at[axes_[1]] = j - part.low[1];
      at[axes_[2]] = k - part.low[2];
      copy(block_.row(j, k) + first, turned.row(at[1], at[2]), turned.row_stride);
    }
}

struct FrameRows::Tile {
  uint64_t* rows[64];    // words of the block's rows, those that there are
  uint64_t* turned[64];  // words of the turned rows
  uint64_t row_count, turned_count;
};

template <class Copy>
void FrameRows::for_each_tile(const Part& part, const RowBlock& turned, Copy&& copy) const {
  const int across = block_axis(0), other = 3 - across;  // of rows and layers
  Tile tile;
  uint64_t at[3], index[3] = {};
  for (index[other] = part.low[other]; index[other] < part.high[other]; ++index[other])
    for (uint64_t a = 0; a < part.count(across); a += bits_per_word)
      for (uint64_t i = 0; i < part.count(0); i += bits_per_word) {
        tile.row_count = std::min<uint64_t>(bits_per_word, part.count(across) - a);
        tile.turned_count = std::min<uint64_t>(bits_per_word, part.count(0) - i);
        for (uint64_t n = 0; n < tile.row_count; ++n) {
          index[across] = part.low[across] + a + n;
          tile.rows[n] = block_.row(index[1], index[2]) + (part.low[0] + i) / bits_per_word;
        }
        at[axes_[static_cast<size_t>(other)]] = index[other] - part.low[other];
        for (uint64_t n = 0; n < tile.turned_count; ++n) {
          at[axes_[0]] = i + n;
          tile.turned[n] = turned.row(at[1], at[2]) + a / bits_per_word;
        }
        copy(tile);
      }
}

void FrameRows::load(const Part& part, const RowBlock& turned) const {
  if (axes_[0] == 0)
    return for_each_row(part, turned, [](const uint64_t* from, uint64_t* to, size_t count) {
      std::copy_n(from, count, to);
    });
  for_each_tile(part, turned, [](const Tile& tile) {
    uint64_t words[64] = {}, any = 0;
    for (uint64_t n = 0; n < tile.row_count; ++n) any |= words[n] = *tile.rows[n];
    if (any == 0) return;  // turned rows are zeros
    transpose(words);
    for (uint64_t n = 0; n < tile.turned_count; ++n) *tile.turned[n] = words[n];
  });
}

void FrameRows::store(const Part& part, const RowBlock& turned) const {
  if (axes_[0] == 0)
    return for_each_row(part, turned, [](uint64_t* to, const uint64_t* from, size_t count) {
      std::copy_n(from, count, to);
    });
  for_each_tile(part, turned, [](const Tile& tile) {
    uint64_t words[64] = {}, any = 0;
    for (uint64_t n = 0; n < tile.turned_count; ++n) any |= words[n] = *tile.turned[n];
    if (any != 0) transpose(words);
    for (uint64_t n = 0; n < tile.row_count; ++n) *tile.rows[n] = words[n];
  });
}

}  // namespace msq
