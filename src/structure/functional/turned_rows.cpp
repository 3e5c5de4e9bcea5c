// SPDX-License-Identifier: Apache-2.0
// The angles from a row's first sample on are the same all over a block. Their sines and cosines,
// with those of the angles at a row's first sample, give the sines and cosines at all samples, by
// the addition theorems; for integer multiples, the wrap at a cell's border has no effect. First
// the sines and cosines at the first of each 64 samples are computed in double precision, then
// those at all samples in single precision, with a proven bound of the error
// (trigonometric_form.cpp). Samples nearer to the level than that are evaluated one by one.
//
// Sums of products of waves need less for each sample. By the same theorems they are sums of
// functions of the distance from the middle of 64 samples, which are the same all over a block,
// times coefficients of these samples (wave_products.cpp). Samples as far from the middle on either
// side share the even functions' part and the odd ones'.
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
      values_(form_.values()),
      products_(form_.products()) {
  const size_t waves = form_.waves().size();
  find_angle_error();
  find_steps();
  at_first_.resize(2 * waves * padded_words());
  group_starts_.resize(waves);
  if (structure.level().is_constant()) bounds_.set(structure.level().range(), slack_);
  if (products_)
    set_up_products();
  else
    set_up_waves();
}

void TurnedRows::set_up_waves() {
  const size_t waves = form_.waves().size();
  waves_ = allocate_aligned(2 * waves * (single_points + batch_padding));
  std::fill_n(waves_.get(), 2 * waves * (single_points + batch_padding), 0.0f);
  for (size_t i = 0; i < 2 * waves; ++i)
    values_.set_input(i, {waves_.get() + i * (single_points + batch_padding), false});
}

void TurnedRows::set_up_products() {
  std::vector<const WaveProducts::Function*> functions;
  for (const bool is_odd : {false, true}) {
    for (const WaveProducts::Function& function : products_->functions())
      if (function.is_odd() == is_odd) functions.push_back(&function);
    if (!is_odd) evens_ = functions.size();
  }
  constexpr size_t half = ProductRow::half;
  functions_ = allocate_aligned(functions.size() * half);
  for (size_t f = 0; f < functions.size(); ++f) {
    float* const to = functions_.get() + f * half;
    function_pointers_.push_back(to);
    for (size_t i = 0; i < half; ++i) {
      double value = 1;
      for (const WaveProducts::Part part : functions[f]->parts)
        value *= step(part, 0, static_cast<double>(i) + 0.5);
      to[i] = static_cast<float>(value);
    }
    std::vector<ProductFactor>& factors = factors_.emplace_back();
    for (const WaveProducts::Product& product : functions[f]->coefficient) {
      ProductFactor factor{
          static_cast<float>(product.factor), static_cast<uint32_t>(product.parts.size()), {}};
      for (size_t p = 0; p < product.parts.size(); ++p)
        factor.parts[p] = at_first_.data() + product.parts[p] * padded_words();
      factors.push_back(factor);
    }
  }
  coefficients_.resize(functions.size() * padded_words());
  in_.resize(block_.row_words());
  doubt_.resize(block_.row_words());
  mask_.assign(block_.row_words(), ~uint64_t{0});
}

/// The sine or cosine of a wave's angle between samples of a row (axis 0), or rows (axis 1), that
/// are so far apart.
double TurnedRows::step(WaveProducts::Part part, int axis, double samples) const {
  const Neighbourhood& cells = structure_.neighbourhood();
  const TrigonometricForm::Wave& wave = form_.waves()[part / 2];
  // The direction along the grid's axis, in cells per sample.
  const double along = cells.rotation.m[static_cast<size_t>(3 * axis + wave.axis)] *
                       grid_.spacing[axis] / cells.cell_size[wave.axis];
  // Whole turns are removed before precision is lost.
  const double turns = along * samples * wave.frequency;
  return apply(part % 2 ? Op::cosine : Op::sine, angle_of(turns - std::round(turns)), 0);
}

