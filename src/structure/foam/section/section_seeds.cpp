// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/section/section_seeds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/borrowed.h"
#include "base/job.h"
#include "structure/foam/seeds/seed_trees.h"

namespace msq {

namespace {

/// Seeds of a section: 1.6 GB of them.
constexpr double max_seeds = 0x1p26;

class Search {
 public:
  Search(const SectionFoam& foam, double z, const Box2& window)
      : foam_(foam),
        grid_(foam.grid),
        z_(z),
        reach_(length(grid_.cell_size)),
        area_(window.grown(3 * reach_)) {
    found_.reach = reach_;
  }

  SectionSeeds find();

 private:
  /// Cells [first, last] of a row that may hold seeds in question; none if first > last.
  struct Row {
    double first, last;
  };
  Row row(double cell_y, double cell_z) const;
  void reserve(double expected);
  void visit(CellIndex cell);
  void visit_tree(CellIndex cell);
  void add(CellIndex cell, Vec3 in_cell);

  const SectionFoam& foam_;
  const Neighbourhood& grid_;
  const double z_, reach_;
  const Box2 area_;
  SectionSeeds found_;
};

Search::Row Search::row(double cell_y, double cell_z) const {
  const Vec3 size = grid_.cell_size;
  const auto& m = grid_.rotation.m;
  const double low[3] = {area_.min.x, area_.min.y, z_ - reach_};
  const double high[3] = {area_.max.x, area_.max.y, z_ + reach_};
  double first = -std::numeric_limits<double>::infinity(), last = -first;
  for (size_t axis = 0; axis < 3; ++axis) {
    // The model coordinate of a point of the row is `at` + `slope` * (cells along the row), give or
    // take `half`.
    const double along_y = m[3 * axis + 1] * size.y, along_z = m[3 * axis + 2] * size.z;
    const double at =
        grid_.origin[static_cast<int>(axis)] + along_y * (cell_y + 0.5) + along_z * (cell_z + 0.5);
    const double half = 0.5 * (std::abs(along_y) + std::abs(along_z)) + 1e-6 * reach_;
    const double slope = m[3 * axis] * size.x;
    const double from = low[axis] - half - at, to = high[axis] + half - at;
    if (slope == 0) {
      if (from > 0 || to < 0) return {0, -1};
      continue;
    }
    first = std::max(first, std::min(from / slope, to / slope));
    last = std::min(last, std::max(from / slope, to / slope));
  }
  return {std::floor(first), std::floor(last)};
}

void Search::reserve(double expected) {
  if (!(expected < max_seeds))
    fail(Status::limit, "the window meets about %g seeds of the foam; the limit is %g", expected,
         max_seeds);
  const size_t count = static_cast<size_t>(1.1 * expected) + 1000;
  found_.memory = Reservation(foam_.context.budget, count * (sizeof(SectionSeed) + 8),
                              "the seeds about a section");
  found_.seeds.reserve(count);
}

void Search::add(CellIndex cell, Vec3 in_cell) {
  const Vec3 g = Vec3{cell.x + in_cell.x, cell.y + in_cell.y, cell.z + in_cell.z} * grid_.cell_size;
  const Vec3 p = grid_.from_grid(g);
  const double above = p.z - z_;
  if (std::abs(above) > reach_ || !area_.contains({p.x, p.y})) return;
  if (static_cast<double>(found_.seeds.size()) >= max_seeds)
    fail(Status::limit, "the window meets more than %g seeds of the foam", max_seeds);
  found_.seeds.push_back({{p.x, p.y}, above * above});
}

void Search::visit(CellIndex cell) {
  add(cell, foam_.seeds.fractions(foam_.seeds.bits(cell)));
}

void Search::visit_tree(CellIndex cell) {
  const Vec3 size = grid_.cell_size, scale = foam_.seeds.scale();
  const Vec3 corner = Vec3{double(cell.x), double(cell.y), double(cell.z)} * size;
  // A point of the plane whose nearest seed is in the cell is within `reach_` of the cell, and its
  // own leaf's diagonal is the most that this distance can be.
  const Box3 about = Box3{corner, corner + size}.grown(reach_);
  const double near = std::ldexp(reach_, -foam_.graded->min_level(about));
  const auto& m = grid_.rotation.m;
  const auto wanted = [&](const Box3& box) {
    const Vec3 centre = (box.min + box.max) * (0.5 * foam_.unit);
    const Vec3 half = box.extent() * (0.5 * foam_.unit);
    const double z = grid_.from_grid(corner + centre).z;
    const double room = std::abs(m[6]) * half.x + std::abs(m[7]) * half.y + std::abs(m[8]) * half.z;
    return std::abs(z - z_) <= (near + room) * (1 + 1e-9);
  };
  const Borrowed<SeedTrees> trees;
  trees->move_to(foam_.graded);
  const Vec3 middle = scale * 0.5;
  trees->visit(cell, Box3{middle, middle}, wanted, [&](const LeafSeed& leaf) {
    add(cell, {leaf.position.x / scale.x, leaf.position.y / scale.y, leaf.position.z / scale.z});
  });
}

SectionSeeds Search::find() {
  const Vec3 size = grid_.cell_size;
  const Box3 asked = grid_.to_grid(
      Box3{{area_.min.x, area_.min.y, z_ - reach_}, {area_.max.x, area_.max.y, z_ + reach_}});
  for (int axis = 0; axis < 3; ++axis) {
    const double low = asked.min[axis] / size[axis], high = asked.max[axis] / size[axis];
    if (!(low > -max_cell_index && high < max_cell_index))
      fail(Status::limit,
           "the section reaches from cell %g to cell %g along axis %d; the limit is %g cells from "
           "the grid's origin",
           std::floor(low), std::floor(high), axis, max_cell_index);
  }
  const Vec2 extent = area_.extent();
  const double cells = extent.x * extent.y * 2 * reach_ / (size.x * size.y * size.z);
  reserve(foam_.graded ? std::min(cells, max_seeds / 2) : cells);
  JobPoll poll(current_job());
  for (double z = std::floor(asked.min.z / size.z); z <= asked.max.z / size.z; ++z)
    for (double y = std::floor(asked.min.y / size.y); y <= asked.max.y / size.y; ++y) {
      const Row row = this->row(y, z);
      poll();
      for (double x = row.first; x <= row.last; ++x) {
        const CellIndex cell{static_cast<int32_t>(x), static_cast<int32_t>(y),
                             static_cast<int32_t>(z)};
        poll();
        foam_.graded ? visit_tree(cell) : visit(cell);
      }
    }
  return std::move(found_);
}

}  // namespace

SectionSeeds find_section_seeds(const SectionFoam& foam, double z, const Box2& window) {
  return Search(foam, z, window).find();
}

}  // namespace msq
