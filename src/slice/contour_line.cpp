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
      const Cone gate{{p.right[0] - a.x, p.right[1] - a.y}, {p.left[0] - a.x, p.left[1] - a.y}};
      if (!(cross(gate.right, gate.left) > 0)) break;
      if (is_first) {
        cone = gate;
        continue;
      }
      // Each side of the cone moves to the gate's where that lies within the cone, stays where it
      // lies within the gate, and else the two have no direction in common. Of two crosses with
      // the factors exchanged, one is the other's negative to the last bit.
      const double right_left = cross(cone.right, gate.left);
      const double left_left = cross(gate.left, cone.left);
      const double right_right = cross(cone.right, gate.right);
      const double right_behind = cross(gate.right, cone.left);
      if (right_left >= 0 && left_left >= 0)
        cone.left = gate.left;
      else if (!(right_behind >= 0 && left_left <= 0))
        break;
      if (right_right >= 0 && right_behind >= 0)
        cone.right = gate.right;
      else if (!(right_right <= 0 && right_left >= 0))
        break;
      if (!(cross(cone.right, cone.left) > 0)) break;
    }
    from = last;
  }
}

}  // namespace msq
