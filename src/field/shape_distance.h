// SPDX-License-Identifier: Apache-2.0
// The signed distance to a shape, a tree search a point; and samples of it, which cost little.
#pragma once

#include <memory>
#include <utility>

#include "base/parallel.h"
#include "field/field.h"
#include "shape/image.h"
#include "shape/shape.h"

namespace msq {

/// For curves over it: the range is not that of a parameter.
class ShapeDistanceField final : public Field {
 public:
  explicit ShapeDistanceField(Ref<const Shape> shape) : shape_(std::move(shape)) {}

  double at(Vec3 p) const override { return shape_->distance(p); }
  bool is_concurrent() const override { return shape_->is_concurrent(); }
  Interval range() const override;
  Interval range(const Box3& box) const override;
  double lipschitz() const override;

 private:
  Ref<const Shape> shape_;
};

/// Its distances at points `step` apart over bounds() and a step around them. Throws
/// Error(argument) for more samples along an axis than images have, Error(limit) where the budget
/// has no room.
Image sample_distance(const Shape& shape, double step, const Executor& executor,
                      const std::shared_ptr<MemoryBudget>& budget);

}  // namespace msq
