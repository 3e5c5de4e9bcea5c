// SPDX-License-Identifier: Apache-2.0
// An affine map that places a shape: p = A q + b. What is stored and what decides is its inverse
// B, once computed: the point q of the original that belongs to a point p is B (p - b), in the
// order of operations of to_original().
//
// Each entry of B is within 4 * 2^-53 of that of the inverse of A, except for one factor that all
// have in common (the determinant's, whose error is 5 K * 2^-53), and a product with B loses
// another 4: A to_original(p) + b lies within 21 K * 2^-53 |p - b| of p, where K is the greatest
// row sum of |A| |B| (Skeel's condition; 1 for scalings along the axes, at most 3 for rotations).
// Source of K: Higham, "Accuracy and Stability of Numerical Algorithms", 2002, section 7.2.
#pragma once

#include <array>

#include "base/hash_input.h"
#include "base/ray.h"
#include "base/vec.h"

namespace msq {

class Placement {
 public:
  static constexpr double max_condition = 1e6, max_scale = 1e75;

  /// Rows of A, each followed by its component of b. Throws Error(argument) where a number is not
  /// finite, A is singular or its condition above max_condition, or a length grows or shrinks by
  /// more than max_scale.
  explicit Placement(const std::array<double, 12>& matrix);

  Vec3 to_original(Vec3 p) const { return apply(inverse_, p - offset_); }
  Vec3 to_placed(Vec3 q) const { return apply(linear_, q) + offset_; }
  /// The same points of a ray, whose t is `factor` times as large in the original.
  Ray to_original(const Ray& ray, double& factor) const;
  /// The normal, of length 1, of a surface that has this one in the original.
  Vec3 normal_to_placed(Vec3 normal) const;
  /// Encloses what a box of the original is placed to, rounding of to_original() included.
  Box3 to_placed(const Box3& box) const;

  /// No length of the original becomes shorter than this times itself, or longer than max_growth().
  double min_growth() const { return min_growth_; }
  double max_growth() const { return max_growth_; }
  /// Whether all lengths grow by scale(), within deviation() of themselves.
  bool is_similarity() const { return deviation_ <= max_deviation; }
  double scale() const { return scale_; }
  double deviation() const { return deviation_; }
  double determinant() const { return determinant_; }
  void describe(HashInput& input) const {
    input.list(linear_.data(), linear_.size());
    input.point(offset_);
  }
  /// How far a point may be from where its original is placed, both exactly.
  double rounding(Vec3 p) const { return rounding_ * max_magnitude(p - offset_); }
  /// The same of any two points, of which one is p and the other no farther from it than that,
  /// together.
  double rounding(Vec3 p, double distance) const { return 2 * rounding(p) + rounding_ * distance; }
  double rounding(const Box3& box) const { return std::max(rounding(box.min), rounding(box.max)); }

 private:
  using Matrix = std::array<double, 9>;
  static constexpr double max_deviation = 0x1p-20;

  static Vec3 apply(const Matrix& m, Vec3 v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
            m[6] * v.x + m[7] * v.y + m[8] * v.z};
  }
  void invert();
  void measure();

  Matrix linear_, inverse_;
  Vec3 offset_;
  double determinant_ = 1, rounding_ = 0;
  double min_growth_ = 1, max_growth_ = 1, scale_ = 1, deviation_ = 0;
};

}  // namespace msq
