// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/ray_cells.h"

#include <algorithm>
#include <cmath>

namespace msq {

namespace {

int floor_div(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// A strut that a list is to hold.
struct Entry {
  float a[3], ab[3];
  uint32_t seeds;
};

}  // namespace

NearCells::NearCells(const FoamSeeds& seeds, double reach) {
  const Vec3 scale = seeds.scale();
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    // A point of the edge is within reach, and its seeds within the empty radius of that.
    const double cells = (reach + seeds.empty_radius()) / scale[axis] + 0.5 + 1e-6;
    half_[axis] = static_cast<int>(std::min(cells, 127.0));
    count *= 2 * half_[axis] + 1;
  }
  if (count > 1024) {
    cells_.resize(1025);
    return;
  }
  for (int z = -half_[2]; z <= half_[2]; ++z)
    for (int y = -half_[1]; y <= half_[1]; ++y)
      for (int x = -half_[0]; x <= half_[0]; ++x)
        cells_.push_back({static_cast<int8_t>(x), static_cast<int8_t>(y), static_cast<int8_t>(z)});
}

double RayCells::reach(const FoamSeeds& seeds, double radius) {
  return 0.5 * length(seeds.scale()) + radius + 2 * ray_list_margin + 1e-5;
}

RayCells::RayCells(const FoamSeeds& seeds, const NearCells& near, double radius, CellIndex corner,
                   const Fetch& fetch) {
  thread_local std::vector<Entry> lists[side * side * side];
  for (std::vector<Entry>& list : lists) list.clear();
  const Vec3 scale = seeds.scale();
  const std::array<int, 3> reach = SeededEdges::reach(seeds, radius);
  const int cell[3] = {corner.x, corner.y, corner.z};
  int first[3], last[3];
  for (size_t axis = 0; axis < 3; ++axis) {
    first[axis] = floor_div(cell[axis] - reach[axis] + SeededEdges::lead, SeededEdges::side);
    last[axis] =
        floor_div(cell[axis] + side - 1 + reach[axis] + SeededEdges::lead, SeededEdges::side);
  }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const CellIndex from{i * SeededEdges::side - SeededEdges::lead,
                             j * SeededEdges::side - SeededEdges::lead,
                             k * SeededEdges::side - SeededEdges::lead};
        const SeededEdges& edges = fetch(from);
        for (int n = 0; n < side * side * side; ++n) {
          // From the brick's corner.
          const int x = corner.x - from.x + n % side, y = corner.y - from.y + n / side % side,
                    z = corner.z - from.z + n / side / side;
          const double at[3] = {x * scale.x, y * scale.y, z * scale.z};
          for (const uint16_t e : edges.list(x, y, z)) {
            const FloatSegment s = edges.segments().at(e);
            Entry entry;
            for (int axis = 0; axis < 3; ++axis) {
              entry.a[axis] = static_cast<float>(s.a[axis] - at[axis]);
              entry.ab[axis] = s.b[axis] - s.a[axis];
            }
            entry.seeds = unknown;
            if (const auto& triple = edges.seeds(e); !(triple[0] == triple[1])) {
              uint32_t number[3];
              for (size_t s = 0; s < 3; ++s)
                number[s] = near.number(triple[s].x - x, triple[s].y - y, triple[s].z - z);
              if (number[1] > number[2]) std::swap(number[1], number[2]);  // the owner is first
              entry.seeds = number[0] | number[1] << 10 | number[2] << 20;
            }
            lists[n].push_back(entry);
          }
        }
      }

  size_t count = 0;
  for (size_t n = 0; n < side * side * side; ++n) {
    starts_[n] = static_cast<uint32_t>(count);
    count += lists[n].size();
  }
  starts_[side * side * side] = static_cast<uint32_t>(count);
  stride_ = count;
  values_.resize(6 * count + capsule_padding);
  seeds_.resize(count);
  size_t i = 0;
  for (const std::vector<Entry>& list : lists)
    for (const Entry& entry : list) {
      for (size_t axis = 0; axis < 3; ++axis) {
        values_[axis * stride_ + i] = entry.a[axis];
        values_[(axis + 3) * stride_ + i] = entry.ab[axis];
      }
      seeds_[i++] = entry.seeds;
    }
}

}  // namespace msq
