// SPDX-License-Identifier: Apache-2.0
// Rows of samples of sums of waves.
//
// In a block of 64 samples along x and up to 64 rows and layers the sum is computed at knots, and
// interpolated along z, y and x between them. Knots are the zeros of a Chebyshev polynomial, of the
// lowest degree that serves. So the cost of a sample does not depend on the number of waves where
// samples are much closer than a wavelength. Where they are not, the samples of an axis are its
// knots. Samples within the error of the level are decided by the definition.
// Source of the bounds: Rivlin, "Chebyshev Polynomials", 1990: m knots on [-1, 1] interpolate f
// with an error of at most max |f^(m)| / (2^(m-1) m!), and a sum of values times weights is at most
// 1 + 2 / pi ln m times the largest value.
//
// The error. Along an axis of half-length h, wave i is a cosine of rate k_i h, so its error is at
// most a 2 (k_i h / 2)^m / m!. Interpolation along x multiplies the errors of y and z by its
// constant, and that along y those of z. The last sum is in single precision: weights, values,
// products and sums are rounded, u (m + 3) times the largest value times the constant, with u =
// 2^-24. All else is in double precision, and within Waves::error().
#pragma once

#include <vector>

#include "base/simd.h"
#include "structure/waves/wave_kernels.h"
#include "structure/waves/waves.h"

namespace msq {

class WaveRows {
 public:
  WaveRows(const Waves& structure, const RowBlock& block, const Job* job);

  void keep();

 private:
  static constexpr size_t side = 64;
  /// Samples of a block along an axis.
  struct Axis {
    double centre = 0;
    size_t samples = 0, knots = 0;
    std::vector<double> offsets;          // of the knots from the centre
    std::vector<double> weights;          // sample by sample, one for each knot
    double error = 0, constant = 1;       // of the interpolation
    std::vector<double> real, imaginary;  // of the waves at the knots: knot by knot
  };

  /// `positions` of up to `side` samples along an axis of the samples.
  void prepare(int axis, const double* positions, size_t count, Axis& to) const;
  void find_waves(int axis, Axis& to) const;
  void keep_chunk(uint64_t y0, uint64_t y1, uint64_t z0, uint64_t z1);
  bool is_alive(size_t word, uint64_t y0, uint64_t y1, uint64_t z0, uint64_t z1) const;
  void find_knots(double x);
  void keep_word(size_t word, uint64_t y0, uint64_t z0);
  uint64_t decide(size_t word, uint64_t j, uint64_t k, uint64_t alive, const WordBits& bits,
                  const float* values, double slack) const;

  const Waves& structure_;
  const RowBlock& block_;
  const SampleGrid& grid_;
  const Job* const job_;
  const size_t waves_;            // padded
  std::vector<double> rates_[3];  // of the waves, in cycles per unit along the samples' axes
  Axis x_, y_, z_;
  size_t width_ = 0;                         // of a row of knots, padded
  std::vector<double> x_cosines_, x_sines_;  // wave by wave, a row of knots each
  std::vector<float> x_weights_;             // knot by knot, one for each sample
  std::vector<double> knots_, layer_, row_, work_, unused_;
  double double_error_ = 0;
};

}  // namespace msq
