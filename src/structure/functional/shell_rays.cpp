// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/shell_rays.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/infinity.h"
#include "base/unit.h"
#include "structure/functional/ray_search.h"

namespace msq {

RayParts ShellRays::parts_of_box(const Ray& ray, double from, double to) const {
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
  RayParts parts;
  add_part(parts, first, last, from, to, solid_.ray_tolerance(ray, to),
           [&](double t) { return is_in_shell(ray, t); });
  return parts;
}

RayParts ShellRays::parts_of(const Ray& ray, double from, double to) const {
  if (map_) return parts_of_box(ray, from, to);
  return shell_->parts_of(ray, from, to, solid_.ray_tolerance(ray, to));
}

Vec3 ShellRays::normal_of_shell(Vec3 p) const {
  if (shell_) return shell_->normal(p);
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

void ShellRays::enter(RaySearch* searches, size_t count) const {
  FunctionalRays rays(solid_, job_);
  std::vector<RaySearch> queried;
  std::vector<RayPart> parts;
  std::vector<size_t> index;
  for (size_t i = 0; i < count; ++i) {
    searches[i].found = false;
    searches[i].normal = {};
  }
  for (size_t n = 0; n < 2; ++n) {
    queried.clear();
    parts.clear();
    index.clear();
    for (size_t i = 0; i < count; ++i) {
      if (searches[i].found) continue;
      const RayParts of_ray = parts_of(searches[i].ray, searches[i].from, searches[i].to);
      if (n >= of_ray.count) continue;
      queried.push_back({searches[i].ray, of_ray.part[n].from, of_ray.part[n].to});
      parts.push_back(of_ray.part[n]);
      index.push_back(i);
    }
    rays.find(true, queried.data(), queried.size());
    for (size_t k = 0; k < queried.size(); ++k)
      if (queried[k].found && parts[k].is_entry && queried[k].t == parts[k].from)
        queried[k].normal = normal_of_shell(queried[k].ray.at(queried[k].t));
    rays.find_normals(queried.data(), queried.size());
    for (size_t k = 0; k < queried.size(); ++k) {
      if (!queried[k].found) continue;
      RaySearch& search = searches[index[k]];
      search.found = true;
      search.t = queried[k].t;
      search.normal = queried[k].normal;
    }
  }
}

double ShellRays::leave(const Ray& ray, double from, double to) const {
  const RayParts parts = parts_of(ray, from, to);
  // Rounding may leave nothing of the shell.
  if (parts.count == 0 || parts.part[0].from > from) return from;
  RaySearch search{ray, from, parts.part[0].to};
  FunctionalRays(solid_, job_).find(false, &search, 1);
  if (search.found) return search.t;
  const double t = parts.part[0].to, tolerance = solid_.ray_tolerance(ray, to);
  if (shell_) return shell_->follow(ray, t, to, tolerance);
  return follow_part(t, to, tolerance, [&](double at) { return is_in_shell(ray, at); });
}

}  // namespace msq
