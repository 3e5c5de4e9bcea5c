// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/strut_exit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/borrowed.h"
#include "structure/common/leave_strut.h"
#include "structure/foam/point/graded_point.h"
#include "structure/foam/rays/near_edges.h"
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
        most_(radii(0, 0).high) {
    find_axes();
  }

  /// How far struts that hold the ray hold it.
  double find() {
    double until = 0;
    if (foam_.radius().is_constant()) {
      follow(0, to_, until);
      return until;
    }
    follow_pieces(to_, 2 * most_, foam_ray_.tolerance, until, [&](double end) {
      const Segment* const axis = follow(until, end, until);
      return axis && until < end && follow_out(*axis, end, until);
    });
    return until;
  }

 private:
  /// Of the piece, less room().
  Interval radii(double begin, double end) const {
    const double unit = foam_.unit();
    const Interval range =
        foam_.radius().is_constant()
            ? Interval{foam_.radius().at({}), foam_.radius().at({})}
            : foam_.radius().range(box_of(ray_, from_ + begin * unit, from_ + end * unit));
    return {std::max(0.0, range.low / unit - room()), std::max(0.0, range.high / unit - room())};
  }
  /// For the rounding of points.
  double room() const { return 2 * foam_ray_.error; }

  /// The parts of edges that are near the start.
  void find_axes() {
    const Vec3 p = ray_.at(from_);
    axes_->clear();
    if (!foam_.graded()) {
      const NearEdges edges(foam_, p, 2 * most_);
      for (const NearEdge& edge : edges)
        axes_->emplace_back(edge.line.at(edge.part.low) - edges.q,
                            edge.line.at(edge.part.high) - edges.q);
      return;
    }
    const Borrowed<std::vector<NearGradedEdge>> edges;
    const Neighbourhood::Located located = foam_.neighbourhood().locate(p);
    const Vec3 q = located.fraction * foam_.seeds().scale();
    find_graded_edges_near(foam_.graded(), located.cell, q, 2 * most_, *edges);
    for (const NearGradedEdge& edge : *edges)
      axes_->emplace_back(edge.ends[0] - q, edge.ends[1] - q);
  }

  /// Moves `until` as far as a strut of the piece's minimum radius holds the ray, which is in it at
  /// `begin`. Returns the strut's axis, or null.
  const Segment* follow(double begin, double end, double& until) const {
    const double radius = radii(begin, end).low;
    const Vec3 u = foam_ray_.direction;
    const Segment* last = nullptr;
    for (const Segment& axis : *axes_) {
      if (!(axis.distance_squared(u * begin) <= radius * radius)) continue;
      const double exit = -capsule_entry(axis.a, axis.ab, u * -1.0, radius);
      if (!(std::isfinite(exit) && exit > until)) continue;
      until = std::min(end, exit);
      last = &axis;
    }
    return last;
  }

  bool follow_out(const Segment& axis, double end, double& until) const {
    const double unit = foam_.unit();
    const Vec3 u = foam_ray_.direction;
    const auto is_out = [&](double t) {
      const double radius = foam_.radius().at(ray_.at(from_ + t * unit)) / unit - room();
      return !(radius > 0 && axis.distance_squared(u * t) <= radius * radius);
    };
    const Box3 box = box_of(ray_, from_ + until * unit, from_ + end * unit);
    return msq::follow_out(axis.way_to(u * until), u, foam_.radius().lipschitz(box), end,
                           foam_ray_.tolerance, is_out, until);
  }

  const FoamData& foam_;
  const Ray& ray_;
  const double from_, to_;
  const RaySearch search_{ray_, from_, from_ + to_* foam_.unit()};
  const FoamRay foam_ray_;
  const double most_;                          // the radius where the ray starts
  const Borrowed<std::vector<Segment>> axes_;  // from the start
};

}  // namespace

double strut_exit(const FoamData& foam, const Ray& ray, double from, double to) {
  return std::min(to, from + Exit(foam, ray, from, to).find() * foam.unit());
}

}  // namespace msq