/// A coordinate in the grid, in cells, as the definition computes it, is a sum of three products
/// divided by the cell size. So its error is within a dozen roundings, of 2^-53 of the sum of
/// magnitudes. The same holds for that of a row's first sample. The angle between the two and its
/// sine and cosine have a few more roundings; 2^-47 is 64 of them.
void TurnedRows::find_angle_error() {
  const Neighbourhood& cells = structure_.neighbourhood();
  const Box3 box = block_.box();
  const double most =
      3 * (max_magnitude(box.min) + max_magnitude(box.max) + max_magnitude(cells.origin) +
           bits_per_word * grid_.spacing.x + grid_.magnitude());
  const double in_cells = 1 + most / min_component(cells.cell_size);
  const double angle_error = two_pi * 0x1p-47 * in_cells;
  slack_ = products_ ? products_->slack(angle_error) : form_.slack(angle_error);
}

void TurnedRows::find_steps() {
  const size_t waves = form_.waves().size();
  steps_ = allocate_aligned(2 * waves * bits_per_word);
  float* to = steps_.get();
  const double middle = products_ ? 0.5 * bits_per_word - 0.5 : 0;  // of a word
  for (size_t wave = 0; wave < waves; ++wave)
    for (const bool is_cosine : {true, false}) {
      const auto part = static_cast<WaveProducts::Part>(2 * wave + is_cosine);
      for (size_t i = 0; i < bits_per_word && !products_; ++i)
        *to++ = static_cast<float>(step(part, 0, static_cast<double>(i)));
      for (size_t w = 0; w < padded_words(); ++w)
        word_steps_.push_back(w < block_.row_words()
                                  ? step(part, 0, static_cast<double>(w * bits_per_word) + middle)
                                  : 0);
    }
  for (size_t wave = 0; wave < waves; ++wave)
    for (uint64_t row = 0; row < max_group_rows; ++row) {
      const auto part = static_cast<WaveProducts::Part>(2 * wave);
      const auto rows = static_cast<double>(row);
      row_steps_.push_back(
          {step(static_cast<WaveProducts::Part>(part + 1), 1, rows), step(part, 1, rows)});
    }
}

void TurnedRows::keep(const Job* job) {
  for (RowGroup group{0, 0, block_.z0, 0}; group.z0 < block_.z1; group.z0 = group.z1) {
    check_cancelled(job);
    group.z1 = std::min(block_.z1, group.z0 + max_group_layers);
    for (group.y0 = block_.y0; group.y0 < block_.y1; group.y0 = group.y1) {
      group.y1 = std::min(block_.y1, group.y0 + max_group_rows);
      keep_group(group);
    }
  }
}

void TurnedRows::keep_group(const RowGroup& group) {
  words_.clear();
  const auto is_alive = [&](uint32_t w) {
    for (size_t row = 0; row < group.rows(); ++row)
      if (block_.row(group.y(row), group.z(row))[w]) return true;
    return false;
  };
  uint32_t first = 0, last = static_cast<uint32_t>(block_.row_words());
  while (first < last && !is_alive(first)) ++first;
  while (first < last && !is_alive(last - 1)) --last;
  for (uint32_t w = first; w < last; ++w) words_.push_back(w);
  if (words_.empty()) return;
  if (!structure_.level().is_constant())
    bounds_.set(structure_.level(), slack_, grid_, group, words_);
  for (size_t row = 0; row < group.rows(); ++row) {
    find_starts(group, row);
    if (products_) {
      decide_products(group, row);
      continue;
    }
    for (size_t batch = 0; batch < words_.size(); batch += batch_words)
      decide(group, row, batch, std::min(batch_words, words_.size() - batch));
  }
}

