// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/strut_entry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "structure/foam/edge_line.h"
#include "strut/segment.h"

namespace msq {

namespace {

/// Squared sine of the angle below which a ray never leaves the distance that it has from a line:
/// far below what rounding makes of a direction, but in rays that are exactly along one.
constexpr double parallel_squared = 1e-60;

double square(double x) {
  return x * x;
}

Vec3 corner_of(CellIndex cell, Vec3 scale) {
  return Vec3{double(cell.x), double(cell.y), double(cell.z)} * scale;
}

}  // namespace

double capsule_entry(Vec3 a, Vec3 ab, Vec3 u, double radius) {
  const double z0 = dot(a, u), dz = dot(ab, u);
  const Vec3 p = a - u * z0, q = ab - u * dz;
  const double qq = dot(q, q), length_squared = dot(ab, ab);
  double s = dz > 0 ? 0 : 1;  // along the axis
  if (qq > 1e-24) {
    const double s0 = -dot(p, q) / qq;
    const Vec3 across = p + q * s0;
    const double room = radius * radius - dot(across, across);
    if (room < 0) return std::numeric_limits<double>::infinity();
    s = std::clamp(s0 - dz * std::sqrt(room / (qq * length_squared)), 0.0, 1.0);
  }
  const Vec3 v = p + q * s;
  const double under = radius * radius - dot(v, v);
  if (under < 0) return std::numeric_limits<double>::infinity();
  return z0 + s * dz - std::sqrt(under);
}

bool comes_before(const StrutEntry& entry, const StrutEntry& other) {
  if (!entry.is_met || !other.is_met) return entry.is_met;
  const auto rank = [](const StrutEntry& e) {
    return std::make_tuple(e.t, !e.at_from, e.by_ends, e.normal.x, e.normal.y, e.normal.z);
  };
  return rank(entry) < rank(other);
}

StrutEntries::StrutEntries(const Foam& foam)
    : foam_(foam),
      radius_(foam.most_radius()),
      inverse_radius_(1 / radius_),
      tolerance_(foam.ray_tolerance() / foam.unit()) {}

bool StrutEntries::inside(const FoamRay& ray, double t) const {
  return foam_.inside(ray.model_point(t, foam_.unit()));
}

StrutEntry StrutEntries::settle(const FoamRay& ray, double before, double beyond) const {
  const double step = 0.5 * tolerance_;
  double low = std::floor(before / step), high = std::ceil(beyond / step);
  while (high - low > 1) {
    const double middle = std::floor(0.5 * (low + high));
    if (!(middle > low && middle < high)) break;
    (inside(ray, middle * step) ? high : low) = middle;
  }
  StrutEntry entry;
  entry.is_met = true;
  entry.t = std::max(ray.from, high * step);
  return entry;
}

StrutEntry StrutEntries::graze(const FoamRay& ray, const StrutLine& strut, double middle,
                               double half) const {
  // The part of the ray that is between the ends.
  double before = middle - half, after = middle + half;
  const double low = std::min(0.0, strut.length) - end_error,
               high = std::max(0.0, strut.length) + end_error;
  const double at = dot(ray.at(middle) - strut.corner - strut.a, strut.along);
  const double by = dot(ray.direction, strut.along);
  StrutEntry entry;
  if (std::abs(by) * half > end_error) {
    const double one = middle + (low - at) / by, other = middle + (high - at) / by;
    before = std::max(before, std::min(one, other));
    after = std::min(after, std::max(one, other));
  } else if (at < low || at > high) {
    return entry;
  }
  before = std::max(before, ray.from);
  after = std::min(after, ray.to);
  if (before > after) return entry;
  const double deepest = std::clamp(middle, before, after);
  if (!inside(ray, before)) return inside(ray, deepest) ? settle(ray, before, deepest) : entry;
  // If not at the ray's beginning, then another strut holds it, and has an entry before.
  entry.is_met = entry.at_from = before == ray.from;
  entry.t = ray.from;
  return entry;
}

StrutEntry StrutEntries::find_by_ends(const FoamRay& ray, const StrutLine& strut) const {
  const Vec3 o = ray.origin - strut.corner;
  const double about = dot(strut.a - o, ray.direction);
  const Vec3 a = strut.a - (o + ray.direction * about);
  const double first = about + capsule_entry(a, strut.ab, ray.direction, radius_ + end_error);
  const double last = about + capsule_entry(a, strut.ab, ray.direction, radius_ - end_error);
  StrutEntry entry;
  if (!(first <= ray.to)) return entry;
  const double before = std::max(ray.from, first - end_error);
  if (inside(ray, before)) {
    entry.is_met = entry.at_from = before == ray.from;
    entry.t = ray.from;
    return entry;
  }
  if (last < ray.to && last >= ray.from && inside(ray, last)) return settle(ray, before, last);
  // A graze, or a ray that begins by the surface: steps from there to where it has left the strut.
  const double exit =
      about - capsule_entry(a, strut.ab, ray.direction * -1.0, radius_ + end_error) + end_error;
  // First where it is deepest in the strut, which those may miss where it begins after the first.
  const double deepest = 0.5 * (first - end_error + exit);
  if (deepest > before && deepest < ray.to && inside(ray, deepest))
    return settle(ray, before, deepest);
  constexpr int steps = 8;
  for (int n = 1; n <= steps; ++n) {
    const double t = before + (std::min(exit, ray.to) - before) * n / steps;
    if (t > before && inside(ray, t)) return settle(ray, before, t);
  }
  return entry;
}

FoamRay StrutEntries::ray(const RaySearch& search) const {
  const Neighbourhood& grid = foam_.neighbourhood();
  const double to_foam = 1 / foam_.unit();
  FoamRay ray{grid.to_grid(search.ray.origin) * to_foam,
              grid.rotation.apply_inverse(search.ray.direction),
              search.from * to_foam,
              search.to * to_foam,
              0,
              &search};
  ray.most = std::max(max_magnitude(ray.at(ray.from)), max_magnitude(ray.at(ray.to)));
  return ray;
}

StrutLine StrutEntries::line(const std::array<CellIndex, 3>& cells) const {
  const FoamSeeds& seeds = foam_.seeds();
  const CellIndex home = cells[0];
  const auto seed = [&](size_t i) {
    return seeds.at(home, cells[i].x - home.x, cells[i].y - home.y, cells[i].z - home.z);
  };
  StrutLine strut;
  strut.line = EdgeLine(seed(0), seed(1), seed(2));
  strut.has_line = strut.line.exists();
  // The line's offset and direction come from products of seeds' differences u and v, and are off
  // by 2^-52 |u| |v| (|u| + |v| + 4) over the triangle's size, |direction|; products above 2^5
  // leave that size above 1 or the seeds' circle so wide that it is no empty ball's.
  const double inverse_size = std::sqrt(strut.line.inverse_squared);
  strut.home = corner_of(home, seeds.scale());
  strut.along = strut.line.direction * inverse_size;
  strut.error = 0x1p-47 * inverse_size;
  return strut;
}

StrutLine StrutEntries::line(const SeededEdges& brick, size_t edge) const {
  StrutLine strut;
  if (brick.knows_seeds(edge)) strut = line(brick.seeds(edge));
  set_ends(brick.end(edge, 0), brick.end(edge, 1), brick.corner(), strut);
  return strut;
}

void StrutEntries::set_ends(const std::array<float, 3>& a, const std::array<float, 3>& b,
                            CellIndex corner, StrutLine& strut) const {
  strut.corner = corner_of(corner, foam_.seeds().scale());
  strut.a = {a[0], a[1], a[2]};
  strut.ab = Vec3{b[0], b[1], b[2]} - strut.a;
  if (!strut.has_line) {
    const double size = length(strut.ab);
    strut.along = size > 0 ? strut.ab * (1 / size) : Vec3{};
  }
  strut.length = dot(strut.ab, strut.along);
}

StrutEntry StrutEntries::find(const FoamRay& ray, const StrutLine& strut) const {
  if (!foam_.has_capsules()) return find_tapered(ray, strut);
  if (!strut.has_line) {
    StrutEntry entry = find_by_ends(ray, strut);
    entry.by_ends = true;
    return entry;
  }
  const EdgeLine& line = strut.line;
  // From where the ray comes nearest to the middle of the owner's cell, which is near the line.
  const Vec3 o = ray.origin - strut.home, u = ray.direction;
  const double t0 = dot(foam_.seeds().scale() * 0.5 - o, u);
  const Vec3 w = o + u * t0 - line.seed - line.offset;
  const Vec3 p = w - strut.along * dot(w, strut.along);
  const Vec3 q = u - strut.along * dot(u, strut.along);
  const double qq = dot(q, q), pq = dot(p, q);
  const double under = pq * pq - qq * (dot(p, p) - radius_ * radius_);
  // Coordinates of points are known to a few units of 2^-53 of themselves, here and in membership.
  const double error = 0x1p-51 * (8 + ray.most) + strut.error;
  StrutEntry entry;
  double in = -std::numeric_limits<double>::infinity(), out = -in;
  if (qq < parallel_squared) {
    // Where rounding leaves a doubt, membership settles it where the ray begins.
    if (length(p) > radius_ + error) return entry;
  } else {
    if (under < -8 * radius_ * error * qq) return entry;
    const double inverse = 1 / qq, middle = t0 - pq * inverse;
    if (under <= 0 || error * radius_ > 0.25 * tolerance_ * std::sqrt(under)) {
      const double half = std::sqrt(std::max(under, 0.0) + 8 * radius_ * error * qq) * inverse;
      return graze(ray, strut, middle, half + tolerance_);
    }
    const double half = std::sqrt(under) * inverse;
    in = middle - half;
    out = middle + half;
  }
  if (out < ray.from || in > ray.to) return entry;

  // How far beyond an end, along the line.
  const auto beyond_ends = [&](double t) {
    const double s = dot(ray.at(t) - strut.corner - strut.a, strut.along);
    return std::max(std::min(0.0, strut.length) - s, s - std::max(0.0, strut.length));
  };
  if (in > ray.from) {
    const double beyond = beyond_ends(in);
    if (beyond > end_error) return entry;
    if (beyond > -end_error && !inside(ray, in) && !inside(ray, in + tolerance_)) return entry;
    entry.is_met = true;
    entry.t = in;
    entry.normal = foam_.neighbourhood().rotation.apply((p + q * (in - t0)) * inverse_radius_);
    return entry;
  }
  entry.t = ray.from;
  // The ball about an end is solid, too, whichever struts hold it.
  const Vec3 begin = ray.at(ray.from) - strut.corner;
  const bool is_sure = Segment(strut.a, strut.a + strut.ab).distance_squared(begin) <
                       square(std::max(0.0, radius_ - end_error));
  if (!is_sure && beyond_ends(ray.from) > end_error) return entry;
  if (is_sure || inside(ray, ray.from)) {
    entry.is_met = entry.at_from = true;
  } else if (ray.from + tolerance_ < out && inside(ray, ray.from + tolerance_)) {
    entry.is_met = true;
    entry.t = ray.from + tolerance_;
  }
  return entry;
}

}  // namespace msq
