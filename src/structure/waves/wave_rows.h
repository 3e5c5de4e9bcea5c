// SPDX-License-Identifier: Apache-2.0
// Rows of samples of sums of waves.
//
// In a block of 64 samples along x and up to 64 rows and layers the sum is computed at knots
// (knots.h), and interpolated along z, y and x between them. So the cost of a sample does not
// depend on the number of waves where samples are much closer than a wavelength. Samples within the
// error of the level are decided by the definition.
//
// Knots and samples along x and y are symmetric about the block's middle. A cosine there is c cos -
// s sin, so its even part needs one product for each pair of knots, and its odd part another; and a
// pair of samples is the sum and the difference of two sums with half of the terms.
//
// The error. Interpolation along x multiplies the errors of y and z by its constant, and that along
// y those of z. The last sum is in single precision: with u = 2^-24, row values, weights, n
// products added one by one, and the last sum are rounded, u (n + 3) times the spread of the
// weights times the largest value. All else is in double precision: knots, within Waves::error()
// and 2^-53 for each of their terms; weights, of m polynomials of degree below m whose recurrence
// adds up to m^2 roundings, so those of all m knots are within m^3 of them.
#pragma once

#include <vector>

#include "base/simd.h"
#include "structure/waves/knots.h"
#include "structure/waves/wave_kernels.h"
#include "structure/waves/waves.h"

namespace msq {

class WaveRows {
 public:
  WaveRows(const Waves& structure, const RowBlock& block, const Job* job);

  void keep();

 private:
  static constexpr size_t side = max_knots;
  using Doubles = AlignedArray<double>;
  /// Knots, and cosines and sines of the waves at them: knot by knot.
  struct Axis {
    Knots knots;
    Doubles cosines, sines;
  };

  AxisWaves along(int axis) const;
  void find_waves(int axis, Axis& to) const;
  void prepare_words();
  void keep_chunk(uint64_t y0, uint64_t y1, uint64_t z0, uint64_t z1);
  bool is_alive(size_t word, uint64_t y0, uint64_t y1, uint64_t z0, uint64_t z1) const;
  void find_knots(double x);
  void keep_word(size_t word, uint64_t y0, uint64_t y1, uint64_t z0, uint64_t z1);
  void keep_layer(size_t word, uint64_t y0, uint64_t y1, uint64_t k, const double* layer);
  uint64_t decide(size_t word, uint64_t j, uint64_t k, uint64_t alive, const WordBits& bits,
                  const float* values, double slack) const;

  const Waves& structure_;
  const RowBlock& block_;
  const SampleGrid& grid_;
  const Job* const job_;
  const size_t waves_;            // padded
  std::vector<double> rates_[3];  // of the waves, in cycles per unit along the samples' axes
  Axis x_, y_, z_;
  size_t width_ = 0;         // of a part of a row of knots, padded
  size_t part_ = 0;          // waves that are added at once: their tables stay in the nearest cache
  Doubles cosines_, sines_;  // along x: wave by wave, a row of knots each
  AlignedFloats weights_;    // along x: even and odd parts of 32 pairs, knot by knot
  Doubles knots_, layer_, work_;
  double double_error_ = 0;
};

}  // namespace msq
