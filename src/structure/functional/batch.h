// SPDX-License-Identifier: Apache-2.0
// Programs evaluated for batches of points, in vectors: the bits of the scalar evaluator.
#pragma once

#include <vector>

#include "base/simd.h"
#include "cell/neighbourhood.h"
#include "structure/functional/program.h"

namespace msq {

/// Points of a batch: the temporaries of usual tapes stay in a core's first cache.
constexpr size_t batch_points = 256;
constexpr size_t single_points = 512;
/// Arrays of values are readable this far beyond their points.
constexpr size_t batch_padding = 2 * most_simd_doubles;

/// A value for each point, or one for all.
template <class T>
struct ValuesOf {
  const T* data = nullptr;
  bool is_uniform = false;

  T operator[](size_t i) const { return is_uniform ? *data : data[i]; }
};
using Values = ValuesOf<double>;

/// Whether an operation can be done in single precision.
constexpr bool is_rational(Op op) {
  return op >= Op::add && op <= Op::absolute && op != Op::divide;
}

/// In double precision, as the scalar evaluator; or, for rational operations, in single precision.
template <class T>
class BatchOf {
 public:
  explicit BatchOf(const Program& program);

  /// The values of an input for all batches from now on; must stay alive.
  void set_input(size_t input, ValuesOf<T> values) { registers_[input] = values; }
  /// Evaluates up to batch_points points, in single precision single_points.
  void run(size_t count);
  /// Valid until the next run.
  ValuesOf<T> output(size_t output) const { return registers_[program_.outputs[output]]; }

 private:
  const Program& program_;
  std::vector<T> constants_, temporaries_;
  std::vector<ValuesOf<T>> registers_;
  std::vector<T*> targets_;  // of the temporaries, by register
};
using Batch = BatchOf<double>;

/// Bit i of `bits` (word i / 64), which is overwritten up to the last word: values[i] <= levels[i].
void compare_values(Values values, Values levels, size_t count, uint64_t* bits);

/// Angles of points in a neighbourhood: Neighbourhood::locate and angle_of, to the last bit. x, y,
/// z and the angles are `count` values; uniform coordinates are allowed.
void find_angles(const Neighbourhood& grid, Values x, Values y, Values z, size_t count,
                 double* const (&angles)[3]);

/// Sines and cosines of an angle plus each of the steps, whose cosines and sines are given.
void turn_angle(double sine, double cosine, const double* cosines, const double* sines,
                size_t count, float* to_sines, float* to_cosines);

/// For each word w of 64 samples the sines and cosines of angles, from those at its first sample
/// and those of the steps from there, in single precision.
void turn_angles(const float* sine, const float* cosine, size_t words, const float* cosines,
                 const float* sines, float* to_sines, float* to_cosines);

/// As compare_linear, for values that are there, word after word.
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
/// For each listed word w of 64 samples: the samples with a value of at most low, and of at most
/// high, thresholds that stand for chunks of samples, or, where has_one_level, for all.
void compare_linear(const LinearRow& row, const uint32_t* words, size_t count, const float* low,
                    const float* high, bool has_one_level, uint64_t* at_most_low,
                    uint64_t* at_most_high);

}  // namespace msq
