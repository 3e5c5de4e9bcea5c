// SPDX-License-Identifier: Apache-2.0
// Whether what is said of a ray agrees with membership at points along it.
#pragma once

#include "base/ray.h"
#include "msq_test.h"

namespace msq::test {

struct RayWalk {
  double tolerance;  ///< of the solid
  int samples;       ///< along the ray
};

/// Follows a ray from part to part by enter(ray, from, to, t) and leave(ray, from, to), and
/// compares with inside(p): no sample before an entry is inside, entries are where membership
/// changes, and all samples up to leave() are inside. Answers how many entries there were.
template <class Inside, class Enter, class Leave>
int check_ray(const char* name, const Ray& ray, double from, double to, const RayWalk& walk,
              Inside&& inside, Enter&& enter, Leave&& leave) {
  const double tolerance = walk.tolerance, step = (to - from) / walk.samples;
  const auto fail_at = [&](const char* what, double t) {
    fail_msg("%s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g), t = %.17g: %s", name,
             ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
             ray.direction.z, t, what);
  };
  // A sample that lies in a part of less than twice the tolerance may be overlooked.
  const auto holds = [&](double t, bool wanted) {
    return inside(ray.at(t)) == wanted && inside(ray.at(t - tolerance)) == wanted &&
           inside(ray.at(t + tolerance)) == wanted;
  };
  // Along the surface rounding decides, as where the winding number is 1/2 all along the ray.
  const auto is_noise = [&](double t) {
    int changes = 0;
    for (int n = -64; n < 64; ++n)
      changes += inside(ray.at(t + n * tolerance)) != inside(ray.at(t + (n + 1) * tolerance));
    return changes >= 4;
  };
  int entries = 0;
  double at = from;
  PartSteps steps;
  while (at < to) {
    double t = to;
    const bool found = enter(ray, at, to, t);
    if (found && (t < at || t > to)) fail_at("the entry is out of range", t);
    const double end = found ? t : to;
    for (double s = std::ceil((at - from) / step) * step + from; s < end - tolerance; s += step)
      if (s >= at && holds(s, true)) fail_at("a point before the entry is inside", s);
    if (!found) break;
    if (!inside(ray.at(t)) && !inside(ray.at(t + tolerance))) fail_at("the entry is outside", t);
    if (t > at + 2 * tolerance) {
      ++entries;
      if (inside(ray.at(t - 2 * tolerance)) && inside(ray.at(t - tolerance)) && !is_noise(t))
        fail_at("before the entry it is inside", t);
    }
    const double out = leave(ray, t, to);
    if (!(out >= t) || out > to + tolerance) fail_at("it leaves out of range", out);
    for (double s = std::ceil((t - from) / step) * step + from; s < out - tolerance; s += step)
      if (s > t + tolerance && holds(s, false)) fail_at("a point before it leaves is outside", s);
    at = std::max(out, t);
    at += steps.behind(at, tolerance, 0x1p18 * tolerance);
  }
  return entries;
}

}  // namespace msq::test
