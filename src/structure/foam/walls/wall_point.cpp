// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/wall_point.h"

#include <algorithm>

#include "base/borrowed.h"

namespace msq {

namespace {

struct WallPointWorkspace {
  std::vector<Vec3> near;

  size_t bytes() const { return near.capacity() * sizeof(Vec3); }
};

}  // namespace

size_t nearest_of(const std::vector<Vec3>& seeds, Vec3 q) {
  size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < seeds.size(); ++i) {
    const Vec3 d = seeds[i] - q;
    const double squared = dot(d, d);
    if (squared < least) {
      least = squared;
      nearest = i;
    }
  }
  return nearest;
}

NearFace nearest_face(const NearSeeds& seeds, const std::vector<Vec3>& near, Vec3 q) {
  NearFace face;
  const size_t nearest = nearest_of(near, q);
  for (size_t i = 0; i < near.size(); ++i) {
    if (i == nearest) continue;
    const Vec3 apart = near[i] - near[nearest];
    const double divisor = length(seeds.normal(apart));
    // Below 0 by rounding only.
    const double onset = std::max(0.0, dot(apart, (near[nearest] - q) + (near[i] - q)) / divisor);
    if (onset < face.onset) face = {onset, apart};
  }
  return face;
}

bool is_in_wall(const NearSeeds& seeds, CellIndex cell, Vec3 q, double thickness) {
  const Borrowed<WallPointWorkspace> workspace;
  std::vector<Vec3>& near = workspace->near;
  // Thick walls reach a crowd of fine leaves, and mostly a near face holds the point: growing
  // distances find it first. Fewer seeds never make the onset less.
  for (double tried = std::min(thickness, seeds.spacing(cell, q));;
       tried = std::min(thickness, 2 * tried)) {
    seeds.find(cell, q, tried, near);
    if (nearest_face(seeds, near, q).onset <= thickness) return true;
    if (tried >= thickness) return false;
  }
}

NearFace find_nearest_face(const NearSeeds& seeds, CellIndex cell, Vec3 q) {
  const Borrowed<WallPointWorkspace> workspace;
  std::vector<Vec3>& near = workspace->near;
  for (double tried = 0.5 * seeds.spacing(cell, q);; tried *= 2) {
    seeds.find(cell, q, tried, near);
    const NearFace face = nearest_face(seeds, near, q);
    if (face.onset <= tried) return face;
  }
}

}  // namespace msq
