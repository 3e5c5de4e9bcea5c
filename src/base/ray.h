// SPDX-License-Identifier: Apache-2.0
// Rays, and searches along them for the boundary of a solid.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/job.h"
#include "base/vec.h"

namespace msq {

/// The points origin + t * direction. The direction has length 1: t is a length.
struct Ray {
  Vec3 origin, direction;

  Vec3 at(double t) const { return origin + direction * t; }
  /// at(t), with each coordinate within about 2^-53 of its own magnitude, also after cancellation.
  Vec3 exactly_at(double t) const {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const double o = origin[axis], way = direction[axis] * t, sum = o + way;
      // Knuth's sum of two numbers, and the rounding error of the product.
      const double back = sum - o;
      const double lost = (o - (sum - back)) + (way - back);
      point[axis] = sum + (lost + std::fma(direction[axis], t, -way));
    }
    return point;
  }
};

/// The maximum magnitude of a coordinate, relative to a point, on a ray from its origin to `to`.
inline double max_coordinate(const Ray& ray, double to, Vec3 seen_from = {}) {
  return std::max(max_magnitude(ray.origin - seen_from), max_magnitude(ray.at(to) - seen_from));
}

/// The error of points of a ray whose coordinates are that large: two to four times the distance
/// between neighbouring numbers.
constexpr double coordinate_rounding(double max_coordinate) {
  return 0x1p-51 * max_coordinate;
}

/// A box around a part of a ray and around its rounded points.
inline Box3 box_of(const Ray& ray, double from, double to) {
  const Vec3 a = ray.at(from), b = ray.at(to);
  return Box3{min(a, b), max(a, b)}.grown(0x1p-50 * (max_magnitude(a) + max_magnitude(b)));
}

/// Clips [from, to] to the part in which a ray is in a box, widened by rounding. Returns false if
/// there is none, or if it begins beyond the range of numbers.
inline bool clip_to_box(const Ray& ray, const Box3& box, double& from, double& to) {
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (o < box.min[axis] || o > box.max[axis]) return false;
      continue;
    }
    double near = (box.min[axis] - o) / d, far = (box.max[axis] - o) / d;
    if (near > far) std::swap(near, far);
    from = std::max(from, near * (near > 0 ? 1 - 0x1p-50 : 1 + 0x1p-50));
    to = std::min(to, far * (far > 0 ? 1 + 0x1p-50 : 1 - 0x1p-50));
  }
  return from <= to && from < std::numeric_limits<double>::infinity();
}

/// The search for the first t in [from, to] at which a ray is inside a solid.
struct RaySearch {
  Ray ray;
  double from = 0, to = 0;
  bool found = false;
  double t = 0;  ///< if found
  /// Outward and of length 1 at t; unchanged, 0, if the caller is to compute it.
  Vec3 normal{};
};

/// Bisects between `before` and `beyond`, where is_beyond(t) is false and true. Returns a t on the
/// far side of a change, within `tolerance` of it.
template <class IsBeyond>
double bisect(double before, double beyond, double tolerance, IsBeyond&& is_beyond) {
  while (beyond - before > tolerance) {
    const double middle = 0.5 * (before + beyond);
    if (!(middle > before && middle < beyond)) break;  // halves vanish in rounding
    (is_beyond(middle) ? beyond : before) = middle;
  }
  return beyond;
}

