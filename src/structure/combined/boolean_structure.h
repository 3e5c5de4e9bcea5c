// SPDX-License-Identifier: Apache-2.0
// Union, intersection and difference of structures: the memberships of the members, put together.
// Rows are the bits of the members' rows; distances are the smallest or the largest of theirs;
// along a ray membership changes only where that of a member does.
#pragma once

#include <utility>

#include "structure/combined/members.h"

namespace msq {

class BooleanStructure final : public CombinedStructure {
 public:
  /// Difference: the first member without the points of the others.
  enum class Operation { united = 1, intersected = 2, subtracted = 3 };

  BooleanStructure(Operation operation, StructureList members)
      : CombinedStructure(std::move(members)), operation_(operation) {}

  bool inside(Vec3 p) const override;
  /// A bound of a member's signed distance holds for the complement with the sign changed. Unions
  /// have the smallest signed distance, intersections and differences the largest: the solid does
  /// not change within it, and its Lipschitz constant is theirs. Exact outside unions if theirs
  /// are.
  double distance_bound(Vec3 p) const override;
  Answer ask(Vec3 p) const override;
  double distance_at_once(Vec3 p) const override;
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  /// Unions of structures whose parameter is the radius of struts. The onset is the least of
  /// theirs.
  bool has_onset() const override;
  double onset(Vec3 p) const override;
  /// The onset minus this is the least difference of a member's onset and parameter. As parameters
  /// may differ, that need not be the member whose onset is least. Minus infinity where a limit of
  /// onsets hides it.
  double parameter(Vec3 p) const override;
  double onset_limit() const override;
  /// Of unions whose members all have struts.
  std::unique_ptr<StrutParts> struts(const StrutSelection& selection) const override;
  BoxClass classify(const Box3& box) const override;
  void keep_rows(const RowBlock& block, const Job* job) const override;
  unsigned row_copies() const override;
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;

  ThinWalls thin_walls() const override;
  /// member_lines.h
  LineGraph wall_lines(const WallSection& section) const override;

 private:
  void describe(HashInput& input) const override;
  bool is_union() const { return operation_ == Operation::united; }
  /// Whether a point that a member holds can be inside.
  bool is_wanted(size_t member) const { return member == 0 || operation_ != Operation::subtracted; }
  /// Whether a member's membership decides that of a point.
  bool decides(size_t member, bool is_inside) const {
    return (is_inside == is_wanted(member)) == is_union();
  }
  /// distance_bound() and membership from the members' signed distances: of member i, distance(i).
  template <class Distance>
  std::pair<double, bool> combine(Distance&& distance) const;
  /// The first t in [from, to] at which the ray is inside.
  bool find_entry(const Ray& ray, double from, double to, double& t, const Job* job) const;
  double leave_union(const Ray& ray, double from, double to, const Job* job) const;

  Operation operation_;
};

}  // namespace msq
