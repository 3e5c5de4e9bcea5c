// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/march.h"
#include "structure/foam/rays/graded_line.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/edges/graded_edges.h"
#include "structure/foam/point/edges_near.h"
#include "structure/foam/point/graded_point.h"
#include "structure/foam/point/stretched_point.h"
#include "structure/foam/point/weighted_point.h"
#include "structure/foam/rays/strut_entry.h"
#include "structure/foam/rays/tapered_entry.h"
#include "strut/segment.h"

namespace msq {

namespace {

/// The struts within a radius (foam units) of a point, and the point in their frame.
class NearStruts {
 public:
  NearStruts(const FoamData& foam, Vec3 p, double radius) {
    const Neighbourhood::Located located = foam.neighbourhood().locate(p);
    q = located.fraction * foam.seeds().scale();
    if (foam.stretch())
      find_stretched_edges_near(*foam.stretch(), located.cell, q, radius, *struts_);
    else if (foam.is_weighted())
      find_weighted_edges_near(foam.seeds(), located.cell, q, radius, *struts_);
    else
      find_edges_near(foam.seeds(), located.cell, q, radius, *struts_);
  }
  auto begin() const { return struts_->cbegin(); }
  auto end() const { return struts_->cend(); }

  Vec3 q;

 private:
  const Borrowed<std::vector<NearEdge>> struts_;
};

/// The same for foams with graded seeds: lines, and NearEdge's numbers of their edges.
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
  for (const NearEdge& strut : NearStruts(foam, p, radius))
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

namespace {

/// A ray from a point in the foam, `q` in the frame of struts near it, by the way from there in
/// foam units.
class Exit {
 public:
  Exit(const FoamData& foam, const Ray& ray, double from, double to)
      : foam_(foam),
        ray_(ray),
        from_(from),
        to_((to - from) / foam.unit()),
        foam_ray_(StrutEntries(foam).ray(search_)),
        most_(radii(0, 0).high),
        struts_(foam, ray.at(from), 2 * most_) {}

  /// How far struts that hold the ray hold it.
  double find() {
    double until = 0;
    if (foam_.radius().is_constant()) {
      follow(0, to_, until);
      return until;
    }
    // The radius varies less in a shorter piece.
    constexpr int max_pieces = 64;
    constexpr double shorter = 0.125;
    double size = 2 * most_;
    for (int n = 0; n < max_pieces && until < to_; ++n) {
      const double end = std::min(to_, until + size);
      const NearEdge* const strut = follow(until, end, until);
      if (until >= end) continue;
      if (strut && follow_out(*strut, end, until)) break;
      size *= shorter;
      if (size < foam_ray_.tolerance) break;
    }
    return until;
  }

 private:
  /// Of the piece, less the rounding of points.
  Interval radii(double begin, double end) const {
    const double unit = foam_.unit(), room = 2 * foam_ray_.error;
    const Interval range =
        foam_.radius().is_constant()
            ? Interval{foam_.radius().at({}), foam_.radius().at({})}
            : foam_.radius().range(box_of(ray_, from_ + begin * unit, from_ + end * unit));
    return {std::max(0.0, range.low / unit - room), std::max(0.0, range.high / unit - room)};
  }

  Vec3 start_of(const NearEdge& strut) const { return strut.line.at(strut.part.low) - struts_.q; }
  Vec3 end_of(const NearEdge& strut) const { return strut.line.at(strut.part.high) - struts_.q; }

  /// Moves `until` as far as a strut of the piece's minimum radius holds the ray, which is in it
  /// at `begin`. Returns the strut, or null. The known part of an edge is its axis.
  const NearEdge* follow(double begin, double end, double& until) const {
    const double radius = radii(begin, end).low;
    const Vec3 u = foam_ray_.direction;
    const NearEdge* last = nullptr;
    for (const NearEdge& strut : struts_) {
      const Vec3 a = start_of(strut), ab = end_of(strut) - a;
      if (!(Segment(a, a + ab).distance_squared(u * begin) <= radius * radius)) continue;
      const double exit = -capsule_entry(a, ab, u * -1.0, radius);
      if (!(std::isfinite(exit) && exit > until)) continue;
      until = std::min(end, exit);
      last = &strut;
    }
    return last;
  }

  /// The distance from an axis is convex along the ray. Where it grows faster than the radius can,
  /// the ray leaves the strut once.
  bool follow_out(const NearEdge& strut, double end, double& until) const {
    const double unit = foam_.unit();
    const Segment axis(start_of(strut), end_of(strut));
    const Vec3 away = axis.way_to(foam_ray_.direction * until);
    const double rise = dot(away, foam_ray_.direction) / length(away);
    const Box3 box = box_of(ray_, from_ + until * unit, from_ + end * unit);
    if (!(rise > foam_.radius().lipschitz(box))) return false;
    const auto is_out = [&](double t) {
      const double radius =
          foam_.radius().at(ray_.at(from_ + t * unit)) / unit - 2 * foam_ray_.error;
      return !(axis.distance_squared(foam_ray_.direction * t) <= radius * radius);
    };
    if (is_out(until)) return false;
    until =
        is_out(end)
            ? std::max(until, bisect(until, end, foam_ray_.tolerance, is_out) - foam_ray_.tolerance)
            : end;
    return until < end;
  }

  const FoamData& foam_;
  const Ray& ray_;
  const double from_, to_;
  const RaySearch search_{ray_, from_, from_ + to_* foam_.unit()};
  const FoamRay foam_ray_;
  const double most_;  // the radius where the ray starts
  const NearStruts struts_;
};

}  // namespace

double strut_exit(const FoamData& foam, const Ray& ray, double from, double to) {
  return std::min(to, from + Exit(foam, ray, from, to).find() * foam.unit());
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
  const NearStruts struts(foam, p, radius + ahead);
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
