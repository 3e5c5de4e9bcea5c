// SPDX-License-Identifier: Apache-2.0
// Segments that are stored for long and drawn often: in single precision, relative to an origin
// near by, component by component so that vectors of them can be read at once, and in runs of
// neighbours, each with a box.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/simd.h"

namespace msq {

struct FloatSegment {
  float a[3], b[3];
};

class SegmentSet {
 public:
  SegmentSet() = default;
  /// Run i holds the segments from starts[i] to starts[i + 1], the last one those from its start to
  /// the end.
  SegmentSet(const std::vector<FloatSegment>& segments, const std::vector<uint32_t>& starts);

  size_t count() const { return count_; }
  FloatSegment at(size_t i) const;
  /// Component 0 to 5 (a.x, a.y, a.z, b.x, b.y, b.z) of all; a vector may be read at any of them.
  const float* component(int c) const {
    return components_.data() + static_cast<size_t>(c) * count_;
  }

  size_t runs() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  size_t run_start(size_t run) const { return starts_[run]; }
  size_t run_end(size_t run) const { return starts_[run + 1]; }
  /// Bound 0 to 5 (least x, y, z, greatest x, y, z) of all runs; a vector may be read at any.
  const float* bound(int b) const { return bounds_.data() + static_cast<size_t>(b) * runs(); }

  uint64_t bytes() const {
    return (components_.capacity() + bounds_.capacity()) * sizeof(float) +
           starts_.capacity() * sizeof(uint32_t);
  }

 private:
  static constexpr size_t padding = 2 * most_simd_doubles;  // floats of the widest vector

  size_t count_ = 0;
  std::vector<float> components_, bounds_;  // one array after the other, then the padding
  std::vector<uint32_t> starts_;            // and the end of the last run
};

}  // namespace msq
