// SPDX-License-Identifier: Apache-2.0
// Bounds of the value of a tape along pieces of rays: proven bounds, for many rays at once.
//
// Coordinates change in proportion to s, which runs from 0 to the piece's span, or nearly so. Each
// node is enclosed by
//   value + [low, high] s  +-  bend s^2  +-  error:
// its value at the start, its slope there (an interval only near kinks), its maximum deviation from
// that line, and its rounding error. Near a simple zero the slope dominates. So steps up to the
// nearest zero that these bounds allow converge as Newton's do, but never pass a zero.
// Source: Moore, "Interval Analysis", 1966 (mean value forms); Berz and Hoffstaetter, "Computation
// and application of Taylor polynomials with interval remainder bounds", 1998, of degree 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "expression/program.h"

namespace msq {

/// A tape, prepared for these bounds.
class RayProgram {
 public:
  explicit RayProgram(const Tape& tape);

  struct Instruction {
    Op op;
    uint16_t to, a, b;
    uint16_t waves = 0;     ///< of sines and cosines: the index where those of the operand are kept
    bool is_first = false;  ///< whether this operation is the first that needs them
    double rounding = 0;    ///< of the node where another cell's coordinates are larger
  };
  const Program& program() const { return program_; }
  const std::vector<Instruction>& code() const { return code_; }
  size_t waves() const { return waves_; }
  /// True if there are no minima, maxima, magnitudes or hypotenuses: then slopes are numbers.
  bool is_smooth() const { return is_smooth_; }
  static constexpr bool has_slope(Op op) {
    return op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::negate ||
           op == Op::sine || op == Op::cosine;
  }
  /// True if there are no other operations: then RayBatch::slopes() works.
  bool has_slopes() const { return has_slopes_; }

 private:
  Program program_;
  std::vector<Instruction> code_;
  size_t waves_ = 0;
  bool is_smooth_ = true, has_slopes_ = true;
};

/// Bounds of pieces of rays. Not for several threads at once.
class RayBatch {
 public:
  static constexpr size_t lanes = 32;

  explicit RayBatch(const RayProgram& program);

  /// For each piece: the coordinates at its start, their rates of change with s, how much they bend
  /// (their maximum deviation from that line, over s^2), their maximum error anywhere on it, and
  /// its span, which is positive. Lanes beyond the number of pieces are read, too, and must be
  /// finite.
  struct alignas(64) Pieces {
    double coordinates[3][lanes] = {}, rates[3][lanes] = {}, bends[3][lanes] = {};
    double error[lanes] = {}, span[lanes] = {};
  };
  /// For each piece. `value` equals evaluate() to the last bit. If nothing is known, `bend` is
  /// infinite or NaN.
  struct Bounds {
    const double *value, *low, *high, *bend, *error;
  };
  /// Valid until the next run.
  Bounds run(const Pieces& pieces, size_t count);
  /// The slopes along the three coordinates, which run() gives as low and high for a rate of 1
  /// along one coordinate and of 0 along the others, to the last bit. Only if the program has
  /// slopes. Valid until the next run.
  struct Slopes {
    const double* along[3];
  };
  Slopes slopes(const double (&coordinates)[3][lanes], size_t count);

 private:
  struct alignas(64) Register {
    double arrays[5][lanes] = {};  // value, low, high, bend, error; or value and three slopes
  };
  struct alignas(64) Wave {
    double arrays[2][lanes] = {};  // sine, cosine
  };

  const RayProgram& program_;
  std::vector<Register> registers_;
  std::vector<Wave> waves_;
};

}  // namespace msq