void TurnedRows::find_starts(const RowGroup& group, size_t row) {
  const uint64_t after = group.y(row) - group.y0;
  if (after == 0) {
    const Vec3 p = grid_.at(uint64_t{words_[0]} * bits_per_word, group.y0, group.z(row));
    double angles[3][batch_padding];
    find_angles(structure_.neighbourhood(), {&p.x, true}, {&p.y, true}, {&p.z, true}, 1,
                {angles[0], angles[1], angles[2]});
    for (size_t n = 0; n < group_starts_.size(); ++n) {
      const TrigonometricForm::Wave& wave = form_.waves()[n];
      const double angle = wave.frequency * angles[wave.axis][0];
      group_starts_[n] = {apply(Op::sine, angle, 0), apply(Op::cosine, angle, 0)};
    }
  }
  float* to = at_first_.data();
  const double* steps = word_steps_.data();
  for (size_t n = 0; n < group_starts_.size(); ++n) {
    const auto [sine, cosine] = group_starts_[n];
    const auto [c, s] = row_steps_[n * max_group_rows + after];
    turn_angle(sine * c + cosine * s, cosine * c - sine * s, steps, steps + padded_words(),
               words_.size(), to, to + padded_words());
    to += 2 * padded_words();
    steps += 2 * padded_words();
  }
}

template <class ValueAt>
uint64_t TurnedRows::held(const RowGroup& group, size_t row, uint32_t word, uint64_t doubt,
                          ValueAt&& value_at) const {
  uint64_t in = 0;
  for (; doubt; doubt &= doubt - 1) {
    const size_t i = static_cast<size_t>(std::countr_zero(doubt));
    const Vec3 p = grid_.at(uint64_t{word} * bits_per_word + i, group.y(row), group.z(row));
    const double value = value_at(i), level = structure_.level().at(p);
    if (value <= level - slack_ || (value <= level + slack_ && structure_.inside(p)))
      in |= doubt & -doubt;
  }
  return in;
}

float TurnedRows::product_at(size_t n, size_t sample) const {
  constexpr size_t half = ProductRow::half;
  const bool is_behind = sample >= half;
  const size_t at = is_behind ? sample - half : half - 1 - sample;
  auto value = static_cast<float>(products_->constant());
  for (size_t f = 0; f < function_pointers_.size(); ++f) {
    const float term = function_pointers_[f][at] * coefficients_[f * padded_words() + n];
    value += f < evens_ || is_behind ? term : -term;
  }
  return products_->is_absolute() ? std::abs(value) : value;
}

void TurnedRows::decide_products(const RowGroup& group, size_t row) {
  for (size_t f = 0; f < factors_.size(); ++f)
    add_products(factors_[f].data(), factors_[f].size(), words_.size(),
                 coefficients_.data() + f * padded_words());
  std::fill(in_.begin(), in_.end(), 0);
  const ProductRow products{function_pointers_.data(),
                            evens_,
                            function_pointers_.data() + evens_,
                            function_pointers_.size() - evens_,
                            coefficients_.data(),
                            padded_words(),
                            static_cast<float>(products_->constant()),
                            products_->is_absolute()};
  const LinearWords words{words_.data(),
                          words_.size(),
                          bounds_.low.data(),
                          bounds_.high.data(),
                          structure_.level().is_constant(),
                          mask_.data()};
  const bool has_doubt = msq::decide_products(products, words, {in_.data(), doubt_.data()});
  uint64_t* const alive = block_.row(group.y(row), group.z(row));
  for (size_t n = 0; n < words_.size(); ++n) {
    const uint32_t w = words_[n];
    uint64_t in = in_[w];
    if (has_doubt && (doubt_[n] & alive[w]))
      in |= held(group, row, w, doubt_[n] & alive[w],
                 [&](size_t i) { return static_cast<double>(product_at(n, i)); });
    alive[w] &= in;
  }
}

void TurnedRows::decide(const RowGroup& group, size_t row, size_t first, size_t count) {
  constexpr size_t stride = single_points + batch_padding;
  for (size_t wave = 0; wave < form_.waves().size(); ++wave) {
    const float* steps = steps_.get() + 2 * wave * bits_per_word;
    const float* from = at_first_.data() + 2 * wave * padded_words() + first;
    float* to = waves_.get() + 2 * wave * stride;
    turn_angles(from, from + padded_words(), count, steps, steps + bits_per_word, to, to + stride);
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
    in |= held(group, row, words_[first + n], at_most_high[n] & ~in & word,
               [&](size_t i) { return static_cast<double>(values[n * bits_per_word + i]); });
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
        structure.angles().find({x, false}, {&y, true}, {&z, true}, size,
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
