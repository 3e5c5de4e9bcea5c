// SPDX-License-Identifier: Apache-2.0
// Rows of samples along which a functional structure is a single wave, and its level changes
// little.
#pragma once

#include <deque>
#include <vector>

#include "base/borrowed.h"
#include "structure/functional/level_bounds.h"
#include "structure/functional/row_angles.h"
#include "structure/functional/single_wave.h"

namespace msq {

/// Tables of columns, which all rows of a grid have in common. They are kept for the next block.
class WaveColumns {
 public:
  /// As many columns as one ColumnSets takes.
  struct Window {
    ColumnSets sets;
    std::vector<float> sines, cosines;
  };
  static constexpr size_t window_words = ColumnSets::max_parts * ColumnSets::part_words,
                          max_windows = 16;

  /// The windows of columns with these angles.
  const std::vector<Window>& of(const double* angles, size_t count);
  size_t bytes() const { return bytes_; }

 private:
  struct Table {
    std::vector<double> angles;
    std::vector<Window> windows;

    Table(const double* angles, size_t count);
    size_t bytes() const;
  };
  static constexpr size_t max_tables = 8, max_bytes = size_t{4} << 20;  // without the latest

  std::deque<Table> tables_;
  size_t bytes_ = 0;
};

class SingleWaveRows {
 public:
  /// If the level changes little along rows. The tables of wide rows would take too much memory.
  static bool serves(const Functional& structure, const RowBlock& block);
  SingleWaveRows(const Functional& structure, const RowBlock& block);

  /// Clears the bits of samples that are outside.
  void keep(const Job* job);

 private:
  void find_levels(uint64_t first, size_t count, WaveLevels& levels);
  void keep_row(const std::vector<WaveColumns::Window>& windows, const WaveLevels& levels,
                uint64_t number, size_t row);
  bool is_alive(uint64_t number) const;
  uint64_t alive(const uint64_t* words, size_t word) const;

  const Functional& structure_;
  const RowBlock& block_;
  const RowGroup all_;  // the block's rows, which are numbered layer by layer
  const RowPlan& plan_;
  const RowAngles angles_;
  const size_t words_;  // after which rows repeat
  const double slack_;
  const Borrowed<WaveColumns> columns_;
  Batch rows_;
  std::vector<double> y_, z_, sine_, cosine_, threshold_;
  std::vector<Interval> level_;  // of each row
  Values constant_;
  std::vector<uint64_t> result_, doubt_;
};

}  // namespace msq
