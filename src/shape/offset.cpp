// SPDX-License-Identifier: Apache-2.0
#include "shape/offset.h"

#include <limits>

#include "base/hash_input.h"
#include "base/status.h"
#include "shape/row_boxes.h"

namespace msq {

OffsetShape::OffsetShape(Ref<const Shape> original, double offset)
    : original_(std::move(original)), offset_(offset) {
  const Box3& box = original_->bounds();
  const double size = max_component(box.extent());
  error_ =
      original_->depth_error() * (2 + std::max(0.0, offset) / size) + 0x1p-46 * std::abs(offset);
  facts_.bounds = box.grown(offset + error_);
  for (int axis = 0; axis < 3; ++axis)
    if (!(facts_.bounds.min[axis] <= facts_.bounds.max[axis]))
      fail(Status::argument,
           "an offset of %g leaves nothing of a shape that is %g wide along axis %d", offset,
           box.extent()[axis], axis);
  facts_.volume = facts_.area = std::numeric_limits<double>::quiet_NaN();
  min_tolerance_ = std::max(original_->ray_tolerance(), 8 * error_);
}

// The distance to the original changes by no more than its points do, so this far no point's
// passes the offset. Exact on the side away from the original's surface: there the nearest point
// lies on the way to that of the original.
double OffsetShape::distance_bound(Vec3 p) const {
  const double distance = original_->distance(p);
  const double error = error_ * (1 + std::abs(distance) / max_component(bounds().extent()));
  const double bound = std::abs(distance - offset_) * (1 - 0x1p-44) - 2 * error;
  const Vec3 gap = max(max(bounds().min - p, p - bounds().max), Vec3{});
  return std::clamp(bound, std::hypot(gap.x, gap.y, gap.z) * (1 - 0x1p-50),
                    std::numeric_limits<double>::max());
}

// The gradient of the distance.
Vec3 OffsetShape::normal(const Ray& ray, double t) const {
  const Vec3 p = ray.at(t);
  const double step = std::max(0x1p-16 * max_component(bounds().extent()), ray_tolerance());
  Vec3 up;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 by;
    by[axis] = step;
    up[axis] = original_->distance(p + by) - original_->distance(p - by);
  }
  const double size = length(up);
  return size > step && dot(up, ray.direction) < 0 ? up * (1 / size) : Shape::normal(ray, t);
}

void OffsetShape::fill_rows(const RowBlock& block) const {
  RowBoxes::fill(*this, block);
}

void OffsetShape::describe(HashInput& input) const {
  input.kind("shape: offset");
  input.object(*original_);
  input.number(offset_);
}

}  // namespace msq
