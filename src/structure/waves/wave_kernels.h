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

/// A wave's factors of the sums at a pair of rows of knots, at equal distances from the middle
/// along y; each pair of knots along x has a cosine and a sine of its own. The even and the odd
/// part of the sum along y, and of each of these along x: coefficients of cosines, sines, cosines
/// and sines.
struct KnotFactors {
  double *even_even, *even_odd, *odd_even, *odd_odd;
};
/// Of the waves of a layer at the middle; `along_y` are cosines and sines. `count` is a multiple of
/// 16.
void knot_factors(Complex layer, Complex along_y, size_t count, KnotFactors to);

/// Adds to[p * width + j], p from 0 to 3, the sums over i of a factor of wave i times cosines[i *
/// width + j] or sines[i * width + j]: even_even, even_odd, odd_even, odd_odd. `width` is a
/// multiple of 8. The second, or NULL, at the same time.
void add_knots(const KnotFactors& first, const KnotFactors* second, size_t count,
               const double* cosines, const double* sines, size_t width, double* to_first,
               double* to_second);

/// to[j] = sum over k of weights[k] rows[k * stride + j]; `width` is a multiple of 16.
void weighted_sum(const double* rows, size_t stride, const double* weights, size_t terms,
                  size_t width, double* to);
/// The largest magnitude of `count` numbers, a multiple of 16.
double largest(const double* numbers, size_t count);

/// A pair of rows of knots: with v[k] row k of `layer`, the upper row is the sum over k of even[k]
/// v[2 k] and odd[k] v[2 k + 1], the lower row their difference; rounded to single precision. Each
/// row has `width` even parts along x, and then as many odd ones; `width` is a multiple of 8, at
/// most 32.
struct KnotRows {
  const double* layer;
  size_t width;
  const double *even, *odd;
  size_t terms;
};
/// What 64 samples are compared with.
struct WordLimits {
  float low, high;
};
/// Samples of at most `low`, and samples above `high`. Not-a-numbers are neither.
struct WordBits {
  uint64_t at_most_low, above_high;
};
/// A word of each of the two rows. Sample 32 + i is the sum over k of the even part k times
/// weights[64 k + i] and the odd part k times weights[64 k + 32 + i], sample 31 - i their
/// difference. With magnitudes if `is_absolute`. `values`: NULL, or where the 128 samples come.
void pair_words(const KnotRows& rows, const float* weights, size_t terms, bool is_absolute,
                const WordLimits (&limits)[2], float* values, WordBits (&to)[2]);

}  // namespace msq
