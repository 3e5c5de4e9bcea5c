// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/joints/named_seeds.h"

#include <algorithm>
#include <cmath>

#include "structure/foam/seeds/graded_seed_name.h"

namespace msq {

void NamedSeeds::move_to(const FoamSeeds& seeds, const std::shared_ptr<const GradedSeeds>& graded,
                         CellIndex corner, int side) {
  graded_ = graded.get();
  corner_ = corner;
  scale_ = seeds.scale();
  empty_radius_ = seeds.empty_radius();
  if (graded_) return trees_.move_to(graded);
  // Points are within the empty radius of a seed of the brick, and so are their nearest seeds from
  // them.
  for (int axis = 0; axis < 3; ++axis) {
    // One cell more than twice the empty radius: find() allows a little more.
    halo_[axis] = static_cast<int>(std::ceil(2 * seeds.empty_radius() / scale_[axis])) + 1;
    size_[axis] = static_cast<size_t>(side + 2 * halo_[axis]);
  }
  in_cell_.resize(size_[0] * size_[1] * size_[2]);
  lifts_.resize(seeds.is_weighted() ? in_cell_.size() : 0);
  size_t i = 0;
  for (int z = -halo_[2]; z < side + halo_[2]; ++z)
    for (int y = -halo_[1]; y < side + halo_[1]; ++y) {
      const uint64_t row = seeds.row_key(corner, y, z);
      for (int x = -halo_[0]; x < side + halo_[0]; ++x, ++i) {
        const uint64_t bits = splitmix_output(row, static_cast<uint32_t>(corner.x + x));
        in_cell_[i] = seeds.fractions(bits);
        if (!lifts_.empty()) lifts_[i] = seeds.lift(bits);
      }
    }
}

void NamedSeeds::find(Vec3 p, double more, std::vector<NamedSeed>& near) {
  near.clear();
  if (graded_) return find_graded(p, more, near);
  const auto cell_of = [&](double at, int axis) {
    const int last = static_cast<int>(size_[axis]) - halo_[axis] - 1;
    return std::clamp(static_cast<int>(std::floor(at / scale_[axis])), -halo_[axis], last);
  };
  const auto squared_to = [&](int x, int y, int z) {
    const Vec3 d = (Vec3{double(x), double(y), double(z)} + in_cell(x, y, z)) * scale_ - p;
    return dot(d, d) + lift(x, y, z);
  };
  const int own[3] = {cell_of(p.x, 0), cell_of(p.y, 1), cell_of(p.z, 2)};
  double least = squared_to(own[0], own[1], own[2]);
  found_.clear();
  // The seed of the point's own cell bounds the search, and the first search bounds the next.
  const auto search = [&](double reach, bool keep) {
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = cell_of(p[axis] - reach, axis);
      last[axis] = cell_of(p[axis] + reach, axis);
    }
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) {
          const double squared = squared_to(x, y, z);
          least = std::min(least, squared);
          if (keep) found_.push_back({squared, {x, y, z}});
        }
  };
  search(std::min(std::sqrt(least), 0.5 * min_component(scale_)), false);
  search(std::sqrt(least) + more, true);
  const double reach = std::sqrt(least) + more;
  for (const Found& found : found_)
    if (found.squared <= reach * reach) {
      const auto [x, y, z] = found.cell;
      near.push_back(
          {{corner_.x + x, corner_.y + y, corner_.z + z}, 0, in_cell(x, y, z), lift(x, y, z)});
    }
}

void NamedSeeds::find_graded(Vec3 p, double more, std::vector<NamedSeed>& near) {
  const Vec3 cells{std::floor(p.x / scale_.x), std::floor(p.y / scale_.y),
                   std::floor(p.z / scale_.z)};
  const CellIndex home{corner_.x + static_cast<int32_t>(cells.x),
                       corner_.y + static_cast<int32_t>(cells.y),
                       corner_.z + static_cast<int32_t>(cells.z)};
  const Vec3 q = p - cells * scale_;
  LeafSeed nearest = trees_.at(home, q);
  const Vec3 d = nearest.position - q;
  double squared = dot(d, d);
  trees_.nearest(home, q, squared, nearest, [](const LeafSeed&) { return true; });
  const double reach = std::sqrt(squared) + more, reach_squared = reach * reach;
  trees_.visit(
      home, Box3{q, q}.grown(reach + near_slack),
      [&](const Box3& box) { return min_squared(box, q) <= reach_squared + near_slack; },
      [&](const LeafSeed& seed) {
        const Vec3 away = seed.position - q;
        if (dot(away, away) > reach_squared) return;
        const GradedSeedName name = name_of(seed);
        const NamedLeafSeed leaf = seed_of(*graded_, home, name);
        near.push_back({leaf.cell, uint32_t{name.order} << 3 | name.level, leaf.in_cell});
      });
}

}  // namespace msq
