// SPDX-License-Identifier: Apache-2.0
// Struts and walls, or plates, on one grid: the union of both.
#pragma once

#include <algorithm>

#include "structure/structure.h"

namespace msq {

class WalledStruts : public Structure {
 public:
  bool inside(Vec3 p) const final { return walls_->inside(p) || struts_->inside(p); }
  CellIndex cell_of(Vec3 p) const final { return struts_->cell_of(p); }
  void for_each_grid(const TakeGrid& take) const final { struts_->for_each_grid(take); }
  bool is_concurrent() const final { return walls_->is_concurrent() && struts_->is_concurrent(); }
  /// Exact outside where those of both are.
  double distance_bound(Vec3 p) const final;
  bool has_steady_distance() const final {
    return walls_->has_steady_distance() && struts_->has_steady_distance();
  }
  bool is_periodic() const final { return walls_->is_periodic() && struts_->is_periodic(); }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const final;
  bool gains_by_groups() const final { return struts_->gains_by_groups(); }
  uint64_t critical_count() const final { return struts_->critical_count(); }
  bool gains_by_layers() const final { return true; }
  unsigned row_copies() const final {
    return 1 + std::max(walls_->row_copies(), struts_->row_copies());
  }
  void keep_rows(const RowBlock& block, const Job* job) const final;
  double min_ray_step() const final {
    return std::max(walls_->min_ray_step(), struts_->min_ray_step());
  }

  std::unique_ptr<StrutParts> struts(const StrutSelection& selection) const final;
  void enter(RaySearch* searches, size_t count, const Job* job) const final;
  double leave(const Ray& ray, double from, double to, const Job* job) const final;
  Vec3 normal(const Ray& ray, double t) const final;

  ThinWalls thin_walls() const final { return walls_->thin_walls(); }
  LineGraph wall_lines(const WallSection& section) const final {
    return walls_->wall_lines(section);
  }

 protected:
  WalledStruts(Ref<const Structure> struts, Ref<const Structure> walls)
      : Structure(struts->neighbourhood(), struts->characteristic_length()),
        struts_(std::move(struts)),
        walls_(std::move(walls)) {}

  const Structure& strut_part() const { return *struts_; }
  const Structure& wall_part() const { return *walls_; }

 private:
  const Ref<const Structure> struts_, walls_;
};

}  // namespace msq
