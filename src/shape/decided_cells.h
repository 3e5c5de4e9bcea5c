// SPDX-License-Identifier: Apache-2.0
// Cells of a closed mesh's bounding box that no triangle comes near: membership is the same all
// over such a cell. Each knows how many cells around it are on its side, so rays step through empty
// and full parts by many cells at a time.
//
// Membership is that of the winding number of the +x ray of a point. It changes only where the
// point is within rounding of a crossing, and crossings are within rounding of their triangles. The
// margin around cells is far larger.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/job.h"
#include "base/memory.h"
#include "base/ray.h"
#include "base/triangle_soup.h"

namespace msq {

class DecidedCells {
 public:
  enum class Side : uint8_t { unknown, inside, outside };

  /// inside(p): the definition. Throws Error(cancelled) if the job, which may be null, is
  /// cancelled. All is unknown in a mesh whose triangles reach through too many cells, and where
  /// the budget has no distance.
  DecidedCells(const TriangleSoup& soup, const Box3& bounds,
               const std::function<bool(Vec3)>& inside, const std::shared_ptr<MemoryBudget>& budget,
               const Job* job);

  /// Of a point in the bounding box.
  Side side(Vec3 p) const;

  /// Whether a ray is proved to be on one side from `from` to `to`. Both points are in the bounding
  /// box.
  bool is_on_one_side(const Ray& ray, double from, double to) const;

 private:
  /// 0: unknown. Otherwise all cells whose indices differ by less than the magnitude along each
  /// axis are on one side: inside (positive) or outside (negative).
  using Distance = int8_t;

  void mark(const TriangleSoup& soup, const Triangle& triangle, uint64_t& work);
  void decide(const std::function<bool(Vec3)>& inside, JobPoll& poll);
  void find_distances(JobPoll& poll);
  /// Whether all cells that the box of two points meets are on that side.
  bool is_box_on(Distance side, Vec3 a, Vec3 b) const;
  uint32_t cell(double v, int axis) const {
    const double c = (v - origin_[axis]) * scale_[axis];
    return c <= 0 ? 0 : c >= count_[axis] ? count_[axis] - 1 : static_cast<uint32_t>(c);
  }
  size_t at(size_t i, size_t j, size_t k) const { return (k * count_[1] + j) * count_[0] + i; }

  Vec3 origin_, scale_, size_;
  double margin_ = 0;
  uint32_t count_[3] = {1, 1, 1};
  /// Of rays' origins, in magnitude: rounding of their points, 2^-39 of the coordinates, is then
  /// below what steps leave, 2^-10 of a cell, which is above 2^-36 of them.
  double max_origin_ = 0;
  std::vector<Distance> distances_;
  Reservation reservation_;
};

}  // namespace msq
