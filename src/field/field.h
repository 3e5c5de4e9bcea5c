// SPDX-License-Identifier: Apache-2.0
// Scalar fields that drive parameters, and parameters: a number or a field.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include "base/hash_input.h"
#include "base/interval.h"
#include "base/ref.h"
#include "base/vec.h"

namespace msq {

/// The slopes of a field in a box: for all points p and q of the box, at(p) - at(q) is
/// dot(s, p - q) for some s of `between`, up to the rounding of the two values.
struct Slopes {
  Box3 between;
  double rounding = 0;  ///< of a value
};

class Field : public Described {
 public:
  virtual double at(Vec3 p) const = 0;
  /// Sets values[i] to at(points[i]), to the last bit.
  virtual void values(const Vec3* points, size_t count, double* values) const {
    for (size_t i = 0; i < count; ++i) values[i] = at(points[i]);
  }
  /// Whether any thread may evaluate values and ranges of boxes, several threads at once. Otherwise
  /// only the thread that made the host's call may. A field over other fields is concurrent if
  /// those are.
  virtual bool is_concurrent() const { return true; }
  /// Whether at(p) is linear in p for all p of a box, up to 2^-40 of its range; if so, its
  /// gradient.
  virtual bool is_linear(const Box3& box, Vec3& gradient) const {
    (void)box;
    (void)gradient;
    return false;
  }
  /// Encloses at(p) for all p, and for all p of a box: proven, rounding included.
  virtual Interval range() const = 0;
  virtual Interval range(const Box3& box) const = 0;
  /// Lipschitz constant: the values of two points differ by at most this times their distance, plus
  /// the rounding that range(box) of the points alone covers. Infinity is always valid and means
  /// that nothing is known.
  virtual double lipschitz() const { return std::numeric_limits<double>::infinity(); }
  /// The same for two points of a box, for small boxes. The rounding of each value is up to 2^-44
  /// of the largest magnitude of range().
  virtual double lipschitz(const Box3& box) const {
    (void)box;
    return lipschitz();
  }
  /// Encloses the slopes in a small box. Empty if nothing is known, or if the box contains too much
  /// of the field to be examined within microseconds.
  virtual std::optional<Slopes> slopes(const Box3& box) const {
    (void)box;
    return {};
  }
  /// Nesting depth of fields over other fields.
  virtual unsigned depth() const { return 0; }
};

class Parameter {
 public:
  Parameter() = default;
  explicit Parameter(double value) : value_(value) {}
  explicit Parameter(Ref<const Field> field) : field_(std::move(field)) {}

  bool is_constant() const { return !field_; }
  void describe(HashInput& input) const {
    input.optional(field_.get());
    if (!field_) input.number(value_);
  }
  double at(Vec3 p) const { return field_ ? field_->at(p) : value_; }
  void values(const Vec3* points, size_t count, double* values) const {
    if (field_)
      field_->values(points, count, values);
    else
      std::fill_n(values, count, value_);
  }
  bool is_concurrent() const { return !field_ || field_->is_concurrent(); }
  bool is_linear(const Box3& box, Vec3& gradient) const {
    return field_ && field_->is_linear(box, gradient);
  }
  Interval range() const { return field_ ? field_->range() : Interval{value_, value_}; }
  Interval range(const Box3& box) const {
    return field_ ? field_->range(box) : Interval{value_, value_};
  }
  double lipschitz() const { return field_ ? field_->lipschitz() : 0; }
  double lipschitz(const Box3& box) const { return field_ ? field_->lipschitz(box) : 0; }
  std::optional<Slopes> slopes(const Box3& box) const {
    return field_ ? field_->slopes(box) : Slopes{};
  }
  /// The gradient at p; if the field is not linear there, by differences over `step` on either
  /// side.
  Vec3 gradient(Vec3 p, double step) const {
    Vec3 gradient;
    if (!field_ || field_->is_linear(Box3{p, p}.grown(step), gradient)) return gradient;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 before = p, beyond = p;
      before[axis] -= step;
      beyond[axis] += step;
      gradient[axis] = (field_->at(beyond) - field_->at(before)) / (beyond[axis] - before[axis]);
    }
    return gradient;
  }

 private:
  double value_ = 0;
  Ref<const Field> field_;
};

}  // namespace msq
