// SPDX-License-Identifier: Apache-2.0
// From the sines and cosines of the angles at the first of 64 samples, and those of the angles from
// there to each of them, which are the same all over a block, follow those at all 64, by the sums
// of angles; whole multiples make the wrap at a cell's border vanish. All that is done in single
// precision, with a proven bound of the error (trigonometric_form.cpp); samples nearer to the level
// than that are asked one by one.
#include "structure/functional/turned_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace msq {

namespace {

constexpr size_t batch_words = single_points / bits_per_word;

}  // namespace

TurnedRows::TurnedRows(const Functional& structure, const RowBlock& block)
    : structure_(structure),
      form_(*structure.form()),
      block_(block),
      grid_(*block.grid),
      starts_(form_.starts()),
      values_(form_.values()) {
  const size_t waves = form_.waves().size(), row_words = block.row_words();
  find_angle_error();
  find_steps();
  waves_.resize(2 * waves * (single_points + batch_padding));
  for (size_t i = 0; i < 2 * waves; ++i)
    values_.set_input(i, {waves_.data() + i * (single_points + batch_padding), false});
  at_first_.resize(3 * waves * row_words);
  x_.resize(row_words + batch_padding);
  for (auto& angles : angles_) angles.resize(row_words + batch_padding);
  if (structure.level().is_constant()) bounds_.set(structure.level().at({}), slack_);
}

/// A coordinate in the grid, in cells, as the definition computes it, is a sum of three products
/// divided by the cell size: within a dozen roundings, of 2^-53 of the sum of magnitudes, of the
/// true one. The same holds for that of a word's first sample, and the angle between the two
/// carries a few roundings more; 2^-48 is 32 of them.
void TurnedRows::find_angle_error() {
  const Neighbourhood& cells = structure_.neighbourhood();
  const Box3 box = block_.box();
  const double most = 3 * (max_magnitude(box.min) + max_magnitude(box.max) +
                           max_magnitude(cells.origin) + bits_per_word * grid_.spacing.x);
  const double in_cells = 1 + most / min_component(cells.cell_size);
  slack_ = form_.slack(two_pi * 0x1p-48 * in_cells);
}

void TurnedRows::find_steps() {
  const Neighbourhood& cells = structure_.neighbourhood();
  steps_.resize(form_.waves().size() * 2 * bits_per_word);
  float* to = steps_.data();
  for (const TrigonometricForm::Wave& wave : form_.waves()) {
    // The row's direction along the grid's axis, as an angle a sample.
    const double along = cells.rotation.m[static_cast<size_t>(wave.axis)] * grid_.spacing.x /
                         cells.cell_size[wave.axis];
    for (size_t i = 0; i < bits_per_word; ++i) {
      // Whole turns are left out before precision is lost.
      const double turns = along * static_cast<double>(i) * wave.frequency;
      const double angle = angle_of(turns - std::round(turns));
      to[i] = static_cast<float>(apply(Op::cosine, angle, 0));
      to[bits_per_word + i] = static_cast<float>(apply(Op::sine, angle, 0));
    }
    to += 2 * bits_per_word;
  }
}

void TurnedRows::keep(const Job* job) {
  for (RowGroup group{0, 0, block_.z0, 0}; group.z0 < block_.z1; group.z0 = group.z1) {
    check_cancelled(job);
    group.z1 = std::min(block_.z1, group.z0 + most_group_layers);
    for (group.y0 = block_.y0; group.y0 < block_.y1; group.y0 = group.y1) {
      group.y1 = std::min(block_.y1, group.y0 + most_group_rows);
      keep_group(group);
    }
  }
}

void TurnedRows::keep_group(const RowGroup& group) {
  words_.clear();
  for (uint32_t w = 0; w < block_.row_words(); ++w)
    for (size_t row = 0; row < group.rows(); ++row)
      if (block_.row(group.y(row), group.z(row))[w]) {
        words_.push_back(w);
        break;
      }
  if (words_.empty()) return;
  if (!structure_.level().is_constant())
    bounds_.set(structure_.level(), slack_, grid_, group, words_);
  for (size_t row = 0; row < group.rows(); ++row) {
    find_starts(group.y(row), group.z(row));
    for (size_t first = 0; first < words_.size(); first += batch_words)
      decide(group, row, first, std::min(batch_words, words_.size() - first));
  }
}

