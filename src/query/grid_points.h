// SPDX-License-Identifier: Apache-2.0
// A regular grid as a set of points: its parts are bricks of samples. Sample (i, j, k) has number
// i + nx (j + ny k).
#pragma once

#include "query/bricks.h"
#include "query/point_set.h"

namespace msq {

class GridPoints final : public PointSet {
 public:
  /// Requires evenly spaced layers.
  explicit GridPoints(const SampleGrid& grid);

  uint64_t count() const override { return grid_.nx * grid_.ny * grid_.nz; }
  void read(uint64_t first, uint64_t count, Vec3* out) const override;
  void gather(uint64_t first, std::span<const uint32_t> numbers, Vec3* out) const override;
  uint64_t parts() const override { return bricks_.count(); }
  void read_part(uint64_t index, Part& part) const override;
  bool is_compact() const override { return true; }
  bool find_bounds(Box3& box) const override {
    box = {grid_.at(0, 0, 0), grid_.at(grid_.nx - 1, grid_.ny - 1, grid_.nz - 1)};
    return true;
  }
  const SampleGrid* as_grid() const override { return &grid_; }

 private:
  Vec3 at(uint64_t number) const {
    return grid_.at(number % grid_.nx, number / grid_.nx % grid_.ny, number / grid_.nx / grid_.ny);
  }

  SampleGrid grid_;
  Bricks bricks_;
};

}  // namespace msq
