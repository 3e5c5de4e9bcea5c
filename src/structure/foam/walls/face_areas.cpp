// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/face_areas.h"

#include <algorithm>

namespace msq {

void FaceAreas::Sum::add(Vec3 v, Vec3 w) {
  if (!is_begun) corner = v;
  is_begun = true;
  const Vec3 to_v = v - corner, to_w = w - corner;
  const double part = 0.5 * length(cross(to_v, to_w));
  area += part;
  moment = moment + (to_v + to_w) * part;
}

WallFace FaceAreas::Sum::face() const {
  if (!(area > 0)) return {};
  return {area, corner + moment * (1 / (3 * area))};
}

bool FaceAreas::find(const VoronoiCell& cell) {
  constexpr double least_along = 0.01, most_radius = 2;
  sums_.assign(cell.count(), {});
  const VoronoiCell::Planes& planes = cell.planes();
  const auto normal = [&](uint32_t i) { return Vec3{planes.x[i], planes.y[i], planes.z[i]}; };
  bool is_known = cell.radius_squared() <= most_radius * most_radius;
  cell.for_each_edge(0, [&](size_t v, size_t w, uint32_t a, uint32_t b) {
    const Vec3 of_a = normal(a), of_b = normal(b), turn = cross(of_a, of_b);
    // The part of one along the plane of the other is the cross product over the other's length.
    is_known = is_known && dot(turn, turn) >= least_along * least_along *
                                                  std::max(dot(of_a, of_a), dot(of_b, of_b));
    const Vec3 from = cell.vertex(v), to = cell.vertex(w);
    sums_[a].add(from, to);
    sums_[b].add(from, to);
  });
  return is_known;
}

}  // namespace msq
