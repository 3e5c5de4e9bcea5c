// SPDX-License-Identifier: Apache-2.0
// The search for the nearest edge among the seeds around a point (onset.h says which matter), for
// foams with and without a stretch or weights.
//
// `Space` says how lengths are measured. Seeds and `q` are in the space of the diagram:
//   Vec3 normal(Vec3 n)        a normal of a plane there, in the space of distances
//   auto line(Seed, Seed, Seed) the line of three seeds
//   double slack()             for the rounding of distances of planes
//
// `Seed` is Vec3, or LiftedSeed (seeds.h) with weights. Distances from seeds are lifted then.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/point/edge_line.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

/// Slack for the rounding of distances; additional seeds never change the result.
constexpr double search_slack = 1e-9;

/// A seed that may matter.
template <class Seed>
struct NearSeedOf {
  double plane;  // distance from q to the plane between the seed and the nearest one
  double distance_squared;
  uint32_t index;  // in the order of seeds
  Seed position;
};
using NearSeed = NearSeedOf<Vec3>;

/// Whether the plane between two seeds is farther from q than `reach`.
template <class Space, class Seed>
bool too_far(const Space& space, const NearSeedOf<Seed>& a, const NearSeedOf<Seed>& b,
             double reach) {
  const Vec3 apart = space.normal(place_of(a.position) - place_of(b.position));
  const double over = std::abs(a.distance_squared - b.distance_squared) - search_slack;
  return over > 0 && over * over > 4 * reach * reach * dot(apart, apart);
}

/// The line of three seeds in any order, with the order that EdgeLine requires.
template <class Space, class Seed>
auto line_of(const Space& space, const NearSeedOf<Seed>& a, const NearSeedOf<Seed>& b,
             const NearSeedOf<Seed>& c) {
  const NearSeedOf<Seed>*x = &a, *y = &b, *z = &c;
  if (x->index > y->index) std::swap(x, y);
  if (y->index > z->index) std::swap(y, z);
  if (x->index > y->index) std::swap(x, y);
  return space.line(x->position, y->position, z->position);
}

/// Fills `near`, in the order of seeds, with those whose planes with the nearest one are within a
/// radius of q.
template <class Space, class Seed>
void find_near_planes(const Space& space, const std::vector<Seed>& seeds, Vec3 q, double radius,
                      std::vector<NearSeedOf<Seed>>& near) {
  near.clear();
  NearSeedOf<Seed> nearest{0, std::numeric_limits<double>::infinity(), 0, {}};
  for (uint32_t i = 0; i < seeds.size(); ++i) {
    near.push_back({0, squared_from(seeds[i], q), i, seeds[i]});
    if (near.back().distance_squared < nearest.distance_squared) nearest = near.back();
  }
  for (NearSeedOf<Seed>& s : near) {
    const double apart = length(space.normal(place_of(s.position) - place_of(nearest.position)));
    s.plane = apart > 0 ? (s.distance_squared - nearest.distance_squared) / (2 * apart) : 0;
  }
  std::erase_if(near, [&](const NearSeedOf<Seed>& s) { return s.plane > radius + space.slack(); });
}

/// Distance from a point to the nearest edge if that is at most `radius`, otherwise infinity. The
/// point: q in the space of the diagram, `centre` in that of distances. any: any edge within the
/// radius will do; then the distance is that to the first one found.
template <class Space, class Seed>
double search_edges(const Space& space, const std::vector<Seed>& seeds, Vec3 q, Vec3 centre,
                    double radius, bool any = false) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (seeds.size() < 3) return none;
  const Borrowed<std::vector<NearSeedOf<Seed>>> borrowed;
  std::vector<NearSeedOf<Seed>>& near = *borrowed;
  find_near_planes(space, seeds, q, radius, near);
  // Seeds first whose faces with the nearest one are near: they make the nearest edges and the
  // relevant cuts.
  std::sort(near.begin(), near.end(), [](const NearSeedOf<Seed>& a, const NearSeedOf<Seed>& b) {
    return a.plane < b.plane || (a.plane == b.plane && a.index < b.index);
  });

  // As in the point query, with a ball that shrinks to the nearest edge found so far.
  double best = none, reach = radius + space.slack(), chord_squared = radius * radius;
  const size_t count = near.size();
  for (size_t c = 2; c < count && near[c].plane <= reach; ++c)
    for (size_t b = 1; b < c; ++b) {
      if (too_far(space, near[b], near[c], reach)) continue;
      for (size_t a = 0; a < b; ++a) {
        if (too_far(space, near[a], near[b], reach) || too_far(space, near[a], near[c], reach))
          continue;
        const auto line = line_of(space, near[a], near[b], near[c]);
        if (!line.exists()) continue;
        LineInterval part = line.chord(centre, chord_squared);
        for (size_t i = 0; i < count && line.holds(part); ++i)
          if (i != a && i != b && i != c) line.cut(near[i].position, part);
        if (!line.holds(part)) continue;
        best = std::min(best, length(line.way_from(part, centre)));
        if (any) return best;
        reach = best + space.slack();
        chord_squared = best * best;
      }
    }
  return best;
}

}  // namespace msq
