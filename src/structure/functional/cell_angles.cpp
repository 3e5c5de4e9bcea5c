// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/cell_angles.h"

#include <algorithm>
#include <cmath>

#include "base/borrowed.h"
#include "structure/common/make_shell.h"
#include "structure/functional/map_places.h"
#include "structure/functional/warped_places.h"

namespace msq {

namespace {

Vec3 fraction_of(Vec3 cells) {
  return {cells.x - std::floor(cells.x), cells.y - std::floor(cells.y),
          cells.z - std::floor(cells.z)};
}

}  // namespace

Neighbourhood smallest_cells(Neighbourhood grid, const CellShape& shape) {
  if (shape.sampled) return shape.sampled->smallest();
  if (shape.period) grid.cell_size[shape.period->axis()] = shape.period->smallest();
  if (shape.warp) {
    grid.cell_size.y = grid.cell_size.x;
    if (shape.warp->kind() == Warp::Kind::spherical) grid.cell_size.z = grid.cell_size.x;
  }
  return grid;
}

double largest_cell(const Neighbourhood& grid, const CellShape& shape) {
  if (shape.sampled) return shape.sampled->largest_size();
  Vec3 size = smallest_cells(grid, shape).cell_size;
  if (shape.period) size[shape.period->axis()] = shape.period->largest();
  return max_component(size);
}

Vec3 CellAngles::fraction(Vec3 p) const {
  if (warp_) return warp_->locate(warp_->to_cells(p)).fraction;
  if (sampled_) return fraction_of(sampled_->to_cells(p));
  Vec3 fraction = grid_.locate(p).fraction;
  if (period_) {
    const double u = period_->cells(position(p));
    fraction[period_->axis()] = u - std::floor(u);
  }
  return fraction;
}

void CellAngles::find(Values x, Values y, Values z, size_t count,
                      double* const (&angles)[3]) const {
  if (warp_) {
    const Borrowed<std::vector<double>> radii;
    radii->resize(count + batch_padding);
    return find_warped_places(*warp_, x, y, z, count, angles, radii->data());
  }
  if (sampled_) return find_map_places(*sampled_, x, y, z, count, angles, nullptr);
  find_angles(grid_, x, y, z, count, angles);
  if (!period_) return;
  double* const to = angles[period_->axis()];
  for (size_t i = 0; i < count; ++i) {
    const double u = period_->cells(position({x[i], y[i], z[i]}));
    to[i] = angle_of(u - std::floor(u));
  }
}

std::unique_ptr<const CellShell> CellAngles::shell() const {
  return make_shell(warp_, sampled_);
}

CellIndex CellAngles::cell_of(Vec3 p) const {
  if (warp_) return warp_->locate(warp_->to_cells(p)).cell;
  if (sampled_) {
    const Vec3 cells = sampled_->to_cells(p);
    return {static_cast<int32_t>(std::floor(cells.x)), static_cast<int32_t>(std::floor(cells.y)),
            static_cast<int32_t>(std::floor(cells.z))};
  }
  CellIndex cell = grid_.locate(p).cell;
  if (!period_) return cell;
  const int32_t number = static_cast<int32_t>(std::floor(period_->cells(position(p))));
  (period_->axis() == 0 ? cell.x : period_->axis() == 1 ? cell.y : cell.z) = number;
  return cell;
}

Vec3 CellAngles::gradient(Vec3 p, Vec3 by_angle) const {
  if (is_mapped()) {
    const std::array<Vec3, 3> of_cells = warp_ ? warp_->gradients(p) : sampled_->gradients(p);
    return (of_cells[0] * by_angle.x + of_cells[1] * by_angle.y + of_cells[2] * by_angle.z) *
           two_pi;
  }
  Vec3 sizes = grid_.cell_size;
  if (period_) sizes[period_->axis()] = 1 / period_->frequency(position(p));
  return grid_.rotation.apply({two_pi * by_angle.x / sizes.x, two_pi * by_angle.y / sizes.y,
                               two_pi * by_angle.z / sizes.z});
}

double CellAngles::error(Vec3 p, double distance) const {
  if (!period_) return 0;
  return period_->error(std::abs(period_->cells(position(p))) + distance * period_->most());
}

}  // namespace msq
