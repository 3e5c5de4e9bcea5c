// SPDX-License-Identifier: Apache-2.0
// Cells of a closed mesh's bounding box that no triangle comes near: membership is the same all
// over such a cell. Most short rays within a part lie in them.
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
#include "base/triangle_soup.h"

namespace msq {

class DecidedCells {
 public:
  enum class Side : uint8_t { unknown, inside, outside };

  /// inside(p): the definition. Throws Error(cancelled) if the job, which may be null, is
  /// cancelled. All is unknown in a mesh whose triangles reach through too many cells, and where
  /// the budget has no room.
  DecidedCells(const TriangleSoup& soup, const Box3& bounds,
               const std::function<bool(Vec3)>& inside, const std::shared_ptr<MemoryBudget>& budget,
               const Job* job);

  /// Of all points of a segment in the bounding box. Unknown for segments of more than two cells
  /// along an axis.
  Side side(Vec3 a, Vec3 b) const;

 private:
  void mark(const TriangleSoup& soup, const Triangle& triangle, uint64_t& work);
  uint32_t cell(double v, int axis) const {
    const double c = (v - origin_[axis]) * scale_[axis];
    return c <= 0 ? 0 : c >= count_[axis] ? count_[axis] - 1 : static_cast<uint32_t>(c);
  }
  size_t at(uint32_t i, uint32_t j, uint32_t k) const {
    return (size_t{k} * count_[1] + j) * count_[0] + i;
  }

  Vec3 origin_, scale_, size_;
  double margin_ = 0;
  uint32_t count_[3] = {1, 1, 1};
  std::vector<Side> sides_;
  Reservation reservation_;
};

}  // namespace msq
