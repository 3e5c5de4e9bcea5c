// SPDX-License-Identifier: Apache-2.0
#include "structure/combined/steady_pair.h"

#include <algorithm>
#include <cmath>

namespace msq {

// Distances are known to 1e-9 of a cell (docs/accuracy.md), and are smaller by as much. So the
// difference of two values may be off by four times that, once more for each such structure within
// another. Booleans choose among values, so they add nothing.
SteadyPair::SteadyPair(const Ref<const Structure>& a, const Ref<const Structure>& b)
    : CombinedStructure({a, b}),
      slack_(
          std::ldexp(cell_length(), -27 + 2 * static_cast<int>(CombinedStructure::steady_pairs()))),
      farthest_origin_(0) {
  for_each_grid([this](const Neighbourhood& grid) {
    farthest_origin_ = std::max(farthest_origin_, max_magnitude(grid.origin));
  });
}

// Far smaller than min_ray_step(), so that only rays that creep along a surface lose parts. Near it
// the bound is 0 over as much of such a ray.
bool SteadyPair::march_finely(bool wanted, const Ray& ray, double from, double to, double& t,
                              const Job* job) const {
  const double tolerance = ray_tolerance(ray, to);
  const double least = has_steady_distance() ? 0x1p-16 * smallest_cell() : min_ray_step();
  const RayMarch steps{std::max(least, tolerance), tolerance};
  return steps.find(
      wanted, ray, from, to, [this](Vec3 p) { return inside(p); },
      [this](Vec3 p) { return distance_bound(p); }, t, job);
}

double SteadyPair::leave(const Ray& ray, double from, double to, const Job* job) const {
  double t;
  return march_finely(false, ray, from, to, t, job) ? t : to;
}

}  // namespace msq
