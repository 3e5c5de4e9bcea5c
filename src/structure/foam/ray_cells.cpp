// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/ray_cells.h"

#include <algorithm>
#include <cmath>

namespace msq {

namespace {

/// Room for roundings in single precision, coordinates below 16.
constexpr double slack = 1e-5;

int floor_div(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// Squared distance between a point and a segment.
float distance_squared(const float (&p)[3], const float (&a)[3], const float (&ab)[3]) {
  float across = 0, length = 0;
  for (int axis = 0; axis < 3; ++axis) {
    across += (p[axis] - a[axis]) * ab[axis];
    length += ab[axis] * ab[axis];
  }
  const float s = std::clamp(across / std::max(length, 1e-30f), 0.0f, 1.0f);
  float squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float d = p[axis] - a[axis] - s * ab[axis];
    squared += d * d;
  }
  return squared;
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
  return 0.5 * length(seeds.scale()) + radius + 2 * margin + slack;
}

RayCells::RayCells(const FoamSeeds& seeds, const NearCells& near, double radius, CellIndex corner,
                   const Fetch& fetch) {
  thread_local std::vector<Entry> lists[side * side * side];
  for (std::vector<Entry>& list : lists) list.clear();
  const Vec3 scale = seeds.scale();
  const double grown = radius + margin + slack;
  const float middle[3] = {static_cast<float>(0.5 * scale.x), static_cast<float>(0.5 * scale.y),
                           static_cast<float>(0.5 * scale.z)};
  const float most = static_cast<float>(reach(seeds, radius)), most_squared = most * most;
  // Owners are within the empty radius of a point of their edge.
  const int cell[3] = {corner.x, corner.y, corner.z};
  int first[3], last[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double out = (grown + seeds.empty_radius()) / scale[axis];
    first[axis] = floor_div(cell[axis] - static_cast<int>(std::ceil(out)), SeededEdges::side);
    last[axis] =
        floor_div(cell[axis] + side - 1 + static_cast<int>(std::ceil(out)), SeededEdges::side);
  }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const CellIndex from{i * SeededEdges::side, j * SeededEdges::side, k * SeededEdges::side};
        const SeededEdges& edges = fetch(from);
        const SegmentSet& segments = edges.segments();
        // From here on from the brick's corner.
        const int ahead[3] = {corner.x - from.x, corner.y - from.y, corner.z - from.z};
        float low[3], high[3];
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = static_cast<float>(ahead[axis] * scale[axis] - grown);
          high[axis] = static_cast<float>((ahead[axis] + side) * scale[axis] + grown);
        }
        for (size_t run = 0; run < segments.runs(); ++run) {
          bool is_far = false;
          for (int axis = 0; axis < 3; ++axis)
            is_far |=
                segments.bound(axis)[run] > high[axis] || segments.bound(axis + 3)[run] < low[axis];
          if (is_far) continue;
          for (size_t e = segments.run_start(run); e < segments.run_end(run); ++e) {
            const FloatSegment s = segments.at(e);
            int begin[3], end[3];
            is_far = false;
            for (int axis = 0; axis < 3; ++axis) {
              const auto [least, greatest] = std::minmax(s.a[axis], s.b[axis]);
              is_far |= least > high[axis] || greatest < low[axis];
              const double to_cell = 1 / scale[axis];
              begin[axis] = std::max(
                  0, static_cast<int>(std::floor((least - grown) * to_cell)) - ahead[axis]);
              end[axis] =
                  std::min(side - 1, static_cast<int>(std::floor((greatest + grown) * to_cell)) -
                                         ahead[axis]);
            }
            if (is_far) continue;
            const auto& triple = edges.seeds(e);
            const bool is_known = !(triple[0] == triple[1]);
            for (int z = begin[2]; z <= end[2]; ++z)
              for (int y = begin[1]; y <= end[1]; ++y)
                for (int x = begin[0]; x <= end[0]; ++x) {
                  const int at[3] = {ahead[0] + x, ahead[1] + y, ahead[2] + z};
                  Entry entry;
                  for (int axis = 0; axis < 3; ++axis) {
                    entry.a[axis] = static_cast<float>(s.a[axis] - at[axis] * scale[axis]);
                    entry.ab[axis] = s.b[axis] - s.a[axis];
                  }
                  if (distance_squared(middle, entry.a, entry.ab) > most_squared) continue;
                  uint32_t number[3];
                  for (size_t n = 0; n < 3; ++n)
                    number[n] =
                        near.number(triple[n].x - at[0], triple[n].y - at[1], triple[n].z - at[2]);
                  std::sort(number, number + 3);
                  entry.seeds = is_known ? number[0] | number[1] << 10 | number[2] << 20 : unknown;
                  lists[(z * side + y) * side + x].push_back(entry);
                }
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
