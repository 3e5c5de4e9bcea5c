// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/strut_exit.h"

#include <algorithm>
#include <cmath>

#include "structure/foam/rays/near_struts.h"
#include "structure/foam/rays/strut_entry.h"
#include "strut/segment.h"

namespace msq {

namespace {

/// Of a ray that starts in the foam. Ways along it are from there, in foam units.
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

}  // namespace msq
