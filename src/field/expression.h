// SPDX-License-Identifier: Apache-2.0
// An expression in the model's coordinates, cut to a range.
#pragma once

#include <utility>

#include "expression/program.h"
#include "expression/tape.h"
#include "field/field.h"

namespace msq {

class ExpressionField final : public Field {
 public:
  /// Where the expression is NaN, the field is range.low.
  ExpressionField(Tape tape, Interval range)
      : tape_(std::move(tape)), program_(compile(tape_)), range_(range) {}

  double at(Vec3 p) const override { return cut(evaluate(tape_, p)); }
  void values(const Vec3* points, size_t count, double* values) const override;
  bool is_linear(const Box3& box, Vec3& gradient) const override;
  Interval range() const override { return range_; }
  Interval range(const Box3& box) const override;
  double lipschitz(const Box3& box) const override;
  std::optional<Slopes> slopes(const Box3& box) const override;

  using Field::lipschitz;

 private:
  void describe(HashInput& input) const override;
  double cut(double v) const { return v > range_.low ? std::min(v, range_.high) : range_.low; }

  Tape tape_;
  Program program_;
  Interval range_;
};

}  // namespace msq
