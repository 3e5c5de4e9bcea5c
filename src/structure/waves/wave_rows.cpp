// SPDX-License-Identifier: Apache-2.0
#include "structure/waves/wave_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/pi.h"

namespace msq {

namespace {

/// The interpolation's error, above which more knots are used; and the part of the samples above
/// which all of them are knots.
constexpr double enough = 2e-6, max_part = 0.6;

size_t padded_to_16(size_t n) {
  return (n + 15) / 16 * 16;
}

/// The largest single-precision number of at most v.
float at_most(double v) {
  const float f = static_cast<float>(v);
  return static_cast<double>(f) > v ? std::nextafter(f, -std::numeric_limits<float>::infinity())
                                    : f;
}

/// Weights of the zeros of the Chebyshev polynomial of degree m at s, from -1 to 1: by the discrete
/// orthogonality of the lower polynomials.
void chebyshev_weights(size_t m, double s, const std::vector<double>& table, double* weights) {
  double t[64];
  t[0] = 1;
  if (m > 1) t[1] = s;
  for (size_t k = 2; k < m; ++k) t[k] = 2 * s * t[k - 1] - t[k - 2];
  for (size_t j = 0; j < m; ++j) {
    double sum = 0.5;
    for (size_t k = 1; k < m; ++k) sum += t[k] * table[k * m + j];
    weights[j] = 2 * sum / static_cast<double>(m);
  }
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
  double positions[side];
  for (size_t i = 0; i < side; ++i) positions[i] = static_cast<double>(i) * grid_.spacing.x;
  prepare(0, positions, side, x_);
  width_ = padded_to_16(x_.knots);
  x_cosines_.resize(waves_ * width_);
  x_sines_.resize(waves_ * width_);
  for (size_t j = 0; j < x_.knots; ++j)
    for (size_t i = 0; i < waves_; ++i) {
      x_cosines_[i * width_ + j] = x_.real[j * waves_ + i];
      x_sines_[i * width_ + j] = x_.imaginary[j * waves_ + i];
    }
  x_weights_.resize(x_.knots * side);
  for (size_t s = 0; s < side; ++s)
    for (size_t j = 0; j < x_.knots; ++j)
      x_weights_[j * side + s] = static_cast<float>(x_.weights[s * x_.knots + j]);
  work_.resize(10 * waves_);
  row_.resize(width_);
  unused_.resize(width_);
  // Knots are sums of 2 products for each wave; weights, of at most 64 knots with 64 terms each.
  const double terms = 2 * static_cast<double>(waves_) + 64 * 64;
  double magnitude = grid_.magnitude();
  if (grid_.heights)
    magnitude = std::max({magnitude, std::abs(grid_.z(0)), std::abs(grid_.z(grid_.nz - 1))});
  double_error_ = 4 * structure.error(magnitude) + 0x1p-50 * terms * structure.waves().most();
}

void WaveRows::find_waves(int axis, Axis& to) const {
  to.real.resize(to.knots * waves_);
  to.imaginary.resize(to.knots * waves_);
  std::vector<double> turns(waves_);
  for (size_t j = 0; j < to.knots; ++j) {
    for (size_t i = 0; i < waves_; ++i) turns[i] = rates_[axis][i] * to.offsets[j];
    sines_of_turns(turns.data(), waves_, to.imaginary.data() + j * waves_,
                   to.real.data() + j * waves_);
  }
}

void WaveRows::prepare(int axis, const double* positions, size_t count, Axis& to) const {
  to.samples = count;
  to.centre = 0.5 * (positions[0] + positions[count - 1]);
  const double half = 0.5 * (positions[count - 1] - positions[0]);
  const double amplitude = structure_.waves().amplitude();
  // With m knots: the sum over waves of a 2 (k h / 2)^m / m!.
  std::vector<double> terms(waves_, 2 * amplitude);
  size_t m = 0;
  do {
    ++m;
    to.error = 0;
    for (size_t i = 0; i < structure_.waves().count(); ++i) {
      terms[i] *= two_pi / 2 * std::abs(rates_[axis][i]) * half / static_cast<double>(m);
      to.error += terms[i];
    }
    to.error *= 1 + 0x1p-30;
  } while (!(to.error < enough) && static_cast<double>(m) < max_part * static_cast<double>(count));
  const double m_real = static_cast<double>(m);
  if (!(to.error < enough) || m >= count) {
    to.knots = count;
    to.error = 0;
    to.constant = 1;
    to.offsets.resize(count);
    to.weights.assign(count * count, 0);
    for (size_t j = 0; j < count; ++j) {
      to.offsets[j] = positions[j] - to.centre;
      to.weights[j * count + j] = 1;
    }
    return find_waves(axis, to);
  }
  to.knots = m;
  to.constant = (1 + 0x1p-30) * (1 + 2 / pi * std::log(m_real));
  to.offsets.resize(m);
  std::vector<double> table(m * m);
  for (size_t j = 0; j < m; ++j) {
    const double angle = (static_cast<double>(j) + 0.5) * pi / m_real;
    to.offsets[j] = half * std::cos(angle);
    for (size_t k = 0; k < m; ++k) table[k * m + j] = std::cos(static_cast<double>(k) * angle);
  }
  to.weights.resize(count * m);
  for (size_t s = 0; s < count; ++s)
    chebyshev_weights(m, std::clamp((positions[s] - to.centre) / half, -1.0, 1.0), table,
                      to.weights.data() + s * m);
  find_waves(axis, to);
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
      prepare(1, positions, static_cast<size_t>(y1 - y0), y_);
      for (uint64_t k = z0; k < z1; ++k) positions[k - z0] = grid_.z(k);
      prepare(2, positions, static_cast<size_t>(z1 - z0), z_);
      const size_t rows = (y_.knots + 3) / 4 * 4;
      knots_.assign(z_.knots * rows * width_, 0);
      layer_.resize(rows * width_);
      is_prepared = true;
    }
    find_knots(grid_.x(word * side) + x_.centre);
    keep_word(word, y0, z0);
  }
}

