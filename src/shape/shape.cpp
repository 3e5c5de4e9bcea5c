// SPDX-License-Identifier: Apache-2.0
#include "shape/shape.h"

#include <limits>

#include "base/ray_normal.h"
#include "base/signed_distance.h"

namespace msq {

double Shape::distance(Vec3 p) const {
  const Box3& box = bounds();
  const Vec3 gap = max(max(box.min - p, p - box.max), Vec3{});
  // From this far away, the distances to the box and to its contents are equal to the last bits,
  // and squares might overflow.
  if (max_component(gap) > 0x1p60 * max_component(box.extent())) {
    const double far = std::hypot(gap.x, gap.y, gap.z) * (1 - 0x1p-50);
    return std::min(far, std::numeric_limits<double>::max());
  }
  return signed_distance(inside(p), distance_bound(p));
}

bool Shape::march(bool wanted, const Ray& ray, double from, double to, double& t,
                  const Job* job) const {
  const RayMarch steps{min_ray_step(), ray_tolerance()};
  return steps.find(
      wanted, ray, from, to, [this](Vec3 p) { return inside(p); },
      [this](Vec3 p) { return distance_bound(p); }, t, job);
}

bool Shape::enter(const Ray& ray, double from, double to, double& t, const Job* job) const {
  return clip_to_box(ray, bounds(), from, to) && march(true, ray, from, to, t, job);
}

double Shape::leave(const Ray& ray, double from, double to, const Job* job) const {
  if (!clip_to_box(ray, bounds(), from, to)) return from;
  double t;
  return march(false, ray, from, to, t, job) ? t : to;
}

bool Shape::cross(const Ray& ray, double from, double to, double& t, double& end,
                  const Job* job) const {
  if (!enter(ray, from, to, t, job)) return false;
  end = t > to ? t : leave(ray, t, to, job);
  return true;
}

void Shape::enter_all(RaySearch* searches, size_t count, const Job* job) const {
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    check_cancelled(job);
    s.found = enter(s.ray, s.from, s.to, s.t, job);
  }
}

void Shape::leave_all(RaySearch* searches, size_t count, const Job* job) const {
  for (size_t i = 0; i < count; ++i) {
    check_cancelled(job);
    searches[i].t = leave(searches[i].ray, searches[i].from, searches[i].to, job);
  }
}

Vec3 Shape::normal(const Ray& ray, double t) const {
  return normal_by_membership([this](Vec3 p) { return inside(p); }, ray, t, normal_distance());
}

void Shape::find_normals(RaySearch* searches, size_t count) const {
  for (size_t i = 0; i < count; ++i) searches[i].normal = normal(searches[i].ray, searches[i].t);
}

void Shape::fill_rows(const RowBlock& block) const {
  for_each_row_in_bounds(block,
                         [&](double y, double z, uint64_t* row, uint64_t first, uint64_t end) {
                           for (uint64_t i = first; i < end; ++i)
                             if (inside({block.grid->x(i), y, z})) set_bits(row, i, i);
                         });
}

}  // namespace msq
