// SPDX-License-Identifier: Apache-2.0
// The shell that warped cells fill, between the radii of the warp, as a solid.
#pragma once

#include "base/ray.h"
#include "base/sample_grid.h"
#include "cell/warp.h"
#include "structure/common/kept_lines.h"
#include "structure/common/ray_parts.h"

namespace msq {

class WarpShell {
 public:
  explicit WarpShell(const Warp& warp) : warp_(warp) {}

  const Warp& warp() const { return warp_; }
  /// The definition.
  bool holds(Vec3 p) const { return warp_.is_in_shell(warp_.radius(p)); }
  /// The distance of a point in the shell from its boundary; of others, less than 0, that from the
  /// shell. Its error is below Warp::slack(); the boundary's is as large.
  double distance_within(Vec3 p) const;
  /// Of a line in a plane: whether a point of it stays.
  KeptPoint kept(Vec3 p) const;
  /// The parts of a ray, of those in [from, to], in the shell.
  RayParts parts_of(const Ray& ray, double from, double to, double tolerance) const;
  /// A t up to `to` up to which the ray stays in the shell, from the end of one of its parts on.
  double follow(const Ray& ray, double t, double to, double tolerance) const;
  /// At a point of the boundary, outwards.
  Vec3 normal(Vec3 p) const;
  /// Clears the bits of samples that are outside. Returns whether any is left.
  bool keep_rows(const RowBlock& block, const Job* job) const;

 private:
  bool keep_row(const SampleGrid& grid, uint64_t j, uint64_t k, uint64_t* row) const;

  Warp warp_;
};

}  // namespace msq
