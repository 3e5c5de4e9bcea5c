// SPDX-License-Identifier: Apache-2.0
#include "structure/beams/beam_parts.h"

#include <utility>

#include "base/infinity.h"
#include "structure/beams/cone_interval.h"

namespace msq {

namespace {

/// Relative rounding of squared lengths: rays that miss by less count as hits.
constexpr double graze = 0x1p-45;

/// Cuts [enter, leave] to [from, to].
bool keep(double from, double to, double& enter, double& leave) {
  enter = std::max(enter, from);
  leave = std::min(leave, to);
  // Rounding may give a short part a negative length.
  return enter <= leave + graze * (std::abs(enter) + std::abs(leave));
}

bool meet_ball(Vec3 from_centre, Vec3 direction, double radius, double& enter, double& leave) {
  const double middle = -dot(from_centre, direction);
  const Vec3 nearest = from_centre + direction * middle;
  const double under = radius * radius - dot(nearest, nearest);
  if (under < -graze * (radius * radius + dot(from_centre, from_centre))) return false;
  const double half = std::sqrt(std::max(0.0, under));
  enter = middle - half;
  leave = middle + half;
  return true;
}

/// The part in which low <= at + t * slope <= high.
bool keep_slab(double at, double slope, double low, double high, double rounding, double& enter,
               double& leave) {
  if (slope == 0) return at >= low - rounding && at <= high + rounding;
  double from = (low - at) / slope, to = (high - at) / slope;
  if (from > to) std::swap(from, to);
  return keep(from, to, enter, leave);
}

}  // namespace

bool BeamPart::meet(const Ray& ray, double& enter, double& leave) const {
  // Relative to the ray's point nearest to the middle of the beam.
  const Vec3 middle = beam.a + (beam.b - beam.a) * 0.5;
  const double start = dot(middle - ray.origin, ray.direction);
  const Vec3 p = ray.at(start), d = ray.direction, ab = beam.b - beam.a;
  const double length = beam.has_length() ? msq::length(ab) : 0;
  const Vec3 axis = length > 0 ? ab * (1 / length) : Vec3{};
  const double along = dot(d, axis);
  const double rounding = graze * (length + beam.radius_a + beam.radius_b);

  enter = -infinity;
  leave = infinity;
  if (kind != between) {
    const Vec3 from_end = p - (kind == at_a ? beam.a : beam.b);
    const double radius = kind == at_a ? beam.radius_a : beam.radius_b;
    if (!meet_ball(from_end, d, radius, enter, leave)) return false;
    const double out = kind == at_a ? -1 : 1;  // along the axis
    if ((kind == at_a ? beam.cap_a : beam.cap_b) == BeamCap::hemisphere && length > 0 &&
        !keep_slab(out * dot(from_end, axis), out * along, 0, infinity, rounding, enter, leave))
      return false;
  } else {
    const Vec3 from_a = p - beam.a;
    const double z = dot(from_a, axis), slope = (beam.radius_b - beam.radius_a) / length;
    if (!keep_slab(z, along, 0, length, rounding, enter, leave)) return false;
    // Across the axis the ray is at `across` + t * `moves`, where the frustum's radius is r + t *
    // grows. It is inside where a t^2 + 2 b t + c <= 0 and the radius is not negative.
    const Vec3 across = from_a - axis * z, moves = d - axis * along;
    const double r = beam.radius_a + slope * z, grows = slope * along;
    const double a = dot(moves, moves) - grows * grows;
    const double b = dot(across, moves) - grows * r, c = dot(across, across) - r * r;
    const double size = dot(across, across) + r * r + rounding * length;
    const double grazes = a > 0 ? graze * (b * b + a * size) : 0;
    if (!cut_to_cone(a, b, a > 0 || grows != 0 ? c : c - graze * size, grows, grazes, enter,
                     leave) ||
        !keep(enter, leave, enter, leave))
      return false;
  }
  enter += start;
  leave += start;
  return true;
}

BeamPart::Face BeamPart::face_at(Vec3 p) const {
  const Vec3 ab = beam.b - beam.a;
  const double length = beam.has_length() ? msq::length(ab) : 0;
  const Vec3 axis = length > 0 ? ab * (1 / length) : Vec3{};
  const auto unit = [](Vec3 v, double size) { return size > 0 ? v * (1 / size) : Vec3{}; };
  if (kind != between) {
    const Vec3 out = p - (kind == at_a ? beam.a : beam.b);
    const double away = msq::length(out);
    const Face round{away - (kind == at_a ? beam.radius_a : beam.radius_b), unit(out, away)};
    const double before = kind == at_a ? dot(out, axis) : -dot(out, axis);
    const bool is_half =
        (kind == at_a ? beam.cap_a : beam.cap_b) == BeamCap::hemisphere && length > 0;
    return is_half && before > round.above ? Face{before, {}} : round;
  }
  const Vec3 from_a = p - beam.a;
  const double z = dot(from_a, axis), slope = (beam.radius_b - beam.radius_a) / length;
  const Vec3 across = from_a - axis * z;
  const double away = msq::length(across), per_unit = 1 / std::sqrt(1 + slope * slope);
  Face face{(away - beam.radius_a - slope * z) * per_unit, {}};
  if (away > 0) face.normal = (across * (1 / away) - axis * slope) * per_unit;
  if (-z > face.above) face = {-z, axis * -1.0};
  if (z - length > face.above) face = {z - length, axis};
  return face;
}

}  // namespace msq
