// SPDX-License-Identifier: Apache-2.0
// The box that the cells of a sampled map fill: that of its samples.
#pragma once

#include <memory>

#include "cell/sampled_map.h"
#include "structure/common/cell_shell.h"

namespace msq {

class BoxShell final : public CellShell {
 public:
  explicit BoxShell(std::shared_ptr<const SampledMap> map)
      : map_(std::move(map)), frame_(map_->smallest()), size_(map_->box().max) {}

  bool holds(Vec3 p) const override { return map_->is_in_box(p); }
  double distance_within(Vec3 p) const override { return map_->distance_within(p); }
  double slack(Vec3 p, double distance) const override { return map_->slack(p, distance); }
  BoxClass classify(const Box3& box) const override;
  RayParts parts_of(const Ray& ray, double from, double to, double tolerance) const override;
  Vec3 normal(Vec3 p) const override;
  bool meets(Vec3 a, Vec3 b) const override;
  void describe(HashInput& input) const override { map_->describe(input); }

 private:
  /// Where a line is in the box made larger by that much: empty, low above high, if nowhere.
  Interval within(Vec3 at, Vec3 way, double more) const;
  void keep_row(Row& row) const override;

  const std::shared_ptr<const SampledMap> map_;
  const Neighbourhood frame_;  // whose origin is a corner of the box
  const Vec3 size_;
};

}  // namespace msq
