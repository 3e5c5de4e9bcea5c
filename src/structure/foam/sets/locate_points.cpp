// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/sets/locate_points.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/simd.h"
#include "structure/foam/sets/locate_points.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

// Operations and their order are those of Neighbourhood::locate(). Handles whole vectors of points
// only; returns the number of points handled.
size_t locate_vectors(const Neighbourhood& grid, Vec3 scale, const double* points, size_t count,
                      int32_t* const (&cell)[3], double* const (&place)[3]) {
  const hn::ScalableTag<double> d;
  const hn::Rebind<int32_t, decltype(d)> di;
  const size_t lanes = hn::Lanes(d);
  const auto& m = grid.rotation.m;
  size_t i = 0;
  for (; i + lanes <= count; i += lanes) {
    auto x = hn::Undefined(d), y = hn::Undefined(d), z = hn::Undefined(d);
    hn::LoadInterleaved3(d, points + 3 * i, x, y, z);
    x = hn::Sub(x, hn::Set(d, grid.origin.x));
    y = hn::Sub(y, hn::Set(d, grid.origin.y));
    z = hn::Sub(z, hn::Set(d, grid.origin.z));
    for (int axis = 0; axis < 3; ++axis) {
      const auto g = hn::Add(hn::Add(hn::Mul(hn::Set(d, m[static_cast<size_t>(axis)]), x),
                                     hn::Mul(hn::Set(d, m[static_cast<size_t>(axis) + 3]), y)),
                             hn::Mul(hn::Set(d, m[static_cast<size_t>(axis) + 6]), z));
      const auto c = hn::Div(g, hn::Set(d, grid.cell_size[axis]));
      const auto floor = hn::Floor(c);
      hn::StoreU(hn::DemoteTo(di, floor), di, cell[axis] + i);
      hn::StoreU(hn::Mul(hn::Sub(c, floor), hn::Set(d, scale[axis])), d, place[axis] + i);
    }
  }
  return i;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(locate_vectors);

void LocatedPoints::locate(const Neighbourhood& grid, Vec3 scale, const Vec3* points,
                           size_t count) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  for (std::vector<int32_t>& cells : cell)
    if (cells.size() < count) cells.resize(count);
  for (std::vector<double>& places : place)
    if (places.size() < count) places.resize(count);
  int32_t* const cells[3] = {cell[0].data(), cell[1].data(), cell[2].data()};
  double* const places[3] = {place[0].data(), place[1].data(), place[2].data()};
  size_t done = 0;
  if (count > 0)
    done = HWY_DYNAMIC_DISPATCH(locate_vectors)(grid, scale, &points[0].x, count, cells, places);
  if (done == count) return;
  Vec3 rest[max_simd_doubles];
  std::copy(points + done, points + count, rest);
  int32_t rest_cell[3][max_simd_doubles];
  double rest_place[3][max_simd_doubles];
  int32_t* const rest_cells[3] = {rest_cell[0], rest_cell[1], rest_cell[2]};
  double* const rest_places[3] = {rest_place[0], rest_place[1], rest_place[2]};
  HWY_DYNAMIC_DISPATCH(locate_vectors)
  (grid, scale, &rest[0].x, max_simd_doubles, rest_cells, rest_places);
  for (int axis = 0; axis < 3; ++axis) {
    std::copy(rest_cell[axis], rest_cell[axis] + (count - done), cells[axis] + done);
    std::copy(rest_place[axis], rest_place[axis] + (count - done), places[axis] + done);
  }
}

}  // namespace msq
#endif  // HWY_ONCE
