// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/strut_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace msq {

StrutClusters::StrutClusters(const std::vector<PeriodicStrut>& struts, Vec3 cell_size,
                             Interval radius, int side)
    : side_(side),
      cluster_size_(cell_size * (1.0 / side)),
      reach_(8 * min_component(cell_size)),
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
  slack_ = 1e-9 * (length(cell_size) + reach_);
  const size_t count = static_cast<size_t>(side);
  clusters_.resize(count * count * count);
  divide({{0, 0, 0}, {side, side, side}}, all);
}

void StrutClusters::divide(const Box& box, const std::vector<uint32_t>& from) {
  const auto vector = [](const std::array<int, 3>& v) {
    return Vec3{double(v[0]), double(v[1]), double(v[2])};
  };
  const Vec3 low = vector(box.first) * cluster_size_;
  const Vec3 half = vector(box.size) * cluster_size_ * 0.5;
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
  const double room = 2 * half_diagonal + slack_;
  const auto rules_out = [&](const Gaps& t, const Gaps& s) {
    return t.thin + room < s.thin && t.thick + room < s.thick;
  };
  std::vector<uint32_t> kept;
  for (size_t i = 0; i < from.size(); ++i)
    if (!rules_out(thin, gaps[i]) && !rules_out(thick, gaps[i])) kept.push_back(from[i]);
  if (box.size == std::array<int, 3>{1, 1, 1}) {
    Cluster& cluster = clusters_[static_cast<size_t>((box.first[2] * side_ + box.first[1]) * side_ +
                                                     box.first[0])];
    cluster.begin = static_cast<uint32_t>(entries_.size());
    entries_.insert(entries_.end(), kept.begin(), kept.end());
    cluster.end = static_cast<uint32_t>(entries_.size());
    set_radii(cluster, low, low + half * 2, kept);
    return;
  }
  for (int octant = 0; octant < 8; ++octant) {
    Box part = box;
    bool is_empty = false;
    for (size_t axis = 0; axis < 3; ++axis) {
      const int lower = (box.size[axis] + 1) / 2;
      const bool is_upper = octant >> axis & 1;
      if (is_upper) part.first[axis] += lower;
      part.size[axis] = is_upper ? box.size[axis] - lower : lower;
      is_empty |= part.size[axis] == 0;
    }
    if (!is_empty) divide(part, kept);
  }
}

void StrutClusters::set_radii(Cluster& cluster, Vec3 low, Vec3 high,
                              const std::vector<uint32_t>& near) const {
  const Vec3 centre = (low + high) * 0.5;
  const double half_diagonal = length(high - low) * 0.5;
  // With no strut near, nothing is known to be inside, and all is outside up to where struts that
  // are not looked for begin.
  cluster.outside = (reach_ - half_diagonal - slack_) / most_factor_;
  cluster.inside = std::numeric_limits<double>::infinity();
  for (const uint32_t s : near) {
    const LatticeStrut& strut = struts_[s];
    const double distance = std::sqrt(strut.axis.distance_squared(centre));
    double greatest_squared = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                   corner & 4 ? high.z : low.z};
      greatest_squared = std::max(greatest_squared, strut.axis.distance_squared(p));
    }
    cluster.outside = std::min(cluster.outside, (distance - half_diagonal - slack_) / strut.factor);
    cluster.inside =
        std::min(cluster.inside, (std::sqrt(greatest_squared) + slack_) / strut.factor);
  }
}

double StrutClusters::onset(Vec3 fraction, Vec3 q) const {
  const Cluster& cluster = at(fraction);
  double least_squared = std::numeric_limits<double>::infinity();
  for (uint32_t i = cluster.begin; i < cluster.end; ++i) {
    const LatticeStrut& strut = struts_[entries_[i]];
    least_squared =
        std::min(least_squared, strut.axis.distance_squared(q) / (strut.factor * strut.factor));
  }
  return std::sqrt(least_squared);
}

double StrutClusters::gap(Vec3 fraction, Vec3 q, double r) const {
  const Cluster& cluster = at(fraction);
  double least = reach_ - most_factor_ * r;
  for (uint32_t i = cluster.begin; i < cluster.end;) {
    const double factor = struts_[entries_[i]].factor;
    double squared = std::numeric_limits<double>::infinity();
    for (; i < cluster.end && struts_[entries_[i]].factor == factor; ++i)
      squared = std::min(squared, struts_[entries_[i]].axis.distance_squared(q));
    least = std::min(least, std::sqrt(squared) - factor * r);
  }
  return least;
}

}  // namespace msq
