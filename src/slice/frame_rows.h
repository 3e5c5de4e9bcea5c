// SPDX-License-Identifier: Apache-2.0
// Rows of samples along one axis as rows along another: blocks of bits, turned.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "base/sample_grid.h"

namespace msq {

class FrameRows {
 public:
  /// `axes`: for each axis of the block, the axis that it becomes.
  FrameRows(const RowBlock& block, std::array<int, 3> axes) : block_(block), axes_(axes) {}

  /// Calls use(turned) for parts of the block, which together are the whole: bits are those of the
  /// block on entry, and become those of the block.
  template <class Use>
  void for_each_part(Use&& use);

 private:
  /// Of the words of a part, which are more than the block's where turned rows are short.
  static constexpr uint64_t max_words = uint64_t{1} << 16, max_layers = 64;

  /// Samples of the block: x, rows and layers, ends excluded. Along x whole words, except the
  /// last.
  struct Part {
    uint64_t low[3], high[3];
    uint64_t count(int axis) const { return high[axis] - low[axis]; }
  };

  SampleGrid turned_grid(const Part& part) const;
  template <class Use>
  void divide(const Part& part, Use&& use);
  template <class Use>
  void use_part(const Part& part, const SampleGrid& grid, Use&& use);
  void load(const Part& part, const RowBlock& turned) const;
  void store(const Part& part, const RowBlock& turned) const;
  /// Where x stays x. Calls copy(words of the block, words of turned rows, count).
  template <class Copy>
  void for_each_row(const Part& part, const RowBlock& turned, Copy&& copy) const;
  /// Otherwise. Calls copy(tile) for 64 x 64 samples along x and along what becomes x.
  struct Tile;
  template <class Copy>
  void for_each_tile(const Part& part, const RowBlock& turned, Copy&& copy) const;
  /// The axis of the block that becomes this one.
  int block_axis(int turned) const {
    return static_cast<int>(std::find(axes_.begin(), axes_.end(), turned) - axes_.begin());
  }
  /// The axis to halve: of the two that are not along turned rows, if they can be.
  int widest(const Part& part) const {
    const int y = block_axis(1), z = block_axis(2);
    const int wide = part.count(y) >= part.count(z) ? y : z;
    return part.count(wide) > 1 ? wide : block_axis(0);
  }

  const RowBlock& block_;
  const std::array<int, 3> axes_;
  std::vector<uint64_t> words_;
};

template <class Use>
void FrameRows::for_each_part(Use&& use) {
  divide({{0, block_.y0, block_.z0}, {block_.grid->nx, block_.y1, block_.z1}}, use);
}

template <class Use>
void FrameRows::divide(const Part& part, Use&& use) {
  // Listed heights are those of layers alone: along rows and columns there is one at a time.
  const bool is_uneven = block_.grid->heights && axes_[2] != 2 && part.count(2) > 1;
  const SampleGrid grid = turned_grid(part);
  const bool is_large = words_for(grid.nx) * grid.ny * grid.nz > max_words;
  if (!is_uneven && !is_large && grid.nz <= max_layers) return use_part(part, grid, use);
  const int halved = is_uneven ? 2 : grid.nz > max_layers ? block_axis(2) : widest(part);
  Part lower = part, upper = part;
  uint64_t half = part.count(halved) / 2;
  if (halved == 0) half = (half + bits_per_word - 1) / bits_per_word * bits_per_word;
  lower.high[halved] = upper.low[halved] = part.low[halved] + half;
  divide(lower, use);
  divide(upper, use);
}

template <class Use>
void FrameRows::use_part(const Part& part, const SampleGrid& grid, Use&& use) {
  RowBlock turned;
  turned.grid = &grid;
  turned.y1 = grid.ny;
  turned.z1 = grid.nz;
  turned.row_stride = words_for(grid.nx);
  turned.layer_stride = turned.row_stride * grid.ny;
  words_.assign(turned.layer_stride * grid.nz, 0);
  turned.words = words_.data();
  load(part, turned);
  use(turned);
  store(part, turned);
}

}  // namespace msq
