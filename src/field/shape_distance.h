// SPDX-License-Identifier: Apache-2.0
// The signed distance to a shape, one tree search per point; and samples of it, which are cheap to
// evaluate.
#pragma once

#include <memory>
#include <utility>

#include "base/parallel.h"
#include "field/field.h"
#include "shape/image.h"
#include "shape/shape.h"

namespace msq {

/// For curves over it: its range is not the range of a parameter.
class ShapeDistanceField final : public Field {
 public:
  explicit ShapeDistanceField(Ref<const Shape> shape) : shape_(std::move(shape)) {}

  double at(Vec3 p) const override { return shape_->distance(p); }
  bool is_concurrent() const override { return shape_->is_concurrent(); }
  Interval range() const override;
  Interval range(const Box3& box) const override;
  double lipschitz() const override;

 private:
  void describe(HashInput& input) const override;
  Ref<const Shape> shape_;
};

/// Its distances at points `step` apart, over bounds() and one step around them. Throws
/// Error(argument) if an axis needs more samples than images may have, Error(limit) if the budget
/// is exceeded, Error(cancelled) if the job, which may be null, is cancelled.
Image sample_distance(const Shape& shape, double step, const Executor& executor,
                      const std::shared_ptr<MemoryBudget>& budget, Job* job = nullptr);

}  // namespace msq
