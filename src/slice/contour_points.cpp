// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_points.h"

#include "query/array_points.h"
#include "query/membership.h"

namespace msq {

const std::vector<uint8_t>& ContourPoints::find_inside() {
  /// Fewer are not worth sorting by cell.
  constexpr size_t few = 256;
  inside_.resize(points_.size());
  if (points_.empty()) return inside_;
  check_cancelled(job_);
  // Neither the progress nor the counts of the call are those of one such question.
  Job part(job_);
  if (points_.size() < few) {
    ask_points(model_, resolved_, {}, points_.data(), inside_.data(), points_.size(), &part);
    return inside_;
  }
  PointArray array;
  array.data = reinterpret_cast<const unsigned char*>(points_.data());
  array.count = points_.size();
  array.stride = sizeof(Vec3);
  set_membership(model_, resolved_, ArrayPoints(array), {}, inside_.data(), &part);
  return inside_;
}

}  // namespace msq