/// The sums at the knots of a word, whose middle is at x.
void WaveRows::find_knots(double x) {
  const Vec3 from_origin = Vec3{x, y_.centre, z_.centre} - structure_.neighbourhood().origin;
  double* const at = work_.data();
  const auto part = [&](size_t n) {
    return Complex{at + 2 * n * waves_, at + (2 * n + 1) * waves_};
  };
  const Complex middle = part(0);
  const WaveSet& waves = structure_.waves();
  // The turns stand where the first product comes.
  double* const turns = part(1).real;
  for (size_t i = 0; i < waves_; ++i)
    turns[i] = rates_[0][i] * from_origin.x + rates_[1][i] * from_origin.y +
               rates_[2][i] * from_origin.z + waves.phases()[i];
  sines_of_turns(turns, waves_, middle.imaginary, middle.real);
  for (size_t i = 0; i < waves_; ++i) {
    middle.real[i] *= waves.amplitudes()[i];
    middle.imaginary[i] *= waves.amplitudes()[i];
  }
  const size_t rows = (y_.knots + 3) / 4 * 4;
  const auto wave_at = [&](Axis& axis, size_t knot) {
    return Complex{axis.real.data() + knot * waves_, axis.imaginary.data() + knot * waves_};
  };
  std::vector<double> of_layer(2 * waves_);
  const Complex layer{of_layer.data(), of_layer.data() + waves_};
  for (size_t k = 0; k < z_.knots; ++k) {
    complex_products(middle, wave_at(z_, k), waves_, layer);
    for (size_t j = 0; j < y_.knots; j += 4) {
      Complex four[4];
      double* to[4];
      for (size_t r = 0; r < 4; ++r) {
        four[r] = part(1 + r);
        to[r] = knots_.data() + (k * rows + j + r) * width_;
        // The last knot stands for those that pad the rows.
        complex_products(layer, wave_at(y_, std::min(j + r, y_.knots - 1)), waves_, four[r]);
      }
      knot_sums(four, waves_, x_cosines_.data(), x_sines_.data(), width_, to);
    }
  }
}

void WaveRows::keep_word(size_t word, uint64_t y0, uint64_t z0) {
  const size_t rows = (y_.knots + 3) / 4 * 4, layer_size = rows * width_;
  const Parameter& level = structure_.level();
  const double error = double_error_ * x_.constant * y_.constant * z_.constant + x_.error +
                       x_.constant * (y_.error + y_.constant * z_.error);
  float floats[side], values[side];
  for (size_t k = 0; k < z_.samples; ++k) {
    weighted_sum(knots_.data(), layer_size, z_.weights.data() + k * z_.knots, z_.knots, layer_size,
                 layer_.data());
    const double most = largest(layer_.data(), layer_size) * y_.constant;
    const double slack =
        error + 0x1p-24 * 1.01 * static_cast<double>(x_.knots + 3) * x_.constant * most + 0x1p-100;
    const auto thresholds = [&](Interval levels, float& low, float& high) {
      low = at_most(levels.low - slack);
      high = -at_most(-(levels.high + slack));
    };
    float low = 0, high = 0;
    if (level.is_constant()) thresholds(level.range(), low, high);
    for (size_t j = 0; j < y_.samples; ++j) {
      uint64_t& bits = block_.row(y0 + j, z0 + k)[word];
      if (!bits) continue;
      weighted_sum(layer_.data(), width_, y_.weights.data() + j * y_.knots, y_.knots, width_,
                   row_.data());
      for (size_t i = 0; i < x_.knots; ++i) floats[i] = static_cast<float>(row_[i]);
      if (!level.is_constant()) {
        const uint64_t first = word * side, last = std::min(first + side, grid_.nx) - 1;
        thresholds(level.range({grid_.at(first, y0 + j, z0 + k), grid_.at(last, y0 + j, z0 + k)}),
                   low, high);
      }
      const WordBits found =
          row_word(floats, x_weights_.data(), x_.knots, structure_.is_sheet(), low, high, values);
      bits = decide(word, y0 + j, z0 + k, bits, found, values, slack);
    }
  }
}

/// What is left of a word. Samples that are not alive may lie where nothing must be evaluated.
uint64_t WaveRows::decide(size_t word, uint64_t j, uint64_t k, uint64_t alive, const WordBits& bits,
                          const float* values, double slack) const {
  uint64_t kept = alive & bits.at_most_low;
  const Parameter& level = structure_.level();
  for (uint64_t doubt = alive & bits.at_most_high & ~bits.at_most_low; doubt; doubt &= doubt - 1) {
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
