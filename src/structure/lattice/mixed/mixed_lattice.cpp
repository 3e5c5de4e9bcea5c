// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/mixed/mixed_lattice.h"

#include <algorithm>
#include <limits>

#include "structure/common/group_by_cell.h"
#include "structure/common/strut_distance_bound.h"
#include "structure/common/strut_rows.h"
#include "structure/lattice/cell/may_reach.h"

namespace msq {

namespace {

/// As in lattice.cpp.
constexpr double critical_samples = 4;

CellIndex moved(CellIndex cell, const int (&offset)[3]) {
  return {cell.x + offset[0], cell.y + offset[1], cell.z + offset[2]};
}

bool is_same_strut(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const auto close = [](Vec3 p, Vec3 q) { return max_magnitude(p - q) <= same_node; };
  return (close(a, c) && close(b, d)) || (close(a, d) && close(b, c));
}

}  // namespace

MixedLattice::MixedLattice(const Neighbourhood& neighbourhood, std::vector<UnitCell> library,
                           Parameter choice, Parameter radius)
    : Structure(neighbourhood),
      library_(std::move(library)),
      graph_(library_),
      choice_(std::move(choice)),
      radius_(std::move(radius)) {
  const Vec3 size = neighbourhood.cell_size;
  for (const UnitCell& cell : library_) {
    const uint32_t begin = static_cast<uint32_t>(struts_.size());
    for (size_t s = 0; s < cell.struts.size(); ++s) {
      const Vec3 a = cell.nodes[cell.struts[s][0]], b = cell.nodes[cell.struts[s][1]];
      struts_.push_back({a, b, cell.factor(s), Segment(a * size, b * size)});
      factors_.push_back(cell.factor(s));
    }
    std::stable_sort(struts_.begin() + begin, struts_.end(),
                     [](const OwnStrut& s, const OwnStrut& t) { return s.factor > t.factor; });
    own_runs_.push_back({begin, static_cast<uint32_t>(struts_.size())});
  }
  std::sort(factors_.begin(), factors_.end(), std::greater<>());
  factors_.erase(std::unique(factors_.begin(), factors_.end()), factors_.end());
  max_factor_ = factors_[0];
  reach_ = 2 * min_component(size) + max_factor_ * radius_.range().high;
  find_neighbours();
  find_copies();
}

void MixedLattice::find_neighbours() {
  const Vec3 size = neighbourhood().cell_size;
  const double most = max_factor_ * radius_.range().high * (1 + 1e-6) + 1e-6 * max_component(size);
  int around[3];
  for (int axis = 0; axis < 3; ++axis)
    around[axis] = 1 + static_cast<int>(std::floor(reach_ * (1 + 1e-9) / size[axis]));
  for (int k = -around[2]; k <= around[2]; ++k)
    for (int j = -around[1]; j <= around[1]; ++j)
      for (int i = -around[0]; i <= around[0]; ++i) {
        const auto apart = [&](int n, int axis) {
          return std::max(0, std::abs(n) - 1) * size[axis];
        };
        const double gap = length({apart(i, 0), apart(j, 1), apart(k, 2)});
        if (gap <= reach_ * (1 + 1e-9)) neighbours_.push_back({{i, j, k}, gap});
      }
  const auto steps = [](const Neighbour& n) {
    return std::abs(n.offset[0]) + std::abs(n.offset[1]) + std::abs(n.offset[2]);
  };
  std::stable_sort(neighbours_.begin(), neighbours_.end(),
                   [&](const Neighbour& n, const Neighbour& m) {
                     return n.gap != m.gap ? n.gap < m.gap : steps(n) < steps(m);
                   });
  const Box3 box{{0, 0, 0}, size};
  for (const Neighbour& n : neighbours_) {
    if (n.gap > most) break;
    ++near_neighbours_;
    const Vec3 shift{double(n.offset[0]), double(n.offset[1]), double(n.offset[2])};
    for (size_t type = 0; type < library_.size(); ++type) {
      const uint32_t begin = static_cast<uint32_t>(near_.size());
      for (const OwnStrut& s : own(type)) {
        const Segment segment((s.a + shift) * size, (s.b + shift) * size);
        if (may_reach(segment, box, s.factor * radius_.range().high))
          near_.push_back({segment, s.factor});
      }
      near_runs_.push_back({begin, static_cast<uint32_t>(near_.size())});
    }
  }
}

/// If a strut is on a face of two cells, rows draw it once: the lower cell leaves it to the upper
/// one if that has it too, with the same thickness. copies_[(3 * strut + axis) * types + type]
/// tells whether a cell of that type, above along the axis, has it.
void MixedLattice::find_copies() {
  copies_.assign(3 * struts_.size() * library_.size(), 0);
  for (size_t s = 0; s < struts_.size(); ++s)
    for (int axis = 0; axis < 3; ++axis) {
      const OwnStrut& strut = struts_[s];
      if (std::min(strut.a[axis], strut.b[axis]) < 1 - same_node) continue;
      Vec3 up;
      up[axis] = 1;
      for (size_t type = 0; type < library_.size(); ++type)
        copies_[(3 * s + static_cast<size_t>(axis)) * library_.size() + type] =
            std::any_of(own(type).begin(), own(type).end(), [&](const OwnStrut& other) {
              return other.factor == strut.factor &&
                     is_same_strut(strut.a - up, strut.b - up, other.a, other.b);
            });
    }
}

size_t MixedLattice::type_of(CellIndex cell) const {
  const Neighbourhood& grid = neighbourhood();
  const Vec3 centre{cell.x + 0.5, cell.y + 0.5, cell.z + 0.5};
  const double nearest = std::floor(choice_.at(grid.from_grid(centre * grid.cell_size)) + 0.5);
  const double last = static_cast<double>(library_.size() - 1);
  return nearest > 0 ? static_cast<size_t>(std::min(nearest, last)) : 0;
}

bool MixedLattice::inside(Vec3 p) const {
  const double r = radius_.at(p);
  const Neighbourhood::Located located = neighbourhood().locate(p);
  const Vec3 q = located.fraction * neighbourhood().cell_size;
  for (size_t n = 0; n < near_neighbours_; ++n)
    for (const LatticeStrut& s : near(n, type_of(moved(located.cell, neighbours_[n].offset))))
      if (s.holds(q, r)) return true;
  return false;
}

void MixedLattice::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  std::vector<std::span<const LatticeStrut>> lists(near_neighbours_);
  for_each_cell(group_by_cell(neighbourhood(), points, alive, count),
                [&](CellIndex cell, std::span<const LocatedPoint> group) {
                  for (size_t n = 0; n < near_neighbours_; ++n)
                    lists[n] = near(n, type_of(moved(cell, neighbours_[n].offset)));
                  for (const LocatedPoint& point : group) {
                    const double r = radius_.at(points[point.index]);
                    const Vec3 q = point.located.fraction * neighbourhood().cell_size;
                    const auto holds = [&](const LatticeStrut& s) { return s.holds(q, r); };
                    alive[point.index] = std::any_of(lists.begin(), lists.end(), [&](auto list) {
                      return std::any_of(list.begin(), list.end(), holds);
                    });
                  }
                });
}

