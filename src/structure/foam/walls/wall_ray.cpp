// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/wall_ray.h"

#include <algorithm>

#include "base/borrowed.h"
#include "base/job.h"
#include "structure/foam/walls/wall_point.h"

namespace msq {

namespace {

template <class Seed>
struct WallRayWorkspace {
  std::vector<Seed> near;

  size_t bytes() const { return near.capacity() * sizeof(Seed); }
};

Vec3 moved(Vec3 seed, Vec3 by) {
  return seed + by;
}
LiftedSeed moved(const LiftedSeed& seed, Vec3 by) {
  return {seed.place + by, seed.lift};
}
/// How much the lift of a seed exceeds that of another.
double more_lift(Vec3, Vec3) {
  return 0;
}
double more_lift(const LiftedSeed& seed, const LiftedSeed& other) {
  return seed.lift - other.lift;
}

}  // namespace

WallRay::Way WallRay::find(const Ray& ray, double from, double to, double tolerance,
                           double& t) const {
  return seeds.is_weighted() ? find_among<LiftedSeed>(ray, from, to, tolerance, t)
                             : find_among<Vec3>(ray, from, to, tolerance, t);
}

template <class Seed>
WallRay::Way WallRay::find_among(const Ray& ray, double from, double to, double tolerance,
                                 double& t) const {
  constexpr int max_steps = 64;
  // Of unlike seeds; copies of one, seen from unlike cells, are a rounding apart.
  constexpr double min_distance = 1e-9;
  const Borrowed<WallRayWorkspace<Seed>> workspace;
  std::vector<Seed>& near = workspace->near;
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
  const Seed own = near[nearest_of(near, q)];

  // Both ends of the way in the void are within the empty radius of the seed.
  const double most =
      2.001 * seeds.seeds().empty_radius() * unit * (stretch ? stretch->max_factor() : 1);
  const double end = std::min(to, from + most);
  double found = end;
  // What the seeds at hand, near a point at `at`, leave of the way up to `found`.
  const auto cut = [&](double at, Vec3 place, const Seed& seed) {
    double first = found;
    for (const Seed& other : near) {
      const Vec3 apart = place_of(other) - place_of(seed);
      const double distance = length(apart);
      if (!(distance > min_distance)) continue;  // the seed itself
      const double divisor = stretch ? length(seeds.normal(apart)) : distance;
      const double slope = 2 * dot(apart, along) / divisor;
      if (!(slope > 0)) continue;
      const Vec3 from_place = (place_of(seed) - place) + (place_of(other) - place);
      const double over = (dot(apart, from_place) + more_lift(other, seed)) / divisor - thickness;
      first = std::min(first, at + over / slope);
    }
    return std::max(from, first);
  };
  found = cut(from, q, own);
  for (int step = 0; step < max_steps; ++step) {
    check_cancelled();  // a box may have 2^15 seeds
    const Neighbourhood::Located located = grid.locate(ray.at(found));
    const Vec3 there = place(located);
    const Seed own_there = moved(
        own, Vec3{double(start.cell.x - located.cell.x), double(start.cell.y - located.cell.y),
                  double(start.cell.z - located.cell.z)} *
                 scale);
    seeds.find(located.cell, there, thickness, near);
    const double before = found;
    found = cut(before, there, own_there);
    if (before - found > 0.25 * tolerance) continue;
    t = found;
    if (found < end) return Way::meets;
    return end == to ? Way::passes : Way::unknown;
  }
  return Way::unknown;
}

}  // namespace msq
