// SPDX-License-Identifier: Apache-2.0
#include "structure/common/line_graph.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "base/job.h"
#include "base/polled_sort.h"
#include "base/status.h"
#include "structure/common/point_in_square.h"

namespace msq {

namespace {

/// Disjoint sets; the least number of a set stands for it.
class Sets {
 public:
  explicit Sets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  uint32_t find(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  CountedVector<uint32_t> parent_;
};

}  // namespace

void LineGraph::require_squares(double side) const {
  constexpr double max_number = 0x1p50;
  for (const Vec2 p : points)
    if (!(std::abs(p.x) <= max_number * side && std::abs(p.y) <= max_number * side))
      fail(Status::limit,
           "a wall is at (%g, %g); with such small cells the limit is %g from the origin", p.x, p.y,
           max_number * side);
}

void LineGraph::weld(double distance) {
  // Points lie in squares many times as wide as the distance, and most look into their own alone.
  const double side = 64 * distance;
  require_squares(side);
  const auto square = [side](double x) { return std::floor(x / side); };
  CountedVector<PointInSquare> places(points.size());
  for (uint32_t i = 0; i < points.size(); ++i)
    places[i] = {square(points[i].x), square(points[i].y), i};
  CancelPoll poll(current_job());
  polled_sort(places.begin(), places.end(), std::less<>(), poll);
  Sets sets(points.size());
  for (const PointInSquare& place : places) {
    poll();
    const Vec2 p = points[place.point];
    for (double column = square(p.x - distance); column <= square(p.x + distance); ++column)
      for (double row = square(p.y - distance); row <= square(p.y + distance); ++row)
        for (auto other = std::lower_bound(places.begin(), places.end(),
                                           PointInSquare{column, row, place.point});
             other != places.end() && other->column == column && other->row == row; ++other) {
          const Vec2 d = points[other->point] - p;
          if (std::abs(d.x) <= distance && std::abs(d.y) <= distance)
            sets.join(place.point, other->point);
        }
  }
  CountedVector<uint32_t> number(points.size());
  uint32_t count = 0;
  for (uint32_t i = 0; i < points.size(); ++i)
    if (sets.find(i) == i) {
      points[count] = points[i];
      number[i] = count++;
    }
  for (auto& [a, b] : lines) {
    a = number[sets.find(a)];
    b = number[sets.find(b)];
    if (a > b) std::swap(a, b);
  }
  points.resize(count);
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  std::erase_if(lines, [](const std::array<uint32_t, 2>& line) { return line[0] == line[1]; });
}

}  // namespace msq
