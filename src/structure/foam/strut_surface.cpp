// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/strut_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "structure/foam/near_struts.h"
#include "structure/foam/strut_entry.h"

namespace msq {

namespace {

/// The struts within a radius (foam units) of a point, and the point in their frame.
const std::vector<NearStrut>& struts_near(const Foam& foam, Vec3 p, double radius, Vec3& q) {
  thread_local std::vector<NearStrut> struts;
  const Neighbourhood::Located located = foam.neighbourhood().locate(p);
  q = located.fraction * foam.seeds().scale();
  find_near_struts(foam.seeds(), located.cell, q, radius, struts);
  return struts;
}

/// Points of the surface are this near to it, in foam units.
constexpr double surface_error = 1e-8;

}  // namespace

Vec3 strut_normal(const Foam& foam, const Ray& ray, double t) {
  const double radius = foam.radius().at(ray.at(t)) / foam.unit();
  const Vec3 tilt = foam.radius().gradient(ray.at(t), foam.normal_distance());
  Vec3 q;
  const NearStrut* nearest = nullptr;
  for (const NearStrut& strut : struts_near(foam, ray.at(t), radius + surface_error, q))
    if (!nearest || strut.distance_squared < nearest->distance_squared) nearest = &strut;
  if (!nearest) return {};
  const EdgeLine& line = nearest->line;
  const double foot = dot(q - line.seed - line.offset, line.direction) * line.inverse_squared;
  const Vec3 out = q - line.at(std::clamp(foot, nearest->part.low, nearest->part.high));
  const double size = length(out);
  if (!(size > 0.5 * radius)) return {};
  Vec3 normal = foam.neighbourhood().rotation.apply(out * (1 / size));
  if (!foam.radius().is_constant()) {
    normal = normal - tilt;
    normal = normal * (1 / length(normal));
  }
  return dot(normal, ray.direction) < 0 ? normal : Vec3{};
}

double strut_exit(const Foam& foam, const Ray& ray, double from, double to) {
  const double unit = foam.unit(), radius = foam.most_radius();
  const Vec3 u = foam.neighbourhood().rotation.apply_inverse(ray.direction);
  Vec3 q;
  double farthest = 0;
  for (const NearStrut& strut : struts_near(foam, ray.at(from), 2 * radius, q)) {
    if (strut.distance_squared > radius * radius) continue;
    // The part of the edge that is known is an axis that the point is within the radius of.
    const Vec3 a = strut.line.at(strut.part.low), ab = strut.line.at(strut.part.high) - a;
    const double exit = -capsule_entry(a - q, ab, u * -1.0, radius);
    if (std::isfinite(exit)) farthest = std::max(farthest, exit);
  }
  return std::min(to, from + farthest * unit);
}

void sharpen_entry(const Foam& foam, RaySearch& search) {
  if (!(search.t > search.from)) return;
  const double unit = foam.unit(), radius = foam.radius().at(search.ray.at(search.t)) / unit;
  const StrutEntries entries(foam);
  const FoamRay ray = entries.ray(search);
  const double at = search.t / unit, near = 4 * foam.ray_tolerance() / unit;
  StrutEntry best;
  Vec3 q;
  for (const NearStrut& strut :
       struts_near(foam, search.ray.at(search.t), radius + surface_error, q)) {
    StrutLine line = entries.line(strut.seeds);
    if (!line.has_line) continue;
    // The ray enters where this edge is: whatever its ends, they are not in the way.
    constexpr double beyond = 16;
    line.corner = line.home;
    line.a = line.line.at(0) - line.along * beyond;
    line.length = 2 * beyond;
    line.ab = line.along * line.length;
    const StrutEntry entry = foam.radius().is_constant()
                                 ? entries.find(ray, line)
                                 : entries.find_tapered_near(ray, line, at, near);
    if (!entry.is_met || entry.at_from || std::abs(entry.t - at) > near) continue;
    if (!best.is_met || entry.t < best.t) best = entry;
  }
  if (!best.is_met)
    best = entries.settle(ray, std::max(ray.from, at - foam.ray_tolerance() / unit), at);
  search.t = std::clamp(best.t * unit, search.from, search.to);
  search.normal = best.normal;
}

}  // namespace msq
