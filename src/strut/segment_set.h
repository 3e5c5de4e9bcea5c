// SPDX-License-Identifier: Apache-2.0
// Segments that are stored for long and drawn often. Coordinates are in single precision, relative
// to a nearby origin. Each node is stored once, even if many segments share it. Segments form runs
// of neighbours, each with a box.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/simd.h"
#include "base/vec.h"

namespace msq {

struct FloatSegment {
  float a[3], b[3];
};

class SegmentSet {
 public:
  using Node = std::array<float, 3>;

  SegmentSet() = default;
  /// Segment i joins nodes[ends[i][0]] and nodes[ends[i][1]]. Run i holds the segments from
  /// starts[i] to starts[i + 1]; the last run holds those from its start to the end.
  SegmentSet(const std::vector<Node>& nodes, const std::vector<std::array<uint32_t, 2>>& ends,
             const std::vector<uint32_t>& starts);
  /// The same for segments that share no nodes.
  SegmentSet(const std::vector<FloatSegment>& segments, const std::vector<uint32_t>& starts);

  static constexpr size_t padding = 2 * max_simd_doubles;  // lanes of the widest vector of floats
  static constexpr size_t node_padding = 1;                // of floats
  /// A set of at most 65,536 nodes as it is stored.
  struct Arrays {
    std::vector<float> nodes;      // x, y and z of each node in turn, then node_padding
    std::vector<uint16_t> ends;    // all first ends, then all second ends, then the padding
    std::vector<float> bounds;     // bound 0 of all runs, then bound 1, up to 5
    std::vector<uint32_t> starts;  // of runs, and the number of segments
  };
  explicit SegmentSet(Arrays&& arrays);

  /// The same segments with coordinates times factors above 0.
  SegmentSet stretched(Vec3 factor) const;

  size_t count() const { return count_; }
  FloatSegment at(size_t i) const;

  /// Coordinates of a node. A fourth number may be read.
  const float* node(size_t number) const { return nodes_.data() + 3 * number; }
  /// First or second ends of all segments, as numbers of nodes, of 16 or 32 bits. A full vector may
  /// be read at any of them.
  bool is_wide() const { return node_count_ > 0x10000; }
  const uint16_t* narrow_ends(size_t end) const { return narrow_.data() + end * count_; }
  const uint32_t* wide_ends(size_t end) const { return wide_.data() + end * count_; }

  size_t runs() const { return starts_.empty() ? 0 : starts_.size() - 1; }
  size_t run_start(size_t run) const { return starts_[run]; }
  size_t run_end(size_t run) const { return starts_[run + 1]; }
  /// Bound 0 to 5 (minimum x, y, z, maximum x, y, z) of all runs.
  const float* bound(int b) const { return bounds_.data() + static_cast<size_t>(b) * runs(); }

  /// Begins to load the nodes, which segments read in any order, from main memory.
  HWY_INLINE void prefetch() const {
    prefetch_all(nodes_.data(), nodes_.size() * sizeof nodes_[0]);
  }

  uint64_t bytes() const {
    return (nodes_.capacity() + bounds_.capacity()) * sizeof(float) +
           narrow_.capacity() * sizeof(uint16_t) +
           (wide_.capacity() + starts_.capacity()) * sizeof(uint32_t);
  }

 private:
  template <class Number>
  void set_bounds(const std::vector<Number>& ends);

  size_t count_ = 0, node_count_ = 0;
  std::vector<float> nodes_;      // as in Arrays
  std::vector<float> bounds_;     // likewise
  std::vector<uint16_t> narrow_;  // ends, likewise
  std::vector<uint32_t> wide_;
  std::vector<uint32_t> starts_;  // with the end of the last run
};

}  // namespace msq
