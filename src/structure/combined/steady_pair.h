// SPDX-License-Identifier: Apache-2.0
// Two structures of steady distance (Structure::has_steady_distance()), and what the structures
// that their two signed distances define have in common.
#pragma once

#include "base/infinity.h"
#include "base/ray_normal.h"
#include "base/signed_distance.h"
#include "structure/combined/members.h"

namespace msq {

class SteadyPair : public CombinedStructure {
 public:
  double min_ray_step() const override {
    return std::max(CombinedStructure::min_ray_step(), smallest_cell() / 64);
  }
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  unsigned steady_pairs() const final { return 1 + CombinedStructure::steady_pairs(); }

 protected:
  SteadyPair(const Ref<const Structure>& a, const Ref<const Structure>& b);

  const Structure& a() const { return *members()[0]; }
  const Structure& b() const { return *members()[1]; }
  static bool has_distance(const std::optional<Answer>& answer) {
    return answer && answer->distance;
  }
  /// Bounds the errors of values at two points p and q together, if a value changes by at most as
  /// much as the larger change of the two signed distances, apart from rounding. `sum`: of the
  /// magnitudes of the numbers that the value at p is computed from.
  double slack(Vec3 p, double sum) const {
    return slack_ + 0x1p-40 * (max_magnitude(p) + farthest_origin_ + sum);
  }
  /// As march(), with smaller steps.
  bool march_finely(bool wanted, const Ray& ray, double from, double to, double& t,
                    const Job* job) const;
  /// The direction in which value(p) grows, where a ray enters at t; by membership if it has none
  /// against the ray.
  template <class Value>
  Vec3 normal_by_value(Value&& value, const Ray& ray, double t) const {
    const Vec3 p = ray.at(t);
    const double step = normal_distance_of_members();
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 before = p, beyond = p;
      before[axis] -= step;
      beyond[axis] += step;
      gradient[axis] = (value(beyond) - value(before)) / (beyond[axis] - before[axis]);
    }
    const double size = length(gradient);
    if (size > 0x1p-10 && std::isfinite(size) && dot(gradient, ray.direction) < 0)
      return gradient * (1 / size);
    return normal_by_membership([this](Vec3 q) { return inside(q); }, ray, t, step);
  }

 private:
  double slack_;            // by which values may be off, apart from coordinates
  double farthest_origin_;  // of the grids
};

}  // namespace msq
