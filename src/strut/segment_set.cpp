// SPDX-License-Identifier: Apache-2.0
#include "strut/segment_set.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

namespace msq {

SegmentSet::SegmentSet(const std::vector<Node>& nodes,
                       const std::vector<std::array<uint32_t, 2>>& ends,
                       const std::vector<uint32_t>& starts)
    : count_(ends.size()),
      node_count_(nodes.size()),
      nodes_(3 * nodes.size() + node_padding),
      starts_(starts) {
  starts_.push_back(static_cast<uint32_t>(count_));
  for (size_t i = 0; i < node_count_; ++i)
    for (size_t axis = 0; axis < 3; ++axis) nodes_[3 * i + axis] = nodes[i][axis];
  const auto set_ends = [&](auto& numbers) {
    using Number = typename std::decay_t<decltype(numbers)>::value_type;
    numbers.resize(2 * count_ + padding);
    for (size_t i = 0; i < count_; ++i)
      for (size_t end = 0; end < 2; ++end)
        numbers[end * count_ + i] = static_cast<Number>(ends[i][end]);
    set_bounds(numbers);
  };
  if (is_wide())
    set_ends(wide_);
  else
    set_ends(narrow_);
}

SegmentSet::SegmentSet(const std::vector<FloatSegment>& segments,
                       const std::vector<uint32_t>& starts)
    : SegmentSet(
          [&] {
            std::vector<Node> nodes;
            for (const FloatSegment& s : segments) {
              nodes.push_back({s.a[0], s.a[1], s.a[2]});
              nodes.push_back({s.b[0], s.b[1], s.b[2]});
            }
            return nodes;
          }(),
          [&] {
            std::vector<std::array<uint32_t, 2>> ends;
            for (uint32_t i = 0; i < segments.size(); ++i) ends.push_back({2 * i, 2 * i + 1});
            return ends;
          }(),
          starts) {}

SegmentSet::SegmentSet(Arrays&& arrays)
    : count_(arrays.starts.back()),
      node_count_((arrays.nodes.size() - node_padding) / 3),
      nodes_(std::move(arrays.nodes)),
      bounds_(std::move(arrays.bounds)),
      narrow_(std::move(arrays.ends)),
      starts_(std::move(arrays.starts)) {}

template <class Number>
void SegmentSet::set_bounds(const std::vector<Number>& ends) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  bounds_.resize(6 * runs());
  for (size_t run = 0; run < runs(); ++run)
    for (size_t axis = 0; axis < 3; ++axis) {
      float low = inf, high = -inf;
      for (size_t end = 0; end < 2; ++end)
        for (size_t i = run_start(run); i < run_end(run); ++i) {
          const float x = node(ends[end * count_ + i])[axis];
          low = std::min(low, x);
          high = std::max(high, x);
        }
      bounds_[axis * runs() + run] = low;
      bounds_[(axis + 3) * runs() + run] = high;
    }
}

// Rounding keeps the order of numbers, so bounds stay those of the nodes.
SegmentSet SegmentSet::stretched(Vec3 factor) const {
  SegmentSet set = *this;
  const auto multiply = [](float& value, double by) {
    value = static_cast<float>(static_cast<double>(value) * by);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto from = static_cast<size_t>(axis);
    for (size_t i = 0; i < node_count_; ++i) multiply(set.nodes_[3 * i + from], factor[axis]);
    for (const size_t bound : {from, from + 3})
      for (size_t run = 0; run < runs(); ++run)
        multiply(set.bounds_[bound * runs() + run], factor[axis]);
  }
  return set;
}

FloatSegment SegmentSet::at(size_t i) const {
  const size_t a = is_wide() ? wide_ends(0)[i] : narrow_ends(0)[i];
  const size_t b = is_wide() ? wide_ends(1)[i] : narrow_ends(1)[i];
  FloatSegment segment;
  for (int axis = 0; axis < 3; ++axis) {
    segment.a[axis] = node(a)[axis];
    segment.b[axis] = node(b)[axis];
  }
  return segment;
}

}  // namespace msq
