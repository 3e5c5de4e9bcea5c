// SPDX-License-Identifier: Apache-2.0
// Rays through what of a solid is in a shell (cell_shell.h). A ray meets the shell in two parts at
// most. The solid is searched in these; at their ends the shell is the boundary.
#pragma once

#include <vector>

#include "structure/common/cell_shell.h"

namespace msq {

/// As Structure::enter() of `solid`. find(searches, count) does it as if there were no shell.
template <class Find>
void enter_in_shell(const CellShell& shell, const Structure& solid, RaySearch* searches,
                    size_t count, Find&& find) {
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
      const RaySearch& s = searches[i];
      if (s.found) continue;
      const RayParts of_ray = shell.parts_of(s.ray, s.from, s.to, solid.ray_tolerance(s.ray, s.to));
      if (n >= of_ray.count) continue;
      queried.push_back({s.ray, of_ray.part[n].from, of_ray.part[n].to});
      parts.push_back(of_ray.part[n]);
      index.push_back(i);
    }
    if (queried.empty()) return;
    find(queried.data(), queried.size());
    for (size_t k = 0; k < queried.size(); ++k) {
      if (!queried[k].found) continue;
      RaySearch& search = searches[index[k]];
      search.found = true;
      search.t = queried[k].t;
      search.normal = parts[k].is_entry && search.t == parts[k].from
                          ? shell.normal(search.ray.at(search.t))
                          : queried[k].normal;
    }
  }
}

/// Whether a ray comes into the shell at t. Where it enters the solid at once, either has a normal.
inline bool enters_shell(const CellShell& shell, const Structure& solid, const Ray& ray, double t) {
  const double room = 2 * solid.ray_tolerance(ray, t);
  return !shell.holds(ray.at(t - room)) && shell.holds(ray.at(t + room));
}

/// As Structure::leave() of `solid`. leave(from, to, t) does it as if there were no shell: false if
/// the ray does not leave.
template <class Leave>
double leave_in_shell(const CellShell& shell, const Structure& solid, const Ray& ray, double from,
                      double to, Leave&& leave) {
  const double tolerance = solid.ray_tolerance(ray, to);
  const RayParts parts = shell.parts_of(ray, from, to, tolerance);
  // Rounding may leave nothing of the shell.
  if (parts.count == 0 || parts.part[0].from > from) return from;
  const double end = parts.part[0].to;
  double t = end;
  return leave(from, end, t) ? t : shell.follow(ray, end, to, tolerance);
}

}  // namespace msq
