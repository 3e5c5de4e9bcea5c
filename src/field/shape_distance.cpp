// SPDX-License-Identifier: Apache-2.0
#include "field/shape_distance.h"

#include <limits>

#include "base/checked.h"
#include "base/run_parts.h"
#include "base/status.h"

namespace msq {

Interval ShapeDistanceField::range() const {
  // The distance of a point of a box from the outside is at most half the box's shortest side.
  const double deepest = min_component(shape_->bounds().extent()) * (0.5 + 0x1p-40);
  return {-deepest, std::numeric_limits<double>::max()};
}

Interval ShapeDistanceField::range(const Box3& box) const {
  const Interval all = range();
  if (!shape_->has_steady_distance()) return all;
  const Vec3 half = box.extent() * 0.5;
  const double middle = at((box.min + box.max) * 0.5);
  const double slack =
      0x1p-20 * length(shape_->bounds().extent()) +
      0x1p-40 * (std::abs(middle) + max_magnitude(box.min) + max_magnitude(box.max));
  const double reach = length(half) + slack;
  return {std::max(all.low, middle - reach), std::min(all.high, middle + reach)};
}

double ShapeDistanceField::lipschitz() const {
  return shape_->has_steady_distance() ? 1 : std::numeric_limits<double>::infinity();
}

Image sample_distance(const Shape& shape, double step, const Executor& executor,
                      const std::shared_ptr<MemoryBudget>& budget, Job* job) {
  // Below it floats lose digits, and then all.
  constexpr double min_step = std::numeric_limits<float>::min();
  if (!(step >= min_step))
    fail(Status::argument, "step is %g; it must be at least %g, as distances are kept as floats",
         step, min_step);
  const Box3& box = shape.bounds();
  const double farthest = length(box.extent()) + 4 * step;
  if (!(farthest <= std::numeric_limits<float>::max()))
    fail(Status::argument,
         "a step of %g about a shape %g long makes distances up to %g; the limit is %g", step,
         length(box.extent()), farthest, double{std::numeric_limits<float>::max()});
  Image::Source source{nullptr, Image::Type::float32, {}, 0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    const double samples = std::ceil(box.extent()[axis] / step) + 3;
    if (!(samples <= static_cast<double>(Image::max_size)))
      fail(Status::argument, "a step of %g makes %g samples along axis %d; the limit is %llu", step,
           samples, axis, static_cast<unsigned long long>(Image::max_size));
    source.size[axis] = static_cast<uint64_t>(samples);
  }
  const uint64_t layer = source.size[0] * source.size[1];
  const uint64_t count = checked_product(layer, source.size[2], "samples of a distance");
  const Reservation staging(budget, checked_product(count, sizeof(float), "samples of a distance"),
                            "samples of a distance");
  const auto values = std::make_unique_for_overwrite<float[]>(count);
  shape.prepare_distance(job);
  const ImageFrame frame{box.min - Vec3{step, step, step}, {step, step, step}, {}};
  const auto fill = [&](uint64_t k) {
    for (uint64_t at = 0; at < layer; ++at) {
      check_cancelled(job);  // distances computed by the host may take long
      const uint64_t i = at % source.size[0], j = at / source.size[0];
      const Vec3 index{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
      values[k * layer + at] = static_cast<float>(shape.distance(frame.origin + index * step));
    }
  };
  const Executor serial(1);
  run_parts(shape.is_concurrent() ? executor : serial, source.size[2], job, {0, 0.95}, fill);
  source.values = values.get();
  source.row_stride = source.size[0] * sizeof(float);
  source.layer_stride = layer * sizeof(float);
  return Image(source, frame, budget, job);
}

void ShapeDistanceField::describe(HashInput& input) const {
  input.kind("field: distance");
  input.object(*shape_);
}

}  // namespace msq
