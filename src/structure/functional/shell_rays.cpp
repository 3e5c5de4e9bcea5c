// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/shell_rays.h"

#include <vector>

#include "structure/functional/ray_search.h"

namespace msq {

RayParts ShellRays::parts_of(const Ray& ray, double from, double to) const {
  return shell_->parts_of(ray, from, to, solid_.ray_tolerance(ray, to));
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
        queried[k].normal = shell_->normal(queried[k].ray.at(queried[k].t));
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
  return shell_->follow(ray, parts.part[0].to, to, solid_.ray_tolerance(ray, to));
}

}  // namespace msq
