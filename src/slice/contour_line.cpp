// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_line.h"

namespace msq {

namespace {

/// Directions between two, less than half a turn apart.
struct Cone {
  Vec2 right, left;

  bool holds(Vec2 d) const { return cross(right, d) >= 0 && cross(d, left) >= 0; }
};

}  // namespace

void simplify_ring(const std::vector<LinePoint>& ring, std::vector<Vec2>& out) {
  /// Points that are looked at beyond the last that fits.
  constexpr size_t max_look_ahead = 64;
  out.clear();
  const size_t count = ring.size();
  if (count == 0) return;
  size_t start = 0;
  while (start < count && !ring[start].is_fixed) ++start;
  if (start == count) start = 0;
  const auto point = [&](size_t i) -> const LinePoint& {
    const size_t at = start + i;
    return ring[at < count ? at : at - count];
  };
  for (size_t from = 0; from < count;) {
    const Vec2 a = point(from).at;
    out.push_back(a);
    size_t last = from + 1;
    Cone cone{};
    for (size_t i = from + 1; i <= count && i - last <= max_look_ahead; ++i) {
      const LinePoint& p = point(i == count ? 0 : i);
      const bool is_first = i == from + 1;
      if (is_first || cone.holds(p.at - a)) last = i;
      if (i == count || p.is_fixed) break;
      const Cone gate{p.right - a, p.left - a};
      if (!(cross(gate.right, gate.left) > 0)) break;
      if (is_first) {
        cone = gate;
        continue;
      }
      const Cone before = cone;
      if (before.holds(gate.left))
        cone.left = gate.left;
      else if (!gate.holds(before.left))
        break;
      if (before.holds(gate.right))
        cone.right = gate.right;
      else if (!gate.holds(before.right))
        break;
      if (!(cross(cone.right, cone.left) > 0)) break;
    }
    from = last;
  }
}

}  // namespace msq
