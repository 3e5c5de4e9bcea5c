// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/strut_onsets.h"

#include <cmath>
#include <limits>

namespace msq {

StrutOnsets::StrutOnsets(const std::vector<PeriodicStrut>& struts, Vec3 cell_size, double most)
    : box_size_(cell_size * (1.0 / parts)) {
  double most_factor = 0;
  for (const PeriodicStrut& s : struts) most_factor = std::max(most_factor, s.factor);
  // Every cell has a strut of the greatest factor, so no onset is above this.
  const double farthest = std::min(most, length(cell_size) / most_factor) * (1 + 1e-6);
  for (const PeriodicStrut& s : struts) {
    const Vec3 low = min(s.a, s.b) * cell_size, high = max(s.a, s.b) * cell_size;
    const double reach = farthest * s.factor;
    int64_t first[3], last[3];
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = static_cast<int64_t>(std::floor((-high[axis] - reach) / cell_size[axis]));
      last[axis] = static_cast<int64_t>(std::ceil(1 + (reach - low[axis]) / cell_size[axis]));
    }
    const Box3 near = Box3{{0, 0, 0}, cell_size}.grown(reach);
    for (int64_t k = first[2]; k <= last[2]; ++k)
      for (int64_t j = first[1]; j <= last[1]; ++j)
        for (int64_t i = first[0]; i <= last[0]; ++i) {
          const Vec3 shift = Vec3{double(i), double(j), double(k)} * cell_size;
          if (near.overlaps({low + shift, high + shift}))
            struts_.push_back(
                {Segment(s.a * cell_size + shift, s.b * cell_size + shift), s.factor});
        }
  }

  const double half = length(box_size_) / 2 * (1 + 1e-6);
  std::vector<double> distances(struts_.size());
  for (int k = 0; k < parts; ++k)
    for (int j = 0; j < parts; ++j)
      for (int i = 0; i < parts; ++i) {
        const Vec3 centre = Vec3{i + 0.5, j + 0.5, k + 0.5} * box_size_;
        double least = farthest;
        for (size_t s = 0; s < struts_.size(); ++s) {
          distances[s] = std::sqrt(struts_[s].axis.distance_squared(centre));
          least = std::min(least, (distances[s] + half) / struts_[s].factor);
        }
        List list{static_cast<uint32_t>(entries_.size()), 0};
        for (size_t s = 0; s < struts_.size(); ++s)
          if ((distances[s] - half) / struts_[s].factor <= least * (1 + 1e-6))
            entries_.push_back(static_cast<uint32_t>(s));
        list.end = static_cast<uint32_t>(entries_.size());
        lists_.push_back(list);
      }
}

double StrutOnsets::onset(Vec3 q) const {
  size_t box = 0;
  for (int axis : {2, 1, 0}) {
    const double place = std::clamp(std::floor(q[axis] / box_size_[axis]), 0.0, parts - 1.0);
    box = box * parts + static_cast<size_t>(place);
  }
  double least = std::numeric_limits<double>::infinity();
  for (uint32_t e = lists_[box].begin; e < lists_[box].end; ++e) {
    const LatticeStrut& s = struts_[entries_[e]];
    least = std::min(least, std::sqrt(s.axis.distance_squared(q)) / s.factor);
  }
  return least;
}

}  // namespace msq
