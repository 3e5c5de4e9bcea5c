// SPDX-License-Identifier: Apache-2.0
#include "structure/common/warp_shell.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "base/unit.h"

namespace msq {

namespace {

/// A ray as the radius sees it: nearest to the axis, or to the point, at `middle`, at the distance
/// `near`.
struct Passage {
  double speed, middle, near;

  Passage(const Warp& warp, const Ray& ray) {
    Vec3 at = warp.grid().to_grid(ray.origin);
    Vec3 way = warp.grid().rotation.apply_inverse(ray.direction);
    if (warp.kind() == Warp::Kind::cylindrical) at.z = way.z = 0;
    speed = length(way);
    middle = speed > 0 ? -dot(at, way) / (speed * speed) : 0;
    near = length(at + way * middle);
  }
  /// How far from the middle the ray is at a radius; below 0 if it never is.
  double half(double radius) const {
    if (radius < near) return -1.0;
    return speed > 0 ? std::sqrt((radius - near) * (radius + near)) / speed : infinity;
  }
};

}  // namespace

double WarpShell::distance_within(Vec3 p) const {
  const double r = warp_.radius(p), inner = warp_.shell().inner;
  return std::min(inner > 0 ? r - inner : infinity, warp_.outer() - r);
}

BoxClass WarpShell::classify(const Box3& box) const {
  const Interval radius = warp_.image(box).radius;
  if (radius.high < warp_.shell().inner || radius.low > warp_.outer()) return BoxClass::outside;
  return warp_.is_in_shell(radius.low) && warp_.is_in_shell(radius.high) ? BoxClass::inside
                                                                         : BoxClass::mixed;
}

RayParts WarpShell::parts_of(const Ray& ray, double from, double to, double tolerance) const {
  const Passage passage(warp_, ray);
  const double middle = passage.middle, out = passage.half(warp_.outer()),
               in = warp_.shell().inner > 0 ? passage.half(warp_.shell().inner) : -1;
  RayParts parts;
  if (out < 0 || from > to) return parts;
  const auto add = [&](double first, double last) {
    add_part(parts, first, last, from, to, tolerance, [&](double t) { return holds(ray.at(t)); });
  };
  if (in > 0) {
    add(middle - out, middle - in);
    add(middle + in, middle + out);
  } else {
    add(middle - out, middle + out);
  }
  return parts;
}

Vec3 WarpShell::normal(Vec3 p) const {
  Vec3 g = warp_.grid().to_grid(p);
  if (warp_.kind() == Warp::Kind::cylindrical) g.z = 0;
  const double r = length(g);
  const bool is_inner = r - warp_.shell().inner < warp_.outer() - r;
  return warp_.grid().rotation.apply(unit_along(g) * (is_inner ? -1.0 : 1.0));
}

// The radius is continuous along a line, so it takes all values between its least and greatest.
bool WarpShell::meets(Vec3 a, Vec3 b) const {
  a = warp_.grid().to_grid(a);
  b = warp_.grid().to_grid(b);
  if (warp_.kind() == Warp::Kind::cylindrical) a.z = b.z = 0;
  const double most = std::max(length(a), length(b));
  const Vec3 way = b - a;
  const double squared = dot(way, way);
  const double t = squared > 0 ? std::clamp(-dot(a, way) / squared, 0.0, 1.0) : 0;
  return most >= warp_.shell().inner && length(a + way * t) <= warp_.outer();
}

// A sample is decided by where it is in the row, except those whose radius is one of the shell's up
// to rounding.
void WarpShell::keep_row(Row& row) const {
  const SampleGrid& grid = row.grid();
  const Vec3 start = row.start();
  const Passage passage(warp_, {start, {1, 0, 0}});
  constexpr double steep = 1e-3;
  // Of radii, with what the nearest point is off where the row is steep.
  const double slack = 0x1p4 * warp_.slack(start, 2 * row.extent());
  if (passage.speed > 0 && passage.speed < steep) return row.decide(0, grid.nx);
  // [first, last) of the samples within a radius that surely are, or may be.
  struct Range {
    uint64_t first, last;
  };
  const auto within = [&](double radius) -> Range {
    const double half = passage.half(radius);
    if (half < 0) return {0, 0};
    if (half == infinity) return {0, grid.nx};
    const double at = start.x + passage.middle;
    const Range range{grid.first_x_from(at - half), grid.first_x_from<true>(at + half)};
    return range.first < range.last ? range : Range{0, 0};
  };
  const double inner = warp_.shell().inner, outer = warp_.outer();
  // Outwards: what is beyond the greater range is outside, what is in the smaller one inside.
  const auto keep = [&](double radius, bool keeps_within) {
    const Range sure = within(radius - slack), may = within(radius + slack);
    const bool has_sure = sure.first < sure.last;
    if (keeps_within) {
      row.clear(0, may.first);
      row.clear(may.last, grid.nx);
    } else if (has_sure) {
      row.clear(sure.first, sure.last);
    }
    if (!has_sure) return row.decide(may.first, may.last);
    row.decide(may.first, sure.first);
    row.decide(sure.last, may.last);
  };
  if (outer < infinity) keep(outer, true);
  if (inner > 0) keep(inner, false);
}

}  // namespace msq
