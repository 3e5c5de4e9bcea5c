// SPDX-License-Identifier: Apache-2.0
// The lines in a plane of constant z on which a function is 0: the middle of the walls of sheets,
// the boundary of networks.
//
// Source: marching squares, the plane form of Lorensen and Cline, "Marching cubes", 1987. The
// squares are those of a grid in model coordinates: lines closer than a square may be joined, and
// closed lines smaller than one lost. Crossings with the grid are found by the Illinois method
// (Dowell and Jarratt, "A modified regula falsi method", 1971); lines that bend more than the
// tolerance are halved.
#pragma once

#include <cmath>
#include <limits>

#include "base/sample_grid.h"
#include "base/vec.h"
#include "structure/common/line_graph.h"

namespace msq {

/// Points are inside where it is at most 0. What is no number is outside.
class LevelFunction {
 public:
  /// Points that row() takes at once.
  static constexpr size_t row_points = 256;

  virtual ~LevelFunction() = default;
  virtual double at(Vec3 p) const = 0;
  /// The same, to the last bit, at points of a row. x is readable up to batch_padding beyond.
  virtual void row(const double* x, double y, double z, size_t count, double* to) = 0;

  /// Whether find_signs() is there: signs of rows cost less than values.
  virtual bool has_signs() const { return false; }
  /// In rows of nodes clears the bits of those that may be outside, and in `not_outside` of those
  /// that are. The grid's positions are those of the nodes, except for rounding (SampleGrid).
  virtual void find_signs(const RowBlock& /*inside*/, const RowBlock& /*not_outside*/) {}
};

class LevelLines {
 public:
  /// `pitch`: of the grid. Where the function jumps from inside to outside there is a line only if
  /// `follows_jumps`. The function must stay alive.
  LevelLines(LevelFunction& function, double pitch, bool follows_jumps, const WallSection& section);

  LineGraph find();

 private:
  static constexpr uint32_t nothing = UINT32_MAX;
  /// A row of nodes of the grid, and the crossings on the sides that begin there.
  struct Row {
    CountedVector<double> values;
    CountedVector<uint32_t> right, up;
  };

  Vec2 node(int64_t i, int64_t j) const {
    return {pitch_ * static_cast<double>(first_x_ + i), pitch_ * static_cast<double>(first_y_ + j)};
  }
  /// The function, infinite where it is no number.
  double value(Vec2 p) const;
  void evaluate(int64_t j, Row& row);
  /// As evaluate(), but a node whose value is not needed yet has one of this sign.
  void evaluate_signs(int64_t j, Row& row);
  static constexpr double not_known = std::numeric_limits<double>::max();
  void find_strip(int64_t j);
  /// The value of a node.
  double exact(Row& row, int64_t i, int64_t j) {
    double& at = row.values[static_cast<size_t>(i)];
    if (std::abs(at) == not_known) at = value(node(i, j));
    return at;
  }
  /// The point where the function passes the level between two points, one inside and one outside;
  /// `nothing` where it jumps.
  uint32_t crossing(Vec2 a, double at_a, Vec2 b, double at_b);
  /// Narrows a and b to where the function passes the level. False where it jumps past it; of
  /// networks, by a cheaper rule.
  bool find_root(Vec2& a, double& at_a, Vec2& b, double& at_b) const;
  /// Two places on a way, one inside and one outside, and the values there.
  struct Bracket {
    double low, high, at_low, at_high;
    bool is_lower_than(double height) const {
      return std::isfinite(at_low) && std::isfinite(at_high) &&
             std::abs(at_high - at_low) <= height;
    }
  };
  /// Whether more than a quarter of `height`, that of the first bracket, remains after up to 20
  /// steps that narrow the bracket, 19 of them halvings.
  bool is_jump(Vec2 from, Vec2 way, Bracket in, double step, double height) const;
  void connect(int64_t j, const Row& low, const Row& high);
  void add_line(uint32_t a, uint32_t b);
  void refine();
  /// Halves a line as long as its middle is farther from the level than the tolerance.
  void halve(uint32_t a, uint32_t b, int depth);

  LevelFunction& function_;
  const WallSection& section_;
  double pitch_;
  bool follows_jumps_;
  int64_t first_x_, first_y_, columns_, rows_;  // nodes
  CountedVector<double> x_;
  // Signs of a strip of rows.
  static constexpr int64_t strip_rows = 64;
  SampleGrid nodes_;
  int64_t strip_begin_ = 0, strip_end_ = 0;
  CountedVector<uint64_t> inside_, not_outside_;
  LineGraph graph_;
};

}  // namespace msq
