// SPDX-License-Identifier: Apache-2.0
// Points grouped by boxes of neighbourhood cells, in parallel, in bounded memory.
// Source: paper, section "Structured and Unstructured Set Queries".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/job.h"
#include "base/parallel.h"
#include "cell/neighbourhood.h"
#include "query/point_set.h"

namespace msq {

class PointGroups {
 public:
  /// For up to `most` points at once, below 2^32; takes bytes(most) of memory.
  explicit PointGroups(uint64_t most);
  static uint64_t bytes(uint64_t most);

  /// Groups the points first ... first + count - 1 that have alive[i] != 0, i counted from first.
  /// If a cell contains hundreds of points, it is divided into up to `parts` parts along each axis,
  /// rounded down to a power of two.
  void group(const Executor& executor, const Neighbourhood& grid, const PointSet& points,
             uint64_t first, uint64_t count, const uint8_t* alive, const Job* job,
             uint32_t parts = 1);

  /// The number of groups of neighbouring points, and the points of one group, as numbers i. A
  /// group has at most max_in_group points.
  size_t size() const { return groups_.size(); }
  std::span<const uint32_t> operator[](size_t group) const {
    return {order_.data() + groups_[group].first, groups_[group].count};
  }
  static constexpr uint32_t max_in_group = 8192;

 private:
  struct Group {
    uint32_t first, count;
  };

  std::vector<uint16_t> box_;     // of each point
  std::vector<uint32_t> order_;   // points; those of a box are adjacent
  std::vector<uint32_t> counts_;  // for each slice of points and each box
  std::vector<Group> groups_;
};

}  // namespace msq
