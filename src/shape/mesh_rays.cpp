// SPDX-License-Identifier: Apache-2.0
// Rays through a mesh. Between two crossings of the boundary's triangles membership does not
// change, so one point between them decides it. False crossings from the tree do no harm. Short
// rays away from all triangles need no search (decided_cells.h).
#include "base/ray_normal.h"
#include "base/unit.h"
#include "shape/mesh.h"

namespace msq {

bool Mesh::find_along(const Ray& ray, double from, double to, bool wanted, double& t,
                      const Job* job) const {
  if (open_) return find_along_open(ray, from, to, wanted, t, job);
  const DecidedCells* decided = facts_.closed ? &cells(job) : nullptr;
  const auto is_wanted = [&](double at) {
    const Vec3 p = ray.at(at);
    const DecidedCells::Side side = decided ? decided->side(p) : DecidedCells::Side::unknown;
    return (side == DecidedCells::Side::unknown ? inside(p) : side == DecidedCells::Side::inside) ==
           wanted;
  };
  if (is_wanted(from)) {
    t = from;
    return true;
  }
  if (decided && decided->is_on_one_side(ray, from, to)) return false;
  const double tolerance = ray_tolerance();
  double known = from;  // not wanted here
  double crossing;
  Vec3 normal;
  // What is crossed at `from` may be found a little before it.
  bool crosses = boundary().first_crossing(ray, from - tolerance, to, tolerance, crossing, normal);
  if (crosses) crossing = std::max(crossing, from);
  // A triangle is crossed at one t, and each search begins behind the last crossing: there are no
  // more rounds than triangles.
  JobPoll poll(job);
  while (crosses) {
    poll();
    double next;
    // Crossings closer than the tolerance are one.
    crosses = crossing + tolerance <= to &&
              boundary().first_crossing(ray, crossing + tolerance, to, tolerance, next, normal);
    const double beyond = 0.5 * (crossing + (crosses ? next : to));
    if (is_wanted(beyond)) {
      if (is_wanted(crossing)) {
        if (crossing - tolerance <= known || !is_wanted(crossing - tolerance)) {
          t = crossing;
          return true;
        }
      } else if (crossing + tolerance >= beyond || is_wanted(crossing + tolerance)) {
        t = std::min(crossing + tolerance, beyond);
        return true;
      }
      // The error of the crossing is large: along a triangle's plane, or at a needle.
      t = bisect(known, beyond, tolerance, is_wanted);
      return true;
    }
    known = beyond;
    crossing = next;
  }
  return false;
}

bool Mesh::enter(const Ray& ray, double from, double to, double& t, const Job* job) const {
  if (!clip_to_box(ray, bounds(), from, to)) return false;
  return find_along(ray, from, to, true, t, job);
}

double Mesh::leave(const Ray& ray, double from, double to, const Job* job) const {
  if (!clip_to_box(ray, bounds(), from, to)) return from;
  double t;
  return find_along(ray, from, to, false, t, job) ? t : to;
}

Vec3 Mesh::normal(const Ray& ray, double t) const {
  const double room = 2 * ray_tolerance();
  double at;
  Vec3 normal;
  if (boundary().first_crossing(ray, t - room, t + room, room, at, normal)) {
    // That of a tiny triangle in a large mesh may be too short to be squared.
    const Vec3 unit = unit_along(normal);
    if (!(unit == Vec3{})) return dot(unit, ray.direction) > 0 ? unit * -1.0 : unit;
  }
  if (open_) {
    const Vec3 level = open_->normal(ray.at(t));
    if (!(level == Vec3{})) return dot(level, ray.direction) > 0 ? level * -1.0 : level;
  }
  return Shape::normal(ray, t);
}

}  // namespace msq
