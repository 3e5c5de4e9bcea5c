// SPDX-License-Identifier: Apache-2.0
// Sums of products of waves, as most presets are: products of sines and cosines of multiples of
// different coordinates. Near a sample, by the addition theorems, such a sum is a sum of fixed
// functions of the distance along the row, each times a coefficient of the sample.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "expression/tape.h"

namespace msq {

class WaveProducts {
 public:
  /// Sine (2 * wave) or cosine (2 * wave + 1).
  using Part = uint16_t;
  struct Product {
    double factor;
    std::vector<Part> parts;  ///< of different waves, in ascending order
  };
  /// A product of cosines and sines of the angles from a sample on: the coefficient is a sum of
  /// products of sines and cosines at the sample. It is even or odd in the distance.
  struct Function {
    std::vector<Part> parts;
    std::vector<Product> coefficient;
    bool is_odd() const;
  };
  static constexpr size_t max_functions = 24, max_parts = 4;

  /// `parts`: for each node of the tape that is a wave, its part; otherwise -1. `frequencies`: of
  /// the waves. Returns nothing for tapes that are no such sum, of few functions.
  static std::optional<WaveProducts> of(const Tape& tape, const std::vector<int>& parts,
                                        const std::vector<int>& frequencies);

  const std::vector<Function>& functions() const { return functions_; }
  double constant() const { return constant_; }
  bool is_absolute() const { return is_absolute_; }
  /// Bound of the error of the sum in single precision, from sines and cosines that are rounded to
  /// it; for angles that differ by at most angle_error.
  double slack(double angle_error) const;

 private:
  std::vector<Function> functions_;
  double constant_ = 0;
  bool is_absolute_ = false;
  double most_ = 0;   // of the sum of the magnitudes of all products
  double steep_ = 0;  // of their slopes by angles
  double operations_ = 0;
};

}  // namespace msq
