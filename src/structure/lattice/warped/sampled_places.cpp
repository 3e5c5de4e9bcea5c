// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/warped/sampled_places.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/infinity.h"
#include "base/job.h"
#include "base/status.h"
#include "structure/lattice/graph/lattice_graph.h"

namespace msq {

namespace {

bool precedes(Vec3 a, Vec3 b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

constexpr Vec3 nowhere() {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {none, none, none};
}

}  // namespace

void SampledPlaces::Bounds::add(const Bounds& other) {
  for (int axis = 0; axis < 3; ++axis) {
    min[axis] = std::min(min[axis], other.min[axis]);
    max[axis] = std::max(max[axis], other.max[axis]);
  }
}

bool SampledPlaces::Bounds::overlaps(const Box3& box) const {
  for (int axis = 0; axis < 3; ++axis)
    if (!(double{min[axis]} <= box.max[axis] && double{max[axis]} >= box.min[axis])) return false;
  return true;
}

Box3 SampledPlaces::Bounds::box(double unit) const {
  return {Vec3{min[0], min[1], min[2]} * unit, Vec3{max[0], max[1], max[2]} * unit};
}

SampledPlaces::SampledPlaces(std::shared_ptr<const SampledMap> map, const UnitCell& cell,
                             std::shared_ptr<MemoryBudget> budget)
    : map_(std::move(map)),
      smallest_(map_->smallest()),
      side_(map_->mean_size()),
      unit_(std::ldexp(1.0, std::ilogb(side_))) {
  const LatticeGraph graph({cell});
  for (uint32_t n = 0; n < graph.node_count(); ++n) fractions_.push_back(graph.node(n));
  std::sort(fractions_.begin(), fractions_.end(), precedes);
  fractions_.erase(std::unique(fractions_.begin(), fractions_.end()), fractions_.end());
  // A strut may belong to the cell before that of its nodes.
  const SampledMap::Cells of_map = map_->cells();
  first_ = {of_map.first.x - 1, of_map.first.y - 1, of_map.first.z - 1};
  Level cells;
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    cells.size[axis] = of_map.count[axis] + 1;
    count *= static_cast<double>(cells.size[axis]);
  }
  if (!(count <= max_cells))
    fail(Status::limit,
         "warp.u, v and w run over %g cells; the limit for lattices, whose nodes are placed one by "
         "one, is %g",
         count, max_cells);
  const auto size = static_cast<uint64_t>(count);
  reservation_ =
      Reservation(std::move(budget), size * (fractions_.size() * sizeof(Vec3) + 2 * sizeof(Bounds)),
                  "nodes of a sampled map");
  levels_.push_back(std::move(cells));
  nodes_.assign(size * fractions_.size(), nowhere());
  place_nodes();
  bound_cells();
}

void SampledPlaces::place_nodes() {
  const Level& cells = levels_[0];
  SampledMap::SearchCost cost(nodes_.size());
  size_t n = 0;
  for (uint64_t z = 0; z < cells.size[2]; ++z)
    for (uint64_t y = 0; y < cells.size[1]; ++y) {
      check_cancelled();
      for (uint64_t x = 0; x < cells.size[0]; ++x) {
        const Vec3 corner{first_.x + static_cast<double>(x), first_.y + static_cast<double>(y),
                          first_.z + static_cast<double>(z)};
        for (const Vec3 fraction : fractions_) {
          Vec3 g;
          if (map_->find(corner + fraction, g, cost)) nodes_[n] = g;
          ++n;
        }
      }
    }
}

void SampledPlaces::bound_cells() {
  constexpr auto most = std::numeric_limits<float>::infinity();
  const Bounds none{{most, most, most}, {-most, -most, -most}};
  // Of the nodes that each cell owns, then of those and the ones of the cells beyond.
  Level& cells = levels_[0];
  const uint64_t count = cells.size[0] * cells.size[1] * cells.size[2];
  std::vector<Bounds> own(count, none);
  for (uint64_t c = 0; c < count; ++c)
    for (size_t n = 0; n < fractions_.size(); ++n) {
      const Vec3 g = nodes_[c * fractions_.size() + n];
      if (!is_finite(g)) continue;
      Bounds at;
      for (int axis = 0; axis < 3; ++axis) {
        const auto value = static_cast<float>(g[axis] / unit_);
        at.min[axis] = std::nextafter(value, -most);
        at.max[axis] = std::nextafter(value, most);
      }
      own[c].add(at);
    }
  cells.bounds.assign(count, none);
  for (uint64_t z = 0; z < cells.size[2]; ++z)
    for (uint64_t y = 0; y < cells.size[1]; ++y)
      for (uint64_t x = 0; x < cells.size[0]; ++x) {
        Bounds& all = cells.bounds[(z * cells.size[1] + y) * cells.size[0] + x];
        for (unsigned corner = 0; corner < 8; ++corner) {
          const uint64_t at[3] = {x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)};
          if (at[0] < cells.size[0] && at[1] < cells.size[1] && at[2] < cells.size[2])
            all.add(own[(at[2] * cells.size[1] + at[1]) * cells.size[0] + at[0]]);
        }
      }
  while (levels_.back().bounds.size() > 1) {
    const Level& fine = levels_.back();
    Level level;
    for (int axis = 0; axis < 3; ++axis) level.size[axis] = (fine.size[axis] + 1) / 2;
    level.bounds.assign(level.size[0] * level.size[1] * level.size[2], none);
    for (uint64_t z = 0; z < fine.size[2]; ++z)
      for (uint64_t y = 0; y < fine.size[1]; ++y)
        for (uint64_t x = 0; x < fine.size[0]; ++x)
          level.bounds[(z / 2 * level.size[1] + y / 2) * level.size[0] + x / 2].add(
              fine.at(x, y, z));
    levels_.push_back(std::move(level));
  }
}

