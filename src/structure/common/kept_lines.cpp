// SPDX-License-Identifier: Apache-2.0
#include "structure/common/kept_lines.h"

#include <algorithm>

#include "base/job.h"

namespace msq {

namespace {

class KeptParts {
 public:
  KeptParts(LineGraph& graph, double tolerance, const KeepPoint& keep)
      : graph_(graph), tolerance_(tolerance), keep_(keep) {}

  void find() {
    JobPoll poll(current_job());
    CountedVector<KeptPoint> known;
    known.reserve(graph_.points.size());
    for (const Vec2 p : graph_.points) {
      poll();
      known.push_back(keep_(p));
    }
    CountedVector<std::array<uint32_t, 2>> lines;
    std::swap(lines, graph_.lines);
    for (const auto& [a, b] : lines) {
      // The same way in every window.
      const Vec2 p = graph_.points[a], q = graph_.points[b];
      const bool is_turned = q.x < p.x || (q.x == p.x && q.y < p.y);
      const uint32_t from = is_turned ? b : a, to = is_turned ? a : b;
      follow(from, to, known[from], known[to], poll);
    }
  }

 private:
  void follow(uint32_t a, uint32_t b, KeptPoint at, KeptPoint at_b, JobPoll& poll);
  /// The point between two, one of which stays, where that changes.
  Vec2 change(Vec2 from, Vec2 to, bool from_stays) const;

  LineGraph& graph_;
  const double tolerance_;
  const KeepPoint& keep_;
};

Vec2 KeptParts::change(Vec2 from, Vec2 to, bool from_stays) const {
  for (int i = 0; i < 60 && length(to - from) > tolerance_ / 64; ++i) {
    const Vec2 middle = (from + to) * 0.5;
    (keep_(middle).stays == from_stays ? from : to) = middle;
  }
  return from_stays ? from : to;
}

void KeptParts::follow(uint32_t a, uint32_t b, KeptPoint at, const KeptPoint at_b, JobPoll& poll) {
  const Vec2 begin = graph_.points[a], way = graph_.points[b] - begin;
  const double span = length(way);
  uint32_t from = a;  // of the part that is followed, if it stays
  Vec2 last = begin;
  double s = 0;
  while (s < span) {
    poll();
    s += std::max(at.steady, tolerance_);
    const bool is_end = !(s < span);
    const Vec2 p = is_end ? graph_.points[b] : begin + way * (s / span);
    const KeptPoint next = is_end ? at_b : keep_(p);
    if (next.stays != at.stays) {
      const auto number = static_cast<uint32_t>(graph_.points.size());
      graph_.points.push_back(change(last, p, at.stays));
      if (at.stays) graph_.lines.push_back({from, number});
      from = number;
    }
    at = next;
    last = p;
  }
  if (at.stays) graph_.lines.push_back({from, b});
}

}  // namespace

void keep_parts(LineGraph& graph, double tolerance, const KeepPoint& keep) {
  KeptParts(graph, tolerance, keep).find();
}

}  // namespace msq