/// Corrects a computed entry t by membership. Sets t to the first point at which the ray is inside,
/// near t, at most `tolerance` past the change, not before `from` and not past `to`. Returns false
/// if there is none (a graze caused by rounding). If a ray grazes a boundary, the error of t is
/// much larger than rounding; then a few steps of growing length search for the change.
template <class Inside>
bool settle_entry(const Ray& ray, double from, double to, double tolerance, Inside&& inside,
                  double& t) {
  if (!inside(ray.at(t))) {
    const double beyond = std::min(t + tolerance, to);
    if (!inside(ray.at(beyond))) return false;
    t = beyond;
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

/// The minimum step of a march along a ray. A march may creep: along a surface that it almost
/// touches, or where bounds of the distance are poor. If 64 steps advance by less than 2^30
/// tolerances, the minimum step doubles. So a ray takes at most some thousand steps for each 2^30
/// tolerances of its way.
class LeastStep {
 public:
  LeastStep() = default;
  LeastStep(double least, double tolerance, double from)
      : at_first_(least), least_(least), slow_(0x1p30 * tolerance), looked_at_(from) {}

  /// The minimum for the step that begins at t; called once per step.
  double of_step(double t) {
    constexpr int steps_at_once = 64;
    if (++steps_ % steps_at_once == 0) {
      check_cancelled();
      const bool is_slow = t - looked_at_ < slow_;
      creeps_ = creeps_ || is_slow;
      least_ = is_slow ? 2 * least_ : std::max(at_first_, 0.5 * least_);
      looked_at_ = t;
    }
    return least_;
  }
  /// Whether the ray ever crept. Then the march may have missed more.
  bool creeps() const { return creeps_; }

 private:
  double at_first_ = 0, least_ = 0, slow_ = 0, looked_at_ = 0;
  int steps_ = 0;
  bool creeps_ = false;
};

/// The distance behind a part of a solid along a ray at which the next part is searched.
///
/// A ray may run along a boundary where rounding decides, and meet a part at every other point. The
/// step doubles if 64 parts lead no farther than `slow`, or less than twice as far as the steps
/// behind them. A part that leads farther than `slow` resets it. So a ray meets at most
/// 64 (n + 1) (k + 2) parts, where n is its length over `slow` and k the number of doublings from
/// the first step to its length. If all is noise it meets 64 (k + 1).
class PartSteps {
 public:
  /// Behind a part that ends at t, at least `least`. Called once for each.
  double behind(double t, double least, double slow) {
    constexpr int parts_at_once = 64;
    if (t - last_ > slow) {
      factor_ = 1;
      parts_ = 0;
    }
    if (parts_++ % parts_at_once == 0) {
      if (parts_ > 1) {
        const bool is_slow = t - looked_at_ < std::max(slow, 2 * parts_at_once * least * factor_);
        factor_ = is_slow ? 2 * factor_ : std::max(1.0, 0.5 * factor_);
      }
      looked_at_ = t;
    }
    const double step = least * factor_;
    last_ = t + step;
    return step;
  }

 private:
  double factor_ = 1, looked_at_ = 0;
  double last_ = -std::numeric_limits<double>::infinity();
  int parts_ = 0;
};

/// A march along a ray: in steps of at least `min_step` (LeastStep) until membership changes,
/// then by bisection to within `tolerance`, or `settled` if that is smaller. The march may miss a
/// solid or a gap that lies within one step, if the step is longer than the lower bound on the
/// distance.
struct RayMarch {
  double min_step, tolerance;
  double settled = tolerance;

  /// Finds the first t in [from, to] where inside(p) is `wanted`, on the far side of the change.
  /// Returns false if there is none. distance_bound(p) is a lower bound on the distance to the
  /// boundary. Sets *creeps to true if the ray crept. Stops early, by Error(cancelled), with the
  /// job. Each step is positive or the last, so the march ends. Source: Hart, "Sphere tracing",
  /// 1996.
  template <class Inside, class DistanceBound>
  bool find(bool wanted, const Ray& ray, double from, double to, Inside&& inside,
            DistanceBound&& distance_bound, double& t, const Job* job,
            bool* creeps = nullptr) const {
    double at = from;
    JobPoll poll(job);
    LeastStep least(min_step, tolerance, from);
    if (inside(ray.at(at)) == wanted) {
      t = at;
      return true;
    }
    while (at < to) {
      poll();
      const double min_now = least.of_step(at);
      if (creeps && least.creeps()) *creeps = true;
      const double next = std::min(to, at + std::max(distance_bound(ray.at(at)), min_now));
      if (!(next > at)) return false;  // steps vanish in rounding
      if (inside(ray.at(next)) == wanted) {
        t = bisect(at, next, std::min(tolerance, settled),
                   [&](double middle) { return inside(ray.at(middle)) == wanted; });
        return true;
      }
      at = next;
    }
    return false;
  }
};

}  // namespace msq
