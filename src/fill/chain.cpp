// SPDX-License-Identifier: Apache-2.0
#include "fill/chain.h"

#include <algorithm>
#include <array>

#include "base/job.h"

namespace msq {

namespace {

/// Ends of lines: 2 * line, and 2 * line + 1.
using End = uint32_t;
constexpr End nothing = UINT32_MAX;

class Chains {
 public:
  explicit Chains(const LineGraph& graph)
      : graph_(graph), partner_(2 * graph.lines.size(), nothing), is_used_(graph.lines.size()) {
    pair_ends();
  }

  CountedVector<Polyline> find() {
    CountedVector<Polyline> paths;
    for (End end = 0; end < partner_.size(); ++end)
      if (partner_[end] == nothing && !is_used_[end / 2]) paths.push_back(follow(end));
    for (uint32_t line = 0; line < is_used_.size(); ++line)
      if (!is_used_[line]) paths.push_back(follow(2 * line));
    return paths;
  }

 private:
  uint32_t point_of(End end) const { return graph_.lines[end / 2][end % 2]; }

  void pair_ends();
  Polyline follow(End end);

  const LineGraph& graph_;
  CountedVector<End> partner_;  // the other of the only two ends at a point
  CountedVector<bool> is_used_;
};

void Chains::pair_ends() {
  // The only end at a point, or one of two; then how many there are.
  CountedVector<End> first(graph_.points.size(), nothing);
  CountedVector<uint32_t> counts(graph_.points.size(), 0);
  CancelPoll poll(current_job());
  for (End end = 0; end < partner_.size(); ++end) {
    poll();
    const uint32_t point = point_of(end);
    if (++counts[point] == 1) {
      first[point] = end;
    } else if (counts[point] == 2) {
      partner_[end] = first[point];
      partner_[first[point]] = end;
    } else if (counts[point] == 3) {
      partner_[partner_[first[point]]] = nothing;
      partner_[first[point]] = nothing;
    }
  }
}

Polyline Chains::follow(End end) {
  Polyline path;
  const uint32_t first = end / 2;
  path.points.push_back(graph_.points[point_of(end)]);
  for (;;) {
    is_used_[end / 2] = true;
    const End last = end ^ 1;
    const End next = partner_[last];
    path.is_closed = next != nothing && next / 2 == first;
    if (path.is_closed) return path;
    path.points.push_back(graph_.points[point_of(last)]);
    if (next == nothing) return path;
    end = next;
  }
}

}  // namespace

CountedVector<Polyline> chain(const LineGraph& graph) {
  return Chains(graph).find();
}

void simplify(Polyline& path, double distance, const Box2& window) {
  CountedVector<Vec2>& points = path.points;
  if (path.is_closed) points.push_back(points[0]);
  const size_t count = points.size();
  CountedVector<bool> stays(count, false);
  CountedVector<std::array<size_t, 2>> open;
  size_t last = 0;
  for (size_t i = 0; i < count; ++i) {
    stays[i] = i == 0 || i + 1 == count || !window.contains(points[i]);
    if (!stays[i] || i == 0) continue;
    open.push_back({last, i});
    last = i;
  }
  CancelPoll poll(current_job());
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double farthest = 0;
    size_t at = from;
    for (size_t i = from + 1; i < to; ++i) {
      poll();
      const Vec2 off = off_segment(points[i], points[from], points[to]);
      if (dot(off, off) > farthest) {
        farthest = dot(off, off);
        at = i;
      }
    }
    if (farthest <= distance * distance) continue;
    stays[at] = true;
    open.push_back({from, at});
    open.push_back({at, to});
  }
  size_t kept = 0;
  for (size_t i = 0; i < count; ++i)
    if (stays[i]) points[kept++] = points[i];
  points.resize(path.is_closed ? kept - 1 : kept);
}

}  // namespace msq
