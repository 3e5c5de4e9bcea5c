// SPDX-License-Identifier: Apache-2.0
// Evaluates programs for batches of points, in vectors, with the bits of the scalar evaluator.
#pragma once

#include <vector>

#include "base/simd.h"
#include "expression/program.h"

namespace msq {

/// Points per batch: the temporaries of usual tapes fit a core's first-level cache.
constexpr size_t batch_points = 256;
constexpr size_t single_points = 512;
/// Arrays of values are readable this far beyond their points.
constexpr size_t batch_padding = 2 * max_simd_doubles;

/// One value per point, or one for all points.
template <class T>
struct ValuesOf {
  const T* data = nullptr;
  bool is_uniform = false;

  T operator[](size_t i) const { return is_uniform ? *data : data[i]; }
};
using Values = ValuesOf<double>;

/// Whether an operation can be done in single precision.
constexpr bool is_rational(Op op) {
  return op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::minimum ||
         op == Op::maximum || op == Op::negate || op == Op::absolute;
}

/// In double precision, as the scalar evaluator; or, for rational operations, in single precision.
template <class T>
class BatchOf {
 public:
  explicit BatchOf(const Program& program);

  /// Sets the values of an input for all following batches. They must stay alive.
  void set_input(size_t input, ValuesOf<T> values) { registers_[input] = values; }
  /// Evaluates up to batch_points points; up to single_points in single precision.
  void run(size_t count);
  /// Valid until the next run.
  ValuesOf<T> output(size_t output) const { return registers_[program_.outputs[output]]; }

 private:
  const Program& program_;
  std::vector<T> constants_;
  AlignedArray<T> temporaries_;  // so that no vector crosses a cache line
  std::vector<ValuesOf<T>> registers_;
  std::vector<T*> targets_;  // of the temporaries, by register
};
using Batch = BatchOf<double>;

}  // namespace msq
