// SPDX-License-Identifier: Apache-2.0
// Where a ray comes within a radius, which is a field, of the line of an edge.
//
// With tau along the ray, the distance d(tau) from the line is known exactly, and is convex. Of the
// radius r(tau), only bounds are known: a slope, or ranges over boxes. The method is sphere tracing
// (Hart, "Sphere tracing", 1996) with the function d in place of its value. Let a be a point where
// the ray is outside, and L the maximum slope of r. The ray cannot come within r before it comes
// within r(a) + L (tau - a). That is a cone around the line, and a quadratic equation. Where d
// falls faster than r may, there is one entry, and secants find it. For radii that are linear along
// the ray, the first cone gives the entry.
#pragma once

#include "structure/foam/rays/strut_entry.h"

namespace msq {

/// A ray and a line, in foam units; t as along the FoamRay.
class TaperedStrut {
 public:
  TaperedStrut(const FoamData& foam, const FoamRay& ray, const StrutLine& strut);

  /// Clips [from, to] to the part in which the foot on the line is at most `room` beyond the edge's
  /// ends; returns false if there is none.
  bool clip_to_ends(double room, double& from, double& to) const;
  /// The same for points within a radius of the line.
  bool clip_to_radius(double radius, double& from, double& to) const;
  /// Distance of the foot beyond an end; negative between the ends.
  double beyond_ends(double t) const;

  /// Distance from the line minus the radius there, and its maximum error. If only the ends of the
  /// line are known, the gap is reduced by their error, so that no strut is missed.
  double gap(double t) const { return distance(t) - radius(t); }
  double error() const { return error_; }

  /// Moves `at`, where the gap is above 0, to the first point up to `to` where it is not, at most
  /// half the tolerance past it. May miss shorter parts. Returns false if there is none.
  bool approach(double& at, double to) const;
  /// The same if the gap is above 0 at `from`, not above 0 at `to`, and changes sign once.
  double narrow(double from, double to) const;

  /// The outward normal of the surface at t, in the model's frame, of length 1.
  Vec3 normal(double t) const;

 private:
  Vec3 across(double t) const { return p_ + q_ * (t - t0_); }
  double distance(double t) const { return length(across(t)); }
  double radius(double t) const;  // including the error of ends
  /// Derivative of the distance at t.
  double distance_slope(double t) const;
  double first_within_cone(double at, double radius, double slope) const;
  Box3 box(double from, double to) const;
  bool approach_by_slopes(double min_slope, double max_slope, double& at, double to) const;
  bool approach_by_ranges(double& at, double to) const;

  const FoamData& foam_;
  const FoamRay& ray_;
  const StrutLine& strut_;
  double tolerance_;
  double t0_;   // near the point nearest to the line
  Vec3 p_, q_;  // across the line: from it to the ray at t0, and along the ray
  double error_;
};

}  // namespace msq
