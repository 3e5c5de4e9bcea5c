// SPDX-License-Identifier: Apache-2.0
#include "strut/segment_set.h"

#include <algorithm>
#include <limits>

namespace msq {

SegmentSet::SegmentSet(const std::vector<FloatSegment>& segments,
                       const std::vector<uint32_t>& starts)
    : count_(segments.size()), components_(6 * count_ + padding), starts_(starts) {
  starts_.push_back(static_cast<uint32_t>(count_));
  for (size_t i = 0; i < count_; ++i)
    for (size_t axis = 0; axis < 3; ++axis) {
      components_[axis * count_ + i] = segments[i].a[axis];
      components_[(axis + 3) * count_ + i] = segments[i].b[axis];
    }
  constexpr float inf = std::numeric_limits<float>::infinity();
  bounds_.assign(6 * runs() + padding, inf);
  for (size_t run = 0; run < runs(); ++run)
    for (size_t axis = 0; axis < 3; ++axis) {
      float low = inf, high = -inf;
      for (size_t i = run_start(run); i < run_end(run); ++i) {
        low = std::min({low, segments[i].a[axis], segments[i].b[axis]});
        high = std::max({high, segments[i].a[axis], segments[i].b[axis]});
      }
      bounds_[axis * runs() + run] = low;
      bounds_[(axis + 3) * runs() + run] = high;
    }
}

FloatSegment SegmentSet::at(size_t i) const {
  FloatSegment segment;
  for (int axis = 0; axis < 3; ++axis) {
    segment.a[axis] = component(axis)[i];
    segment.b[axis] = component(axis + 3)[i];
  }
  return segment;
}

}  // namespace msq
