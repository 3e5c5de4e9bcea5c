// SPDX-License-Identifier: Apache-2.0
// A foam with struts and walls: the union of both.
#pragma once

#include "structure/foam/foam.h"
#include "structure/foam/walls/foam_walls.h"

namespace msq {

class WalledFoam final : public Structure {
 public:
  /// Both of the same seeds.
  WalledFoam(Ref<const Foam> struts, Ref<const FoamWalls> walls)
      : Structure(struts->neighbourhood()), struts_(std::move(struts)), walls_(std::move(walls)) {}

  bool inside(Vec3 p) const override { return walls_->inside(p) || struts_->inside(p); }
  bool is_concurrent() const override {
    return walls_->is_concurrent() && struts_->is_concurrent();
  }
  /// Exact in the voids where radius and thickness are constant.
  double distance_bound(Vec3 p) const override;
  bool has_steady_distance() const override {
    return walls_->has_steady_distance() && struts_->has_steady_distance();
  }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  bool gains_by_groups() const override { return true; }
  uint64_t critical_count() const override { return struts_->critical_count(); }
  bool gains_by_layers() const override { return true; }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  double min_ray_step() const override {
    return std::max(walls_->min_ray_step(), struts_->min_ray_step());
  }

  std::unique_ptr<StrutParts> struts(const StrutSelection& selection) const override;
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;

  ThinWalls thin_walls() const override { return walls_->thin_walls(); }
  LineGraph wall_lines(const WallSection& section) const override {
    return walls_->wall_lines(section);
  }

 private:
  void describe(HashInput& input) const override;
  const Ref<const Foam> struts_;
  const Ref<const FoamWalls> walls_;
};

}  // namespace msq
