// SPDX-License-Identifier: Apache-2.0
#include "fill/near_points.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/job.h"

namespace msq {

NearPoints::NearPoints(const CountedVector<Vec2>& points) : points_(points) {
  if (points.empty()) {
    starts_.assign(2, 0);
    counts_.assign(1, 0);
    return;
  }
  Vec2 high = low_ = points[0];
  CancelPoll poll(current_job());
  for (const Vec2 p : points) {
    poll();
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  // About two points in a square, and not more squares than that on a long thin window either.
  const double width = high.x - low_.x, height = high.y - low_.y;
  const double squares = std::max(1.0, static_cast<double>(points.size()) / 2);
  side_ = std::max(std::sqrt(width * height / squares), std::max(width, height) / squares);
  if (!(side_ > 0)) side_ = 1;
  columns_ = static_cast<long>(width / side_) + 1;
  rows_ = static_cast<long>(height / side_) + 1;
  const auto square = [this](Vec2 p) {
    return static_cast<size_t>(row(p.y) * columns_ + column(p.x));
  };
  starts_.assign(static_cast<size_t>(columns_ * rows_) + 1, 0);
  for (const Vec2 p : points) ++starts_[square(p) + 1];
  for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  counts_.assign(starts_.size() - 1, 0);
  members_.resize(points.size());
  for (uint32_t i = 0; i < points.size(); ++i) {
    poll();
    const size_t at = square(points[i]);
    members_[starts_[at] + counts_[at]++] = i;
  }
}

long NearPoints::column(double x) const {
  return static_cast<long>(
      std::clamp((x - low_.x) / side_, 0.0, static_cast<double>(columns_ - 1)));
}

long NearPoints::row(double y) const {
  return static_cast<long>(std::clamp((y - low_.y) / side_, 0.0, static_cast<double>(rows_ - 1)));
}

void NearPoints::look(long column, long row, Vec2 p, size_t count) {
  const auto square = static_cast<size_t>(row * columns_ + column);
  const uint32_t first = starts_[square], last = first + counts_[square];
  for (uint32_t i = first; i < last; ++i) {
    const Vec2 way = points_[members_[i]] - p;
    const Found found{dot(way, way), members_[i]};
    if (found_.size() == count) {
      if (!(found < found_.back())) continue;
      found_.pop_back();
    }
    found_.insert(std::upper_bound(found_.begin(), found_.end(), found), found);
  }
}

void NearPoints::find(Vec2 p, size_t count, CountedVector<uint32_t>& found) {
  found_.clear();
  const long i = column(p.x), j = row(p.y);
  for (long ring = 0; ring < std::max(columns_, rows_); ++ring) {
    // Squares of this ring are at least so far away; of points outside of the grid more.
    const double least = static_cast<double>(ring - 1) * side_;
    if (ring > 1 && found_.size() == count && least * least > found_.back().squared) break;
    for (long b = std::max(j - ring, 0L); b <= std::min(j + ring, rows_ - 1); ++b) {
      const bool is_whole = std::abs(b - j) == ring;
      const long step = is_whole ? 1 : std::max(2 * ring, 1L);
      for (long a = i - ring; a <= i + ring; a += step)
        if (a >= 0 && a < columns_) look(a, b, p, count);
    }
  }
  found.clear();
  for (const Found& one : found_) found.push_back(one.point);
}

void NearPoints::remove(uint32_t point) {
  const Vec2 p = points_[point];
  const auto square = static_cast<size_t>(row(p.y) * columns_ + column(p.x));
  uint32_t* first = members_.data() + starts_[square];
  uint32_t* last = first + counts_[square];
  uint32_t* at = std::find(first, last, point);
  if (at == last) return;
  *at = last[-1];
  --counts_[square];
}

}  // namespace msq
