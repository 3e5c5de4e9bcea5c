// SPDX-License-Identifier: Apache-2.0
// Sums of waves (wave_set.h): the solid is where the sum (network), or its magnitude (sheet), is at
// most the level.
#pragma once

#include "field/field.h"
#include "structure/structure.h"
#include "structure/waves/wave_set.h"

namespace msq {

enum class WavesKind : int32_t { network = 1, sheet = 2 };

class Waves final : public Structure {
 public:
  /// The cell sizes of the grid are the wavelengths along its axes.
  Waves(const Neighbourhood& grid, const WaveDirections& directions, WavesKind kind,
        Parameter level);

  bool inside(Vec3 p) const override { return onset(p) <= level_.at(p); }
  bool is_concurrent() const override { return level_.is_concurrent(); }
  /// The gap between onset and level is reduced along a way by at most the slope at p and a bound
  /// of the second derivatives of all waves together; a field of levels adds its Lipschitz
  /// constant. The distance at which the gap may be 0 is a lower bound.
  double distance_bound(Vec3 p) const override;
  bool has_steady_distance() const override {
    return level_.lipschitz() < std::numeric_limits<double>::infinity();
  }
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  double min_ray_step() const override { return ray_tolerance(); }
  bool gains_by_layers() const override { return true; }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  bool has_onset() const override { return true; }
  double onset(Vec3 p) const override;
  double parameter(Vec3 p) const override { return level_.at(p); }

  ThinWalls thin_walls() const override {
    return is_sheet() || level_.is_constant() ? ThinWalls::uniform : ThinWalls::varying;
  }
  /// Of sheets the lines where the sum is 0, of networks those where it is the level.
  LineGraph wall_lines(const WallSection& section) const override;

  const WaveSet& waves() const { return waves_; }
  const WaveDirections& directions() const { return directions_; }
  const Parameter& level() const { return level_; }
  bool is_sheet() const { return kind_ == WavesKind::sheet; }
  /// A position in cells, as the definition computes it.
  Vec3 position(Vec3 p) const {
    const Neighbourhood& grid = neighbourhood();
    const Vec3 q = grid.to_grid(p);
    return {q.x / grid.cell_size.x, q.y / grid.cell_size.y, q.z / grid.cell_size.z};
  }
  /// Bound on the difference between the sum as computed and that of exact arithmetic, at points
  /// with coordinates up to that magnitude; and on the error of other sums of the same waves that
  /// are computed in as many operations.
  double error(double magnitude) const;
  /// Bound on the change of the sum per unit length.
  double steepest() const { return steepest_; }

 private:
  void describe(HashInput& input) const override;

  WaveDirections directions_;
  WavesKind kind_;
  Parameter level_;
  WaveSet waves_;
  double cycles_ = 0;  // the largest sum of the magnitudes of a wave's components, per unit length
  double steepest_ = 0, bend_ = 0;  // bounds of the first and second derivatives
};

}  // namespace msq
