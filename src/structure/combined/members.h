// SPDX-License-Identifier: Apache-2.0
// The structures that a structure is made of, and what follows from them alone.
#pragma once

#include <optional>
#include <vector>

#include "structure/common/row_copy.h"
#include "structure/structure.h"

namespace msq {

using StructureList = std::vector<Ref<const Structure>>;

/// A structure made of others, at least one. It has no grid of its own: hits name no cell.
class CombinedStructure : public Structure {
 public:
  void for_each_grid(const TakeGrid& take) const final;
  bool is_alike_from_origin() const final;
  unsigned nesting() const final { return nesting_; }
  /// How many structures of other kinds it evaluates, the same one as often as it occurs.
  uint64_t terms() const { return terms_; }
  /// How many structures within each other join signed distances (SteadyPair).
  virtual unsigned steady_pairs() const { return steady_pairs_; }
  bool is_concurrent() const override { return is_concurrent_; }
  bool gains_by_groups() const final { return gains_by_groups_; }
  uint32_t group_parts() const final { return group_parts_; }
  bool gains_by_layers() const final { return gains_by_layers_; }
  bool knows_boxes() const override { return knows_boxes_; }
  bool has_steady_distance() const override { return has_steady_distance_; }
  double min_ray_step() const override { return min_ray_step_; }
  /// The most of a member's. Kinds with copies of their own while a member's keep_rows() runs add
  /// these.
  unsigned row_copies() const override { return row_copies_; }

  /// Membership, and distance() if membership took distances of members.
  struct Answer {
    bool is_inside;
    std::optional<double> distance{};
  };
  /// inside() for a structure made of this one. If that needs the distance, too, it takes it from
  /// the answer or calls distance_bound(). So every member is evaluated at most twice for
  /// membership and once for its distance, however many structures are within each other.
  virtual Answer ask(Vec3 p) const = 0;
  /// distance(), with one evaluation of each member.
  virtual double distance_at_once(Vec3 p) const = 0;
  using Structure::ray_tolerance;
  /// The largest of the members'.
  double ray_tolerance(const Ray& ray, double to) const final;

 protected:
  explicit CombinedStructure(StructureList members);

  const StructureList& members() const { return members_; }
  Answer ask_member(size_t member, Vec3 p) const {
    const CombinedStructure* combined = combined_[member];
    return combined ? combined->ask(p) : Answer{members_[member]->inside(p)};
  }
  /// distance() of a member. It was evaluated at p if it has a value.
  double distance_of_member(size_t member, const std::optional<Answer>& answer, Vec3 p) const {
    if (answer && answer->distance) return *answer->distance;
    if (answer) return signed_distance(answer->is_inside, members_[member]->distance_bound(p));
    const CombinedStructure* combined = combined_[member];
    return combined ? combined->distance_at_once(p) : members_[member]->distance(p);
  }
  /// The smallest side of a cell in the grids within.
  double smallest_cell() const { return smallest_cell_; }
  /// The distance from a point at which normals are sampled.
  double normal_distance_of_members() const { return 0x1p-12 * smallest_cell_; }

 private:
  StructureList members_;
  std::vector<const CombinedStructure*> combined_;  // null for members of other kinds
  unsigned nesting_ = 0, steady_pairs_ = 0, row_copies_ = 0;
  uint64_t terms_ = 0;
  bool is_concurrent_ = true, gains_by_groups_ = false, gains_by_layers_ = false,
       knows_boxes_ = false, has_steady_distance_ = true;
  uint32_t group_parts_ = 1;
  double min_ray_step_ = 0, smallest_cell_;
};

/// As Structure::keep_points(), point by point where the structure is faster so.
void keep_points_of(const Structure& structure, const Vec3* points, uint8_t* alive, size_t count);

/// For each search, the first entry into any of the structures, as Structure::enter().
void enter_any(const StructureList& structures, RaySearch* searches, size_t count, const Job* job);

}  // namespace msq
