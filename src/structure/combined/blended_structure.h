// SPDX-License-Identifier: Apache-2.0
// A structure that becomes another one: the solid holds the points p with
// (1 - f) a + f b <= 0, where a and b are the signed distances (Structure::distance()) from p to
// two structures, and f, from 0 to 1, is the fraction at p.
//
// Both terms have the sign of their structure's membership: where both agree, so does the blend.
// Where f is 0 or 1 it is one of the two. So distances are evaluated only at points that one of
// them holds and the other does not, and only where f is in between.
#pragma once

#include "field/field.h"
#include "structure/combined/steady_pair.h"

namespace msq {

class BlendedStructure final : public SteadyPair {
 public:
  /// Both have a steady distance; the range of the fraction is within 0 and 1.
  BlendedStructure(const Ref<const Structure>& a, const Ref<const Structure>& b, Parameter fraction)
      : SteadyPair(a, b), fraction_(std::move(fraction)) {}

  bool inside(Vec3 p) const override;
  bool is_concurrent() const override {
    return CombinedStructure::is_concurrent() && fraction_.is_concurrent();
  }
  /// Let v be the blended value at p, m = |b - a| there, and L the Lipschitz constant of f. Within
  /// a distance d, a and b change by at most d, and |b - a| is at most m + 2 d. So v changes by at
  /// most d (1 + L (m + 2 d)), which is less than |v| for d below the root of that quadratic. This
  /// root is the bound. It changes by at most the points' distance (Lipschitz constant 1): with s
  /// the way between two points, |v| shrinks by at most s (1 + L m) + L s^2 and m grows by at most
  /// 2 s, so d - s still fits. Where a and b agree in sign, the smaller of them is a bound too.
  double distance_bound(Vec3 p) const override;
  Answer ask(Vec3 p) const override;
  double distance_at_once(Vec3 p) const override;
  bool has_steady_distance() const override { return fraction_.lipschitz() < max_lipschitz; }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  BoxClass classify(const Box3& box) const override;
  void keep_rows(const RowBlock& block, const Job* job) const override;
  unsigned row_copies() const override { return 1 + SteadyPair::row_copies(); }
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;

 private:
  static constexpr double max_lipschitz = std::numeric_limits<double>::max();

  /// Signed distances from a point.
  struct Pair {
    double a, b;
    double blended(double f) const { return (1 - f) * a + f * b; }
  };

  void describe(HashInput& input) const override;
  /// The distances at p, where the members were evaluated, if they have values.
  Pair distances(Vec3 p, const std::optional<Answer>& of_a = {},
                 const std::optional<Answer>& of_b = {}) const {
    return {distance_of_member(0, of_a, p), distance_of_member(1, of_b, p)};
  }
  /// Membership, by the fraction f.
  static bool holds(const Pair& pair, double f) {
    const bool in_a = pair.a <= 0, in_b = pair.b <= 0;
    if (f <= 0) return in_a;
    return f >= 1 || in_a == in_b ? in_b : pair.blended(f) <= 0;
  }
  /// Sets values[i] to the fraction at points[i] where alive[i]; the others are undefined.
  void values_at_living(const Vec3* points, const uint8_t* alive, size_t count,
                        double* values) const;
  double bound_of(const Pair& pair, double f, Vec3 p) const;
  /// A distance from p within which the value stays above 0 or below.
  double steady_distance_of(double gap, double apart, Vec3 p) const;
  /// The samples of a word of a row that one structure holds and the blend does, too.
  uint64_t decide(const SampleGrid& grid, uint64_t w, uint64_t j, uint64_t k, uint64_t in_a,
                  uint64_t in_b, const Job* job) const;

  Parameter fraction_;
};

}  // namespace msq
