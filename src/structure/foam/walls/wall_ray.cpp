// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/wall_ray.h"

#include <algorithm>

#include "base/borrowed.h"
#include "structure/foam/walls/wall_point.h"

namespace msq {

namespace {

struct WallRayWorkspace {
  std::vector<Vec3> near;

  size_t bytes() const { return near.capacity() * sizeof(Vec3); }
};

}  // namespace

WallRay::Way WallRay::find(const Ray& ray, double from, double to, double tolerance,
                           double& t) const {
  constexpr int max_steps = 64;
  // Of unlike seeds; copies of one, seen from unlike cells, are a rounding apart.
  constexpr double min_distance = 1e-9;
  const Borrowed<WallRayWorkspace> workspace;
  std::vector<Vec3>& near = workspace->near;
  const Vec3 scale = seeds.seeds().scale();
  const Stretch* stretch = seeds.stretch();
  const Vec3 in_grid = grid.rotation.apply_inverse(ray.direction) * (1 / unit);
  const Vec3 along = stretch ? stretch->to_diagram(in_grid) : in_grid;
  const auto place = [&](const Neighbourhood::Located& located) {
    return located.fraction * scale;
  };

  const Neighbourhood::Located start = grid.locate(ray.at(from));
  const Vec3 q = place(start);
  // Most faces of a cell are of seeds within this.
  const double about = 0.75 * seeds.spacing(start.cell, q);
  seeds.find(start.cell, q, std::max(thickness, about), near);
  const Vec3 own = near[nearest_of(near, q)];

  // Both ends of the way in the void are within the empty radius of the seed.
  const double most =
      2.001 * seeds.seeds().empty_radius() * unit * (stretch ? stretch->max_factor() : 1);
  const double end = std::min(to, from + most);
  double found = end;
  // What the seeds at hand, near a point at `at`, leave of the way up to `found`.
  const auto cut = [&](double at, Vec3 place, Vec3 seed) {
    double first = found;
    for (const Vec3& other : near) {
      const Vec3 apart = other - seed;
      const double distance = length(apart);
      if (!(distance > min_distance)) continue;  // the seed itself
      const double divisor = stretch ? length(seeds.normal(apart)) : distance;
      const double slope = 2 * dot(apart, along) / divisor;
      if (!(slope > 0)) continue;
      const double over = dot(apart, (seed - place) + (other - place)) / divisor - thickness;
      first = std::min(first, at + over / slope);
    }
    return std::max(from, first);
  };
  found = cut(from, q, own);
  for (int step = 0; step < max_steps; ++step) {
    const Neighbourhood::Located located = grid.locate(ray.at(found));
    const Vec3 there = place(located);
    const Vec3 moved =
        own + Vec3{double(start.cell.x - located.cell.x), double(start.cell.y - located.cell.y),
                   double(start.cell.z - located.cell.z)} *
                  scale;
    seeds.find(located.cell, there, thickness, near);
    const double before = found;
    found = cut(before, there, moved);
    if (before - found > 0.25 * tolerance) continue;
    t = found;
    if (found < end) return Way::meets;
    return end == to ? Way::passes : Way::unknown;
  }
  return Way::unknown;
}

}  // namespace msq
