// SPDX-License-Identifier: Apache-2.0
// One of the scales that fill the coarse shape: its structure, and the skin that it leaves under
// the coarse surface.
#pragma once

#include <vector>

#include "model/material.h"
#include "model/skin.h"
#include "structure/structure.h"

namespace msq {

struct Scale {
  Ref<const Structure> structure;
  Skin skin;
  /// Each may be null. Then the material of a coarser scale is used and, in the skin, the scale's
  /// own.
  Ref<const Material> material{}, skin_material{};

  /// Membership of a point of the shape: the definition.
  bool inside(Vec3 p) const { return structure->inside(p) || (!skin.is_none() && skin.holds(p)); }

  /// Signed distance of a point of the shape with the given depth: at most 0 if inside(p),
  /// otherwise positive. Its magnitude is at most the distance from p to the boundary of the scale
  /// within the shape.
  double distance(Vec3 p, double depth) const;

  /// Sets alive[i] to 0 where points[i] is outside. Evaluates only points with alive[i] != 0, which
  /// are 1 and in the shape.
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const;

  /// As in Structure, for points in the shape.
  void enter(RaySearch* searches, size_t count, const Job* job) const;
  double leave(const Ray& ray, double from, double to, const Job* job) const;
  Vec3 normal(const Ray& ray, double t) const;

  /// Clears the bits of samples that are outside, in rows of samples of the shape.
  void keep_rows(const RowBlock& block, const Job* job) const;
  /// As Structure::draw_rows().
  void draw_rows(const RowBlock& block, const Job* job) const;
};

/// The scales that a query resolves, coarsest first; of a model of regions, those of all regions in
/// turn, and by themselves.
struct Scales : std::vector<const Scale*> {
  std::vector<Scales> regions{};  ///< none of a model that is one region
};

}  // namespace msq