CellIndex SampledPlaces::cell_of(Vec3 g) const {
  const Vec3 cells = map_->cells_of(g);
  return {static_cast<int32_t>(std::floor(cells.x)), static_cast<int32_t>(std::floor(cells.y)),
          static_cast<int32_t>(std::floor(cells.z))};
}

CellIndex SampledPlaces::list_of(Vec3 g) const {
  // Points are limited in the smallest cells, which are smaller.
  return {static_cast<int32_t>(std::floor(g.x / side_)),
          static_cast<int32_t>(std::floor(g.y / side_)),
          static_cast<int32_t>(std::floor(g.z / side_))};
}

Box3 SampledPlaces::list_bounds(CellIndex list) const {
  const Vec3 first{double(list.x), double(list.y), double(list.z)};
  return {first * side_, (first + Vec3{1, 1, 1}) * side_};
}

bool SampledPlaces::index_of(CellIndex cell, uint64_t (&at)[3]) const {
  const int64_t from[3] = {int64_t{cell.x} - first_.x, int64_t{cell.y} - first_.y,
                           int64_t{cell.z} - first_.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (from[axis] < 0 || from[axis] >= static_cast<int64_t>(levels_[0].size[axis])) return false;
    at[axis] = static_cast<uint64_t>(from[axis]);
  }
  return true;
}

CellIndex SampledPlaces::nearest_with_struts(CellIndex cell) const {
  return cell;  // points have coordinates of the map
}

Vec3 SampledPlaces::place(CellIndex cell, Vec3 fraction) const {
  uint64_t at[3];
  if (!index_of(cell, at)) return nowhere();
  const auto known = std::lower_bound(fractions_.begin(), fractions_.end(), fraction, precedes);
  const Level& cells = levels_[0];
  const uint64_t number = (at[2] * cells.size[1] + at[1]) * cells.size[0] + at[0];
  return nodes_[number * fractions_.size() + static_cast<size_t>(known - fractions_.begin())];
}

Box3 SampledPlaces::bounds(const CellBlock& block) const {
  uint64_t at[3];
  const CellIndex first{static_cast<int32_t>(block.first[0]), static_cast<int32_t>(block.first[1]),
                        static_cast<int32_t>(block.first[2])};
  if (block.count() != 1) return levels_.back().bounds[0].box(unit_);
  if (!index_of(first, at))
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  return levels_[0].at(at[0], at[1], at[2]).box(unit_);
}

void SampledPlaces::visit(size_t level, const uint64_t (&block)[3], const Box3& box,
                          const TakeBlock& take) const {
  if (!levels_[level].at(block[0], block[1], block[2]).overlaps(box)) return;
  if (level == 0) {
    CellBlock cell;
    const int32_t first[3] = {first_.x, first_.y, first_.z};
    for (int axis = 0; axis < 3; ++axis)
      cell.first[axis] = cell.last[axis] = first[axis] + static_cast<double>(block[axis]);
    return take(cell);
  }
  const Level& fine = levels_[level - 1];
  for (unsigned part = 0; part < 8; ++part) {
    const uint64_t child[3] = {2 * block[0] + (part & 1), 2 * block[1] + (part >> 1 & 1),
                               2 * block[2] + (part >> 2)};
    if (child[0] < fine.size[0] && child[1] < fine.size[1] && child[2] < fine.size[2])
      visit(level - 1, child, box, take);
  }
}

void SampledPlaces::for_each_block(const Box3& box, const TakeBlock& take) const {
  const uint64_t root[3] = {0, 0, 0};
  visit(levels_.size() - 1, root, {box.min * (1 / unit_), box.max * (1 / unit_)}, take);
}

}  // namespace msq
