// SPDX-License-Identifier: Apache-2.0
// A foam in warped cells: what of a foam is in the shell that the cells fill. The foam goes on
// beyond the shell (seeds/warp_seeds.h, sampled_seeds.h), so all searches in it are those of any
// foam.
#pragma once

#include <memory>

#include "structure/common/cell_shell.h"
#include "structure/structure.h"

namespace msq {

class ShelledFoam final : public Structure {
 public:
  /// `foam`: of struts, of walls or of both, whose seeds are those of the map.
  ShelledFoam(Ref<const Structure> foam, std::shared_ptr<const CellShell> shell);

  bool inside(Vec3 p) const override { return shell_->holds(p) && foam_->inside(p); }
  CellIndex cell_of(Vec3 p) const override { return foam_->cell_of(p); }
  void for_each_grid(const TakeGrid& take) const override { foam_->for_each_grid(take); }
  bool is_concurrent() const override { return foam_->is_concurrent(); }
  /// A lower bound, that of the foam or of the shell.
  double distance_bound(Vec3 p) const override;
  bool has_steady_distance() const override { return foam_->has_steady_distance(); }
  bool has_onset() const override { return foam_->has_onset(); }
  double onset(Vec3 p) const override;
  double parameter(Vec3 p) const override { return foam_->parameter(p); }
  double onset_limit() const override { return foam_->onset_limit(); }
  bool is_alike_from_origin() const override { return false; }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  bool gains_by_groups() const override { return foam_->gains_by_groups(); }
  uint64_t critical_count() const override { return foam_->critical_count(); }
  BoxClass classify(const Box3& box) const override;
  bool knows_boxes() const override { return foam_->knows_boxes(); }
  bool gains_by_layers() const override { return foam_->gains_by_layers(); }
  unsigned row_copies() const override { return foam_->row_copies(); }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  double min_ray_step() const override { return foam_->min_ray_step(); }

  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;

  /// Those that have a point in the shell, whole.
  std::unique_ptr<StrutParts> struts(const StrutSelection& selection) const override;
  /// Cells vary in size.
  ThinWalls thin_walls() const override;
  /// Those of the foam, as far as the shell.
  LineGraph wall_lines(const WallSection& section) const override;

 private:
  void describe(HashInput& input) const override;

  const Ref<const Structure> foam_;
  const std::shared_ptr<const CellShell> shell_;
};

}  // namespace msq
