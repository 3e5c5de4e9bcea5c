// SPDX-License-Identifier: Apache-2.0
#include "structure/waves/wave_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace msq {

namespace {

/// The largest number of waves whose tables stay in the nearest cache.
constexpr size_t max_part = 128;

size_t padded_to(size_t step, size_t n) {
  return (n + step - 1) / step * step;
}

/// The largest single-precision number of at most v.
float at_most(double v) {
  const float f = static_cast<float>(v);
  return static_cast<double>(f) > v ? std::nextafter(f, -std::numeric_limits<float>::infinity())
                                    : f;
}

}  // namespace

WaveRows::WaveRows(const Waves& structure, const RowBlock& block, const Job* job)
    : structure_(structure),
      block_(block),
      grid_(*block.grid),
      job_(job),
      waves_(structure.waves().padded()) {
  const Neighbourhood& cells = structure.neighbourhood();
  for (auto& rates : rates_) rates.resize(waves_);
  for (size_t i = 0; i < waves_; ++i) {
    const Vec3 n = structure.waves().wave(i);
    const Vec3 w = cells.rotation.apply(
        {n.x / cells.cell_size.x, n.y / cells.cell_size.y, n.z / cells.cell_size.z});
    for (int axis = 0; axis < 3; ++axis) rates_[axis][i] = w[axis];
  }
  prepare_words();
  const size_t parts = (waves_ + max_part - 1) / max_part;
  part_ = padded_to(WaveSet::sums, (waves_ + parts - 1) / parts);
  work_ = allocate_aligned<double>(3 * waves_ + 10 * part_);
  // The last word may reach beyond the grid.
  double magnitude = grid_.magnitude() + side * grid_.spacing.x;
  if (grid_.heights)
    magnitude = std::max({magnitude, std::abs(grid_.z(0)), std::abs(grid_.z(grid_.nz - 1))});
  const double roundings = static_cast<double>(waves_ + max_knots * max_knots * max_knots);
  double_error_ = 4 * structure.error(magnitude) + 0x1p-50 * roundings * structure.waves().most();
}

AxisWaves WaveRows::along(int axis) const {
  const WaveSet& waves = structure_.waves();
  return {rates_[axis].data(), waves.count(), waves.amplitude()};
}

void WaveRows::find_waves(int axis, Axis& to) const {
  const size_t count = to.knots.count() * waves_;
  std::vector<double> turns(count);
  for (size_t j = 0; j < to.knots.count(); ++j)
    for (size_t i = 0; i < waves_; ++i)
      turns[j * waves_ + i] = rates_[axis][i] * to.knots.offsets[j];
  to.cosines = allocate_aligned<double>(count);
  to.sines = allocate_aligned<double>(count);
  sines_of_turns(turns.data(), count, to.sines.get(), to.cosines.get());
}

/// What all words along x have in common.
void WaveRows::prepare_words() {
  double positions[side];
  for (size_t i = 0; i < side; ++i) positions[i] = static_cast<double>(i) * grid_.spacing.x;
  x_.knots = knot_pairs_for(along(0), positions, side);
  find_waves(0, x_);
  const size_t count = x_.knots.count();
  width_ = padded_to(8, count);
  cosines_ = allocate_aligned<double>(waves_ * width_);
  sines_ = allocate_aligned<double>(waves_ * width_);
  std::fill_n(cosines_.get(), waves_ * width_, 0.0);
  std::fill_n(sines_.get(), waves_ * width_, 0.0);
  for (size_t j = 0; j < count; ++j)
    for (size_t i = 0; i < waves_; ++i) {
      cosines_[i * width_ + j] = x_.cosines[j * waves_ + i];
      sines_[i * width_ + j] = x_.sines[j * waves_ + i];
    }
  x_.cosines.reset();
  x_.sines.reset();
  weights_ = allocate_aligned<float>(count * side);
  for (size_t p = 0; p < side / 2; ++p)
    for (size_t j = 0; j < 2 * count; ++j)
      weights_[(j % count) * side + j / count * (side / 2) + p] =
          static_cast<float>(x_.knots.weights[p * 2 * count + j]);
}

