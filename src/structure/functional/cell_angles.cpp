// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/cell_angles.h"

#include <algorithm>
#include <cmath>

namespace msq {

Neighbourhood smallest_cells(Neighbourhood grid, const std::optional<GradedPeriod>& period) {
  if (period) grid.cell_size[period->axis()] = period->smallest();
  return grid;
}

double largest_cell(const Neighbourhood& grid, const std::optional<GradedPeriod>& period) {
  Vec3 size = grid.cell_size;
  if (period) size[period->axis()] = period->largest();
  return max_component(size);
}

Vec3 CellAngles::fraction(Vec3 p) const {
  Vec3 fraction = grid_.locate(p).fraction;
  if (period_) {
    const double u = period_->cells(position(p));
    fraction[period_->axis()] = u - std::floor(u);
  }
  return fraction;
}

void CellAngles::find(Values x, Values y, Values z, size_t count,
                      double* const (&angles)[3]) const {
  find_angles(grid_, x, y, z, count, angles);
  if (!period_) return;
  double* const to = angles[period_->axis()];
  for (size_t i = 0; i < count; ++i) {
    const double u = period_->cells(position({x[i], y[i], z[i]}));
    to[i] = angle_of(u - std::floor(u));
  }
}

CellIndex CellAngles::cell_of(Vec3 p) const {
  CellIndex cell = grid_.locate(p).cell;
  if (!period_) return cell;
  const int32_t number = static_cast<int32_t>(std::floor(period_->cells(position(p))));
  (period_->axis() == 0 ? cell.x : period_->axis() == 1 ? cell.y : cell.z) = number;
  return cell;
}

Vec3 CellAngles::sizes(Vec3 p) const {
  Vec3 sizes = grid_.cell_size;
  if (period_) sizes[period_->axis()] = 1 / period_->frequency(position(p));
  return sizes;
}

double CellAngles::error(Vec3 p, double distance) const {
  if (!period_) return 0;
  return period_->error(std::abs(period_->cells(position(p))) + distance * period_->most());
}

}  // namespace msq
