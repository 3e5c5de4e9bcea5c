// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/vent_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/borrowed.h"
#include "base/job.h"
#include "structure/foam/walls/wall_point.h"

namespace msq {

namespace {

/// Where the ray is in the slab between the seed of its cell and another, by the way from its
/// start.
struct RaySlab {
  Vec3 other;
  double low, high;
};

struct VentRayWorkspace {
  std::vector<Vec3> near;
  std::vector<RaySlab> slabs;

  size_t bytes() const {
    return near.capacity() * sizeof(Vec3) + slabs.capacity() * sizeof(RaySlab);
  }
};

/// Of the way q + s * along in the cell of a seed. Foam units; s in model units.
class RayInCell {
 public:
  RayInCell(const VentRay& foam, CellIndex cell, Vec3 q, Vec3 along, Vec3 own,
            VentRayWorkspace& work)
      : foam_(foam), cell_(cell), q_(q), along_(along), own_(own), work_(work) {}

  /// Finds the slabs that the way meets in [from, to], and where it leaves the cell: sets `to`, if
  /// that is before it, and `next`, the seed of the cell after that.
  void cut(double from, double& to, Vec3& next) {
    work_.slabs.clear();
    for (const Vec3& other : work_.near) {
      const Vec3 apart = other - own_;
      const double size = length(apart);
      if (!(size > 0)) continue;
      // The onset at s is onset - slope * s.
      const double onset = dot(apart, (own_ - q_) + (other - q_)) / size;
      const double slope = 2 * dot(apart, along_) / size;
      if (slope > 0 && onset / slope < to) {
        to = std::max(from, onset / slope);
        next = other;
      }
      RaySlab slab{other, from, std::numeric_limits<double>::infinity()};
      const double over = onset - foam_.thickness, closing = slope + foam_.growth;
      if (closing > 0)
        slab.low = std::max(from, over / closing);
      else if (closing < 0)
        slab.high = over / closing;
      else if (over > 0)
        continue;
      if (slab.low <= to && slab.low <= slab.high) work_.slabs.push_back(slab);
    }
    for (RaySlab& slab : work_.slabs) slab.high = std::min(slab.high, to);
  }

  /// The first point in the solid; infinity if there is none.
  double entry() const {
    double first = std::numeric_limits<double>::infinity();
    for (const RaySlab& slab : work_.slabs) {
      if (!(slab.low <= slab.high && slab.low < first)) continue;
      const VentedWall wall = wall_of(slab);
      const double low = wall.is_there ? beyond_hole(wall, slab.low) : beyond_walls(slab);
      if (low <= slab.high) first = std::min(first, low);
    }
    return first;
  }

 private:
  VentedWall wall_of(const RaySlab& slab) const {
    return foam_.vents.wall(foam_.seeds, cell_, own_, slab.other);
  }

  /// The first point from s on that is not in the hole of a wall.
  double beyond_hole(const VentedWall& wall, double s) const {
    if (!(wall.radius > 0)) return s;
    const Vec3 from = q_ - wall.middle;
    const Vec3 o = from - wall.along * dot(from, wall.along);
    const Vec3 d = along_ - wall.along * dot(along_, wall.along);
    const double a = dot(d, d), b = dot(o, d), c = dot(o, o) - wall.radius * wall.radius;
    if (!(a > 0)) return c < 0 ? std::numeric_limits<double>::infinity() : s;
    const double root = b * b - a * c;
    if (!(root > 0)) return s;
    const double half = std::sqrt(root) / a, middle = -b / a;
    return s >= middle - half && s < middle + half ? middle + half : s;
  }

  /// Planes without a face hold points that no wall's slab holds.
  double beyond_walls(const RaySlab& slab) const {
    double s = slab.low;
    for (bool moved = true; moved && s <= slab.high;) {
      moved = false;
      for (const RaySlab& other : work_.slabs) {
        if (!(other.low <= s && s < other.high) || !wall_of(other).is_there) continue;
        s = other.high;
        moved = true;
      }
    }
    return s;
  }

  const VentRay& foam_;
  const CellIndex cell_;
  const Vec3 q_, along_, own_;
  VentRayWorkspace& work_;
};

}  // namespace

// A cell's seed is ahead of that of the cell before it along the ray, so the cells come to an end.
bool VentRay::find(const Ray& ray, double from, double to, double& t) const {
  const Borrowed<VentRayWorkspace> borrowed;
  VentRayWorkspace& work = *borrowed;
  const Neighbourhood::Located start = grid.locate(ray.at(from));
  const Vec3 q = start.fraction * seeds.seeds().scale();
  const Vec3 along = grid.rotation.apply_inverse(ray.direction) * (1 / unit);
  // At a way s from q, seeds matter that are farther than the nearest one there by the thickness.
  const double way = to - from;
  seeds.find(start.cell, q, thickness + growth * way + 2 * way / unit, work.near);
  Vec3 own = work.near[nearest_of(work.near, q)];
  for (double at = 0;;) {
    check_cancelled();
    RayInCell cell(*this, start.cell, q, along, own, work);
    double end = way;
    Vec3 next = own;
    cell.cut(at, end, next);
    const double entry = cell.entry();
    if (entry <= end) {
      t = std::min(to, from + entry);
      return true;
    }
    if (next == own) return false;
    at = end;
    own = next;
  }
}

}  // namespace msq
