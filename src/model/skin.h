// SPDX-License-Identifier: Apache-2.0
// The solid skin that a scale may leave under the coarse surface: the points of the shape whose
// depth is at most the skin's thickness there.
//
// The skin relates to the depth of a point as a strut does to the distance from its axis. So
// distances to it are those of structure/common/strut_distance_bound.h.
#pragma once

#include "base/job.h"
#include "base/sample_grid.h"
#include "field/field.h"
#include "shape/shape.h"

namespace msq {

class Skin {
 public:
  /// Throws Error(unsupported) if there is a skin and the shape's depth is only a bound.
  Skin(Ref<const Shape> shape, Parameter thickness);

  const Shape& shape() const { return *shape_; }
  const Parameter& thickness() const { return thickness_; }
  bool is_none() const { return !(thickness_.range().high > 0); }

  /// Whether a point of the shape lies in the skin: the definition.
  bool holds(Vec3 p) const { return holds(p, shape_->depth(p)); }
  /// The same for a point whose depth is known.
  bool holds(Vec3 p, double depth) const {
    const double thickness = thickness_.at(p);
    return thickness > 0 && depth <= thickness;
  }
  /// Equals holds(p). Uses the shape's search of its boundary if it has one. `part`: where to start
  /// the search; that of a nearby point, or 0.
  bool find(Vec3 p, uint32_t& part) const;
  /// Maximum difference between searched distances and depths.
  double search_margin() const;
  /// A lower bound on the distance from a point of the shape, with known depth, to the points of
  /// the shape with a different holds().
  double distance_bound(Vec3 p, double depth) const;

  /// Finds the first t in [from, to], within the shape, at which the ray is in the skin, at most
  /// `tolerance` past it. Returns false if there is none.
  bool enter(const Ray& ray, double from, double to, double tolerance, double& t,
             const Job* job) const;
  /// A t up to which a ray that is in the skin at `from` stays in it.
  double leave(const Ray& ray, double from, double to, double tolerance, const Job* job) const;

  /// For each alive sample in the skin, sets its bit in `skin`, a block of zeros with the rows of
  /// `alive`. Alive samples must be in the shape.
  void mark_rows(const RowBlock& alive, const RowBlock& skin, const Job* job) const;

 private:
  void step_along_rows(const RowBlock& alive, const RowBlock& skin, const Job* job) const;
  bool march(bool wanted, const Ray& ray, double from, double to, double tolerance, double& t,
             const Job* job) const;

  Ref<const Shape> shape_;
  Parameter thickness_;
};

}  // namespace msq
