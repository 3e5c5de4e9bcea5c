// SPDX-License-Identifier: Apache-2.0
// Samples of a block of rows that are asked of a shape one by one, many at a time.
#pragma once

#include <vector>

#include "base/job.h"
#include "shape/shape.h"

namespace msq {

class AskedSamples {
 public:
  AskedSamples(const RowBlock& block, const Shape& shape)
      : block_(block), grid_(*block.grid), shape_(shape) {}

  /// Of row j of layer k, those from i = begin on to `end`, which is excluded.
  void add(uint64_t begin, uint64_t end, uint64_t j, uint64_t k) {
    for (uint64_t i = begin; i < end; ++i) {
      points_.push_back(grid_.at(i, j, k));
      places_.push_back({block_.row(j, k), i});
      if (points_.size() == batch) ask();
    }
  }

  /// Sets or clears the bits of those that were added since.
  void ask() {
    if (points_.empty()) return;
    check_cancelled();
    inside_.resize(points_.size());
    shape_.find_inside(points_.data(), points_.size(), inside_.data());
    for (size_t n = 0; n < points_.size(); ++n) {
      uint64_t& word = places_[n].row[places_[n].i / bits_per_word];
      const uint64_t bit = uint64_t{1} << places_[n].i % bits_per_word;
      word = inside_[n] ? word | bit : word & ~bit;
    }
    points_.clear();
    places_.clear();
  }

 private:
  static constexpr size_t batch = 1024;
  struct Place {
    uint64_t* row;
    uint64_t i;
  };

  const RowBlock& block_;
  const SampleGrid& grid_;
  const Shape& shape_;
  std::vector<Vec3> points_;
  std::vector<Place> places_;
  std::vector<uint8_t> inside_;
};

}  // namespace msq
