// SPDX-License-Identifier: Apache-2.0
// Rows of a shape of which membership and a bound of the distance are known: boxes of samples that
// the distance of their middle proves to be all on one side are answered as a whole, others are
// halved until few samples are left, which are queried together.
#pragma once

#include "base/job.h"
#include "base/sample_grid.h"
#include "shape/asked_samples.h"
#include "shape/shape.h"

namespace msq {

class RowBoxes {
 public:
  /// Sets the bits of the samples that are inside, in a block of zeros.
  static void fill(const Shape& shape, const RowBlock& block) { RowBoxes(shape, block).fill_all(); }

 private:
  static constexpr uint64_t few = 16;

  struct Part {
    uint64_t low[3], high[3];  // samples, high excluded
    uint64_t count(int axis) const { return high[axis] - low[axis]; }
  };

  RowBoxes(const Shape& shape, const RowBlock& block)
      : shape_(shape), block_(block), grid_(*block.grid), asked_(block, shape) {}

  void fill_all() {
    const Box3& bounds = shape_.bounds();
    Part all;
    all.low[0] = grid_.first_x_from(bounds.min.x);
    all.high[0] = grid_.first_x_from<true>(bounds.max.x);
    all.low[1] = std::max(block_.y0, grid_.first_y_from(bounds.min.y));
    all.high[1] = std::min(block_.y1, grid_.first_y_from<true>(bounds.max.y));
    if (all.low[0] >= all.high[0] || all.low[1] >= all.high[1]) return;
    all.low[2] = block_.z0;
    all.high[2] = block_.z1;
    while (all.low[2] < all.high[2] && grid_.z(all.low[2]) < bounds.min.z) ++all.low[2];
    while (all.low[2] < all.high[2] && grid_.z(all.high[2] - 1) > bounds.max.z) --all.high[2];
    if (all.low[2] == all.high[2]) return;
    divide(all);
    asked_.ask();
  }

  void divide(const Part& part) {
    check_cancelled();
    const Vec3 low = grid_.at(part.low[0], part.low[1], part.low[2]);
    const Vec3 high = grid_.at(part.high[0] - 1, part.high[1] - 1, part.high[2] - 1);
    const Vec3 extent = high - low, middle = (low + high) * 0.5;
    // Of the ball about the middle that holds all samples.
    const double radius =
        (0.5 + 0x1p-40) * length(extent) + 0x1p-48 * (max_magnitude(low) + max_magnitude(high));
    const uint64_t samples = part.count(0) * part.count(1) * part.count(2);
    if (samples <= few) {
      for_each_row(part,
                   [&](uint64_t j, uint64_t k) { asked_.add(part.low[0], part.high[0], j, k); });
      return;
    }
    const double d = shape_.distance(middle);
    if (std::abs(d) > radius) {
      if (d <= 0)
        for_each_row(part, [&](uint64_t j, uint64_t k) {
          set_bits(block_.row(j, k), part.low[0], part.high[0] - 1);
        });
      return;
    }
    int longest = -1;
    for (int axis = 0; axis < 3; ++axis)
      if (part.count(axis) > 1 && (longest < 0 || extent[axis] > extent[longest])) longest = axis;
    Part lower = part, upper = part;
    lower.high[longest] = upper.low[longest] = part.low[longest] + part.count(longest) / 2;
    divide(lower);
    divide(upper);
  }

  template <class Visit>
  static void for_each_row(const Part& part, Visit&& visit) {
    for (uint64_t k = part.low[2]; k < part.high[2]; ++k)
      for (uint64_t j = part.low[1]; j < part.high[1]; ++j) visit(j, k);
  }

  const Shape& shape_;
  const RowBlock& block_;
  const SampleGrid& grid_;
  AskedSamples asked_;
};

}  // namespace msq
