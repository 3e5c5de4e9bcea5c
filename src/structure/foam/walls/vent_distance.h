// SPDX-License-Identifier: Apache-2.0
// A bound on the distance to the boundary of walls with holes.
//
// Foam units; t is the thickness. Let a be the seed nearest to a point p. For a seed c and a wall
// of it towards d, let g(c, d) be the distance from p to the plane between c and d, positive on the
// side of c, less t / 2, and k(c, d) the depth of p in the wall's hole. Let
//
//   f(c) = min over the walls of c of max(g(c, d), k(c, d)),
//   h(c) = max over all seeds e of the distance from p to the plane between e and c, positive on
//   the
//          side of e.
//
// A point of the cell of c is in the void if and only if f(c) > 0 there, and h(c) is no more than
// the distance from p to that cell. All four change by no more than p does.
//
// Outside. F = min over all seeds c of max(h(c), f(c)) changes by no more than p does, and is at
// most 0 in the solid, where the term of c = a is. So F is no more than the distance to the solid.
// Nor is D = half of (distance to the nearest face less t / 2) twice, which ignores holes. The
// bound is max(D, min(F, greatest radius)): far from walls no hole needs to be known. Terms below a
// radius r have |p - c| <= |p - a| + 2 r, and |p - d| <= |p - c| + 2 r + t.
//
// Inside. The void that walls without holes would leave is at -D or farther; the void in the hole
// of a wall (c, d) at max(-k, |g + t / 2| - t / 2) or farther. A hole nearer than r <= t / 2 has |p
// - c| <= |p - a| + 2 r and |p - d| <= |p - a| + 2 r + t.
#pragma once

#include "structure/foam/walls/vents.h"

namespace msq {

/// At most the distance from q to the boundary of the walls of any thickness between two; changes
/// by no more than q does, and than half the thickness does.
double vented_distance(const NearSeeds& seeds, const Vents& vents, CellIndex cell, Vec3 q,
                       Interval thickness);

}  // namespace msq
