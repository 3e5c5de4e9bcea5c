// SPDX-License-Identifier: Apache-2.0
// Union, intersection and difference of shapes: what their members answer, put together. Rows are
// the members' bits; distances are the least or greatest of theirs; along rays membership changes
// only where a member's does.
#pragma once

#include <vector>

#include "shape/shape.h"

namespace msq {

class BooleanShape final : public Shape {
 public:
  /// Difference: the first member without the points of the others.
  enum class Operation { united = 1, intersected = 2, subtracted = 3 };

  /// At least one member. Throws Error(argument) where members of an intersection have bounds that
  /// do not meet.
  BooleanShape(Operation operation, std::vector<Ref<const Shape>> members);

  bool inside(Vec3 p) const override;
  void find_inside(const Vec3* points, size_t count, uint8_t* inside) const override;
  bool is_concurrent() const override { return is_concurrent_; }
  bool has_steady_distance() const override { return is_steady_; }
  bool is_exact_outside() const override { return is_exact_outside_; }
  bool is_exact_inside() const override { return is_exact_inside_; }
  void prepare_distance(const Job* job) const override;
  void prepare_rows(const Job* job) const override;
  /// Intersections and differences know it if their members do; unions, if in addition no two
  /// members have bounds that meet.
  bool knows_depth() const override { return knows_depth_; }
  double depth(Vec3 p) const override;
  double depth(Vec3 p, double) const override { return depth(p); }
  double depth_error() const override;
  bool enter(const Ray& ray, double from, double to, double& t, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  void fill_rows(const RowBlock& block) const override;
  unsigned nesting() const override { return nesting_; }
  uint64_t terms() const override { return terms_; }

 protected:
  double distance_bound(Vec3 p) const override;

 private:
  void describe(HashInput& input) const override;
  /// Whether a point that a member holds can be inside.
  bool is_wanted(size_t member) const { return member == 0 || operation_ != Operation::subtracted; }
  /// Of a member, as the composition has it: that of a subtracted one is its complement's.
  double distance_of(size_t member, Vec3 p) const {
    const double distance = members_[member]->distance(p);
    return is_wanted(member) ? distance : 0.0 - distance;
  }
  void find_bounds();
  void find_exactness();
  bool find(bool wanted, const Ray& ray, double from, double to, double& t, const Job* job) const;

  Operation operation_;
  std::vector<Ref<const Shape>> members_;
  bool is_concurrent_ = true, is_steady_ = true, knows_depth_ = true;
  bool is_exact_outside_ = true, is_exact_inside_ = true;
  unsigned nesting_ = 0;
  uint64_t terms_ = 0;
};

}  // namespace msq
