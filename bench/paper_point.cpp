// SPDX-License-Identifier: Apache-2.0
// Source: Igouchkine and Liu, "Set-based queries for multiscale shape-material modeling", section
// "Fine-scale Structures" (Voronoi Foams); Martinez, Dumas and Lefebvre, "Procedural Voronoi foams
// for additive manufacturing", 2016.
#include "paper_point.h"

namespace bench {

using msq::Vec3;

bool paper_point_inside(const msq::FoamSeeds& seeds, Vec3 p, double r) {
  // The seeds of the 5^3 cells about the point's.
  constexpr int count = 5 * 5 * 5;
  Vec3 s[count];
  const msq::CellIndex cell{static_cast<int32_t>(std::floor(p.x)),
                            static_cast<int32_t>(std::floor(p.y)),
                            static_cast<int32_t>(std::floor(p.z))};
  const Vec3 q = p - Vec3{double(cell.x), double(cell.y), double(cell.z)};
  int n = 0, nearest = 0;
  for (int z = -2; z <= 2; ++z)
    for (int y = -2; y <= 2; ++y)
      for (int x = -2; x <= 2; ++x) s[n++] = seeds.at(cell, x, y, z);

  // The nearest one.
  double least = 1e300;
  for (int i = 0; i < count; ++i) {
    const double d2 = dot(s[i] - q, s[i] - q);
    if (d2 < least) least = d2, nearest = i;
  }

  // Every triplet with it: the foot of the perpendicular from the point to the line that is equally
  // far from the three, and whether no other seed is nearer to the foot.
  const Vec3 a = s[nearest];
  for (int i = 0; i < count; ++i) {
    if (i == nearest) continue;
    for (int j = i + 1; j < count; ++j) {
      if (j == nearest) continue;
      const Vec3 u = s[i] - a, v = s[j] - a, along = cross(u, v);
      const double squared = dot(along, along);
      if (squared < 1e-24) continue;
      const Vec3 offset = cross(v * dot(u, u) - u * dot(v, v), along) * (0.5 / squared);
      const Vec3 w = q - a - offset;
      const Vec3 away = w - along * (dot(w, along) / squared);
      if (dot(away, away) > r * r) continue;
      const Vec3 foot = q - away;
      const double own = dot(foot - a, foot - a) * (1 - 1e-12);
      bool is_edge = true;
      for (int k = 0; k < count && is_edge; ++k)
        is_edge = k == nearest || k == i || k == j || dot(foot - s[k], foot - s[k]) >= own;
      if (is_edge) return true;
    }
  }
  return false;
}

}  // namespace bench
