// SPDX-License-Identifier: Apache-2.0
// Whether a boundary is flat across a normal, by membership.
#pragma once

#include <cstddef>

#include "base/basis.h"
#include "base/vec.h"

namespace msq::test {

/// Whether the boundary, of which p is a point, is flat across n at the distance `along`: within
/// about 1 degree. Just before that plane points are outside, just behind it inside.
template <class Inside>
bool is_flat_across(Vec3 p, Vec3 n, double along, Inside&& inside) {
  const Vec3 beside = n * (0.02 * along);
  Vec3 u, v;
  complete_basis(n, u, v);
  for (const Vec3 way : {u, v})
    for (const double side : {-along, along}) {
      const Vec3 q = p + way * side;
      if (inside(q + beside) || !inside(q - beside)) return false;
    }
  return true;
}

/// Normals across which the boundary is flat, and others: near edges, or they are wrong.
struct Flatness {
  size_t straight = 0, tilted = 0;

  void add(bool is_flat) { ++(is_flat ? straight : tilted); }
  void add(const Flatness& others) {
    straight += others.straight;
    tilted += others.tilted;
  }
  bool are_most_tilted() const { return tilted >= 10 && tilted > straight; }
};

}  // namespace msq::test
