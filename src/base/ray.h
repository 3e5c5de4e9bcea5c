// SPDX-License-Identifier: Apache-2.0
// Rays, and what is asked of a solid along them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/vec.h"

namespace msq {

/// The points origin + t * direction. The direction has length 1: t is a length.
struct Ray {
  Vec3 origin, direction;

  Vec3 at(double t) const { return origin + direction * t; }
};

/// About a part of a ray, and about points of it that are rounded.
inline Box3 box_of(const Ray& ray, double from, double to) {
  const Vec3 a = ray.at(from), b = ray.at(to);
  return Box3{min(a, b), max(a, b)}.grown(0x1p-50 * (max_magnitude(a) + max_magnitude(b)));
}

/// The part of [from, to] in which a ray is in a box, wider by rounding; false if there is none.
inline bool clip_to_box(const Ray& ray, const Box3& box, double& from, double& to) {
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (o < box.min[axis] || o > box.max[axis]) return false;
      continue;
    }
    double near = (box.min[axis] - o) / d, far = (box.max[axis] - o) / d;
    if (near > far) std::swap(near, far);
    from = std::max(from, near - 0x1p-50 * std::abs(near));
    to = std::min(to, far + 0x1p-50 * std::abs(far));
  }
  return from <= to;
}

/// The search for the first t in [from, to] at which a ray is inside a solid.
struct RaySearch {
  Ray ray;
  double from = 0, to = 0;
  bool found = false;
  double t = 0;  ///< where found
  /// There, outward and of length 1; as it was, 0, where others are to find it.
  Vec3 normal{};
};

/// Where membership changes between `before` and `beyond`, as is_beyond(t) tells, which is false
/// and true there: on the far side of a change, within `tolerance` of it.
template <class IsBeyond>
double bisect(double before, double beyond, double tolerance, IsBeyond&& is_beyond) {
  while (beyond - before > tolerance) {
    const double middle = 0.5 * (before + beyond);
    if (!(middle > before && middle < beyond)) break;  // halves vanish in rounding
    (is_beyond(middle) ? beyond : before) = middle;
  }
  return beyond;
}

/// An entry that was computed as t, settled by membership: the first point at which the ray is
/// inside, within `tolerance` past it, about t and not before `from`; false where there is none
/// (a graze that rounding made up). Where a ray grazes a boundary, t is known far worse than to
/// rounding, and a few steps of growing length look for the change.
template <class Inside>
bool settle_entry(const Ray& ray, double from, double tolerance, Inside&& inside, double& t) {
  if (!inside(ray.at(t))) {
    if (!inside(ray.at(t + tolerance))) return false;
    t += tolerance;
    return true;
  }
  double within = t;
  for (double step = tolerance; within > from; step *= 2) {
    const double before = std::max(from, t - step);
    if (!inside(ray.at(before))) {
      within = bisect(before, within, tolerance, [&](double at) { return inside(ray.at(at)); });
      break;
    }
    within = before;
  }
  t = within;
  return true;
}

/// The least step of a march along a ray, which may creep: along a surface that it all but touches,
/// or where bounds of the distance are poor. Where 64 steps lead no farther than 2^30 tolerances,
/// the least step doubles, so that a ray takes some thousand steps at most for so much of its way
/// as 64 of those.
class LeastStep {
 public:
  LeastStep() = default;
  LeastStep(double least, double tolerance, double from)
      : at_first_(least), least_(least), slow_(0x1p30 * tolerance), looked_at_(from) {}

  /// Of the step that begins at t; called once for each.
  double of_step(double t) {
    constexpr int steps_at_once = 64;
    if (++steps_ % steps_at_once == 0) {
      const bool is_slow = t - looked_at_ < slow_;
      creeps_ = creeps_ || is_slow;
      least_ = is_slow ? 2 * least_ : std::max(at_first_, 0.5 * least_);
      looked_at_ = t;
    }
    return least_;
  }
  /// Whether the ray ever did, so that more may have been overlooked.
  bool creeps() const { return creeps_; }

 private:
  double at_first_ = 0, least_ = 0, slow_ = 0, looked_at_ = 0;
  int steps_ = 0;
  bool creeps_ = false;
};

/// A march along a ray: in steps of no less than `least_step` (LeastStep), until membership
/// changes, then by halves until it is known within `tolerance`. What changes and changes back
/// within a step that clearance does not vouch for may be overlooked.
struct RayMarch {
  double least_step, tolerance;

  /// The first t in [from, to] where inside(p) is `wanted`, found on the far side of the change;
  /// false if there is none. clearance(p) is a lower bound of the distance to the boundary.
  /// *creeps becomes true if the ray did.
  /// Source: Hart, "Sphere tracing", 1996.
  template <class Inside, class Clearance>
  bool find(bool wanted, const Ray& ray, double from, double to, Inside&& inside,
            Clearance&& clearance, double& t, bool* creeps = nullptr) const {
    double at = from;
    LeastStep least(least_step, tolerance, from);
    if (inside(ray.at(at)) == wanted) {
      t = at;
      return true;
    }
    while (at < to) {
      const double least_now = least.of_step(at);
      if (creeps && least.creeps()) *creeps = true;
      const double next = std::min(to, at + std::max(clearance(ray.at(at)), least_now));
      if (!(next > at)) return false;  // steps vanish in rounding
      if (inside(ray.at(next)) == wanted) {
        t = bisect(at, next, tolerance,
                   [&](double middle) { return inside(ray.at(middle)) == wanted; });
        return true;
      }
      at = next;
    }
    return false;
  }
};

}  // namespace msq
