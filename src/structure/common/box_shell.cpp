// SPDX-License-Identifier: Apache-2.0
#include "structure/common/box_shell.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"

namespace msq {

BoxClass BoxShell::classify(const Box3& box) const {
  switch (map_->side_of(box)) {
    case SampledMap::Side::outside:
      return BoxClass::outside;
    case SampledMap::Side::inside:
      return BoxClass::inside;
    case SampledMap::Side::both:
      break;
  }
  return BoxClass::mixed;
}

Interval BoxShell::within(Vec3 at, Vec3 way, double more) const {
  Interval range{-infinity, infinity};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = -more - at[axis], high = size_[axis] + more - at[axis];
    if (way[axis] == 0) {
      if (low > 0 || high < 0) return {infinity, -infinity};
      continue;
    }
    const double one = low / way[axis], other = high / way[axis];
    range.low = std::max(range.low, std::min(one, other));
    range.high = std::min(range.high, std::max(one, other));
  }
  return range;
}

// Rounding may put points on a face to either side of it, also of a ray that is along the face up
// to rounding: settle_end() looks at them.
RayParts BoxShell::parts_of(const Ray& ray, double from, double to, double tolerance) const {
  const Vec3 at = frame_.to_grid(ray.origin), way = frame_.rotation.apply_inverse(ray.direction);
  constexpr double flat = 1e-12;
  const bool is_along = std::abs(way.x) < flat || std::abs(way.y) < flat || std::abs(way.z) < flat;
  const double more = is_along ? map_->slack(ray.origin, max_component(size_)) : 0;
  const Interval range = within(at, way, more);
  RayParts parts;
  add_part(parts, range.low, range.high, from, to, tolerance,
           [&](double t) { return holds(ray.at(t)); });
  return parts;
}

Vec3 BoxShell::normal(Vec3 p) const {
  const Vec3 at = frame_.to_grid(p);
  double nearest = infinity;
  Vec3 normal;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const double gap = sign < 0 ? at[axis] : size_[axis] - at[axis];
      if (!(gap < nearest)) continue;
      nearest = gap;
      normal = {};
      normal[axis] = sign;
    }
  return frame_.rotation.apply(normal);
}

bool BoxShell::meets(Vec3 a, Vec3 b) const {
  a = frame_.to_grid(a);
  const Interval range = within(a, frame_.to_grid(b) - a, 0);
  return std::max(range.low, 0.0) <= std::min(range.high, 1.0);
}

// A sample is decided by where it is in the row, except those that are on a face up to rounding. A
// row that is almost along a face may be near it for long.
void BoxShell::keep_row(Row& row) const {
  const SampleGrid& grid = row.grid();
  const Vec3 start = row.start(), at = frame_.to_grid(start);
  Vec3 way = frame_.rotation.apply_inverse(Vec3{1, 0, 0});
  // That of places, and as much for what a row departs from a line along the faces.
  const double rounding = 0x1p4 * map_->slack(start, 2 * row.extent()), slack = 2 * rounding;
  constexpr double steep = 1e-3;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(way[axis]) * row.extent() <= rounding) way[axis] = 0;
    if (way[axis] != 0 && std::abs(way[axis]) < steep) return row.decide(0, grid.nx);
  }
  const Interval may = within(at, way, slack), sure = within(at, way, -slack);
  if (may.low > may.high) return row.clear(0, grid.nx);
  const uint64_t first = grid.first_x_from(start.x + may.low - slack),
                 last = grid.first_x_from<true>(start.x + may.high + slack);
  row.clear(0, first);
  row.clear(last, grid.nx);
  const uint64_t from = grid.first_x_from(start.x + sure.low + slack),
                 to = grid.first_x_from<true>(start.x + sure.high - slack);
  if (!(sure.low < sure.high && from < to)) return row.decide(first, last);
  row.decide(first, from);
  row.decide(to, last);
}

}  // namespace msq
