// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/vent_distance.h"

#include <algorithm>

#include "base/borrowed.h"
#include "base/job.h"

namespace msq {

namespace {

struct VentDistanceWorkspace {
  std::vector<Vec3> near;

  size_t bytes() const { return near.capacity() * sizeof(Vec3); }
};

/// In walls that are thicker than fine leaves there is no bound: it would take too many pairs.
constexpr size_t max_seeds = 128;

struct VentDistance {
  const NearSeeds& seeds;
  const Vents& vents;
  CellIndex cell;
  Vec3 q;

  VentedWall wall(Vec3 a, Vec3 b) const { return vents.wall(seeds, cell, a, b); }

  /// f of a seed, or `most` if that is less; not below 0.
  double in_cell_of(Vec3 own, const std::vector<Vec3>& near, double thickness, double most) const {
    for (const Vec3& other : near) {
      if (other == own) continue;
      const double gap = 0.5 * (plane_onset(own, other, q) - thickness);
      if (gap >= most) continue;
      const VentedWall wall = this->wall(own, other);
      if (wall.is_there) most = std::min(most, std::max({0.0, gap, wall.depth(q)}));
    }
    return most;
  }

  double outside(double thickness) const {
    const Borrowed<VentDistanceWorkspace> workspace;
    std::vector<Vec3>& near = workspace->near;
    const double max_radius = vents.max_radius();
    const double plain = 0.5 * (find_nearest_face(seeds, cell, q).onset - thickness);
    if (plain >= max_radius) return plain;
    // By growing distances, as few leaves as may be.
    for (double most = std::min(max_radius, 0.5 * seeds.spacing(cell, q));;
         most = std::min(max_radius, 2 * most)) {
      seeds.find(cell, q, 4 * most + thickness, near);
      const double least = below(near, thickness, most);
      if (least < most || most >= max_radius) return std::max(plain, least);
    }
  }

  /// F, or `most` if that is less.
  double below(const std::vector<Vec3>& near, double thickness, double most) const {
    const Vec3 own = near[nearest_of(near, q)];
    double least = in_cell_of(own, near, thickness, most);
    for (const Vec3& seed : near) {
      if (seed == own) continue;
      if (!(0.5 * plane_onset(own, seed, q) < least)) continue;  // as h is no less than this
      double away = 0;
      for (const Vec3& other : near)
        if (!(other == seed)) away = std::max(away, 0.5 * plane_onset(other, seed, q));
      if (!(away < least)) continue;
      least = std::min(least, std::max(away, in_cell_of(seed, near, thickness, least)));
      check_cancelled();
    }
    return least;
  }

  double inside(Interval thickness) const {
    const Borrowed<VentDistanceWorkspace> workspace;
    std::vector<Vec3>& near = workspace->near;
    double least = 0.5 * (thickness.low - find_nearest_face(seeds, cell, q).onset);
    if (!(least > 0)) return 0;
    seeds.find(cell, q, 2 * thickness.high, near);
    if (near.size() > max_seeds) return 0;
    for (size_t i = 0; i < near.size(); ++i)
      for (size_t k = i + 1; k < near.size(); ++k) {
        const double gap = 0.5 * (std::abs(plane_onset(near[i], near[k], q)) - thickness.high);
        if (gap >= least) continue;
        const VentedWall wall = this->wall(near[i], near[k]);
        if (wall.radius > 0) least = std::min(least, std::max(gap, -wall.depth(q)));
        if (!(least > 0)) return 0;
      }
    return least;
  }
};

}  // namespace

double vented_distance(const NearSeeds& seeds, const Vents& vents, CellIndex cell, Vec3 q,
                       Interval thickness) {
  const VentDistance distance{seeds, vents, cell, q};
  const double inside = distance.inside(thickness);
  return inside > 0 ? inside : std::max(0.0, distance.outside(thickness.high));
}

}  // namespace msq