double MixedLattice::distance_bound(Vec3 p) const {
  const Vec3 size = neighbourhood().cell_size;
  const Neighbourhood::Located located = neighbourhood().locate(p);
  const Vec3 q = located.fraction * size;
  const Interval r = radius_.range(Box3{p, p});
  const double most = max_factor_ * r.low;
  // Struts farther than reach_ have larger gaps.
  double gap = reach_ - most;
  for (const Neighbour& n : neighbours_) {
    if (n.gap - most > gap) break;
    const Vec3 from =
        q - Vec3{double(n.offset[0]), double(n.offset[1]), double(n.offset[2])} * size;
    if (length(from - max({}, min(size, from))) - most > gap) continue;
    const auto struts = own(type_of(moved(located.cell, n.offset)));
    for (auto s = struts.begin(); s != struts.end();) {
      const double factor = s->factor;
      double squared = std::numeric_limits<double>::infinity();
      for (; s != struts.end() && s->factor == factor; ++s)
        squared = std::min(squared, s->axis.distance_squared(from));
      gap = std::min(gap, std::sqrt(squared) - factor * r.low);
    }
  }
  const double slack =
      locating_slack(p - neighbourhood().origin, reach_) + 0x1p-46 * (max_component(size) + reach_);
  return factored_distance_bound(gap, max_factor_, slack, radius_, p);
}

const MixedParts& MixedLattice::parts() const {
  return parts_.get([&] {
    std::vector<MixedParts::Neighbour> neighbours;
    for (size_t n = 0; n < near_neighbours_; ++n) {
      const int(&offset)[3] = neighbours_[n].offset;
      neighbours.push_back({{offset[0], offset[1], offset[2]}, {}});
      for (size_t type = 0; type < library_.size(); ++type)
        neighbours.back().near.push_back(near(n, type));
    }
    return std::make_unique<MixedParts>(neighbours, neighbourhood().cell_size,
                                        radius_.range().high);
  });
}

