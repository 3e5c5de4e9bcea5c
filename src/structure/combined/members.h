// SPDX-License-Identifier: Apache-2.0
// The structures that a structure is made of, and what follows from them alone.
#pragma once

#include <vector>

#include "base/borrowed.h"
#include "structure/structure.h"

namespace msq {

using StructureList = std::vector<Ref<const Structure>>;

/// A structure made of others, at least one. It has no grid of its own: hits name no cell.
class CombinedStructure : public Structure {
 public:
  void for_each_grid(const TakeGrid& take) const final;
  unsigned nesting() const final { return nesting_; }
  /// How many structures of other kinds it evaluates, the same one as often as it occurs.
  uint64_t terms() const { return terms_; }
  bool is_concurrent() const override { return is_concurrent_; }
  bool gains_by_groups() const final { return gains_by_groups_; }
  uint32_t group_parts() const final { return group_parts_; }
  bool gains_by_layers() const final { return gains_by_layers_; }
  bool knows_boxes() const override { return knows_boxes_; }
  bool has_steady_distance() const override { return has_steady_distance_; }
  double min_ray_step() const override { return min_ray_step_; }
  using Structure::ray_tolerance;
  /// The largest of the members'.
  double ray_tolerance(const Ray& ray, double to) const final;

 protected:
  explicit CombinedStructure(StructureList members);

  const StructureList& members() const { return members_; }
  /// The smallest side of a cell in the grids within.
  double smallest_cell() const { return smallest_cell_; }
  /// The distance from a point at which normals are sampled.
  double normal_distance_of_members() const { return 0x1p-12 * smallest_cell_; }

 private:
  StructureList members_;
  unsigned nesting_ = 0;
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

/// A copy of a block of rows, in memory of its own.
class RowCopy {
 public:
  explicit RowCopy(const RowBlock& original);

  const RowBlock& block() const { return block_; }

 private:
  const Borrowed<std::vector<uint64_t>> words_;
  RowBlock block_;
};

/// Calls change(a, b) for the words of two blocks of the same rows.
template <class Change>
void for_each_word(const RowBlock& one, const RowBlock& other, Change&& change) {
  const size_t words = one.row_words();
  for (uint64_t k = one.z0; k < one.z1; ++k)
    for (uint64_t j = one.y0; j < one.y1; ++j) {
      uint64_t *a = one.row(j, k), *b = other.row(j, k);
      for (size_t w = 0; w < words; ++w) change(a[w], b[w]);
    }
}

}  // namespace msq
