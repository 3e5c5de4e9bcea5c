// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/edges/weighted_cells.h"

#include <algorithm>
#include <cmath>

namespace msq {

namespace {

/// D^2 of the first neighbours, for cells of volume 1: without weights, and what weights add to it.
constexpr double typical_distance_squared = 4.75, first_per_weight = 2;
/// The square of the first guess of V: as without weights, and what they add to it where the own
/// lift is the mean one, 2/3 of the square of the weight, and where it is less. With more seeds
/// than are within the greatest D at first, on average, walks have no room.
constexpr double reach_per_weight = 0.5, reach_per_lift = 0.75, max_first_distance = 2.85;
/// Slack for the rounding of vertices and planes.
constexpr double plane_slack = 1e-9;

}  // namespace

void WeightedCells::move_to(const FoamSeeds& seeds, CellIndex corner, int side) {
  const Vec3 scale = seeds.scale();
  empty_radius_ = seeds.empty_radius();
  max_squared_ = 4 * empty_radius_ * empty_radius_ * (1 + 1e-9);
  weight_squared_ = empty_radius_ * empty_radius_ - dot(scale, scale);
  const double side_squared = std::pow(scale.x * scale.y * scale.z, 2.0 / 3);
  first_squared_ = typical_distance_squared * side_squared + first_per_weight * weight_squared_;
  typical_squared_ = 0.25 * typical_distance_squared * side_squared;
  block_.move_to(seeds, corner, side, first_squared_);
  lifts_.resize(block_.positions().size());
  for (size_t i = 0; i < lifts_.size(); ++i) {
    const auto [x, y, z] = block_.cell(i);
    lifts_[i] = seeds.lift(seeds.bits({corner.x + x, corner.y + y, corner.z + z}));
  }
}

void WeightedCells::take(size_t own, uint32_t seed, double from, double to) {
  const Vec3 d = block_.position(seed) - block_.position(own);
  const double squared = dot(d, d);
  if (!(squared > from && squared <= to)) return;
  const double offset = 0.5 * (squared + (lifts_[seed] - lifts_[own]));
  neighbours_.push_back({d, offset, offset / std::sqrt(squared), seed});
}

void WeightedCells::append(size_t own, double from, double to) {
  const size_t first = neighbours_.size();
  block_.refill(walked_, own, to);
  if (walked_.count() > VoronoiCell::max_planes) {
    for (uint32_t i = 0; i < lifts_.size(); ++i)
      if (i != own) take(own, i, from, to);
  } else {
    for (size_t i = 0; i < walked_.count(); ++i) take(own, walked_.planes().seed[i], from, to);
  }
  std::sort(neighbours_.begin() + static_cast<ptrdiff_t>(first), neighbours_.end(),
            [](const Neighbour& a, const Neighbour& b) {
              return a.plane < b.plane || (a.plane == b.plane && a.seed < b.seed);
            });
}

bool WeightedCells::keep_planes(size_t own, double reach) {
  VoronoiCell::Planes& planes = walked_.planes();
  const Vec3 seed = block_.position(own);
  size_t count = 0;
  before_ = 0;
  for (size_t i = 0; i < planes.count; ++i) {
    const uint32_t other = planes.seed[i];
    const Vec3 d = block_.position(other) - seed;
    const double squared = dot(d, d), offset = 0.5 * (squared + (lifts_[other] - lifts_[own]));
    if (!(offset > 0)) return false;
    if (offset * offset > reach * reach * squared) continue;
    planes.x[count] = static_cast<float>(d.x);
    planes.y[count] = static_cast<float>(d.y);
    planes.z[count] = static_cast<float>(d.z);
    planes.offset[count] = static_cast<float>(offset);
    planes.seed[count] = other;
    ++count;
    before_ += other < own;
  }
  planes.count = count;
  return true;
}

bool WeightedCells::walk(size_t own) {
  const double lift = lifts_[own];
  double reach = std::sqrt(
      std::max(0.5 * typical_squared_, typical_squared_ + reach_per_weight * weight_squared_ +
                                           reach_per_lift * (weight_squared_ * (2.0 / 3) - lift)));
  // As far as D goes.
  const double most = max_first_distance * std::sqrt(typical_squared_ / 1.1875);
  reach = std::min(reach, 0.5 * (most - lift / most));
  for (int tries = 0; tries < 3; ++tries) {
    const double distance = reach + std::sqrt(reach * reach + lift) + plane_slack;
    block_.refill(walked_, own, std::min(max_squared_, distance * distance));
    if (walked_.count() > VoronoiCell::max_planes) return false;
    if (!keep_planes(own, reach + plane_slack)) return false;
    if (!walked_.walk_power(lifts_.data(), lift)) return false;
    const double farthest = std::sqrt(walked_.radius_squared()) + plane_slack;
    if (farthest <= reach) return true;
    reach = farthest * (1 + 1e-6);
  }
  return false;
}

WeightedCells::Found WeightedCells::find(size_t own) {
  return walk(own) ? Found::walked : cut(own);
}

WeightedCells::Found WeightedCells::cut(size_t own) {
  neighbours_.clear();
  // All points of the cell are within the empty radius of the seed: the cube cuts off nothing.
  clipped_.start(1.001 * empty_radius_);
  double farthest = empty_radius_, done = -1;
  for (double reach = std::min(first_squared_, max_squared_);;) {
    size_t next = neighbours_.size();
    append(own, done, reach);
    for (; next < neighbours_.size(); ++next) {
      const Neighbour& n = neighbours_[next];
      if (n.plane > farthest + plane_slack) {
        // The planes of the cell are numbered by cuts.
        neighbours_.resize(next);
        break;
      }
      if (!clipped_.cut(n.position, n.offset)) {
        if (clipped_.is_empty()) return Found::none;
        neighbours_.clear();
        append(own, -1, max_squared_);
        return Found::unknown;
      }
      if (clipped_.made() == clipped_.vertices().size()) continue;
      double squared = 0;
      for (const ClippedCell::Vertex& vertex : clipped_.vertices())
        if (vertex.is_there) squared = std::max(squared, dot(vertex.position, vertex.position));
      farthest = std::min(empty_radius_, std::sqrt(squared));
    }
    const double needed = farthest + std::sqrt(farthest * farthest + lifts_[own]) + plane_slack;
    if (reach >= std::min(max_squared_, needed * needed)) return Found::cell;
    done = reach;
    reach = std::min(max_squared_, needed * needed * (1 + 1e-6));
  }
}

}  // namespace msq
