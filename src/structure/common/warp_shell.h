// SPDX-License-Identifier: Apache-2.0
// The shell that warped cells fill, between the radii of the warp.
#pragma once

#include "cell/warp.h"
#include "structure/common/cell_shell.h"

namespace msq {

class WarpShell final : public CellShell {
 public:
  explicit WarpShell(const Warp& warp) : warp_(warp) {}

  bool holds(Vec3 p) const override { return warp_.is_in_shell(warp_.radius(p)); }
  double distance_within(Vec3 p) const override;
  double slack(Vec3 p, double distance) const override { return warp_.slack(p, distance); }
  BoxClass classify(const Box3& box) const override;
  RayParts parts_of(const Ray& ray, double from, double to, double tolerance) const override;
  Vec3 normal(Vec3 p) const override;
  bool meets(Vec3 a, Vec3 b) const override;
  void describe(HashInput& input) const override { warp_.describe(input); }

 private:
  void keep_row(Row& row) const override;

  Warp warp_;
};

}  // namespace msq
