// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/nearest_struts.h"

#include <limits>

namespace msq {

NearestStruts::NearestStruts(const std::vector<PeriodicStrut>& struts, Vec3 cell_size,
                             Interval radius)
    : box_size_(cell_size * (1.0 / parts)),
      reach_(8 * min_component(cell_size)),
      most_factor_(0),
      radius_(radius) {
  // Each strut of the tiling that may be the nearest to a point of the cell, whose axis is no
  // farther than `most` from it: half the cell's diagonal and the distance of one of its own struts
  // from its centre, and what a thicker strut may gain over that.
  const Vec3 centre = cell_size * 0.5;
  double least_squared = std::numeric_limits<double>::infinity(), least_factor = least_squared;
  for (const PeriodicStrut& s : struts) {
    least_squared =
        std::min(least_squared, Segment(s.a * cell_size, s.b * cell_size).distance_squared(centre));
    least_factor = std::min(least_factor, s.factor);
    most_factor_ = std::max(most_factor_, s.factor);
  }
  const double gain = (most_factor_ - least_factor) * radius.high;
  const double most =
      std::min(reach_, std::sqrt(least_squared) + length(centre) + gain) * (1 + 1e-9);
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
          struts_.push_back(
              {Segment((s.a + shift) * cell_size, (s.b + shift) * cell_size), s.factor});
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
  struct Gaps {  // at either end of the radii
    double thin, thick;
  };
  const auto gaps_of = [&](double distance, double factor) {
    return Gaps{distance - factor * radius_.low, distance - factor * radius_.high};
  };
  std::vector<Gaps> gaps;
  gaps.reserve(from.size());
  Gaps thin = gaps_of(reach_, most_factor_), thick = thin;  // of the nearest to the centre
  for (const uint32_t s : from) {
    gaps.push_back(gaps_of(std::sqrt(struts_[s].axis.distance_squared(centre)), struts_[s].factor));
    if (gaps.back().thin < thin.thin) thin = gaps.back();
    if (gaps.back().thick < thick.thick) thick = gaps.back();
  }
  const double room = 2 * half_diagonal + 1e-9 * (half_diagonal + reach_);
  const auto rules_out = [&](const Gaps& t, const Gaps& s) {
    return t.thin + room < s.thin && t.thick + room < s.thick;
  };
  std::vector<uint32_t> kept;
  for (size_t i = 0; i < from.size(); ++i)
    if (!rules_out(thin, gaps[i]) && !rules_out(thick, gaps[i])) kept.push_back(from[i]);
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

double NearestStruts::gap(Vec3 q, double r) const {
  size_t index = 0;
  for (int axis = 2; axis >= 0; --axis) {
    // A point that rounding puts next to its box is as near to its centre, to the slack of `room`.
    const int part = static_cast<int>(q[axis] / box_size_[axis]);
    index = index * parts + static_cast<size_t>(std::clamp(part, 0, parts - 1));
  }
  double least = reach_ - most_factor_ * r;
  const uint32_t end = lists_[index].end;
  for (uint32_t i = lists_[index].begin; i < end;) {
    const double factor = struts_[entries_[i]].factor;
    double squared = std::numeric_limits<double>::infinity();
    for (; i < end && struts_[entries_[i]].factor == factor; ++i)
      squared = std::min(squared, struts_[entries_[i]].axis.distance_squared(q));
    least = std::min(least, std::sqrt(squared) - factor * r);
  }
  return least;
}

}  // namespace msq