void TurnedRows::find_starts(uint64_t j, uint64_t k) {
  const size_t count = words_.size(), waves = form_.waves().size();
  const double y = grid_.y(j), z = grid_.z(k);
  for (size_t n = 0; n < count; ++n) x_[n] = grid_.x(uint64_t{words_[n]} * bits_per_word);
  find_angles(structure_.neighbourhood(), {x_.data(), false}, {&y, true}, {&z, true}, count,
              {angles_[0].data(), angles_[1].data(), angles_[2].data()});
  for (size_t begin = 0; begin < count; begin += batch_points) {
    const size_t size = std::min(batch_points, count - begin);
    for (size_t axis = 0; axis < 3; ++axis)
      starts_.set_input(axis, {angles_[axis].data() + begin, false});
    starts_.run(size);
    for (size_t wave = 0; wave < waves; ++wave) {
      const Values sines = starts_.output(2 * wave), cosines = starts_.output(2 * wave + 1);
      float* to = at_first_.data() + 3 * wave * count + begin;
      for (size_t n = 0; n < size; ++n) {
        to[n] = static_cast<float>(sines[n]);
        to[count + n] = static_cast<float>(cosines[n]);
        to[2 * count + n] = -to[n];
      }
    }
  }
}

void TurnedRows::decide(const RowGroup& group, size_t row, size_t first, size_t count) {
  const size_t all = words_.size();
  for (size_t wave = 0; wave < form_.waves().size(); ++wave) {
    const float* cosines = steps_.data() + 2 * wave * bits_per_word;
    const float* sines = cosines + bits_per_word;
    const float* from = at_first_.data() + 3 * wave * all + first;
    float* to = waves_.data() + 2 * wave * (single_points + batch_padding);
    add_angles(from, from + all, count, cosines, sines, to);
    add_angles(from + all, from + 2 * all, count, cosines, sines,
               to + single_points + batch_padding);
  }
  values_.run(count * bits_per_word);
  const ValuesOf<float> values = values_.output(0);
  uint64_t at_most_low[batch_words], at_most_high[batch_words];
  const bool is_constant = structure_.level().is_constant();
  compare_singles(values, words_.data() + first, count, bounds_.low.data(), bounds_.high.data(),
                  is_constant, at_most_low, at_most_high);
  uint64_t* const words = block_.row(group.y(row), group.z(row));
  for (size_t n = 0; n < count; ++n) {
    uint64_t& word = words[words_[first + n]];
    uint64_t in = at_most_low[n];
    for (uint64_t doubt = at_most_high[n] & ~in & word; doubt; doubt &= doubt - 1) {
      const size_t i = static_cast<size_t>(std::countr_zero(doubt));
      const Vec3 p = grid_.at(words_[first + n] * bits_per_word + i, group.y(row), group.z(row));
      const double value = values[n * bits_per_word + i], level = structure_.level().at(p);
      if (value <= level - slack_ || (value <= level + slack_ && structure_.inside(p)))
        in |= doubt & -doubt;
    }
    word &= in;
  }
}

void keep_turned_rows(const Functional& structure, const RowBlock& block, const Job* job) {
  const SampleGrid& grid = *block.grid;
  const Parameter& level = structure.level();
  Batch batch(structure.program());
  double x[batch_points + batch_padding] = {}, angles[3][batch_points + batch_padding];
  double levels[batch_points + batch_padding] = {level.at({})};
  for (size_t axis = 0; axis < 3; ++axis) batch.set_input(axis, {angles[axis], false});
  uint64_t* words[batch_points / bits_per_word];
  const size_t row_words = block.row_words();
  for (uint64_t k = block.z0; k < block.z1; ++k) {
    check_cancelled(job);
    for (uint64_t j = block.y0; j < block.y1; ++j) {
      const double y = grid.y(j), z = grid.z(k);
      for (size_t next = 0; next < row_words;) {
        size_t size = 0;
        for (; next < row_words && size < batch_points; ++next) {
          uint64_t* word = block.row(j, k) + next;
          if (*word == 0) continue;
          words[size / bits_per_word] = word;
          for (size_t i = 0; i < bits_per_word; ++i, ++size) {
            x[size] = grid.x(next * bits_per_word + i);
            if (!level.is_constant()) levels[size] = level.at({x[size], y, z});
          }
        }
        find_angles(structure.neighbourhood(), {x, false}, {&y, true}, {&z, true}, size,
                    {angles[0], angles[1], angles[2]});
        batch.run(size);
        uint64_t bits[batch_points / bits_per_word];
        compare_values(batch.output(0), {levels, level.is_constant()}, size, bits);
        for (size_t i = 0; i < size / bits_per_word; ++i) *words[i] &= bits[i];
      }
    }
  }
}

}  // namespace msq
