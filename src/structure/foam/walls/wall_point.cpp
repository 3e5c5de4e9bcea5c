// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/wall_point.h"

#include <algorithm>

#include "base/borrowed.h"

namespace msq {

namespace {

template <class Seed>
struct WallPointWorkspace {
  std::vector<Seed> near;

  size_t bytes() const { return near.capacity() * sizeof(Seed); }
};

// Of a plane that is equally far from both.
Vec3 from_to(Vec3 a, Vec3 b) {
  return b - a;
}
double over(Vec3 apart, Vec3 a, Vec3 b, Vec3 q) {
  return dot(apart, (a - q) + (b - q));
}
// Of a plane of equal power.
Vec3 from_to(const LiftedSeed& a, const LiftedSeed& b) {
  return b.place - a.place;
}
double over(Vec3 apart, const LiftedSeed& a, const LiftedSeed& b, Vec3 q) {
  return over(apart, a.place, b.place, q) + (b.lift - a.lift);
}

template <class Seed>
size_t nearest_among(const std::vector<Seed>& seeds, Vec3 q) {
  size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < seeds.size(); ++i) {
    const double squared = squared_from(seeds[i], q);
    if (squared < least) {
      least = squared;
      nearest = i;
    }
  }
  return nearest;
}

template <class Seed>
NearFace face_among(const NearSeeds& seeds, const std::vector<Seed>& near, Vec3 q) {
  NearFace face;
  const size_t nearest = nearest_among(near, q);
  for (size_t i = 0; i < near.size(); ++i) {
    if (i == nearest) continue;
    const Vec3 apart = from_to(near[nearest], near[i]);
    const double divisor = length(seeds.normal(apart));
    // Below 0 by rounding only.
    const double onset = std::max(0.0, over(apart, near[nearest], near[i], q) / divisor);
    if (onset < face.onset) face = {onset, apart};
  }
  return face;
}

template <class Seed>
bool is_in_wall_of(const NearSeeds& seeds, CellIndex cell, Vec3 q, double thickness) {
  const Borrowed<WallPointWorkspace<Seed>> workspace;
  std::vector<Seed>& near = workspace->near;
  // Thick walls reach a crowd of fine leaves, and mostly a near face holds the point: growing
  // distances find it first. Fewer seeds never make the onset less.
  for (double tried = std::min(thickness, seeds.spacing(cell, q));;
       tried = std::min(thickness, 2 * tried)) {
    seeds.find(cell, q, tried, near);
    if (face_among(seeds, near, q).onset <= thickness) return true;
    if (tried >= thickness) return false;
  }
}

template <class Seed>
NearFace find_face_of(const NearSeeds& seeds, CellIndex cell, Vec3 q) {
  const Borrowed<WallPointWorkspace<Seed>> workspace;
  std::vector<Seed>& near = workspace->near;
  for (double tried = 0.5 * seeds.spacing(cell, q);; tried *= 2) {
    seeds.find(cell, q, tried, near);
    const NearFace face = face_among(seeds, near, q);
    if (face.onset <= tried) return face;
  }
}

}  // namespace

size_t nearest_of(const std::vector<Vec3>& seeds, Vec3 q) {
  return nearest_among(seeds, q);
}
size_t nearest_of(const std::vector<LiftedSeed>& seeds, Vec3 q) {
  return nearest_among(seeds, q);
}

NearFace nearest_face(const NearSeeds& seeds, const std::vector<Vec3>& near, Vec3 q) {
  return face_among(seeds, near, q);
}

bool is_in_wall(const NearSeeds& seeds, CellIndex cell, Vec3 q, double thickness) {
  return seeds.is_weighted() ? is_in_wall_of<LiftedSeed>(seeds, cell, q, thickness)
                             : is_in_wall_of<Vec3>(seeds, cell, q, thickness);
}

NearFace find_nearest_face(const NearSeeds& seeds, CellIndex cell, Vec3 q) {
  return seeds.is_weighted() ? find_face_of<LiftedSeed>(seeds, cell, q)
                             : find_face_of<Vec3>(seeds, cell, q);
}

}  // namespace msq
