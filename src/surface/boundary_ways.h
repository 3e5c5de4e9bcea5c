// SPDX-License-Identifier: Apache-2.0
// Ways across the boundary of a model, and places on them where membership changes.
#pragma once

#include <vector>

#include "base/job.h"
#include "model/model.h"
#include "surface/mesh_grid.h"

namespace msq {

/// A way from a point inside to one outside; neither is evaluated.
struct BoundaryWay {
  Vec3 inside, outside;
  Vec3 middle() const { return (inside + outside) * 0.5; }
  double size() const { return length(inside - outside); }
  /// The unit direction; 0 if the ends are equal.
  Vec3 inwards() const { return size() > 0 ? (inside - outside) * (1 / size()) : Vec3{}; }
};
/// Whether cells are so large against the pitch that rays do not find points of the boundary to
/// pitch / 1000.
bool rays_are_coarse(const Model& model, const Scales& resolved, const MeshGrid& grid);
/// Halves the ways `rounds` times, so that each still leads from inside to outside.
void halve(const Model& model, const Scales& resolved, std::vector<BoundaryWay>& ways, int rounds,
           const Job* job);

}  // namespace msq
