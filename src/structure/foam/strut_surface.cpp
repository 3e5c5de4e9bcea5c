// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/strut_surface.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/graded_point.h"
#include "structure/foam/near_struts.h"
#include "structure/foam/strut_entry.h"
#include "structure/foam/tapered_entry.h"

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

/// The same of foams whose seeds are graded: lines, and the squared distances of their edges.
struct NearLine {
  StrutLine line;
  double distance_squared;
};
void find_graded_lines(const Foam& foam, Vec3 p, double radius, std::vector<NearLine>& lines) {
  const Borrowed<std::vector<NearGradedStrut>> struts;
  const Neighbourhood::Located located = foam.neighbourhood().locate(p);
  find_near_graded_struts(foam.graded(), located.cell, located.fraction * foam.seeds().scale(),
                          radius, *struts);
  for (const NearGradedStrut& strut : *struts)
    lines.push_back(
        {graded_line(*foam.graded(), located.cell, strut.seeds), strut.distance_squared});
}

/// The lines of the edges within a radius of a point, in the frame of StrutEntries.
std::vector<NearLine> lines_near(const Foam& foam, const StrutEntries& entries, Vec3 p,
                                 double radius) {
  std::vector<NearLine> lines;
  if (foam.graded()) {
    find_graded_lines(foam, p, radius, lines);
    return lines;
  }
  Vec3 q;
  for (const NearStrut& strut : struts_near(foam, p, radius, q))
    lines.push_back({entries.line(strut.seeds), strut.distance_squared});
  return lines;
}

/// Points of the surface are this near to it, in foam units.
constexpr double surface_error = 1e-8;

}  // namespace

Vec3 strut_normal(const Foam& foam, const Ray& ray, double t) {
  const Vec3 p = ray.at(t);
  const double radius = foam.radius().at(p) / foam.unit();
  const StrutEntries entries(foam);
  const RaySearch search{ray, t, t};
  const FoamRay foam_ray = entries.ray(search);
  const NearLine* nearest = nullptr;
  const std::vector<NearLine> lines = lines_near(foam, entries, p, radius + surface_error);
  for (const NearLine& near : lines)
    if (!nearest || near.distance_squared < nearest->distance_squared) nearest = &near;
  if (!nearest || !(nearest->distance_squared > 0.25 * radius * radius)) return {};
  const Vec3 normal = TaperedStrut(foam, foam_ray, nearest->line).normal(foam_ray.from);
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

double way_to_strut(const Foam& foam, Vec3 p, Vec3 direction) {
  const double unit = foam.unit();
  const Vec3 u = foam.neighbourhood().rotation.apply_inverse(direction);
  const auto most_radius = [&](double ahead) {
    if (foam.radius().is_constant()) return foam.most_radius();
    return foam.radius().range(box_of({p, direction}, 0, ahead * unit)).high / unit;
  };
  // Farther, more seeds take part, and the triples of them to look at grow with their cube.
  double ahead = 0.05 * min_component(foam.seeds().scale());
  double radius = most_radius(ahead);
  Vec3 q;
  const std::vector<NearStrut>& struts = struts_near(foam, p, radius + ahead, q);
  // To where struts of a radius begin.
  const auto entry = [&] {
    double first = ahead;
    for (const NearStrut& strut : struts) {
      const Vec3 a = strut.line.at(strut.part.low) - q, b = strut.line.at(strut.part.high) - q;
      const double in = capsule_entry(a, b - a, u, radius);
      // Behind p, unless p is on its surface to rounding.
      if (in < 0 && -capsule_entry(a, b - a, u * -1.0, radius) < -surface_error) continue;
      first = std::min(first, in);
    }
    return first;
  };
  double way = entry();
  // The less far it is, the less the radius changes on the way.
  constexpr int most_times = 4;
  for (int n = 0; n < most_times && way < ahead && !foam.radius().is_constant(); ++n) {
    ahead = std::max(2 * way, 0.125 * ahead);
    radius = most_radius(ahead);
    way = std::max(way, entry());
  }
  return way * unit - foam.ray_tolerance();
}

void sharpen_entry(const Foam& foam, RaySearch& search) {
  if (!(search.t > search.from)) return;
  const double unit = foam.unit(), radius = foam.radius().at(search.ray.at(search.t)) / unit;
  const StrutEntries entries(foam);
  const FoamRay ray = entries.ray(search);
  const double at = search.t / unit, near = 4 * foam.ray_tolerance() / unit;
  StrutEntry best;
  for (NearLine& near_line :
       lines_near(foam, entries, search.ray.at(search.t), radius + surface_error)) {
    StrutLine& line = near_line.line;
    if (!line.has_line) continue;
    // The ray enters where this edge is: whatever its ends, they are not in the way.
    constexpr double beyond = 16;
    line.corner = line.home;
    line.a = line.line.at(0) - line.along * beyond;
    line.length = 2 * beyond;
    line.ab = line.along * line.length;
    const StrutEntry entry = foam.has_capsules() ? entries.find(ray, line)
                                                 : entries.find_tapered_near(ray, line, at, near);
    if (!entry.is_met || entry.at_from || std::abs(entry.t - at) > near) continue;
    if (comes_before(entry, best)) best = entry;
  }
  if (!best.is_met)
    best = entries.settle(ray, std::max(ray.from, at - foam.ray_tolerance() / unit), at);
  search.t = std::clamp(best.t * unit, search.from, search.to);
  search.normal = best.normal;
}

}  // namespace msq
