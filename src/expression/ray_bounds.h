// SPDX-License-Identifier: Apache-2.0
// What the value of a tape can be along pieces of rays: proven bounds, for many rays at once.
//
// Where coordinates change in proportion to s, from 0 to the piece's span, each node is enclosed by
//   value + [low, high] s  +-  bend s^2  +-  error:
// its value at the beginning, its slope there (an interval only about kinks), what it may bend away
// from that, and what rounding makes of it. Near a simple zero the slope alone rules, so that steps
// to where these bounds allow one converge as Newton's do, but never pass any.
// Source: Moore, "Interval Analysis", 1966 (mean value forms); Berz and Hoffstaetter, "Computation
// and application of Taylor polynomials with interval remainder bounds", 1998, of degree 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "expression/program.h"

namespace msq {

/// A tape, made ready for that.
class RayProgram {
 public:
  explicit RayProgram(const Tape& tape);

  struct Instruction {
    Op op;
    uint16_t to, a, b;
    uint16_t waves = 0;     ///< of sines and cosines: where those of the operand are kept
    bool is_first = false;  ///< to ask for them
    double rounding = 0;    ///< of the node where another cell's coordinates are larger
  };
  const Program& program() const { return program_; }
  const std::vector<Instruction>& code() const { return code_; }
  size_t waves() const { return waves_; }
  /// No minima, maxima or magnitudes: slopes are numbers.
  bool is_smooth() const { return is_smooth_; }

 private:
  Program program_;
  std::vector<Instruction> code_;
  size_t waves_ = 0;
  bool is_smooth_ = true;
};

/// Bounds of pieces of rays. Not for several threads at once.
class RayBatch {
 public:
  static constexpr size_t lanes = 32;

  explicit RayBatch(const RayProgram& program);

  /// By piece: the coordinates at its beginning, by how much each changes with s, by how much they
  /// may be wrong anywhere on it, and its span, which is positive. What lies beyond the pieces in
  /// number is read, too, and must be finite.
  struct alignas(64) Pieces {
    double coordinates[3][lanes] = {}, rates[3][lanes] = {}, error[lanes] = {}, span[lanes] = {};
  };
  /// By piece. `value` is evaluate()'s, to the last bit. Where nothing is known, `bend` is infinite
  /// or no number.
  struct Bounds {
    const double *value, *low, *high, *bend, *error;
  };
  /// Valid until the next run.
  Bounds run(const Pieces& pieces, size_t count);

 private:
  struct alignas(64) Register {
    double arrays[5][lanes] = {};  // value, low, high, bend, error
  };
  struct alignas(64) Wave {
    double arrays[2][lanes] = {};  // sine, cosine
  };

  const RayProgram& program_;
  std::vector<Register> registers_;
  std::vector<Wave> waves_;
};

}  // namespace msq