MixedPartLists MixedLattice::part_lists() const {
  return MixedPartLists(parts(), [this](CellIndex cell) { return type_of(cell); });
}

void MixedLattice::enter(RaySearch* searches, size_t count, const Job* job) const {
  MixedPartLists lists = part_lists();
  StrutRays(*this, lists, radius_, job).enter(searches, count);
}

double MixedLattice::leave(const Ray& ray, double from, double to, const Job* job) const {
  MixedPartLists lists = part_lists();
  return StrutRays(*this, lists, radius_, job).leave(ray, from, to);
}

Vec3 MixedLattice::normal(const Ray& ray, double t) const {
  MixedPartLists lists = part_lists();
  return StrutRays(*this, lists, radius_, nullptr).normal(ray, t);
}

void MixedLattice::keep_rows(const RowBlock& block, const Job* job) const {
  const Neighbourhood& grid = neighbourhood();
  StrutRows rows(block, grid, radius_, 1e-9 * max_factor_ * radius_.range().high, max_factor_);
  if (rows.empty()) return;
  if (!rows.pays(grid, critical_samples)) return Structure::keep_rows(block, job);
  const Box3 reach = grid.to_grid(rows.reach());
  int64_t first[3], last[3];
  size_t counts[3];
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = std::llround(std::floor(reach.min[axis] / grid.cell_size[axis] - 1e-6));
    last[axis] = std::llround(std::floor(reach.max[axis] / grid.cell_size[axis] + 1e-6));
    counts[axis] = static_cast<size_t>(last[axis] - first[axis] + 1);
  }
  struct Cell {
    Vec3 corner;
    size_t type;      // `types` if it is far from the rows
    size_t above[3];  // types of the cells above; `types` if they are out of range
  };
  std::vector<Cell> cells;
  const size_t types = library_.size(), steps[3] = {1, counts[0], counts[0] * counts[1]};
  // Most cells of the box about a turned block are far from it.
  const bool is_turned = grid.sample_axes()[0] < 0;
  const double slack = 1e-6 * max_component(grid.cell_size);
  for (int64_t k = first[2]; k <= last[2]; ++k) {
    check_cancelled(job);
    for (int64_t j = first[1]; j <= last[1]; ++j)
      for (int64_t i = first[0]; i <= last[0]; ++i) {
        const Vec3 corner{double(i), double(j), double(k)};
        const Box3 cell{corner * grid.cell_size, (corner + Vec3{1, 1, 1}) * grid.cell_size};
        const bool is_near = !is_turned || grid.from_grid(cell).grown(slack).overlaps(rows.reach());
        cells.push_back({corner,
                         is_near ? type_of({static_cast<int32_t>(i), static_cast<int32_t>(j),
                                            static_cast<int32_t>(k)})
                                 : types,
                         {types, types, types}});
      }
  }
  for (size_t c = 0; c < cells.size(); ++c)
    for (int axis = 0; axis < 3; ++axis)
      if (c / steps[axis] % counts[axis] + 1 < counts[axis])
        cells[c].above[axis] = cells[c + steps[axis]].type;
  for (const double factor : factors_) {
    size_t n = 0;
    for (const Cell& cell : cells) {
      if (n++ % 1024 == 0) check_cancelled(job);
      if (cell.type == types) continue;
      const auto struts = own(cell.type);
      auto s = std::lower_bound(struts.begin(), struts.end(), factor,
                                [](const OwnStrut& t, double f) { return t.factor > f; });
      for (; s != struts.end() && s->factor == factor; ++s) {
        bool is_left = false;
        const size_t strut = static_cast<size_t>(&*s - struts_.data());
        for (size_t axis = 0; axis < 3; ++axis)
          is_left |=
              cell.above[axis] < types && copies_[(3 * strut + axis) * types + cell.above[axis]];
        if (!is_left)
          rows.add(grid.from_grid((s->a + cell.corner) * grid.cell_size),
                   grid.from_grid((s->b + cell.corner) * grid.cell_size), factor);
      }
    }
  }
  rows.finish(job, [this](Vec3 p) { return inside(p); });
}

void MixedLattice::describe(HashInput& input) const {
  input.kind("structure: lattice of several cells");
  neighbourhood().describe(input);
  input.integer(library_.size());
  for (const UnitCell& cell : library_) cell.describe(input);
  choice_.describe(input);
  radius_.describe(input);
}

}  // namespace msq
