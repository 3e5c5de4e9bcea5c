// SPDX-License-Identifier: Apache-2.0
// A beam is a solid of revolution. So the point of its boundary nearest to p lies in the half plane
// through its axis and p. In that half plane, with z along the axis from a and r across it, the
// frustum is a trapezium and the caps are discs.
#include "structure/beams/beam_distance.h"

#include "base/infinity.h"

namespace msq {

namespace {

/// p in the half plane.
struct Place {
  double length;  ///< of the axis; 0 if it is a point
  double z, r;
  double to_a, to_b;  ///< distances from the ends

  Place(const Beam& beam, Vec3 p) {
    const Vec3 ab = beam.b - beam.a, from_a = p - beam.a;
    to_a = msq::length(from_a);
    to_b = msq::length(p - beam.b);
    length = beam.has_length() ? msq::length(ab) : 0;
    z = length > 0 ? dot(from_a, ab) / length : 0;
    r = length > 0 ? msq::length(from_a - ab * (z / length)) : to_a;
  }

  /// Distance to the side of the frustum, the segment from (0, radius_a) to (length, radius_b).
  double to_side(const Beam& beam) const {
    const double rise = beam.radius_b - beam.radius_a, above = r - beam.radius_a;
    const double t = (z * length + above * rise) / (length * length + rise * rise);
    const double at = std::clamp(t, 0.0, 1.0);
    const double dz = z - at * length, dr = above - at * rise;
    return std::sqrt(dz * dz + dr * dr);
  }
  bool is_in_frustum(const Beam& beam) const {
    if (!(length > 0) || z < 0 || z > length) return false;
    const double t = z / length;
    return r <= beam.radius_a * (1 - t) + beam.radius_b * t;
  }
};

/// Rounding error of numbers about p and the beam, and of points as far from p as the result.
double rounding_at(const Beam& beam, Vec3 p, const Place& place) {
  return 0x1p-45 * (place.to_a + place.length + beam.radius_a + beam.radius_b) +
         0x1p-47 * max_magnitude(p);
}

}  // namespace

double distance_to_beam(const Beam& beam, Vec3 p) {
  const Place at(beam, p);
  if (at.is_in_frustum(beam)) return 0;
  double least = infinity;
  if (at.length > 0) {
    least = at.to_side(beam);
    if (at.z < 0 && at.r <= beam.radius_a) least = std::min(least, -at.z);
    if (at.z > at.length && at.r <= beam.radius_b) least = std::min(least, at.z - at.length);
  }
  // On the other side of its end's plane, a half ball is no nearer than the frustum.
  if (beam.cap_a == BeamCap::sphere || (beam.cap_a == BeamCap::hemisphere && at.z <= 0))
    least = std::min(least, at.to_a - beam.radius_a);
  if (beam.cap_b == BeamCap::sphere || (beam.cap_b == BeamCap::hemisphere && at.z >= at.length))
    least = std::min(least, at.to_b - beam.radius_b);
  return std::max(0.0, least - rounding_at(beam, p, at));
}

double depth_in_beam(const Beam& beam, Vec3 p) {
  const Place at(beam, p);
  double depth = 0;
  const auto is_round = [](BeamCap cap) { return cap != BeamCap::butt; };
  if (at.length > 0) {
    // For the beam with half balls: on an end's side of its plane the ball's surface bounds the
    // beam; on the other side it is no nearer than the frustum's side.
    const bool is_before = at.z<0, is_behind = at.z> at.length;
    const bool is_held = is_before   ? is_round(beam.cap_a) && at.to_a <= beam.radius_a
                         : is_behind ? is_round(beam.cap_b) && at.to_b <= beam.radius_b
                                     : at.is_in_frustum(beam);
    if (is_held) {
      depth = at.to_side(beam);
      if (!is_round(beam.cap_a)) depth = std::min(depth, at.z);
      if (!is_round(beam.cap_b)) depth = std::min(depth, at.length - at.z);
      if (is_before) depth = std::min(depth, beam.radius_a - at.to_a);
      if (is_behind) depth = std::min(depth, beam.radius_b - at.to_b);
    }
  }
  const auto is_whole = [&](BeamCap cap) {
    return cap == BeamCap::sphere || (cap == BeamCap::hemisphere && !(at.length > 0));
  };
  if (is_whole(beam.cap_a)) depth = std::max(depth, beam.radius_a - at.to_a);
  if (is_whole(beam.cap_b)) depth = std::max(depth, beam.radius_b - at.to_b);
  return std::max(0.0, depth - rounding_at(beam, p, at));
}

}  // namespace msq
