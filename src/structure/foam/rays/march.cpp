// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/march.h"
#include "structure/foam/rays/graded_line.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/edges/graded_edges.h"
#include "structure/foam/point/graded_point.h"
#include "structure/foam/rays/near_edges.h"
#include "structure/foam/rays/strut_entry.h"
#include "structure/foam/rays/tapered_entry.h"

namespace msq {

namespace {

/// Near a point of a foam with graded seeds: lines, and NearEdge's numbers of their edges.
struct NearLine {
  StrutLine line;
  double distance_squared, lead;
};
void find_graded_lines(const FoamData& foam, Vec3 p, double radius, std::vector<NearLine>& lines) {
  const Borrowed<std::vector<NearGradedEdge>> struts;
  const Neighbourhood::Located located = foam.neighbourhood().locate(p);
  find_graded_edges_near(foam.graded(), located.cell, located.fraction * foam.seeds().scale(),
                         radius, *struts);
  for (const NearGradedEdge& strut : *struts)
    lines.push_back({graded_line(*foam.graded(), located.cell, strut.seeds), strut.distance_squared,
                     strut.lead});
}

/// The lines of the edges within a radius of a point, in the frame of StrutEntries.
std::vector<NearLine> lines_near(const FoamData& foam, const StrutEntries& entries, Vec3 p,
                                 double radius) {
  std::vector<NearLine> lines;
  if (foam.graded()) {
    find_graded_lines(foam, p, radius, lines);
    return lines;
  }
  for (const NearEdge& strut : NearEdges(foam, p, radius))
    lines.push_back({entries.line(strut.seeds), strut.distance_squared, strut.lead});
  return lines;
}

/// If a fourth seed is about as near to an edge as its three, the lines of several triples almost
/// coincide, and each is an edge up to rounding. Which of them a search by cells tests depends on
/// roundings there. They decide by less than 1e-10 of NearEdge::lead (max_beyond of
/// voronoi_cell.cpp, and walk_tie).
constexpr double min_lead = 1e-9;

/// Whether a search by cells tests lines of named seeds; otherwise it takes all entries from
/// sharpen_entry(), and ties are decided there. EdgeBuilder names none without jitter.
bool names_edge_seeds(const FoamData& foam) {
  return foam.graded() ? names_edge_seeds(*foam.graded()) : foam.seeds().jitter() > 0;
}

/// Maximum distance, in foam units, of points of the surface from it.
double surface_error(const FoamData& foam) {
  return foam.stretch() ? 1e-8 * foam.stretch()->max_factor() : 1e-8;
}

}  // namespace

Vec3 strut_normal(const FoamData& foam, const Ray& ray, double t) {
  const Vec3 p = ray.at(t);
  const double radius = foam.radius().at(p) / foam.unit();
  const StrutEntries entries(foam);
  const RaySearch search{ray, t, t};
  const FoamRay foam_ray = entries.ray(search);
  const NearLine* nearest = nullptr;
  const double reach = radius + surface_error(foam) + 2 * (foam_ray.tolerance + foam_ray.error);
  const std::vector<NearLine> lines = lines_near(foam, entries, p, reach);
  for (const NearLine& near : lines)
    if (!nearest || near.distance_squared < nearest->distance_squared) nearest = &near;
  if (!nearest || !(nearest->distance_squared > 0.25 * radius * radius)) return {};
  const Vec3 normal = TaperedStrut(foam, foam_ray, nearest->line).normal(foam_ray.from);
  return dot(normal, ray.direction) < 0 ? normal : Vec3{};
}

double way_to_strut(const FoamData& foam, Vec3 p, Vec3 direction, double room) {
  const double unit = foam.unit();
  const Vec3 u = foam.neighbourhood().rotation.apply_inverse(direction);
  const auto max_radius = [&](double ahead) {
    if (foam.radius().is_constant()) return foam.max_radius() + room / unit;
    return (foam.radius().range(box_of({p, direction}, 0, ahead * unit)).high + room) / unit;
  };
  // A longer way needs more seeds, and the number of their triples grows with their cube.
  double ahead = 0.05 * min_component(foam.seeds().scale());
  double radius = max_radius(ahead);
  const NearEdges struts(foam, p, radius + ahead);
  const Vec3 q = struts.q;
  // To the start of struts with the radius.
  const auto entry = [&] {
    double first = ahead;
    for (const NearEdge& strut : struts) {
      const Vec3 a = strut.line.at(strut.part.low) - q, b = strut.line.at(strut.part.high) - q;
      const double in = capsule_entry(a, b - a, u, radius);
      // Behind p, unless p is on its surface up to rounding.
      if (in < 0 && -capsule_entry(a, b - a, u * -1.0, radius) < -surface_error(foam)) continue;
      first = std::min(first, in);
    }
    return first;
  };
  double way = entry();
  // On a shorter way, the radius changes less.
  constexpr int max_times = 4;
  for (int n = 0; n < max_times && way < ahead && !foam.radius().is_constant(); ++n) {
    ahead = std::max(2 * way, 0.125 * ahead);
    radius = max_radius(ahead);
    way = std::max(way, entry());
  }
  return way * unit - foam.ray_tolerance();
}

bool sharpen_entry(const FoamData& foam, RaySearch& search) {
  if (!(search.t > search.from)) return true;
  const double unit = foam.unit(), radius = foam.radius().at(search.ray.at(search.t)) / unit;
  const StrutEntries entries(foam);
  const FoamRay ray = entries.ray(search);
  // Rounding may split an entry into many; the one found may be any of them.
  const double at = search.t / unit, near = 4 * ray.tolerance + 256 * ray.error;
  StrutEntry best;
  bool has_ties = false;
  for (NearLine& near_line : lines_near(foam, entries, search.ray.at(search.t),
                                        radius + std::max(surface_error(foam), near))) {
    StrutLine& line = near_line.line;
    if (!line.has_line) continue;
    // The ray enters at this edge, so its ends are not in the way.
    const double beyond = foam.stretch() ? 16 * foam.stretch()->max_factor() : 16;
    line.corner = line.home;
    line.a = line.line.at(0) - line.along * beyond;
    line.length = 2 * beyond;
    line.ab = line.along * line.length;
    const StrutEntry entry = foam.has_capsules() ? entries.find(ray, line)
                                                 : entries.find_tapered_near(ray, line, at, near);
    if (!entry.is_met || entry.at_from || std::abs(entry.t - at) > near) continue;
    has_ties |= near_line.lead < min_lead;
    if (comes_before(entry, best)) best = entry;
  }
  if (!best.is_met) best = entries.settle(ray, std::max(ray.from, at - ray.tolerance), at);
  search.t = std::clamp(best.t * unit, search.from, search.to);
  search.normal = best.normal;
  return best.is_sure && !(has_ties && names_edge_seeds(foam));
}

}  // namespace msq