void WaveRows::keep() {
  for (uint64_t z0 = block_.z0; z0 < block_.z1; z0 += side)
    for (uint64_t y0 = block_.y0; y0 < block_.y1; y0 += side)
      keep_chunk(y0, std::min(block_.y1, y0 + side), z0, std::min(block_.z1, z0 + side));
}

bool WaveRows::is_alive(size_t word, uint64_t y0, uint64_t y1, uint64_t z0, uint64_t z1) const {
  for (uint64_t k = z0; k < z1; ++k)
    for (uint64_t j = y0; j < y1; ++j)
      if (block_.row(j, k)[word]) return true;
  return false;
}

void WaveRows::keep_chunk(uint64_t y0, uint64_t y1, uint64_t z0, uint64_t z1) {
  double positions[side];
  bool is_prepared = false;
  for (size_t word = 0; word < block_.row_words(); ++word) {
    check_cancelled(job_);
    if (!is_alive(word, y0, y1, z0, z1)) continue;
    if (!is_prepared) {
      for (uint64_t j = y0; j < y1; ++j) positions[j - y0] = grid_.y(j);
      y_.knots = knot_pairs_for(along(1), positions, static_cast<size_t>(y1 - y0));
      find_waves(1, y_);
      for (uint64_t k = z0; k < z1; ++k) positions[k - z0] = grid_.z(k);
      z_.knots = knots_for(along(2), positions, static_cast<size_t>(z1 - z0));
      find_waves(2, z_);
      const size_t layer = 4 * y_.knots.count() * width_;
      knots_ = allocate_aligned<double>(z_.knots.count() * layer);
      layer_ = allocate_aligned<double>(layer);
      is_prepared = true;
    }
    find_knots(grid_.x(word * side) + x_.knots.centre);
    keep_word(word, y0, y1, z0, z1);
  }
}

/// The sums at the knots of a word, whose middle is at x: layer by layer; in these pair by pair,
/// the even part along y and then the odd one; and of both the even part along x and then the odd
/// one.
void WaveRows::find_knots(double x) {
  const Vec3 from_origin =
      Vec3{x, y_.knots.centre, z_.knots.centre} - structure_.neighbourhood().origin;
  const WaveSet& waves = structure_.waves();
  double* const turns = work_.get();
  const Complex middle{turns + waves_, turns + 2 * waves_};
  for (size_t i = 0; i < waves_; ++i)
    turns[i] = rates_[0][i] * from_origin.x + rates_[1][i] * from_origin.y +
               rates_[2][i] * from_origin.z + waves.phases()[i];
  sines_of_turns(turns, waves_, middle.imaginary, middle.real);
  for (size_t i = 0; i < waves_; ++i) {
    middle.real[i] *= waves.amplitudes()[i];
    middle.imaginary[i] *= waves.amplitudes()[i];
  }
  double* const parts = turns + 3 * waves_;
  const auto array = [&](size_t n) { return parts + n * part_; };
  const Complex layer{array(0), array(1)};
  const KnotFactors factors[2] = {{array(2), array(3), array(4), array(5)},
                                  {array(6), array(7), array(8), array(9)}};
  const auto at = [&](const Axis& axis, size_t knot, size_t first) {
    return Complex{axis.cosines.get() + knot * waves_ + first,
                   axis.sines.get() + knot * waves_ + first};
  };
  const size_t pairs = y_.knots.count(), pair = 4 * width_;
  std::fill_n(knots_.get(), z_.knots.count() * pairs * pair, 0.0);
  for (size_t first = 0; first < waves_; first += part_) {
    const size_t count = std::min(part_, waves_ - first);
    const double* const c = cosines_.get() + first * width_;
    const double* const s = sines_.get() + first * width_;
    for (size_t k = 0; k < z_.knots.count(); ++k) {
      check_cancelled(job_);
      complex_products({middle.real + first, middle.imaginary + first}, at(z_, k, first), count,
                       layer);
      for (size_t j = 0; j < pairs; j += 2) {
        const bool are_two = j + 1 < pairs;
        knot_factors(layer, at(y_, j, first), count, factors[0]);
        if (are_two) knot_factors(layer, at(y_, j + 1, first), count, factors[1]);
        double* const to = knots_.get() + (k * pairs + j) * pair;
        add_knots(factors[0], are_two ? &factors[1] : nullptr, count, c, s, width_, to, to + pair);
      }
    }
  }
}

