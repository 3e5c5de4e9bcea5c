// SPDX-License-Identifier: Apache-2.0
#include "fill/round_corners.h"

#include <algorithm>
#include <utility>

#include "base/vec2.h"
#include "fill/side_by_side.h"

namespace msq {

namespace {

constexpr int lines_per_corner = 4;
/// Of the sum of unit vectors to both neighbours. A bend below this, 11 degrees, stays.
constexpr double straight = 0.2;

void add(CountedVector<IntPoint>& points, IntPoint p) {
  if (points.empty() || !(points.back() == p)) points.push_back(p);
}

/// The points of the curve, or the corner alone.
void find_curve(IntPoint before, IntPoint corner, IntPoint after, double distance,
                const FillPolygon& polygon, IntPath& curve, CountedVector<IntPath>& parts) {
  curve.points.clear();
  const Vec2 to_before = between(corner, before), to_after = between(corner, after);
  const double length_before = length(to_before), length_after = length(to_after);
  const Vec2 u = to_before * (1 / length_before), v = to_after * (1 / length_after);
  if (length(u + v) >= straight) {
    const double reach = std::min({distance, 0.5 * length_before, 0.5 * length_after});
    for (int i = 0; i <= lines_per_corner; ++i) {
      const double t = i * (1.0 / lines_per_corner);
      add(curve.points, moved(corner, (u * ((1 - t) * (1 - t)) + v * (t * t)) * reach));
    }
    parts.clear();
    if (curve.points.size() > 1) polygon.cut(curve, parts);
    if (parts.size() == 1 && parts[0].points == curve.points) return;
  }
  curve.points.assign(1, corner);
}

}  // namespace

void round_corners(IntPath& path, double distance, const FillPolygon& polygon) {
  const CountedVector<IntPoint>& given = path.points;
  const size_t count = given.size();
  if (count < 3) return;
  CountedVector<IntPoint> points;
  IntPath curve;
  CountedVector<IntPath> parts;
  for (size_t i = 0; i < count; ++i) {
    if (!path.is_closed && (i == 0 || i + 1 == count)) {
      add(points, given[i]);
      continue;
    }
    find_curve(given[(i + count - 1) % count], given[i], given[(i + 1) % count], distance, polygon,
               curve, parts);
    for (const IntPoint p : curve.points) add(points, p);
  }
  if (path.is_closed && points.size() > 1 && points.front() == points.back()) points.pop_back();
  path.points = std::move(points);
}

}  // namespace msq
