// SPDX-License-Identifier: Apache-2.0
#include "fill/polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/int128.h"
#include "base/job.h"

namespace msq {

namespace {

Int128 cross(IntPoint a, IntPoint b, IntPoint c) {
  return static_cast<Int128>(b.x - a.x) * (c.y - a.y) -
         static_cast<Int128>(b.y - a.y) * (c.x - a.x);
}

/// Whether a corner c of the shifted polygon is to the left of the line from a to b, a != b.
bool corner_is_left(IntPoint a, IntPoint b, IntPoint c) {
  const Int128 d = cross(a, b, c);
  if (d != 0) return d > 0;
  return a.y != b.y ? b.y < a.y : b.x > a.x;
}

/// Whether a point is to the left of the shifted side from p to q, p != q.
bool is_left_of_side(IntPoint p, IntPoint q, IntPoint point) {
  const Int128 d = cross(p, q, point);
  if (d != 0) return d > 0;
  return p.y != q.y ? q.y > p.y : q.x < p.x;
}

IntPoint between(IntPoint a, IntPoint b, double t) {
  return {a.x + std::llround(t * static_cast<double>(b.x - a.x)),
          a.y + std::llround(t * static_cast<double>(b.y - a.y))};
}

void push(CountedVector<IntPoint>& points, IntPoint p) {
  if (points.empty() || !(points.back() == p)) points.push_back(p);
}

}  // namespace

double distance(IntPoint a, IntPoint b) {
  const double x = static_cast<double>(b.x - a.x), y = static_cast<double>(b.y - a.y);
  return std::sqrt(x * x + y * y);
}

double length_of(const IntPath& path) {
  double sum = path.is_closed ? distance(path.points.back(), path.points.front()) : 0;
  for (size_t i = 1; i < path.points.size(); ++i)
    sum += distance(path.points[i - 1], path.points[i]);
  return sum;
}

FillPolygon::FillPolygon(const Rings& rings) : min_(rings[0][0]), max_(rings[0][0]) {
  double heights = 0;
  for (const CountedVector<IntPoint>& ring : rings)
    for (size_t i = 0; i < ring.size(); ++i) {
      const IntPoint p = ring[i], q = ring[i + 1 < ring.size() ? i + 1 : 0];
      min_ = {std::min(min_.x, p.x), std::min(min_.y, p.y)};
      max_ = {std::max(max_.x, p.x), std::max(max_.y, p.y)};
      if (p == q) continue;
      sides_.push_back({p, q});
      heights += std::abs(static_cast<double>(q.y - p.y));
    }
  // So many bands that a side is in few of them: at most 4 for each side, and one more, in total.
  const double height = static_cast<double>(max_.y - min_.y);
  const double count = static_cast<double>(sides_.size());
  band_height_ = std::max({1.0, heights / (4 * count), height / (2 * count)});
  starts_.assign(static_cast<size_t>(height / band_height_) + 2, 0);
  const auto for_bands = [this](const Side& side, auto&& visit) {
    const auto [low, high] = std::minmax(side.from.y, side.to.y);
    for (size_t b = band(low); b <= band(high); ++b) visit(b);
  };
  for (const Side& side : sides_) for_bands(side, [&](size_t b) { ++starts_[b + 1]; });
  for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  members_.resize(starts_.back());
  CountedVector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (uint32_t i = 0; i < sides_.size(); ++i)
    for_bands(sides_[i], [&](size_t b) { members_[next[b]++] = i; });
}

size_t FillPolygon::band(int64_t y) const {
  const int64_t clamped = std::clamp(y, min_.y, max_.y);
  return std::min(static_cast<size_t>(static_cast<double>(clamped - min_.y) / band_height_),
                  starts_.size() - 2);
}

bool FillPolygon::inside(IntPoint p) const {
  if (p.x < min_.x || p.x > max_.x || p.y < min_.y || p.y > max_.y) return false;
  bool is_inside = false;
  const size_t at = band(p.y);
  for (uint32_t i = starts_[at]; i < starts_[at + 1]; ++i) {
    const auto& [from, to] = sides_[members_[i]];
    // Shifted upwards: a corner at the height of the point is above it.
    const bool is_from_above = from.y >= p.y, is_to_above = to.y >= p.y;
    if (is_from_above == is_to_above) continue;
    // The side crosses the ray to +x if the point is left of it as it runs upwards.
    if (is_left_of_side(from, to, p) == is_to_above) is_inside = !is_inside;
  }
  return is_inside;
}

void FillPolygon::find_crossings(IntPoint a, IntPoint b, CountedVector<double>& found) const {
  found.clear();
  const auto [low_x, high_x] = std::minmax(a.x, b.x);
  const auto [low_y, high_y] = std::minmax(a.y, b.y);
  if (high_x < min_.x || low_x > max_.x || high_y < min_.y || low_y > max_.y) return;
  const size_t first = band(low_y), last = band(high_y);
  for (size_t at = first; at <= last; ++at)
    for (uint32_t i = starts_[at]; i < starts_[at + 1]; ++i) {
      const auto& [p, q] = sides_[members_[i]];
      if (std::max(p.x, q.x) < low_x || std::min(p.x, q.x) > high_x || std::max(p.y, q.y) < low_y ||
          std::min(p.y, q.y) > high_y)
        continue;
      // In the first of the bands that both share.
      if (at != std::max(first, band(std::min(p.y, q.y)))) continue;
      if (corner_is_left(a, b, p) == corner_is_left(a, b, q) ||
          is_left_of_side(p, q, a) == is_left_of_side(p, q, b))
        continue;
      const double from = static_cast<double>(cross(p, q, a)),
                   to = static_cast<double>(cross(p, q, b));
      found.push_back(from == to ? 0 : std::clamp(from / (from - to), 0.0, 1.0));
    }
  std::sort(found.begin(), found.end());
}

void FillPolygon::cut(const IntPath& path, CountedVector<IntPath>& parts) const {
  const size_t count = path.points.size();
  if (count < 2) return;
  const size_t first_part = parts.size();
  const bool begins_inside = inside(path.points[0]);
  bool is_inside = begins_inside;
  IntPath part;
  CountedVector<double> crossings;
  CancelPoll poll(current_job());
  if (is_inside) part.points.push_back(path.points[0]);
  const auto end_part = [&] {
    if (part.points.size() > 1) parts.push_back(std::move(part));
    part = {};
  };
  const auto rounded = [this](IntPoint a, IntPoint b, double t) {
    const IntPoint p = between(a, b, t);
    return IntPoint{std::clamp(p.x, min_.x, max_.x), std::clamp(p.y, min_.y, max_.y)};
  };
  bool has_crossings = false;
  for (size_t i = 1; i < count + (path.is_closed ? 1 : 0); ++i) {
    const IntPoint a = path.points[i - 1], b = path.points[i < count ? i : 0];
    poll();
    if (a == b) continue;
    find_crossings(a, b, crossings);
    for (const double t : crossings) {
      has_crossings = true;
      push(part.points, rounded(a, b, t));
      is_inside = !is_inside;
      if (!is_inside) end_part();
    }
    if (is_inside) push(part.points, b);
  }
  if (path.is_closed && begins_inside && !has_crossings) {
    if (part.points.back() == part.points.front()) part.points.pop_back();
    part.is_closed = part.points.size() > 2;
    end_part();
    return;
  }
  if (path.is_closed && begins_inside && parts.size() > first_part && !part.points.empty() &&
      parts[first_part].points.front() == path.points[0]) {
    // What runs over the path's first point is one part.
    for (size_t i = 1; i < parts[first_part].points.size(); ++i)
      push(part.points, parts[first_part].points[i]);
    std::swap(parts[first_part], part);
    return;
  }
  end_part();
}

}  // namespace msq
