// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/vents.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "base/borrowed.h"

namespace msq {

namespace {

/// The faces found last, which nearby points share. Each depends on the cell and its two seeds
/// alone.
struct FaceWorkspace {
  struct Known {
    Vec3 a, b;
    WallFace face;
  };
  std::optional<FoamSeeds> seeds;
  CellIndex cell;
  std::vector<Known> known;
  std::vector<Vec3> near;
  FacePolygon polygon;

  size_t bytes() const {
    return known.capacity() * sizeof(Known) + near.capacity() * sizeof(Vec3) + polygon.bytes();
  }
};

/// A seed that cuts off a corner x of the polygon is nearer to x than a is, so no farther from q
/// than |x - a| + |x - q|.
WallFace find_face(const NearSeeds& seeds, CellIndex cell, Vec3 q, Vec3 a, Vec3 b,
                   FaceWorkspace& work) {
  const double half = seeds.seeds().empty_radius() * (1 + 1e-9);
  for (double more = 1.5 * seeds.spacing(cell, q);; more *= 1.5) {
    seeds.find(cell, q, more, work.near);
    work.polygon.start(a, b, half);
    for (const Vec3& other : work.near) {
      if (other == a || other == b) continue;
      work.polygon.cut(other);
      if (work.polygon.is_empty()) return {};
    }
    double needed = 0;
    work.polygon.for_each_corner(
        [&](Vec3 x) { needed = std::max(needed, length(x - a) + length(x - q)); });
    if (needed <= length(work.near[nearest_of(work.near, q)] - q) + more)
      return work.polygon.face();
  }
}

WallFace face_between(const NearSeeds& seeds, CellIndex cell, Vec3 q, Vec3 a, Vec3 b) {
  const Borrowed<FaceWorkspace> borrowed;
  FaceWorkspace& work = *borrowed;
  // Fine leaves are too many to be found from the middle of their cell.
  if (seeds.graded()) return find_face(seeds, cell, q, a, b, work);
  if (!work.seeds || !(*work.seeds == seeds.seeds()) || !(work.cell == cell) ||
      work.known.size() > 256) {
    work.seeds = seeds.seeds();
    work.cell = cell;
    work.known.clear();
  }
  for (const FaceWorkspace::Known& known : work.known)
    if (known.a == a && known.b == b) return known.face;
  const WallFace face = find_face(seeds, cell, seeds.seeds().scale() * 0.5, a, b, work);
  work.known.push_back({a, b, face});
  return face;
}

struct PointWorkspace {
  struct Plane {
    double onset;
    Vec3 other;
  };
  std::vector<Vec3> near;
  std::vector<Plane> planes;

  size_t bytes() const {
    return near.capacity() * sizeof(Vec3) + planes.capacity() * sizeof(Plane);
  }

  /// Planes between a seed and the others whose onset is at most `most`, from near to far.
  void find_planes(Vec3 seed, Vec3 q, double most) {
    planes.clear();
    for (const Vec3& other : near) {
      if (other == seed) continue;
      const double onset = plane_onset(seed, other, q);
      if (onset <= most) planes.push_back({onset, other});
    }
    std::stable_sort(planes.begin(), planes.end(),
                     [](const Plane& a, const Plane& b) { return a.onset < b.onset; });
  }
};

}  // namespace

VentedWall Vents::wall(const NearSeeds& seeds, CellIndex cell, Vec3 q, Vec3 a, Vec3 b) const {
  // The same bits from both sides.
  if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
  const WallFace face = face_between(seeds, cell, q, a, b);
  VentedWall wall;
  wall.is_there = face.area >= min_face_area;
  if (!wall.is_there) return wall;
  const Vec3 corner = Vec3{double(cell.x), double(cell.y), double(cell.z)} * grid_.cell_size;
  const double radius =
      (radius_.is_constant() ? radius_.at({})
                             : radius_.at(grid_.from_grid(corner + face.middle * unit_))) /
      unit_;
  if (!(radius >= min_vent_radius && face.area >= vent_area(radius))) return wall;
  wall.radius = radius;
  wall.middle = face.middle;
  wall.along = (b - a) * (1 / length(b - a));
  return wall;
}

bool is_in_vented_wall(const NearSeeds& seeds, const Vents& vents, CellIndex cell, Vec3 q,
                       double thickness) {
  const Borrowed<PointWorkspace> borrowed;
  PointWorkspace& work = *borrowed;
  seeds.find(cell, q, thickness, work.near);
  const Vec3 seed = work.near[nearest_of(work.near, q)];
  work.find_planes(seed, q, thickness);
  // By rounding alone, only planes without a wall may hold q.
  bool is_solid = !work.planes.empty();
  for (const PointWorkspace::Plane& plane : work.planes) {
    const VentedWall wall = vents.wall(seeds, cell, q, seed, plane.other);
    if (!wall.is_there) continue;
    if (!(wall.depth(q) > 0)) return true;
    is_solid = false;
  }
  return is_solid;
}

NearFace find_nearest_vented_face(const NearSeeds& seeds, const Vents& vents, CellIndex cell,
                                  Vec3 q) {
  const Borrowed<PointWorkspace> borrowed;
  PointWorkspace& work = *borrowed;
  // Cells are within the empty radius of their seeds, so their faces within twice that of q.
  const double most = 4 * seeds.seeds().empty_radius();
  for (double tried = 0.5 * seeds.spacing(cell, q);; tried = std::min(most, 2 * tried)) {
    seeds.find(cell, q, tried, work.near);
    const Vec3 seed = work.near[nearest_of(work.near, q)];
    work.find_planes(seed, q, tried);
    for (const PointWorkspace::Plane& plane : work.planes) {
      const VentedWall wall = vents.wall(seeds, cell, q, seed, plane.other);
      if (wall.is_there && !(wall.depth(q) > 0))
        return {std::max(0.0, plane.onset), plane.other - seed};
    }
    if (tried >= most) return {};
  }
}

}  // namespace msq
