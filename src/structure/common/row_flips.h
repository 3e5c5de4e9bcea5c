// SPDX-License-Identifier: Apache-2.0
// Samples of repeated rows that differ from those they repeat.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace msq {

/// A sample of a row that repeats another, except for the membership of this sample.
struct RowFlip {
  uint32_t i, j;
};

/// The flips of a layer, up to a number. Samples within rounding of a surface flip, so there are
/// few, except where the rows of a layer lie on surfaces: there whole rows do.
class RowFlips {
 public:
  /// Bytes of the flips of a layer, at most. `layer_bytes`: of its bits.
  static uint64_t max_bytes(uint64_t layer_bytes) {
    return std::max<uint64_t>(layer_bytes / 16, 512 * sizeof(RowFlip));
  }

  /// Forgets all flips. `max_bytes`: of those that are added from now on.
  void begin(uint64_t max_bytes) {
    all_.clear();
    most_ = max_bytes / sizeof(RowFlip);
    is_full_ = false;
  }
  /// There may be one more than the number; then all are dropped.
  void add(uint64_t i, uint64_t j) {
    if (is_full_) return;
    is_full_ = all_.size() == most_;
    if (is_full_) {
      all_ = std::vector<RowFlip>();
      return;
    }
    if (all_.size() == all_.capacity())
      all_.reserve(std::min(most_, std::max<size_t>(2 * all_.capacity(), 64)));
    all_.push_back({static_cast<uint32_t>(i), static_cast<uint32_t>(j)});
  }
  /// Whether there were too many.
  bool is_full() const { return is_full_; }

  void sort_by_rows() {
    std::sort(all_.begin(), all_.end(),
              [](const RowFlip& a, const RowFlip& b) { return a.j < b.j; });
  }
  const std::vector<RowFlip>& all() const { return all_; }

 private:
  std::vector<RowFlip> all_;
  size_t most_ = 0;
  bool is_full_ = false;
};

}  // namespace msq
