// SPDX-License-Identifier: Apache-2.0
// Box, sphere and cylinder as coarse shapes. Their distances are exact except for rounding.
#pragma once

#include "shape/shape.h"

namespace msq {

/// The common part of primitives: rays cut them in one section.
class Primitive : public Shape {
 public:
  bool is_exact_outside() const override { return true; }
  bool is_exact_inside() const override { return true; }
  bool knows_depth() const override { return true; }
  /// Distances are exact except for rounding and the slack subtracted for it, each less than 2^-44
  /// of the bounds' coordinates.
  double depth_error() const override {
    return 0x1p-43 * (max_magnitude(bounds().min) + max_magnitude(bounds().max));
  }
  bool enter(const Ray& ray, double from, double to, double& t, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  bool cross(const Ray& ray, double from, double to, double& t, double& end,
             const Job* job) const override;
  /// Uses the sections of rows.
  void fill_rows(const RowBlock& block) const override;
  bool fills_rows_apart() const override { return true; }

 protected:
  /// Narrows [from, to] to the section of the shape with its surface moved outwards by `grow`,
  /// except for rounding. Returns false if there is none. The ends of the section do not depend on
  /// `from` and `to`.
  virtual bool section(const Ray& ray, double grow, double& from, double& to) const = 0;
};

class BoxShape final : public Primitive {
 public:
  explicit BoxShape(const Box3& box);
  bool inside(Vec3 p) const override { return bounds().contains(p); }
  bool is_box() const override { return true; }
  void fill_rows(const RowBlock& block) const override;
  bool holds_block(const RowBlock& block) const override {
    const Box3 samples = block.box();
    return bounds().contains(samples.min) && bounds().contains(samples.max);
  }
  bool fill_shallow_rows(double depth, const RowBlock& block) const override;
  Vec3 normal(const Ray& ray, double t) const override;

 protected:
  bool section(const Ray& ray, double grow, double& from, double& to) const override {
    return clip_to_box(ray, bounds().grown(grow), from, to);
  }
  double distance_bound(Vec3 p) const override;
  void describe(HashInput& input) const override;
};

class SphereShape final : public Primitive {
 public:
  SphereShape(Vec3 centre, double radius);
  bool inside(Vec3 p) const override;
  Vec3 normal(const Ray& ray, double t) const override;

 protected:
  bool section(const Ray& ray, double grow, double& from, double& to) const override;
  double distance_bound(Vec3 p) const override;
  void describe(HashInput& input) const override;

 private:
  Vec3 centre_;
  double radius_, radius_squared_;
};

/// Flat-ended round cylinder.
class CylinderShape final : public Primitive {
 public:
  CylinderShape(Vec3 from, Vec3 to, double radius);
  bool inside(Vec3 p) const override;
  Vec3 normal(const Ray& ray, double t) const override;

 protected:
  bool section(const Ray& ray, double grow, double& from, double& to) const override;
  double distance_bound(Vec3 p) const override;
  void describe(HashInput& input) const override;

 private:
  Vec3 from_, axis_;  // axis_ leads from one end to the other
  double axis_squared_, height_;
  Vec3 unit_axis_;
  double radius_, radius_squared_;
};

}  // namespace msq
