// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/vents.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <tuple>

#include "base/borrowed.h"
#include "base/id_hash.h"
#include "base/job.h"
#include "cell/cell_hash.h"
#include "structure/foam/seeds/seed_trees.h"

namespace msq {

namespace {

/// The faces found last, which nearby points share. Each is a function of the foam, the cell and
/// its two seeds alone, so that it may be kept or found anew. Faces of unlike keys that share a
/// place replace each other.
class FaceWorkspace {
 public:
  std::vector<Vec3> near;
  FacePolygon polygon;

  /// The face between a and b, by find() if it is not known.
  template <class Find>
  WallFace face(const NearSeeds& seeds, CellIndex cell, Vec3 a, Vec3 b, const Find& find) {
    move_to(seeds);
    IdHash key(0);
    key.add(a);
    key.add(b);
    Known& known = known_[hash_of(cell, key.id().low) % places];
    if (known.round == round_ && known.cell == cell && known.a == a && known.b == b)
      return known.face;
    const WallFace face = find();
    known = {round_, cell, a, b, face};
    return face;
  }

  size_t bytes() const {
    return known_.capacity() * sizeof(Known) + near.capacity() * sizeof(Vec3) + polygon.bytes();
  }

 private:
  struct Known {
    uint64_t round = 0;  ///< 0: none
    CellIndex cell;
    Vec3 a, b;
    WallFace face;
  };
  static constexpr size_t places = 512;

  /// Forgets the faces of another foam.
  void move_to(const NearSeeds& seeds) {
    const std::shared_ptr<const GradedSeeds>& graded = seeds.graded();
    // A control block is not reused while graded_ refers to it.
    const bool is_same = cells_ && *cells_ == seeds.seeds() && !graded_.owner_before(graded) &&
                         !graded.owner_before(graded_);
    if (is_same) return;
    known_.resize(places);
    cells_ = seeds.seeds();
    graded_ = graded;
    ++round_;
  }

  std::optional<FoamSeeds> cells_;
  std::weak_ptr<const GradedSeeds> graded_;  // identifies them, but does not keep them alive
  uint64_t round_ = 0;
  std::vector<Known> known_;
};

/// A seed that cuts off a corner x of the polygon is nearer to x than a is, so no farther from q
/// than |x - a| + |x - q|.
WallFace find_face(const NearSeeds& seeds, CellIndex cell, Vec3 a, Vec3 b, FaceWorkspace& work) {
  const Vec3 q = seeds.seeds().scale() * 0.5;
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

/// The same among fine leaves, which are too many about the middle of their cell. Searches about
/// the midpoint of the seeds, by growing distances, and only where a seed would cut the polygon: in
/// the balls about its corners that a is on.
WallFace find_graded_face(const NearSeeds& seeds, CellIndex cell, Vec3 a, Vec3 b,
                          FacePolygon& polygon) {
  const Borrowed<SeedForest> forest;  // the density may be the host's
  SeedTrees& trees = forest->of(seeds.graded());
  const Vec3 middle = (a + b) * 0.5;
  const auto may_cut = [&](const Box3& box) {
    bool may = false;
    polygon.for_each_corner([&](Vec3 x) {
      const double reach = length(x - a) * (1 + 1e-9) + near_slack;
      may = may || min_squared(box, x) <= reach * reach;
    });
    return may;
  };
  const auto cut = [&](const LeafSeed& seed) {
    if (!(seed.position == a) && !(seed.position == b)) polygon.cut(seed.position);
  };
  polygon.start(a, b, seeds.seeds().empty_radius() * (1 + 1e-9));
  for (double reach = std::max(length(b - a), 0x1p-6);; reach *= 2) {
    trees.visit(
        cell, Box3{middle, middle}.grown(reach),
        [&](const Box3& box) { return min_squared(box, middle) <= reach * reach && may_cut(box); },
        cut);
    if (polygon.is_empty()) return {};
    double needed = 0;
    polygon.for_each_corner(
        [&](Vec3 x) { needed = std::max(needed, length(x - a) + length(x - middle)); });
    if (needed <= reach) return polygon.face();
    check_cancelled();
  }
}

WallFace face_between(const NearSeeds& seeds, CellIndex cell, Vec3 a, Vec3 b) {
  const Borrowed<FaceWorkspace> borrowed;
  FaceWorkspace& work = *borrowed;
  return work.face(seeds, cell, a, b, [&] {
    return seeds.graded() ? find_graded_face(seeds, cell, a, b, work.polygon)
                          : find_face(seeds, cell, a, b, work);
  });
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

VentedWall Vents::wall(const NearSeeds& seeds, CellIndex cell, Vec3 a, Vec3 b) const {
  // The same bits from both sides.
  if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
  const WallFace face = face_between(seeds, cell, a, b);
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
    const VentedWall wall = vents.wall(seeds, cell, seed, plane.other);
    if (!wall.is_there) continue;
    if (!(wall.depth(q) > 0)) return true;
    is_solid = false;
  }
  return is_solid;
}

NearFace find_nearest_vented_face(const NearSeeds& seeds, const Vents& vents, CellIndex cell,
                                  Vec3 q, double limit) {
  const Borrowed<PointWorkspace> borrowed;
  PointWorkspace& work = *borrowed;
  // Cells are within the empty radius of their seeds, so their faces within twice that of q.
  const double most = std::min(limit, 4 * seeds.seeds().empty_radius());
  for (double tried = std::min(most, 0.5 * seeds.spacing(cell, q));;
       tried = std::min(most, 2 * tried)) {
    seeds.find(cell, q, tried, work.near);
    const Vec3 seed = work.near[nearest_of(work.near, q)];
    work.find_planes(seed, q, tried);
    for (const PointWorkspace::Plane& plane : work.planes) {
      const VentedWall wall = vents.wall(seeds, cell, seed, plane.other);
      if (wall.is_there && !(wall.depth(q) > 0))
        return {std::max(0.0, plane.onset), plane.other - seed};
    }
    if (tried >= most) return {};
  }
}

}  // namespace msq
