// SPDX-License-Identifier: Apache-2.0
// The solid angle of the strips from open edges (boundary_loops.h) up to second-order terms, about
// many points at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/ball.h"
#include "base/vec.h"

namespace msq {

/// S about the centre of a ball, as a quadratic function of the scaled vector from there.
struct Expansion {
  /// False where an edge is within twice the radius, as too little would be known, and where the +x
  /// ray from the centre passes through a vertex.
  bool is_known;
  double turns;                  ///< S at the centre
  double error;                  ///< bound of what the function is off by, anywhere in the ball
  Vec3 first;                    ///< factors of x, y and z
  std::array<double, 6> second;  ///< of xx, yy, zz, xy, xz and yz
};

struct LoopEdges {
  const Vec3* vertices;
  const uint64_t* starts;  ///< loop i is vertices[starts[i]] up to [starts[i + 1]]
  size_t loops;
  double scale;
  double rounding;  ///< of positions in the balls, scaled
};

void expand_loops(const LoopEdges& edges, const Ball* balls, size_t count, Expansion* made);

}  // namespace msq
