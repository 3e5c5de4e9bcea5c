// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/shell_rays.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/infinity.h"
#include "base/unit.h"
#include "structure/functional/ray_search.h"

namespace msq {

double ShellRays::settle(const Ray& ray, double t, double end, double tolerance) const {
  const double sign = end < t ? -1 : 1;
  for (double step = 0.25 * tolerance; sign * (end - t) >= 0; step *= 2) {
    if (is_in_shell(ray, t)) return t;
    if (t == end) break;
    t = sign > 0 ? std::min(end, t + step) : std::max(end, t - step);
  }
  return sign * infinity;
}

ShellRays::Parts ShellRays::parts_of_box(const Ray& ray, double from, double to) const {
  const Neighbourhood frame = map_->smallest();
  const Vec3 at = frame.to_grid(ray.origin), way = frame.rotation.apply_inverse(ray.direction);
  const Box3 box = map_->box();
  double first = -infinity, last = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0) {
      // Rounding may put points on a face to either side of it; settle() looks at them.
      const double slack = map_->slack(ray.origin, max_component(box.max));
      if (at[axis] < -slack || at[axis] > box.max[axis] + slack) return {};
      continue;
    }
    const double one = -at[axis] / way[axis], other = (box.max[axis] - at[axis]) / way[axis];
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  Parts parts;
  const double a = std::max(first, from), b = std::min(last, to);
  if (!(a <= b)) return parts;
  const double tolerance = solid_.ray_tolerance(ray, to);
  const Part part{settle(ray, a, b, tolerance), settle(ray, b, a, tolerance), first > from};
  if (part.from <= part.to) parts.part[parts.count++] = part;
  return parts;
}

ShellRays::Parts ShellRays::parts_of(const Ray& ray, double from, double to) const {
  if (map_) return parts_of_box(ray, from, to);
  Vec3 at = warp_->grid().to_grid(ray.origin);
  Vec3 way = warp_->grid().rotation.apply_inverse(ray.direction);
  if (warp_->kind() == Warp::Kind::cylindrical) at.z = way.z = 0;
  // The ray is nearest at `middle`, at the distance `near`, and `half` from there at a radius.
  const double speed = length(way);
  const double middle = speed > 0 ? -dot(at, way) / (speed * speed) : 0;
  const Vec3 nearest = at + way * middle;
  const double near = length(nearest);
  const auto half = [&](double radius) {
    if (radius < near) return -1.0;
    return speed > 0 ? std::sqrt((radius - near) * (radius + near)) / speed : infinity;
  };
  Parts parts;
  const double out = half(warp_->outer()),
               in = warp_->shell().inner > 0 ? half(warp_->shell().inner) : -1;
  if (out < 0 || from > to) return parts;
  const double tolerance = solid_.ray_tolerance(ray, to);
  const auto add = [&](double first, double last) {
    const double a = std::max(first, from), b = std::min(last, to);
    if (!(a <= b)) return;
    Part part{settle(ray, a, b, tolerance), settle(ray, b, a, tolerance), first > from};
    if (part.from <= part.to) parts.part[parts.count++] = part;
  };
  if (in > 0) {
    add(middle - out, middle - in);
    add(middle + in, middle + out);
  } else {
    add(middle - out, middle + out);
  }
  return parts;
}

Vec3 ShellRays::normal_of_shell(Vec3 p) const {
  if (map_) {
    const Neighbourhood frame = map_->smallest();
    const Vec3 at = frame.to_grid(p), size = map_->box().max;
    double nearest = infinity;
    Vec3 normal;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        const double gap = sign < 0 ? at[axis] : size[axis] - at[axis];
        if (!(gap < nearest)) continue;
        nearest = gap;
        normal = {};
        normal[axis] = sign;
      }
    return frame.rotation.apply(normal);
  }
  Vec3 g = warp_->grid().to_grid(p);
  if (warp_->kind() == Warp::Kind::cylindrical) g.z = 0;
  const double r = length(g);
  const bool is_inner = r - warp_->shell().inner < warp_->outer() - r;
  return warp_->grid().rotation.apply(unit_along(g) * (is_inner ? -1.0 : 1.0));
}

void ShellRays::enter(RaySearch* searches, size_t count) const {
  FunctionalRays rays(solid_, job_);
  std::vector<RaySearch> asked;
  std::vector<Part> parts;
  std::vector<size_t> index;
  for (size_t i = 0; i < count; ++i) {
    searches[i].found = false;
    searches[i].normal = {};
  }
  for (size_t n = 0; n < 2; ++n) {
    asked.clear();
    parts.clear();
    index.clear();
    for (size_t i = 0; i < count; ++i) {
      if (searches[i].found) continue;
      const Parts of_ray = parts_of(searches[i].ray, searches[i].from, searches[i].to);
      if (n >= of_ray.count) continue;
      asked.push_back({searches[i].ray, of_ray.part[n].from, of_ray.part[n].to});
      parts.push_back(of_ray.part[n]);
      index.push_back(i);
    }
    rays.find(true, asked.data(), asked.size());
    for (size_t k = 0; k < asked.size(); ++k)
      if (asked[k].found && parts[k].is_entry && asked[k].t == parts[k].from)
        asked[k].normal = normal_of_shell(asked[k].ray.at(asked[k].t));
    rays.find_normals(asked.data(), asked.size());
    for (size_t k = 0; k < asked.size(); ++k) {
      if (!asked[k].found) continue;
      RaySearch& search = searches[index[k]];
      search.found = true;
      search.t = asked[k].t;
      search.normal = asked[k].normal;
    }
  }
}

double ShellRays::leave(const Ray& ray, double from, double to) const {
  const Parts parts = parts_of(ray, from, to);
  // Rounding may leave nothing of the shell.
  if (parts.count == 0 || parts.part[0].from > from) return from;
  RaySearch search{ray, from, parts.part[0].to};
  FunctionalRays(solid_, job_).find(false, &search, 1);
  if (search.found) return search.t;
  double t = parts.part[0].to;
  const double tolerance = solid_.ray_tolerance(ray, to);
  for (double step = 0.25 * tolerance; t < to && is_in_shell(ray, t); step *= 2)
    t = std::min(to, t + step);
  return t;
}

}  // namespace msq
