// SPDX-License-Identifier: Apache-2.0
// One beam and the points in it: the definition of the solid of beams.
//
// Source: 3MF Consortium, "Beam Lattice Extension", version 1.2.0, section 2.1.1.1. A beam is a
// conical frustum about the segment from a to b; its radius is linear from one end to the other. An
// end is flat (butt), or closed by the half ball of its radius beyond the end's plane (hemisphere),
// or by the whole ball (sphere). If both radii are equal, the last two are the same. Otherwise the
// ball of the thicker end extends out of the frustum; that region is part of the beam.
//
// A beam of length 0 has no axis: its round ends are whole balls, its flat ends are empty. So a
// ball is a beam of length 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/vec.h"

namespace msq {

enum class BeamCap : uint8_t { sphere = 0, hemisphere = 1, butt = 2 };

struct Beam {
  Vec3 a, b;
  double radius_a, radius_b;
  BeamCap cap_a, cap_b;

  /// Shorter axes count as length 0.
  static constexpr double min_length = 1e-100;

  bool has_length() const {
    const Vec3 ab = b - a;
    return is_length(dot(ab, ab));
  }
  /// Whether the beam contains more than points of its boundary.
  bool is_solid() const {
    return has_length() || (cap_a != BeamCap::butt && radius_a > 0) ||
           (cap_b != BeamCap::butt && radius_b > 0);
  }
  /// Whether it is the points within radius_a of the segment.
  bool is_capsule() const {
    return radius_a == radius_b && cap_a != BeamCap::butt && cap_b != BeamCap::butt;
  }

  /// Membership; the boundary is inside. These expressions are the definition.
  bool holds(Vec3 p) const { return holds_at_a(p) || holds_at_b(p) || holds_between(p); }
  /// Membership in one of the three convex parts whose union is the beam: the frustum, and the ball
  /// or half ball at either end.
  bool holds_between(Vec3 p) const {
    const Vec3 ab = b - a, from_a = p - a;
    const double squared = dot(ab, ab), along = dot(from_a, ab);
    if (!is_length(squared) || along < 0 || along > squared) return false;
    const double t = along / squared, r = radius_a * (1 - t) + radius_b * t;
    const Vec3 away = from_a - ab * t;
    return dot(away, away) <= r * r;
  }
  bool holds_at_a(Vec3 p) const {
    const Vec3 ab = b - a, from_a = p - a;
    const bool is_beyond = !is_length(dot(ab, ab)) || dot(from_a, ab) < 0;
    return has_ball(cap_a, is_beyond) && dot(from_a, from_a) <= radius_a * radius_a;
  }
  bool holds_at_b(Vec3 p) const {
    const Vec3 ab = b - a, from_b = p - b;
    const double squared = dot(ab, ab);
    const bool is_beyond = !is_length(squared) || dot(p - a, ab) > squared;
    return has_ball(cap_b, is_beyond) && dot(from_b, from_b) <= radius_b * radius_b;
  }

  /// Bound on the displacement of the boundary of holds() by rounding. The error of positions and
  /// their products is a few dozen units of 2^-53 of the lengths about the beam.
  double rounding() const {
    return 0x1p-45 * (max_magnitude(b - a) + std::max(radius_a, radius_b));
  }
  /// Contains all points for which holds() is true.
  Box3 box() const {
    const Vec3 by_a = Vec3{1, 1, 1} * radius_a, by_b = Vec3{1, 1, 1} * radius_b;
    return Box3{min(a - by_a, b - by_b), max(a + by_a, b + by_b)}.grown(rounding() +
                                                                        0x1p-50 * magnitude());
  }
  /// The maximum magnitude of the coordinates of its ends.
  double magnitude() const { return std::max(max_magnitude(a), max_magnitude(b)); }

 private:
  static bool is_length(double squared) { return squared >= min_length * min_length; }
  /// Whether the ball of an end is part of the beam on the given side of the end's plane.
  static bool has_ball(BeamCap cap, bool is_beyond) {
    return cap == BeamCap::sphere || (cap == BeamCap::hemisphere && is_beyond);
  }
};

}  // namespace msq
