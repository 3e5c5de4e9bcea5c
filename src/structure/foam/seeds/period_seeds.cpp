// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/seeds/period_seeds.h"

#include <algorithm>
#include <cmath>

namespace msq {

namespace {

int32_t& component(CellIndex& cell, int axis) {
  return axis == 0 ? cell.x : axis == 1 ? cell.y : cell.z;
}

}  // namespace

PeriodSeeds::PeriodSeeds(const Neighbourhood& grid, GradedPeriod period, double jitter,
                         uint64_t seed)
    : grid_(period.resized(grid, period.largest() * (1 + room))),
      smallest_(period.resized(grid, period.smallest())),
      period_(std::move(period)),
      largest_(max_component(period_.resized(grid, period_.largest()).cell_size)),
      cells_(seed, jitter, {1, 1, 1}) {}

// A seed that is rounded into the box lies within it, up to the errors of its place. In cells they
// are at most the frequency times 2^-49 (n + |u|) largest cells: the ratio of the sizes times
// error(u). cells() is off by error(u), and the corner of the box by less.
PeriodSeeds::Range PeriodSeeds::cells_of(int32_t box) const {
  const double low = period_.cells(box * size()), high = period_.cells((box + 1.0) * size());
  const double slack = 1e-6 + 16 * std::max(period_.error(low), period_.error(high)) *
                                  period_.largest() / period_.smallest();
  return {static_cast<int32_t>(std::floor(low - slack)),
          static_cast<int32_t>(std::floor(high + slack))};
}

PlacedSeed PeriodSeeds::place(CellIndex cell) const {
  const int axis = period_.axis();
  const Vec3 f = cells_.fractions(cells_.bits(cell));
  const double s = period_.position_of(component(cell, axis) + f[axis]);
  const double boxes = s / size(), box = std::floor(boxes);
  component(cell, axis) = static_cast<int32_t>(box);
  PlacedSeed seed{cell, f, 0, 0};
  seed.in_box[axis] = place_in_box(boxes);
  // The nearest power of 8, as factors; max_ratio is below 64.
  seed.level = size() * period_.frequency(s) < 2.828 ? 0 : 1;
  return seed;
}

void PeriodSeeds::find(CellIndex box, std::vector<PlacedSeed>& seeds) const {
  const int axis = period_.axis();
  const Range range = cells_of(component(box, axis));
  for (int32_t at = range.first; at <= range.last; ++at) {
    CellIndex cell = box;
    component(cell, axis) = at;
    PlacedSeed seed = place(cell);
    if (!(seed.box == box)) continue;
    seed.number = static_cast<uint32_t>(at - range.first);
    seeds.push_back(seed);
  }
}

CellIndex PeriodSeeds::cell_of(CellIndex box, uint32_t number) const {
  const int axis = period_.axis();
  component(box, axis) = cells_of(component(box, axis)).first + static_cast<int32_t>(number);
  return box;
}

PlacedSeed PeriodSeeds::seed(CellIndex box, uint32_t number) const {
  PlacedSeed seed = place(cell_of(box, number));
  seed.number = number;
  return seed;
}

CellIndex PeriodSeeds::cell_of(Vec3 g) const {
  int32_t cell[3];
  for (int axis = 0; axis < 3; ++axis)
    cell[axis] = static_cast<int32_t>(std::floor(
        axis == period_.axis() ? period_.cells(g[axis]) : g[axis] / grid_.cell_size[axis]));
  return {cell[0], cell[1], cell[2]};
}

PlacedSeed PeriodSeeds::near(Vec3 g) const {
  const int axis = period_.axis();
  CellIndex cell = cell_of(g);
  PlacedSeed seed = place(cell);
  const int32_t first = cells_of(component(seed.box, axis)).first;
  seed.number = static_cast<uint32_t>(component(cell, axis) - first);
  return seed;
}

// The cell of a point has a place with its mean frequency within its length of the point.
double PeriodSeeds::max_distance(const Box3& box) const {
  const int axis = period_.axis();
  const double most = period_.largest() * (1 + room);
  Vec3 size = grid_.cell_size;
  size[axis] =
      1 / period_.over({box.min[axis] - most, box.max[axis] + most}).least + 0x1p-18 * this->size();
  return std::min(length(size), length(grid_.cell_size)) * (1 + 1e-9);
}

Interval PeriodSeeds::density(const Box3& box) const {
  const int axis = period_.axis();
  const GradedPeriod::Bounds bounds = period_.over({box.min[axis], box.max[axis]});
  return {size() * bounds.least, size() * bounds.most};
}

}  // namespace msq
