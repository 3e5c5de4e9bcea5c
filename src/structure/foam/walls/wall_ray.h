// SPDX-License-Identifier: Apache-2.0
// Where a ray in the void of a cell meets a wall of constant thickness.
//
// The void of a cell is convex: the cell with all its planes moved inwards by half the thickness.
// The seeds near the ray's start give a first point where it may leave the void. Of the seeds near
// that point, those whose moved planes it is beyond give an earlier one, and so on. A point that is
// beyond none is in the void or on its border, and then so is all of the ray up to it.
#pragma once

#include "base/ray.h"
#include "structure/foam/walls/near_seeds.h"

namespace msq {

/// In foam units.
struct WallRay {
  const NearSeeds& seeds;
  const Neighbourhood& grid;
  double unit;       ///< of foams, in model units
  double thickness;  ///< in foam units

  enum class Way { meets, passes, unknown };
  /// From a point outside all walls, the first t in [from, to] at which the ray meets one, except
  /// for rounding. `unknown`: it was not found in some dozen steps.
  Way find(const Ray& ray, double from, double to, double tolerance, double& t) const;

 private:
  template <class Seed>
  Way find_among(const Ray& ray, double from, double to, double tolerance, double& t) const;
};

}  // namespace msq
