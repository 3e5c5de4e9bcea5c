// SPDX-License-Identifier: Apache-2.0
// Vector kernels for sums of waves. The same bits on every instruction set where that is said.
#pragma once

#include <cstddef>
#include <cstdint>

#include "structure/waves/wave_set.h"

namespace msq {

/// The sum that wave_set.h defines, at a position in cells. The same bits everywhere.
double wave_sum(const WaveSet& waves, Vec3 u);

/// The sum, with the same bits, and its first three derivatives along `du`.
struct WaveExpansion {
  double value, first, second, third;
};
WaveExpansion expand_waves(const WaveSet& waves, Vec3 u, Vec3 du);

/// The sum, with the same bits, and its gradient by u.
double wave_gradient(const WaveSet& waves, Vec3 u, Vec3& gradient);

/// Sines and cosines of 2 pi times the numbers; `count` is a multiple of 16.
void sines_of_turns(const double* turns, size_t count, double* sines, double* cosines);

/// The products of `count` complex numbers, a multiple of 16.
struct Complex {
  double *real, *imaginary;
};
void complex_products(Complex a, Complex b, size_t count, Complex to);

/// to[r][j] = sum over i of p[r].real[i] cosines[i][j] - p[r].imaginary[i] sines[i][j], for four r
/// and `width` j, a multiple of 16. The tables have rows of `width`.
void knot_sums(const Complex (&p)[4], size_t count, const double* cosines, const double* sines,
               size_t width, double* const (&to)[4]);

/// to[j] = sum over k of weights[k] rows[k * stride + j]; `width` is a multiple of 16.
void weighted_sum(const double* rows, size_t stride, const double* weights, size_t terms,
                  size_t width, double* to);
/// The largest magnitude of `count` numbers, a multiple of 16.
double largest(const double* numbers, size_t count);

/// values[s] = sum over k of knots[k] weights[k * 64 + s], for 64 samples; with their magnitudes if
/// `is_absolute`. Returns the samples of at most `low`, and those of at most `high`.
struct WordBits {
  uint64_t at_most_low, at_most_high;
};
WordBits row_word(const float* knots, const float* weights, size_t terms, bool is_absolute,
                  float low, float high, float* values);

}  // namespace msq
