// SPDX-License-Identifier: Apache-2.0
// A counting sort in one pass over at most 4096 boxes, so that the positions being written stay in
// a core's own cache and page table. The side of the boxes, in cells or parts of a cell, is the
// smallest power of two for which the points' bounding box has at most that many boxes, and each
// box has at least 512 points on average. If the points lie in few of the boxes, groups are still
// correct, but less compact. The sort is stable and its slices are fixed, so groups do not depend
// on threads.
#include "query/point_groups.h"

#include <algorithm>
#include <bit>

namespace msq {

namespace {

constexpr uint64_t slice = 32768, max_boxes = 4096, usual_in_box = 512;
constexpr uint16_t no_box = UINT16_MAX;

uint64_t slices_of(uint64_t count) {
  return (count + slice - 1) / slice;
}

/// Numbers boxes of cells. Rounding may put a point on a face into the next box; that only costs
/// time.
class Boxes {
 public:
  /// For points in the box `extent` of grid coordinates.
  Boxes(const Neighbourhood& grid, const Box3& extent, uint64_t most, uint32_t parts)
      : grid_(grid) {
    for (double side = 1.0 / std::bit_floor(parts);; side *= 2) {
      double boxes = 1;
      for (int axis = 0; axis < 3; ++axis) {
        inverse_[axis] = 1 / (grid.cell_size[axis] * side);
        base_[axis] = std::floor(extent.min[axis] * inverse_[axis]);
        size_[axis] = std::floor(extent.max[axis] * inverse_[axis]) - base_[axis] + 1;
        boxes *= size_[axis];
      }
      if (boxes <= static_cast<double>(most)) break;
    }
  }

  uint32_t count() const { return static_cast<uint32_t>(size_.x * size_.y * size_.z); }
  uint32_t number(Vec3 p) const {
    const Vec3 g = grid_.to_grid(p);
    uint32_t number = 0;
    for (int axis : {2, 1, 0}) {
      const double place = g[axis] * inverse_[axis] - base_[axis];
      const auto size = static_cast<uint32_t>(size_[axis]);
      number = number * size + std::min(static_cast<uint32_t>(std::max(place, 0.0)), size - 1);
    }
    return number;
  }

 private:
  const Neighbourhood& grid_;
  Vec3 inverse_, base_, size_;
};

}  // namespace

PointGroups::PointGroups(uint64_t most)
    : box_(most), order_(most), counts_(slices_of(most) * max_boxes) {
  groups_.reserve(max_boxes + most / max_in_group);
}

uint64_t PointGroups::bytes(uint64_t most) {
  return most * (sizeof(uint16_t) + sizeof(uint32_t)) +
         slices_of(most) * max_boxes * sizeof(uint32_t) +
         (max_boxes + most / max_in_group) * sizeof(Group);
}

void PointGroups::group(const Executor& executor, const Neighbourhood& grid, const PointSet& points,
                        uint64_t first, uint64_t count, const uint8_t* alive, const Job* job,
                        uint32_t parts) {
  groups_.clear();
  const uint64_t slices = slices_of(count);
  const auto for_each_slice = [&](auto&& work) {
    executor.for_each(slices, [&](uint64_t s) {
      check_cancelled(job);
      work(s, s * slice, std::min(count, (s + 1) * slice));
    });
  };

  // Calls visit(i, position) for the points of a slice that are alive.
  const auto for_each_alive = [&](uint64_t begin, uint64_t end, auto&& visit) {
    constexpr uint64_t read_at_once = 256;
    Vec3 positions[read_at_once];
    for (uint64_t i = begin; i < end; i += read_at_once) {
      const uint64_t size = std::min(read_at_once, end - i);
      points.read(first + i, size, positions);
      for (uint64_t p = 0; p < size; ++p)
        if (alive[i + p]) visit(i + p, positions[p]);
    }
  };

  struct Extent {
    Box3 box{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
    uint64_t points = 0;
  };
  std::vector<Extent> extents(slices);
  for_each_slice([&](uint64_t s, uint64_t begin, uint64_t end) {
    Extent extent;
    for_each_alive(begin, end, [&](uint64_t, Vec3 p) {
      const Vec3 g = grid.to_grid(p);
      extent.box.min = min(extent.box.min, g);
      extent.box.max = max(extent.box.max, g);
      ++extent.points;
    });
    extents[s] = extent;
  });
  Extent all;
  for (const Extent& extent : extents) {
    all.box.min = min(all.box.min, extent.box.min);
    all.box.max = max(all.box.max, extent.box.max);
    all.points += extent.points;
  }
  if (all.points == 0) return;
  const Boxes boxes(grid, all.box, std::clamp<uint64_t>(all.points / usual_in_box, 1, max_boxes),
                    parts);

  for_each_slice([&](uint64_t s, uint64_t begin, uint64_t end) {
    uint32_t* counts = counts_.data() + s * max_boxes;
    std::fill(counts, counts + boxes.count(), 0);
    std::fill(box_.begin() + static_cast<ptrdiff_t>(begin),
              box_.begin() + static_cast<ptrdiff_t>(end), no_box);
    for_each_alive(begin, end, [&](uint64_t i, Vec3 p) {
      box_[i] = static_cast<uint16_t>(boxes.number(p));
      ++counts[box_[i]];
    });
  });

  uint32_t start = 0;
  for (uint32_t box = 0; box < boxes.count(); ++box) {
    uint32_t group = start;
    for (uint64_t s = 0; s < slices; ++s)
      start += std::exchange(counts_[s * max_boxes + box], start);
    for (; group < start; group += std::min(max_in_group, start - group))
      groups_.push_back({group, std::min(max_in_group, start - group)});
  }

  for_each_slice([&](uint64_t s, uint64_t begin, uint64_t end) {
    uint32_t* next = counts_.data() + s * max_boxes;
    for (uint64_t i = begin; i < end; ++i)
      if (box_[i] != no_box) order_[next[box_[i]]++] = static_cast<uint32_t>(i);
  });
}

}  // namespace msq
