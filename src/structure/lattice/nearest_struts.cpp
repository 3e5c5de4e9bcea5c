// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/nearest_struts.h"

#include <limits>

namespace msq {

NearestStruts::NearestStruts(const std::vector<PeriodicStrut>& struts, Vec3 cell_size)
    : box_size_(cell_size * (1.0 / parts)), reach_(8 * min_component(cell_size)) {
  // Each strut of the tiling that may be the nearest to a point of the cell, which is no farther
  // than `most` from it: the cell's diagonal and one of its own struts' distance from its centre.
  const Vec3 centre = cell_size * 0.5;
  double least_squared = std::numeric_limits<double>::infinity();
  for (const PeriodicStrut& s : struts)
    least_squared =
        std::min(least_squared, Segment(s.a * cell_size, s.b * cell_size).distance_squared(centre));
  const double most = std::min(reach_, std::sqrt(least_squared) + length(centre)) * (1 + 1e-9);
  const Box3 near = Box3{{0, 0, 0}, cell_size}.grown(most);
  for (const PeriodicStrut& s : struts) {
    const Vec3 low = min(s.a, s.b) * cell_size, high = max(s.a, s.b) * cell_size;
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = static_cast<int>(std::ceil((near.min[axis] - high[axis]) / cell_size[axis]));
      last[axis] = static_cast<int>(std::floor((near.max[axis] - low[axis]) / cell_size[axis]));
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
          const Vec3 shift{double(i), double(j), double(k)};
          struts_.emplace_back((s.a + shift) * cell_size, (s.b + shift) * cell_size);
        }
  }
  std::vector<uint32_t> all(struts_.size());
  for (uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  lists_.resize(parts * parts * parts);
  divide({0, 0, 0}, parts, all);
}

void NearestStruts::divide(std::array<int, 3> first, int side, const std::vector<uint32_t>& from) {
  const Vec3 low = Vec3{double(first[0]), double(first[1]), double(first[2])} * box_size_;
  const Vec3 half = box_size_ * (0.5 * side);
  const Vec3 centre = low + half;
  const double half_diagonal = length(half);
  std::vector<double> distances;
  distances.reserve(from.size());
  double least = reach_;
  for (const uint32_t s : from) {
    distances.push_back(std::sqrt(struts_[s].distance_squared(centre)));
    least = std::min(least, distances.back());
  }
  const double most = (least + 2 * half_diagonal) * (1 + 1e-9);
  std::vector<uint32_t> kept;
  for (size_t i = 0; i < from.size(); ++i)
    if (distances[i] <= most) kept.push_back(from[i]);
  if (side == 1) {
    List& list = lists_[static_cast<size_t>((first[2] * parts + first[1]) * parts + first[0])];
    list.begin = static_cast<uint32_t>(entries_.size());
    entries_.insert(entries_.end(), kept.begin(), kept.end());
    list.end = static_cast<uint32_t>(entries_.size());
    return;
  }
  const int next = side / 2;
  for (int octant = 0; octant < 8; ++octant)
    divide({first[0] + (octant & 1) * next, first[1] + (octant >> 1 & 1) * next,
            first[2] + (octant >> 2) * next},
           next, kept);
}

double NearestStruts::distance(Vec3 q) const {
  size_t index = 0;
  for (int axis = 2; axis >= 0; --axis) {
    // A point that rounding puts next to its box is as near to its centre, to the slack of `most`.
    const int part = static_cast<int>(q[axis] / box_size_[axis]);
    index = index * parts + static_cast<size_t>(std::clamp(part, 0, parts - 1));
  }
  double least = reach_ * reach_;
  for (uint32_t i = lists_[index].begin; i < lists_[index].end; ++i)
    least = std::min(least, struts_[entries_[i]].distance_squared(q));
  return std::sqrt(least);
}

}  // namespace msq
