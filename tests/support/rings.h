// SPDX-License-Identifier: Apache-2.0
// Rings of contours, and what must hold of any: brute force, for small sections.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "msq_test.h"

namespace msq::test {

struct RingPoint {
  double u, v;
  friend bool operator==(RingPoint a, RingPoint b) { return a.u == b.u && a.v == b.v; }
  friend bool operator<(RingPoint a, RingPoint b) { return a.u != b.u ? a.u < b.u : a.v < b.v; }
};
inline RingPoint operator-(RingPoint a, RingPoint b) {
  return {a.u - b.u, a.v - b.v};
}
inline double cross(RingPoint a, RingPoint b) {
  return a.u * b.v - a.v * b.u;
}
inline double dot(RingPoint a, RingPoint b) {
  return a.u * b.u + a.v * b.v;
}

struct Rings {
  std::vector<std::vector<RingPoint>> rings;
  std::vector<int64_t> parents;
  std::vector<uint8_t> holes;
  uint64_t unresolved = 0, topology = 0;
  double pitch = 0;

  size_t points() const {
    size_t count = 0;
    for (const auto& ring : rings) count += ring.size();
    return count;
  }
  double area() const {
    double sum = 0;
    for (const auto& ring : rings) sum += area_of(ring);
    return sum;
  }
  double length() const {
    double sum = 0;
    for_each_segment([&](RingPoint a, RingPoint b) { sum += std::hypot(b.u - a.u, b.v - a.v); });
    return sum;
  }
  static double area_of(const std::vector<RingPoint>& ring) {
    double sum = 0;
    for (size_t i = 0; i < ring.size(); ++i)
      sum += 0.5 * cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
    return sum;
  }
  template <class Visit>
  void for_each_segment(Visit&& visit) const {
    for (const auto& ring : rings)
      for (size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
  }
  /// How often the ring goes around a point.
  static int winding(const std::vector<RingPoint>& ring, RingPoint p) {
    int count = 0;
    for (size_t i = 0; i < ring.size(); ++i) {
      const RingPoint a = ring[i], b = ring[(i + 1) % ring.size()];
      if ((a.v <= p.v) == (b.v <= p.v)) continue;
      const double side = cross(b - a, p - a);
      if (a.v <= p.v ? side > 0 : side < 0) count += a.v <= p.v ? 1 : -1;
    }
    return count;
  }
  int winding(RingPoint p) const {
    int count = 0;
    for (const auto& ring : rings) count += winding(ring, p);
    return count;
  }
};

/// Copies what a handle holds.
inline Rings rings_of(const msq_contours* contours) {
  msq_contours_report report{};
  report.struct_size = sizeof report;
  assert_ok(msq_contours_info(contours, &report));
  Rings out;
  out.unresolved = report.unresolved_count;
  out.topology = report.topology_count;
  out.pitch = report.pitch;
  for (uint64_t r = 0; r < report.ring_count; ++r) {
    out.parents.push_back(report.parents[r]);
    out.holes.push_back(report.holes[r]);
    out.rings.emplace_back();
    for (uint64_t i = 2 * report.starts[r]; i < 2 * report.starts[r + 1]; i += 2) {
      const auto at = [&](uint64_t n) {
        return report.type == MSQ_INT32
                   ? static_cast<double>(static_cast<const int32_t*>(report.points)[n])
               : report.type == MSQ_INT64
                   ? static_cast<double>(static_cast<const int64_t*>(report.points)[n])
                   : static_cast<const double*>(report.points)[n];
      };
      out.rings.back().push_back({at(i), at(i + 1)});
    }
  }
  assert_int_equal(report.starts[report.ring_count], report.point_count);
  return out;
}

/// Whether segments ab and cd have a point in common.
inline bool do_meet(RingPoint a, RingPoint b, RingPoint c, RingPoint d) {
  const auto side = [](RingPoint p, RingPoint q, RingPoint r) {
    const double s = cross(q - p, r - p);
    return s > 0 ? 1 : s < 0 ? -1 : 0;
  };
  const auto holds = [](RingPoint p, RingPoint q, RingPoint r) {
    return std::min(p.u, q.u) <= r.u && r.u <= std::max(p.u, q.u) && std::min(p.v, q.v) <= r.v &&
           r.v <= std::max(p.v, q.v);
  };
  const int s1 = side(a, b, c), s2 = side(a, b, d), s3 = side(c, d, a), s4 = side(c, d, b);
  if (s1 != s2 && s3 != s4) return true;
  return (s1 == 0 && holds(a, b, c)) || (s2 == 0 && holds(a, b, d)) ||
         (s3 == 0 && holds(c, d, a)) || (s4 == 0 && holds(c, d, b));
}

/// Rings are simple, touch neither themselves nor others, turn the right way, and have the parents
/// that their places say. By all pairs of segments, sorted by v.
inline void check_rings(const Rings& all) {
  struct Segment {
    RingPoint a, b;
    size_t ring, index, of;
    double low, high;
  };
  std::vector<Segment> segments;
  assert_int_equal(all.parents.size(), all.rings.size());
  for (size_t r = 0; r < all.rings.size(); ++r) {
    const auto& ring = all.rings[r];
    if (ring.size() < 3) fail_msg("ring %zu has %zu points", r, ring.size());
    const double area = Rings::area_of(ring);
    if (!(all.holes[r] ? area < 0 : area > 0))
      fail_msg("ring %zu has area %g, hole %d", r, area, all.holes[r]);
    for (size_t i = 0; i < ring.size(); ++i) {
      const RingPoint a = ring[i], b = ring[(i + 1) % ring.size()];
      if (a == b) fail_msg("ring %zu has a point twice", r);
      segments.push_back({a, b, r, i, ring.size(), std::min(a.v, b.v), std::max(a.v, b.v)});
      const RingPoint c = ring[(i + 2) % ring.size()];
      if (cross(b - a, c - b) == 0 && dot(b - a, c - b) < 0)
        fail_msg("ring %zu turns back at (%.9g, %.9g)", r, b.u, b.v);
    }
  }
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.low < b.low; });
  for (size_t i = 0; i < segments.size(); ++i)
    for (size_t j = i + 1; j < segments.size() && segments[j].low <= segments[i].high; ++j) {
      const Segment &s = segments[i], &t = segments[j];
      if (std::max(s.a.u, s.b.u) < std::min(t.a.u, t.b.u) ||
          std::min(s.a.u, s.b.u) > std::max(t.a.u, t.b.u))
        continue;
      if (s.ring == t.ring && ((s.index + 1) % s.of == t.index || (t.index + 1) % t.of == s.index))
        continue;
      if (do_meet(s.a, s.b, t.a, t.b))
        fail_msg("rings %zu and %zu meet near (%.9g, %.9g)", s.ring, t.ring, s.a.u, s.a.v);
    }
  for (size_t r = 0; r < all.rings.size(); ++r) {
    // Of the rings around its first point, the one of least area.
    int64_t parent = -1;
    double least = HUGE_VAL;
    for (size_t q = 0; q < all.rings.size(); ++q) {
      if (q == r || Rings::winding(all.rings[q], all.rings[r][0]) == 0) continue;
      const double area = std::abs(Rings::area_of(all.rings[q]));
      if (area > least) continue;
      least = area;
      parent = static_cast<int64_t>(q);
    }
    if (parent != all.parents[r])
      fail_msg("ring %zu has parent %lld, not %lld", r, static_cast<long long>(all.parents[r]),
               static_cast<long long>(parent));
    if (parent >= 0) assert_true(all.holes[r] != all.holes[static_cast<size_t>(parent)]);
    if (parent < 0) assert_int_equal(all.holes[r], 0);
    assert_true(parent < static_cast<int64_t>(r));
  }
}

}  // namespace msq::test
