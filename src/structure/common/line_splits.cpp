// SPDX-License-Identifier: Apache-2.0
#include "structure/common/line_splits.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/job.h"
#include "base/polled_sort.h"
#include "structure/common/point_in_square.h"

namespace msq {

void split_at_points(LineGraph& graph, double distance) {
  if (graph.lines.empty()) return;
  double sum = 0;
  for (const auto& [a, b] : graph.lines) sum += length(graph.points[b] - graph.points[a]);
  const double side = std::max(sum / static_cast<double>(graph.lines.size()), 64 * distance);
  graph.require_squares(side);
  const auto square = [side](double x) { return std::floor(x / side); };
  CountedVector<PointInSquare> places;
  places.reserve(graph.points.size());
  for (uint32_t i = 0; i < graph.points.size(); ++i)
    places.push_back({square(graph.points[i].x), square(graph.points[i].y), i});
  CancelPoll poll(current_job());
  polled_sort(places.begin(), places.end(), std::less<>(), poll);

  CountedVector<std::array<uint32_t, 2>> parts;
  CountedVector<std::pair<double, uint32_t>> on;
  for (const auto& [a, b] : graph.lines) {
    const Vec2 p = graph.points[a], q = graph.points[b], way = q - p;
    const double squared = dot(way, way), span = std::sqrt(squared);
    const Vec2 low{std::min(p.x, q.x) - distance, std::min(p.y, q.y) - distance};
    const Vec2 high{std::max(p.x, q.x) + distance, std::max(p.y, q.y) + distance};
    on.clear();
    for (double column = square(low.x); column <= square(high.x); ++column) {
      auto place =
          std::lower_bound(places.begin(), places.end(), PointInSquare{column, square(low.y), 0});
      for (; place != places.end() && place->column == column && place->row <= square(high.y);
           ++place) {
        poll();
        if (place->point == a || place->point == b) continue;
        const Vec2 to = graph.points[place->point] - p;
        const double along = dot(to, way);
        if (along > 0 && along < squared && std::abs(cross(to, way)) <= distance * span)
          on.emplace_back(along, place->point);
      }
    }
    std::sort(on.begin(), on.end());
    uint32_t from = a;
    for (const auto& [along, point] : on) {
      parts.push_back({std::min(from, point), std::max(from, point)});
      from = point;
    }
    parts.push_back({std::min(from, b), std::max(from, b)});
  }
  polled_sort(parts.begin(), parts.end(), std::less<>(), poll);
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  graph.lines = std::move(parts);
}

}  // namespace msq
