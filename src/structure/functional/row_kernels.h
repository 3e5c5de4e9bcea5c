// SPDX-License-Identifier: Apache-2.0
// Vector kernels for points and rows of functional structures, in addition to their programs.
#pragma once

#include "cell/neighbourhood.h"
#include "expression/batch.h"
#include "expression/tape.h"

namespace msq {

/// The angle of a fraction of the cell.
inline double angle_of(double fraction) {
  return fraction * two_pi;
}

/// Sets bit i of `bits` (word i / 64) to values[i] <= levels[i]. All words up to the last are
/// overwritten.
void compare_values(Values values, Values levels, size_t count, uint64_t* bits);

/// Angles of points in a neighbourhood: Neighbourhood::locate and angle_of, to the last bit. x, y,
/// z and the angles are `count` values; uniform coordinates are allowed.
void find_angles(const Neighbourhood& grid, Values x, Values y, Values z, size_t count,
                 double* const (&angles)[3]);

/// Sines and cosines of an angle plus each of the steps, from the given cosines and sines of the
/// steps.
void turn_angle(double sine, double cosine, const double* cosines, const double* sines,
                size_t count, float* to_sines, float* to_cosines);

/// For each word w of 64 samples, the sines and cosines of angles, from those at its first sample
/// and those of the steps from there, in single precision.
void turn_angles(const float* sine, const float* cosine, size_t words, const float* cosines,
                 const float* sines, float* to_sines, float* to_cosines);

/// For each listed word w of 64 samples: the samples with a value of at most low, and of at most
/// high. The thresholds are for chunks of samples or, if has_one_level, for all. The values are
/// stored word after word.
void compare_singles(ValuesOf<float> values, const uint32_t* words, size_t count, const float* low,
                     const float* high, bool has_one_level, uint64_t* at_most_low,
                     uint64_t* at_most_high);

/// A row of samples whose value is a sum of coefficients times tables, plus a constant, in single
/// precision.
struct LinearRow {
  const float* const* tables;  ///< `terms` of them, by sample
  const float* coefficients;
  size_t terms;
  float constant;
  bool is_absolute;  ///< the value is the magnitude of the sum
};
/// Samples that share a threshold.
constexpr size_t linear_chunk = 16;
/// Words of 64 samples, and thresholds for chunks of samples or, if has_one_level, for all.
struct LinearWords {
  const uint32_t* numbers;  ///< of the words, `count` of them
  size_t count;
  const float *low, *high;
  bool has_one_level;
  const uint64_t* mask;  ///< by word: samples to decide
};
struct LinearResult {
  uint64_t* in;     ///< by word: adds the samples with a value of at most low
  uint64_t* doubt;  ///< by number in the list: samples above low, but not above high
};
/// Returns whether there is any doubt.
bool decide_linear(const LinearRow& row, const LinearWords& words, const LinearResult& to);

}  // namespace msq
