// SPDX-License-Identifier: Apache-2.0
// Smooth union, intersection and difference of two structures, by the quadratic smooth minimum
// (Quilez, "Smooth minimum", 2013). With the signed distances (Structure::distance()) u and v to
// the two, and k the radius at the point,
//
//   s = min(u, v) - h^2 / (4 k),   h = max(0, k - |u - v|),
//
// and the union holds the points with s <= 0. The intersection is the complement of the union of
// the complements: u and v are the negative distances, and the points with s >= 0 are inside. The
// difference is the intersection with the complement of the second.
//
// s is at most min(u, v), so where that is negative the plain boolean decides. Where u and v are at
// least 0, say u <= v, s <= 0 is h^2 >= 4 k u, that is sqrt(u) + sqrt(v) <= sqrt(k). So nothing
// changes farther than k from either surface. Fillets are parabolas that touch both surfaces.
#pragma once

#include "field/field.h"
#include "structure/combined/boolean_structure.h"
#include "structure/combined/steady_pair.h"

namespace msq {

class SmoothBoolean final : public SteadyPair {
 public:
  using Operation = BooleanStructure::Operation;

  /// Both have a steady distance; the range of the radius is finite and not negative.
  SmoothBoolean(Operation operation, const Ref<const Structure>& a, const Ref<const Structure>& b,
                Parameter radius);

  bool inside(Vec3 p) const override;
  bool is_concurrent() const override {
    return CombinedStructure::is_concurrent() && radius_.is_concurrent();
  }
  /// The derivatives of s by u and v are not negative and have the sum 1; that by k is from -1/4 to
  /// 0. So s changes by at most 1 + L / 4 times a step, L being the Lipschitz constant of k. Where
  /// min(u, v) is negative, its magnitude is a bound, too: all that the plain boolean decides so
  /// stays.
  double distance_bound(Vec3 p) const override;
  Answer ask(Vec3 p) const override;
  double distance_at_once(Vec3 p) const override;
  bool has_steady_distance() const override { return radius_.lipschitz() < max_lipschitz; }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  BoxClass classify(const Box3& box) const override;
  void keep_rows(const RowBlock& block, const Job* job) const override;
  unsigned row_copies() const override { return (is_union() ? 1u : 0u) + plain_->row_copies(); }
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;

  ThinWalls thin_walls() const override;
  /// member_lines.h; fillets are ignored, as thickness is.
  LineGraph wall_lines(const WallSection& section) const override;

 private:
  static constexpr double max_lipschitz = std::numeric_limits<double>::max();

  /// u and v.
  struct Pair {
    double u, v;
    double least() const { return std::min(u, v); }
    double smooth(double k) const;
  };
  /// What is known of all points of a box at which the plain boolean does not decide.
  enum class Fillets { unknown, none, all };
  /// Rows in the process of keep_rows().
  class Rows;

  void describe(HashInput& input) const override;
  bool is_union() const { return operation_ == Operation::united; }
  /// Whether u or v is the negative distance. Where the plain boolean does not decide, this is also
  /// the membership in that member.
  bool is_turned(size_t member) const {
    return operation_ == Operation::intersected ||
           (operation_ == Operation::subtracted && member == 0);
  }
  double oriented(size_t member, double distance) const {
    return is_turned(member) ? 0.0 - distance : distance;
  }
  /// u and v at p, where the members were evaluated, if they have values.
  Pair pair(Vec3 p, const std::optional<Answer>& of_a = {},
            const std::optional<Answer>& of_b = {}) const {
    return {oriented(0, distance_of_member(0, of_a, p)),
            oriented(1, distance_of_member(1, of_b, p))};
  }
  /// Membership, by the radius k.
  bool holds(const Pair& pair, double k) const;
  /// Whether p is in a fillet, if the plain boolean does not decide there.
  bool is_in_fillet(Vec3 p) const { return is_in_fillet(p, {is_turned(0)}, {is_turned(1)}); }
  bool is_in_fillet(Vec3 p, const Answer& of_a, const Answer& of_b) const;
  /// Whether a value of s is that of a point which the plain boolean does not hold, in a union, or
  /// of one that it does.
  bool is_fillet(double s) const { return is_union() ? s <= 0 : s < 0; }
  /// Of a box with all of its points within `reach` of `middle`.
  Fillets fillets_of(const Box3& box, Vec3 middle, double reach) const;
  double bound_of(const Pair& pair, Vec3 p) const;

  Operation operation_;
  Parameter radius_;
  Ref<const BooleanStructure> plain_;
};

}  // namespace msq
