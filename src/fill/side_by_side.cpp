// SPDX-License-Identifier: Apache-2.0
#include "fill/side_by_side.h"

#include <algorithm>
#include <cmath>

namespace msq {

namespace {

/// Of a line that is cut for a test: how far its end is from the border, as a part of a segment and
/// in units, whichever is less. Ends on the border are rounded.
constexpr double short_part = 0.05, short_units = 32;

}  // namespace

Vec2 between(IntPoint from, IntPoint to) {
  return {static_cast<double>(to.x - from.x), static_cast<double>(to.y - from.y)};
}

IntPoint short_of(IntPoint end, IntPoint before) {
  const Vec2 way = between(end, before);
  return moved(end, way * std::min(short_part, short_units / length(way)));
}

IntPoint moved(IntPoint p, Vec2 by) {
  return {p.x + std::llround(by.x), p.y + std::llround(by.y)};
}

Vec2 corner_beside(Vec2 along, double aside, Vec2 other, double limit) {
  const double sine = along.x * other.y - along.y * other.x;
  const double reach = aside / sine;  // along the other line; not finite if both are parallel
  if (reach >= 0 && reach <= limit) return other * reach;
  return unit(left_of(along)) * aside;
}

IntPath beside(const IntPath& line, double aside_from, double aside_to) {
  const CountedVector<IntPoint>& points = line.points;
  const size_t last = points.size() - 1;
  IntPath result = line;
  result.points[0] = moved(points[0], unit(left_of(between(points[0], points[1]))) * aside_from);
  result.points[last] =
      moved(points[last], unit(left_of(between(points[last - 1], points[last]))) * aside_to);
  if (aside_from == aside_to)
    for (size_t i = 1; i < last; ++i) {
      const Vec2 sum = unit(left_of(between(points[i - 1], points[i]))) +
                       unit(left_of(between(points[i], points[i + 1])));
      const double size = length(sum);
      if (size > 0.5) result.points[i] = moved(points[i], sum * (aside_from / size));
    }
  return result;
}

bool fit_beside(const IntPath& line, double aside, bool is_from_pointed, bool is_to_pointed,
                const FillPolygon& polygon) {
  for (const double side : {aside, -aside}) {
    IntPath path = beside(line, side, side);
    CountedVector<IntPoint>& points = path.points;
    const size_t last = points.size() - 1;
    if (is_from_pointed) points[0] = short_of(line.points[0], points[1]);
    if (is_to_pointed) points[last] = short_of(line.points[last], points[last - 1]);
    CountedVector<IntPath> parts;
    polygon.cut(path, parts);
    if (parts.size() != 1 || !(parts[0].points == points)) return false;
  }
  return true;
}

}  // namespace msq
