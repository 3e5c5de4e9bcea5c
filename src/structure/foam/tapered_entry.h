// SPDX-License-Identifier: Apache-2.0
// Where a ray comes within a radius that is a field of the line of an edge.
//
// With tau along the ray, the distance d(tau) from the line is known exactly, and convex. Of the
// radius r(tau) bounds are known: a slope, or ranges over boxes. Sphere tracing (Hart, "Sphere
// tracing", 1996) with all of d in place of its value: the ray cannot come within r before it does
// within r(a) + L (tau - a), a being where it is known to be outside and L the most that r may rise
// by; that is a cone about the line, and a quadratic equation. Where d falls faster than r may,
// there is one entry, and it is found by secants. For radii that are linear along the ray the first
// cone is the answer.
#pragma once

#include "structure/foam/strut_entry.h"

namespace msq {

/// A ray and a line, in foam units; t as along the FoamRay.
class TaperedStrut {
 public:
  TaperedStrut(const Foam& foam, const FoamRay& ray, const StrutLine& strut);

  /// Makes of [from, to] the part in which the foot on the line is no farther than `room` beyond
  /// the edge's ends; false if there is none.
  bool clip_to_ends(double room, double& from, double& to) const;
  /// The same for points within a radius of the line.
  bool clip_to_radius(double radius, double& from, double& to) const;
  /// How far the foot is beyond an end; negative between them.
  double beyond_ends(double t) const;

  /// Distance from the line less the radius there, and by how much that may be off. Where the line
  /// is known by its ends only the gap is less by their error, so that no strut is missed.
  double gap(double t) const { return distance(t) - radius(t); }
  double error() const { return error_; }

  /// Moves `at`, where the gap is above 0, to the first place up to `to` where it is not, within
  /// half the tolerance past it; parts that are shorter may be overlooked. False if there is none.
  bool approach(double& at, double to) const;
  /// The same where the gap is above 0 at `from` and not at `to`, and changes once.
  double narrow(double from, double to) const;

  /// The outward normal of the surface at t, in the model's frame, of length 1.
  Vec3 normal(double t) const;

 private:
  Vec3 across(double t) const { return p_ + q_ * (t - t0_); }
  double distance(double t) const { return length(across(t)); }
  double radius(double t) const;  // and room for the error of ends
  /// How fast the distance changes at t.
  double distance_slope(double t) const;
  double first_within_cone(double at, double radius, double slope) const;
  Box3 box(double from, double to) const;
  bool approach_by_slopes(double least_slope, double most_slope, double& at, double to) const;
  bool approach_by_ranges(double& at, double to) const;

  const Foam& foam_;
  const FoamRay& ray_;
  const StrutLine& strut_;
  double tolerance_;
  double t0_;   // next to a place near the line
  Vec3 p_, q_;  // across the line: from it to the ray at t0, and along the ray
  double error_;
};

}  // namespace msq
