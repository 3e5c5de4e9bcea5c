// SPDX-License-Identifier: Apache-2.0
// Where a ray meets a wall with holes near a point of the void. The thickness is constant, or grows
// along the ray: a bound on one that varies.
//
// On the ray, the slab of a wall is one interval and so is its hole's cylinder. In the cell of a
// seed the ray is in the solid where it is in the slab of a wall of that seed and not in the wall's
// hole. So the first such point in each cell is a matter of intervals, and no step is taken. The
// face of a wall is needed only where the ray comes into its slab before it meets another.
#pragma once

#include "base/ray.h"
#include "structure/foam/walls/vents.h"

namespace msq {

struct VentRay {
  const NearSeeds& seeds;
  const Vents& vents;
  const Neighbourhood& grid;
  double unit;       ///< of foams, in model units
  double thickness;  ///< in foam units, where the ray begins
  double growth;     ///< of the thickness, per model unit of the way

  /// Whether the ray meets a wall in [from, to], a short part that begins in the void; the first t,
  /// except for rounding.
  bool find(const Ray& ray, double from, double to, double& t) const;
};

}  // namespace msq
