// SPDX-License-Identifier: Apache-2.0
#include "fill/order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/job.h"

namespace msq {

namespace {

class Order {
 public:
  explicit Order(const std::vector<IntPath>& paths);

  /// Takes the nearest point where a path that is left may begin.
  std::pair<uint32_t, uint32_t> take_nearest(IntPoint p);

 private:
  /// A point where a path may begin.
  struct Begin {
    IntPoint point;
    uint32_t path, index;
  };

  size_t column(double x) const {
    return static_cast<size_t>(std::clamp((x - low_x_) / side_, 0.0, columns_ - 1.0));
  }
  size_t row(double y) const {
    return static_cast<size_t>(std::clamp((y - low_y_) / side_, 0.0, rows_ - 1.0));
  }
  /// Looks for a nearer one in a square, and forgets what is taken.
  void look(size_t column, size_t row, IntPoint p, double& squared, Begin& best);

  double low_x_ = 0, low_y_ = 0, side_ = 1, columns_ = 1, rows_ = 1;
  std::vector<std::vector<Begin>> squares_;
  std::vector<bool> is_taken_;
};

Order::Order(const std::vector<IntPath>& paths) : is_taken_(paths.size(), false) {
  double high_x = -std::numeric_limits<double>::infinity(), high_y = high_x;
  low_x_ = low_y_ = -high_x;
  size_t begins = 0;
  for (const IntPath& path : paths) {
    begins += path.is_closed ? path.points.size() : 2;
    for (const IntPoint p : path.points) {
      low_x_ = std::min(low_x_, static_cast<double>(p.x));
      low_y_ = std::min(low_y_, static_cast<double>(p.y));
      high_x = std::max(high_x, static_cast<double>(p.x));
      high_y = std::max(high_y, static_cast<double>(p.y));
    }
  }
  // About two beginnings in a square, and not more squares than that on a long thin window either.
  const double width = high_x - low_x_ + 1, height = high_y - low_y_ + 1;
  const double squares = std::max(1.0, static_cast<double>(begins) / 2);
  side_ = std::max({std::sqrt(width * height / squares), std::max(width, height) / squares, 1.0});
  columns_ = std::floor(width / side_) + 1;
  rows_ = std::floor(height / side_) + 1;
  squares_.resize(static_cast<size_t>(columns_ * rows_));
  const auto add = [this](IntPoint p, size_t path, size_t index) {
    const size_t square = row(static_cast<double>(p.y)) * static_cast<size_t>(columns_) +
                          column(static_cast<double>(p.x));
    squares_[square].push_back({p, static_cast<uint32_t>(path), static_cast<uint32_t>(index)});
  };
  for (size_t i = 0; i < paths.size(); ++i) {
    const std::vector<IntPoint>& points = paths[i].points;
    for (size_t k = 0; k < points.size(); ++k)
      if (paths[i].is_closed || k == 0 || k + 1 == points.size()) add(points[k], i, k);
  }
}

void Order::look(size_t column, size_t row, IntPoint p, double& squared, Begin& best) {
  std::vector<Begin>& square = squares_[row * static_cast<size_t>(columns_) + column];
  std::erase_if(square, [this](const Begin& begin) { return is_taken_[begin.path]; });
  for (const Begin& begin : square) {
    const double x = static_cast<double>(begin.point.x - p.x),
                 y = static_cast<double>(begin.point.y - p.y);
    const double d = x * x + y * y;
    const bool is_first = std::pair(begin.path, begin.index) < std::pair(best.path, best.index);
    if (d < squared || (d == squared && is_first)) {
      squared = d;
      best = begin;
    }
  }
}

std::pair<uint32_t, uint32_t> Order::take_nearest(IntPoint p) {
  const double x = static_cast<double>(p.x), y = static_cast<double>(p.y);
  const long i = static_cast<long>(column(x)), j = static_cast<long>(row(y));
  const long columns = static_cast<long>(columns_), rows = static_cast<long>(rows_);
  double squared = std::numeric_limits<double>::infinity();
  Begin best{{}, UINT32_MAX, UINT32_MAX};
  for (long ring = 0; ring < std::max(columns, rows); ++ring) {
    // Squares of this ring are at least so far away; of points outside of the grid more.
    const double least = static_cast<double>(ring - 1) * side_;
    if (ring > 1 && least * least > squared) break;
    for (long b = std::max(j - ring, 0L); b <= std::min(j + ring, rows - 1); ++b) {
      const bool is_whole = std::abs(b - j) == ring;
      const long step = is_whole ? 1 : std::max(2 * ring, 1L);
      for (long a = i - ring; a <= i + ring; a += step)
        if (a >= 0 && a < columns)
          look(static_cast<size_t>(a), static_cast<size_t>(b), p, squared, best);
    }
  }
  is_taken_[best.path] = true;
  return {best.path, best.index};
}

}  // namespace

void order_paths(std::vector<IntPath>& paths, IntPoint start) {
  if (paths.empty()) return;
  Order order(paths);
  std::vector<IntPath> ordered;
  ordered.reserve(paths.size());
  CancelPoll poll(current_job());
  for (size_t n = 0; n < paths.size(); ++n) {
    poll();
    const auto [path, index] = order.take_nearest(start);
    IntPath& next = paths[path];
    if (next.is_closed)
      std::rotate(next.points.begin(), next.points.begin() + index, next.points.end());
    else if (index != 0)
      std::reverse(next.points.begin(), next.points.end());
    start = next.is_closed ? next.points.front() : next.points.back();
    ordered.push_back(std::move(next));
  }
  paths = std::move(ordered);
}

}  // namespace msq
