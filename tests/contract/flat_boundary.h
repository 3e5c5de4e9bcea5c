// SPDX-License-Identifier: Apache-2.0
// Whether a boundary is flat across a normal, by membership.
#pragma once

#include <cmath>

#include "base/vec.h"

namespace msq::test {

/// Whether points at `along` from p, a point of the boundary, lie within 1 degree of the plane
/// across n: just before it they are outside, just behind it inside.
template <class Inside>
bool is_flat_across(Vec3 p, Vec3 n, double along, Inside&& inside) {
  const Vec3 beside = n * (0.02 * along);
  Vec3 axis;
  axis[std::abs(n.x) < 0.6 ? 0 : 1] = 1;
  const Vec3 u = cross(n, axis), v = cross(n, u * (1 / length(u)));
  for (const Vec3 way : {u, v})
    for (const double side : {-along, along}) {
      const Vec3 q = p + way * (side / length(way));
      if (inside(q + beside) || !inside(q - beside)) return false;
    }
  return true;
}

/// Normals across which the boundary is flat, and others: near edges, or they are wrong.
struct Flatness {
  size_t straight = 0, tilted = 0;

  void add(bool is_flat) { ++(is_flat ? straight : tilted); }
  bool are_most_tilted() const { return tilted >= 10 && tilted > straight; }
};

}  // namespace msq::test
