// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/cell/strut_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/job.h"

namespace msq {

namespace {

/// Maximum distance of the points of a box from an axis: it is convex, so its maximum is at a
/// corner.
template <class Axis>
double greatest_distance(const Axis& axis, const Box3& box) {
  double squared = 0;
  for (int corner = 0; corner < 8; ++corner)
    squared = std::max(squared, axis.distance_squared({corner & 1 ? box.max.x : box.min.x,
                                                       corner & 2 ? box.max.y : box.min.y,
                                                       corner & 4 ? box.max.z : box.min.z}));
  return std::sqrt(squared);
}

/// For lists up to this length, clusters may share the list of the box that they are part of.
constexpr size_t few_struts = 64;
/// Ratio of length to width above which a box is long.
constexpr double long_box = 4;

}  // namespace

template <class Periodic>
PartClusters<Periodic>::PartClusters(const std::vector<Periodic>& struts, Vec3 cell_size,
                                     Interval radius, int side)
    : reach_(8 * min_component(cell_size)),
      slack_(1e-9 * (length(cell_size) + reach_)),
      radius_(radius) {
  find_struts(struts, cell_size);
  std::vector<uint32_t> all(struts_.size());
  for (uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  all = nearest({{0, 0, 0}, cell_size}, all);
  for (side_ = side;; side_ /= 2) {
    cluster_size_ = cell_size * (1.0 / side_);
    const size_t count = static_cast<size_t>(side_);
    clusters_.assign(count * count * count, {});
    entries_.clear();
    if (divide({{0, 0, 0}, {side_, side_, side_}}, all) || side_ == 1) break;
  }
  entries_.shrink_to_fit();
}

/// Finds each strut of the tiling that may be the nearest to a point of the cell. Their axes are
/// within `most` of it: half the cell's diagonal, plus the distance of one of its own struts from
/// its centre, plus the maximum gain of a thicker strut.
template <class Periodic>
void PartClusters<Periodic>::find_struts(const std::vector<Periodic>& struts, Vec3 cell_size) {
  const Vec3 centre = cell_size * 0.5;
  double min_squared = std::numeric_limits<double>::infinity(), min_factor = min_squared;
  for (const Periodic& s : struts) {
    min_squared = std::min(min_squared, s.placed({}, cell_size).axis.distance_squared(centre));
    min_factor = std::min(min_factor, s.factor);
    max_factor_ = std::max(max_factor_, s.factor);
  }
  const double gain = (max_factor_ - min_factor) * radius_.high;
  const double most = std::min(reach_, std::sqrt(min_squared) + length(centre) + gain) * (1 + 1e-9);
  const Box3 near = Box3{{0, 0, 0}, cell_size}.grown(most);
  for (const Periodic& s : struts) {
    const Vec3 low = s.low() * cell_size, high = s.high() * cell_size;
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = static_cast<int>(std::ceil((near.min[axis] - high[axis]) / cell_size[axis]));
      last[axis] = static_cast<int>(std::floor((near.max[axis] - low[axis]) / cell_size[axis]));
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
          const Vec3 shift{double(i), double(j), double(k)};
          struts_.push_back(s.placed(shift, cell_size));
        }
  }
}

template <class Periodic>
Box3 PartClusters<Periodic>::place(const Box& box) const {
  const auto vector = [](const std::array<int, 3>& v) {
    return Vec3{double(v[0]), double(v[1]), double(v[2])};
  };
  const Vec3 low = vector(box.first) * cluster_size_;
  return {low, low + vector(box.size) * cluster_size_};
}

template <class Periodic>
Box3 PartClusters<Periodic>::middle_of(const Box3& box) const {
  const Vec3 low = (box.min + box.max - cluster_size_) * 0.5;
  return {low, low + cluster_size_};
}

template <class Periodic>
std::vector<uint32_t> PartClusters<Periodic>::nearest(const Box3& box,
                                                      const std::vector<uint32_t>& from) const {
  const Vec3 centre = (box.min + box.max) * 0.5, extent = box.extent();
  const double half_diagonal = 0.5 * length(extent);
  const bool is_long = max_component(extent) > long_box * min_component(extent);
  struct Distances {
    double least, greatest;
  };
  const auto distances_of = [&](const auto& axis) {
    const double middle = std::sqrt(axis.distance_squared(centre));
    Distances found{middle - half_diagonal, middle + half_diagonal};
    if (!is_long) return found;
    const double at_corner = greatest_distance(axis, box);
    const Box3 whole = bounds_of(axis);
    const Vec3 apart = max(max(whole.min - box.max, box.min - whole.max), Vec3{});
    found.least = std::max({found.least, 2 * middle - at_corner, length(apart)});
    found.greatest = std::min(found.greatest, at_corner);
    return found;
  };
  struct Gaps {  // at either end of the radii
    double thin, thick;
  };
  const auto gaps_of = [&](double distance, double factor) {
    return Gaps{distance - factor * radius_.low, distance - factor * radius_.high};
  };
  std::vector<Gaps> least;
  least.reserve(from.size());
  // The struts whose maximum gap is smallest.
  Gaps thin = gaps_of(reach_ + half_diagonal, max_factor_), thick = thin;
  for (const uint32_t s : from) {
    const Distances distances = distances_of(struts_[s].axis);
    least.push_back(gaps_of(distances.least, struts_[s].factor));
    const Gaps greatest = gaps_of(distances.greatest, struts_[s].factor);
    if (greatest.thin < thin.thin) thin = greatest;
    if (greatest.thick < thick.thick) thick = greatest;
  }
  const auto rules_out = [&](const Gaps& t, const Gaps& s) {
    return t.thin + slack_ < s.thin && t.thick + slack_ < s.thick;
  };
  std::vector<uint32_t> kept;
  for (size_t i = 0; i < from.size(); ++i)
    if (!rules_out(thin, least[i]) && !rules_out(thick, least[i])) kept.push_back(from[i]);
  return kept;
}

template <class Periodic>
bool PartClusters<Periodic>::divide(const Box& box, const std::vector<uint32_t>& from) {
  check_cancelled();
  const Box3 whole = place(box);
  const std::vector<uint32_t> kept = nearest(whole, from);
  const bool is_cluster = box.size == std::array<int, 3>{1, 1, 1};
  const auto gains = [&] {
    return kept.size() <= few_struts ||
           4 * nearest(middle_of(whole), kept).size() <= 3 * kept.size();
  };
  if (is_cluster || !gains()) {
    const Cluster cluster = cluster_of(whole, kept);
    for (int z = box.first[2]; z < box.first[2] + box.size[2]; ++z)
      for (int y = box.first[1]; y < box.first[1] + box.size[1]; ++y)
        for (int x = box.first[0]; x < box.first[0] + box.size[0]; ++x)
          clusters_[static_cast<size_t>((z * side_ + y) * side_ + x)] = cluster;
    return entries_.size() <= std::max(max_entries, max_of_cluster * clusters_.size());
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
    if (!is_empty && !divide(part, kept)) return false;
  }
  return true;
}

template <class Periodic>
typename PartClusters<Periodic>::Cluster PartClusters<Periodic>::cluster_of(
    const Box3& box, const std::vector<uint32_t>& list) {
  Cluster cluster;
  cluster.begin = static_cast<uint32_t>(entries_.size());
  entries_.insert(entries_.end(), list.begin(), list.end());
  cluster.end = static_cast<uint32_t>(entries_.size());
  const Vec3 centre = (box.min + box.max) * 0.5;
  const double half_diagonal = length(box.extent()) * 0.5;
  // Without near struts, nothing is known to be inside. All is outside up to the radius at which
  // struts beyond the reach begin.
  cluster.outside = (reach_ - half_diagonal - slack_) / max_factor_;
  cluster.inside = std::numeric_limits<double>::infinity();
  for (const uint32_t s : list) {
    const Part& strut = struts_[s];
    const double distance = std::sqrt(strut.axis.distance_squared(centre));
    cluster.outside = std::min(cluster.outside, (distance - half_diagonal - slack_) / strut.factor);
    // A corner is at least as far as the centre.
    if ((distance + slack_) / strut.factor >= cluster.inside) continue;
    cluster.inside =
        std::min(cluster.inside, (greatest_distance(strut.axis, box) + slack_) / strut.factor);
  }
  return cluster;
}

template <class Periodic>
double PartClusters<Periodic>::onset(Vec3 fraction, Vec3 q) const {
  const Cluster& cluster = at(fraction);
  double min_squared = std::numeric_limits<double>::infinity();
  for (uint32_t i = cluster.begin; i < cluster.end; ++i) {
    const Part& strut = struts_[entries_[i]];
    min_squared =
        std::min(min_squared, strut.axis.distance_squared(q) / (strut.factor * strut.factor));
  }
  return std::sqrt(min_squared);
}

template <class Periodic>
double PartClusters<Periodic>::gap(Vec3 fraction, Vec3 q, double r) const {
  const Cluster& cluster = at(fraction);
  double least = reach_ - max_factor_ * r;
  for (uint32_t i = cluster.begin; i < cluster.end;) {
    const double factor = struts_[entries_[i]].factor;
    double squared = std::numeric_limits<double>::infinity();
    for (; i < cluster.end && struts_[entries_[i]].factor == factor; ++i)
      squared = std::min(squared, struts_[entries_[i]].axis.distance_squared(q));
    least = std::min(least, std::sqrt(squared) - factor * r);
  }
  return least;
}

template class PartClusters<PeriodicStrut>;
template class PartClusters<PeriodicPlate>;

}  // namespace msq
