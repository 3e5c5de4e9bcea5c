// SPDX-License-Identifier: Apache-2.0
#include "structure/common/level_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/job.h"
#include "expression/batch.h"

namespace msq {

namespace {

/// Nodes along a side of the grid.
constexpr double max_nodes = 0x1p26;

double number_or_infinity(double value) {
  return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

}  // namespace

LevelLines::LevelLines(LevelFunction& function, double pitch, bool follows_jumps,
                       const WallSection& section)
    : function_(function), section_(section), pitch_(pitch), follows_jumps_(follows_jumps) {
  const Box2& w = section.window;
  // A square more on each side, so that each line in the window has those before and after it.
  const double x = std::floor(w.min.x / pitch_) - 1, y = std::floor(w.min.y / pitch_) - 1;
  const double columns = std::ceil(w.max.x / pitch_) - x + 2;
  const double rows = std::ceil(w.max.y / pitch_) - y + 2;
  if (!(std::max(columns, rows) < max_nodes) || !(std::max(std::abs(x), std::abs(y)) < 0x1p50))
    fail(Status::limit,
         "the window has %g by %g squares of %g, a part of a cell; the limit is %g along a side",
         columns - 1, rows - 1, pitch_, max_nodes);
  first_x_ = static_cast<int64_t>(x);
  first_y_ = static_cast<int64_t>(y);
  columns_ = static_cast<int64_t>(columns);
  rows_ = static_cast<int64_t>(rows);
  x_.resize(LevelFunction::row_points + batch_padding);
  nodes_.origin = {node(0, 0).x, node(0, 0).y, section.z};
  nodes_.spacing = {pitch_, pitch_, pitch_};
  nodes_.nx = static_cast<uint64_t>(columns_);
  nodes_.ny = static_cast<uint64_t>(rows_);
  nodes_.nz = 1;
}

double LevelLines::value(Vec2 p) const {
  return number_or_infinity(function_.at({p.x, p.y, section_.z}));
}

void LevelLines::evaluate(int64_t j, Row& row) {
  if (function_.has_signs()) return evaluate_signs(j, row);
  constexpr auto most = static_cast<int64_t>(LevelFunction::row_points);
  const double y = node(0, j).y;
  row.values.resize(static_cast<size_t>(columns_));
  for (int64_t begin = 0; begin < columns_; begin += most) {
    const size_t count = static_cast<size_t>(std::min(columns_ - begin, most));
    check_cancelled();
    for (size_t i = 0; i < count; ++i) x_[i] = node(begin + static_cast<int64_t>(i), j).x;
    double* const values = row.values.data() + begin;
    function_.row(x_.data(), y, section_.z, count, values);
    for (size_t i = 0; i < count; ++i) values[i] = number_or_infinity(values[i]);
  }
}

void LevelLines::find_strip(int64_t j) {
  strip_begin_ = j;
  strip_end_ = std::min(j + strip_rows, rows_);
  const auto block_in = [&](CountedVector<uint64_t>& words) {
    RowBlock block;
    block.grid = &nodes_;
    block.y0 = static_cast<uint64_t>(strip_begin_);
    block.y1 = static_cast<uint64_t>(strip_end_);
    block.z1 = 1;
    block.row_stride = block.row_words();
    block.layer_stride = block.row_stride * block.rows();
    words.assign(block.layer_stride, 0);
    block.words = words.data();
    for (uint64_t row = block.y0; row < block.y1; ++row)
      set_bits(block.row(row, 0), 0, nodes_.nx - 1);
    return block;
  };
  function_.find_signs(block_in(inside_), block_in(not_outside_));
}

void LevelLines::evaluate_signs(int64_t j, Row& row) {
  if (j >= strip_end_) find_strip(j);
  const size_t words = words_for(nodes_.nx), first = static_cast<size_t>(j - strip_begin_) * words;
  row.values.resize(static_cast<size_t>(columns_));
  for (int64_t i = 0; i < columns_; ++i) {
    const size_t word = first + static_cast<size_t>(i) / bits_per_word;
    const uint64_t bit = uint64_t{1} << (static_cast<size_t>(i) % bits_per_word);
    double& at = row.values[static_cast<size_t>(i)];
    if (inside_[word] & bit)
      at = -not_known;
    else if (!(not_outside_[word] & bit))
      at = not_known;
    else
      at = value(node(i, j));
  }
}

bool LevelLines::find_root(Vec2& a, double& at_a, Vec2& b, double& at_b) const {
  const double near = std::min(0.02 * section_.tolerance, 1e-3 * pitch_);
  const double begin = std::max(std::abs(at_a), std::abs(at_b)), height = std::abs(at_a - at_b);
  const Vec2 from = a, way = b - a;
  const double span = length(way);
  double low = 0, high = 1, at_low = at_a, at_high = at_b;
  int last = 0;
  double weight_low = at_low, weight_high = at_high;
  for (int i = 0; i < 60 && (high - low) * span > near; ++i) {
    double t = low + (high - low) * (weight_low / (weight_low - weight_high));
    // Every third step halves, so that slow approach is no matter.
    if (i % 3 == 2 || !(t > low && t < high)) t = 0.5 * (low + high);
    const double at = value(from + way * t);
    if (at == 0) {
      low = high = t;
      at_low = at_high = 0;
      break;
    }
    if ((at <= 0) == (at_a <= 0)) {
      low = t;
      at_low = weight_low = at;
      if (last == 1) weight_high *= 0.5;
      last = 1;
    } else {
      high = t;
      at_high = weight_high = at;
      if (last == 2) weight_low *= 0.5;
      last = 2;
    }
    const double smaller = std::min(std::abs(at_low), std::abs(at_high));
    // The slope of the bracket tells how far the root is from its better end.
    if (smaller * (high - low) * span <= near * 0.5 * std::abs(at_high - at_low) &&
        smaller < 0.01 * begin)
      break;
  }
  a = from + way * low;
  b = from + way * high;
  at_a = at_low;
  at_b = at_high;
  // A network has a line in either case. The result only decides whether bends are followed.
  if (follows_jumps_)
    return std::isfinite(at_low) && std::isfinite(at_high) &&
           std::min(std::abs(at_low), std::abs(at_high)) < 0.25 * begin;
  return !is_jump(from, way, {low, high, at_low, at_high}, near / span, height);
}

// The root is within a step of the better end of the bracket, if the function is as good as
// straight there. The other end may be far off, and is brought near: first by that step, then by
// halving.
bool LevelLines::is_jump(Vec2 from, Vec2 way, Bracket in, double step, double height) const {
  constexpr int max_steps = 20;
  double t = std::abs(in.at_low) <= std::abs(in.at_high) ? in.low + step : in.high - step;
  // Where an end is infinite or not a number, the first height is that of the first finite bracket.
  const auto has_shrunk = [&] {
    if (!std::isfinite(height)) height = std::abs(in.at_high - in.at_low);
    return in.is_lower_than(0.25 * height);
  };
  for (int i = 0; i < max_steps && !has_shrunk(); ++i) {
    if (!(t > in.low && t < in.high)) t = 0.5 * (in.low + in.high);
    const double at = value(from + way * t);
    const bool is_low = (at <= 0) == (in.at_low <= 0);
    (is_low ? in.low : in.high) = t;
    (is_low ? in.at_low : in.at_high) = at;
    t = 0.5 * (in.low + in.high);
  }
  return !has_shrunk();
}

uint32_t LevelLines::crossing(Vec2 a, double at_a, Vec2 b, double at_b) {
  if ((at_a <= 0) == (at_b <= 0)) return nothing;
  const bool jumps = !find_root(a, at_a, b, at_b);
  // The boundary of a network may be a jump; the middle of a wall may not.
  if (jumps && !follows_jumps_) return nothing;
  graph_.points.push_back(std::abs(at_a) <= std::abs(at_b) ? a : b);
  return static_cast<uint32_t>(graph_.points.size() - 1);
}

void LevelLines::add_line(uint32_t a, uint32_t b) {
  if (a != nothing && b != nothing && a != b) graph_.lines.push_back({a, b});
}

void LevelLines::connect(int64_t j, const Row& low, const Row& high) {
  for (size_t i = 0; i + 1 < static_cast<size_t>(columns_); ++i) {
    const bool a = low.values[i] <= 0, b = low.values[i + 1] <= 0;
    const bool c = high.values[i + 1] <= 0, d = high.values[i] <= 0;
    if (a == b && b == c && c == d) continue;
    const uint32_t bottom = low.right[i], right = low.up[i + 1], top = high.right[i],
                   left = low.up[i];
    if (a == c && b == d) {
      // Opposite corners are joined through the middle, or the other two are.
      const Vec2 p = node(static_cast<int64_t>(i), j);
      const bool middle = value(p + Vec2{0.5 * pitch_, 0.5 * pitch_}) <= 0;
      if (middle == a) {
        add_line(bottom, right);
        add_line(top, left);
      } else {
        add_line(left, bottom);
        add_line(right, top);
      }
      continue;
    }
    uint32_t ends[2] = {nothing, nothing};
    size_t count = 0;
    if (a != b) ends[count++] = bottom;
    if (b != c) ends[count++] = right;
    if (c != d) ends[count++] = top;
    if (d != a) ends[count++] = left;
    add_line(ends[0], ends[1]);
  }
}

LineGraph LevelLines::find() {
  Row low, high;
  const auto begin_row = [&](int64_t j, Row& row) {
    evaluate(j, row);
    row.right.assign(static_cast<size_t>(columns_), nothing);
    row.up.assign(static_cast<size_t>(columns_), nothing);
    for (int64_t i = 0; i + 1 < columns_; ++i) {
      const double at = row.values[static_cast<size_t>(i)],
                   next = row.values[static_cast<size_t>(i + 1)];
      if ((at <= 0) != (next <= 0))
        row.right[static_cast<size_t>(i)] =
            crossing(node(i, j), exact(row, i, j), node(i + 1, j), exact(row, i + 1, j));
    }
  };
  begin_row(0, low);
  for (int64_t j = 0; j + 1 < rows_; ++j) {
    check_cancelled();
    begin_row(j + 1, high);
    for (int64_t i = 0; i < columns_; ++i) {
      const double at = low.values[static_cast<size_t>(i)],
                   next = high.values[static_cast<size_t>(i)];
      if ((at <= 0) != (next <= 0))
        low.up[static_cast<size_t>(i)] =
            crossing(node(i, j), exact(low, i, j), node(i, j + 1), exact(high, i, j + 1));
    }
    connect(j, low, high);
    std::swap(low, high);
  }
  refine();
  return std::move(graph_);
}

// A line that bends by an angle at each end, as the lines before and after it do, is about length *
// angle / 8 off in its middle.
void LevelLines::refine() {
  CountedVector<std::array<uint32_t, 2>> lines = std::move(graph_.lines);
  graph_.lines.clear();
  CountedVector<std::array<uint32_t, 2>> next(graph_.points.size(), {nothing, nothing});
  for (const auto& [a, b] : lines) {
    next[a][next[a][0] != nothing] = b;
    next[b][next[b][0] != nothing] = a;
  }
  JobPoll poll(current_job());
  for (const auto& [a, b] : lines) {
    poll();
    const Vec2 p = graph_.points[a], way = graph_.points[b] - p;
    const double span = length(way);
    double bend = 0;
    for (int end = 0; end < 2; ++end) {
      const uint32_t at = end ? b : a, other = end ? a : b;
      const uint32_t beyond = next[at][0] == other ? next[at][1] : next[at][0];
      if (beyond == nothing) {
        bend = 1;  // not known
        continue;
      }
      const Vec2 on = graph_.points[beyond] - graph_.points[at];
      const double off = std::abs(cross(on, way)), along = dot(on, way) * (end ? 1 : -1);
      bend = std::max(bend, std::atan2(off, along));
    }
    if (span * bend > 2 * section_.tolerance)
      halve(a, b, 0);
    else
      graph_.lines.push_back({a, b});
  }
}

void LevelLines::halve(uint32_t a, uint32_t b, int depth) {
  const Vec2 p = graph_.points[a], way = graph_.points[b] - p;
  const double span = length(way);
  const Vec2 middle = p + way * 0.5, normal{-way.y, way.x};
  Vec2 from = middle, to = middle;
  double at_from = value(middle), at_to = 0;
  bool is_found = at_from == 0;
  // Near first, as another part of the level may be beyond.
  if (depth < 8 && span > 2 * section_.tolerance && !is_found)
    for (const double step : {0.03, -0.03, 0.15, -0.15, 0.5, -0.5}) {
      to = middle + normal * step;
      at_to = value(to);
      if ((at_from <= 0) == (at_to <= 0)) continue;
      is_found = find_root(from, at_from, to, at_to);
      break;
    }
  const Vec2 on = std::abs(at_from) <= std::abs(at_to) ? from : to;
  // Where a line bends one way and then the other its middle alone does not tell: both halves are
  // looked at.
  if (!is_found || (depth > 0 && length(on - middle) <= 0.5 * section_.tolerance)) {
    graph_.lines.push_back({a, b});
    return;
  }
  const uint32_t number = static_cast<uint32_t>(graph_.points.size());
  graph_.points.push_back(on);
  halve(a, number, depth + 1);
  halve(number, b, depth + 1);
}

}  // namespace msq