void WaveRows::keep_word(size_t word, uint64_t y0, uint64_t y1, uint64_t z0, uint64_t z1) {
  const size_t terms = z_.knots.count(), size = 4 * y_.knots.count() * width_;
  for (uint64_t k = z0; k < z1; ++k) {
    if (!is_alive(word, y0, y1, k, k + 1)) continue;
    const double* layer = knots_.get() + (k - z0) * size;
    if (!z_.knots.are_samples) {
      weighted_sum(knots_.get(), size, z_.knots.weights.data() + (k - z0) * terms, terms, size,
                   layer_.get());
      layer = layer_.get();
    }
    keep_layer(word, y0, y1, k, layer);
  }
}

void WaveRows::keep_layer(size_t word, uint64_t y0, uint64_t y1, uint64_t k, const double* layer) {
  const Knots &x = x_.knots, &y = y_.knots, &z = z_.knots;
  const size_t terms = y.count(), rows = static_cast<size_t>(y1 - y0);
  const double error = double_error_ * x.constant * y.constant * z.constant + x.error +
                       x.constant * (y.error + y.constant * z.error);
  const double most = y.spread * largest(layer, 4 * terms * width_);
  const double slack =
      error + 0x1p-24 * 1.01 * static_cast<double>(x.count() + 3) * x.spread * most + 0x1p-100;
  const auto limits_of = [&](Interval levels) {
    return WordLimits{at_most(levels.low - slack), -at_most(-(levels.high + slack))};
  };
  const Parameter& level = structure_.level();
  const bool is_constant = level.is_constant();
  WordLimits limits[2] = {};
  if (is_constant) limits[0] = limits[1] = limits_of(level.range());
  const uint64_t first = word * side, last = std::min(first + side, grid_.nx) - 1;
  float values[2 * side];
  for (size_t p = 0; p < (rows + 1) / 2; ++p) {
    const uint64_t pair[2] = {y0 + rows / 2 + p, y0 + (rows - 1) / 2 - p};
    uint64_t* const bits[2] = {block_.row(pair[0], k) + word, block_.row(pair[1], k) + word};
    if (!*bits[0] && !*bits[1]) continue;
    const double* const even = y.weights.data() + p * 2 * terms;
    if (!is_constant)
      for (int row = 0; row < 2; ++row)
        if (*bits[row])
          limits[row] =
              limits_of(level.range({grid_.at(first, pair[row], k), grid_.at(last, pair[row], k)}));
    WordBits found[2];
    pair_words({layer, width_, even, even + terms, terms}, weights_.get(), x.count(),
               structure_.is_sheet(), limits, is_constant ? nullptr : values, found);
    for (size_t row = 0; row < (pair[0] == pair[1] ? 1u : 2u); ++row)
      *bits[row] = decide(word, pair[row], k, *bits[row], found[row], values + side * row, slack);
  }
}

/// What is left of a word. Samples that are not alive may lie where nothing must be evaluated.
uint64_t WaveRows::decide(size_t word, uint64_t j, uint64_t k, uint64_t alive, const WordBits& bits,
                          const float* values, double slack) const {
  uint64_t kept = alive & bits.at_most_low;
  const Parameter& level = structure_.level();
  for (uint64_t doubt = alive & ~bits.above_high & ~bits.at_most_low; doubt; doubt &= doubt - 1) {
    const auto bit = static_cast<size_t>(std::countr_zero(doubt));
    const Vec3 p = grid_.at(word * side + bit, j, k);
    bool is_inside;
    if (level.is_constant()) {
      is_inside = structure_.inside(p);
    } else {
      const double limit = level.at(p), gap = static_cast<double>(values[bit]) - limit;
      is_inside = std::abs(gap) > slack ? gap < 0 : structure_.onset(p) <= limit;
    }
    if (is_inside) kept |= doubt & -doubt;
  }
  return kept;
}

}  // namespace msq
