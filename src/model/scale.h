// SPDX-License-Identifier: Apache-2.0
// One of the scales that fill the coarse shape: within it, the structure and the skin that the
// scale leaves under the coarse surface.
#pragma once

#include <vector>

#include "model/material.h"
#include "model/skin.h"
#include "structure/structure.h"

namespace msq {

struct Scale {
  Ref<const Structure> structure;
  Skin skin;
  /// Each may be null: then a coarser scale's counts, and in the skin the scale's own.
  Ref<const Material> material{}, skin_material{};

  /// Membership of a point of the shape: the definition.
  bool inside(Vec3 p) const { return structure->inside(p) || (!skin.is_none() && skin.holds(p)); }

  /// Signed distance of a point of the shape that is so deep in it: at most 0 where inside(p),
  /// positive elsewhere, and never larger in magnitude than the distance from p to the boundary
  /// that the scale has within the shape.
  double distance(Vec3 p, double depth) const;

  /// Sets alive[i] to 0 where points[i] is outside; looks only at those with alive[i] != 0, which
  /// are 1 and in the shape.
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const;

  /// As those of Structure, in the shape.
  void enter(RaySearch* searches, size_t count) const;
  double leave(const Ray& ray, double from, double to) const;
  Vec3 normal(const Ray& ray, double t) const;

  /// Clears the bits of samples that are outside, in rows of samples of the shape.
  void keep_rows(const RowBlock& block, const Job* job) const;
};

/// The scales that a query resolves, coarsest first.
using Scales = std::vector<const Scale*>;

}  // namespace msq
