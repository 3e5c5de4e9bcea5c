// SPDX-License-Identifier: Apache-2.0
// The solid skin that a scale may leave under the coarse surface: the points of the shape that are
// no deeper than the skin is thick there.
//
// To the depth of a point it is what a strut is to the distance from its axis, so distances to it
// are those of structure/strut_clearance.h.
#pragma once

#include "base/job.h"
#include "base/sample_grid.h"
#include "field/field.h"
#include "shape/shape.h"

namespace msq {

class Skin {
 public:
  /// Throws Error(unsupported) if there is to be a skin and the shape's depth is a mere bound.
  Skin(Ref<const Shape> shape, Parameter thickness);

  const Shape& shape() const { return *shape_; }
  const Parameter& thickness() const { return thickness_; }
  bool is_none() const { return !(thickness_.range().high > 0); }

  /// Whether a point of the shape lies in the skin: the definition.
  bool holds(Vec3 p) const { return holds(p, shape_->depth(p)); }
  /// The same of a point whose depth is known.
  bool holds(Vec3 p, double depth) const {
    const double thickness = thickness_.at(p);
    return thickness > 0 && depth <= thickness;
  }
  /// What holds(p) answers, by the shape's search of its boundary where it has one. `part`: where
  /// to start; that of a point nearby, or 0.
  bool find(Vec3 p, uint32_t& part) const;
  /// What searched distances and depths may differ by.
  double search_margin() const;
  /// A lower bound of the distance from a point of the shape, of known depth, to the points of the
  /// shape of which holds() answers otherwise.
  double clearance(Vec3 p, double depth) const;

  /// The first t in [from, to], within the shape, at which the ray is in the skin; false if there is
  /// none.
  bool enter(const Ray& ray, double from, double to, double& t) const;
  /// A t up to which a ray that is in the skin at `from` stays in it.
  double leave(const Ray& ray, double from, double to) const;

  /// Sets the bits of `skin`, a block of zeros with the rows of `alive`, of those alive samples
  /// that lie in the skin. Samples that are alive are in the shape.
  void mark_rows(const RowBlock& alive, const RowBlock& skin, const Job* job) const;

 private:
  void step_along_rows(const RowBlock& alive, const RowBlock& skin, const Job* job) const;
  bool march(bool wanted, const Ray& ray, double from, double to, double& t) const;

  Ref<const Shape> shape_;
  Parameter thickness_;
};

}  // namespace msq
