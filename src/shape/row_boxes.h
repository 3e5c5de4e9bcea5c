// SPDX-License-Identifier: Apache-2.0
// Rows of a solid of which membership and a bound of the distance are known: boxes of samples that
// the distance of their middle proves to be all on one side are answered as a whole, others are
// halved until few samples are left, which are queried together.
#pragma once

#include <array>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"

namespace msq {

class RowBoxes {
 public:
  explicit RowBoxes(const RowBlock& block) : block_(block), grid_(*block.grid) {}

  /// Sets the bits of the samples of a box that are inside, in a block of zeros. distance(p):
  /// signed, as Shape::distance(). find_inside(points, count, inside): as Shape::find_inside().
  template <class Distance, class FindInside>
  void fill(const Box3& bounds, Distance&& distance, FindInside&& find_inside) {
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
    divide(all, distance, find_inside);
    ask(find_inside);
  }

 private:
  static constexpr uint64_t few = 16;
  static constexpr size_t batch = 1024;

  struct Part {
    uint64_t low[3], high[3];  // samples, high excluded
    uint64_t count(int axis) const { return high[axis] - low[axis]; }
  };
  struct Sample {
    uint64_t* row;
    uint64_t i;
  };

  template <class Distance, class FindInside>
  void divide(const Part& part, Distance&& distance, FindInside&& find_inside) {
    check_cancelled();
    const Vec3 low = grid_.at(part.low[0], part.low[1], part.low[2]);
    const Vec3 high = grid_.at(part.high[0] - 1, part.high[1] - 1, part.high[2] - 1);
    const Vec3 extent = high - low, middle = (low + high) * 0.5;
    // Of the ball about the middle that holds all samples.
    const double radius =
        (0.5 + 0x1p-40) * length(extent) + 0x1p-48 * (max_magnitude(low) + max_magnitude(high));
    const uint64_t samples = part.count(0) * part.count(1) * part.count(2);
    if (samples <= few) return gather(part, find_inside);
    const double d = distance(middle);
    if (std::abs(d) > radius) {
      if (d <= 0) set_all(part);
      return;
    }
    int longest = -1;
    for (int axis = 0; axis < 3; ++axis)
      if (part.count(axis) > 1 && (longest < 0 || extent[axis] > extent[longest])) longest = axis;
    Part lower = part, upper = part;
    lower.high[longest] = upper.low[longest] = part.low[longest] + part.count(longest) / 2;
    divide(lower, distance, find_inside);
    divide(upper, distance, find_inside);
  }

  void set_all(const Part& part) {
    for (uint64_t k = part.low[2]; k < part.high[2]; ++k)
      for (uint64_t j = part.low[1]; j < part.high[1]; ++j)
        set_bits(block_.row(j, k), part.low[0], part.high[0] - 1);
  }

  template <class FindInside>
  void gather(const Part& part, FindInside&& find_inside) {
    for (uint64_t k = part.low[2]; k < part.high[2]; ++k)
      for (uint64_t j = part.low[1]; j < part.high[1]; ++j)
        for (uint64_t i = part.low[0]; i < part.high[0]; ++i) {
          points_.push_back(grid_.at(i, j, k));
          samples_.push_back({block_.row(j, k), i});
        }
    if (points_.size() >= batch) ask(find_inside);
  }

  template <class FindInside>
  void ask(FindInside&& find_inside) {
    if (points_.empty()) return;
    inside_.resize(points_.size());
    find_inside(points_.data(), points_.size(), inside_.data());
    for (size_t n = 0; n < points_.size(); ++n)
      if (inside_[n]) set_bits(samples_[n].row, samples_[n].i, samples_[n].i);
    points_.clear();
    samples_.clear();
  }

  const RowBlock& block_;
  const SampleGrid& grid_;
  std::vector<Vec3> points_;
  std::vector<Sample> samples_;
  std::vector<uint8_t> inside_;
};

}  // namespace msq
