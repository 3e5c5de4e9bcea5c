// SPDX-License-Identifier: Apache-2.0
#include "surface/boundary_ways.h"

#include "query/inside_points.h"
#include "ray/cast.h"

namespace msq {

bool rays_are_coarse(const Model& model, const Scales& resolved, const MeshGrid& grid) {
  const Ray across{grid.box().min, grid.box().extent()};
  return way_past_end(model, resolved, across, 1) > 0x1p-11 * grid.pitch();
}

void halve(const Model& model, const Scales& resolved, std::vector<BoundaryWay>& ways, int rounds,
           const Job* job) {
  std::vector<Vec3> points(ways.size());
  std::vector<uint8_t> inside;
  for (int round = 0; round < rounds && !ways.empty(); ++round) {
    for (size_t i = 0; i < ways.size(); ++i) points[i] = ways[i].middle();
    find_inside(model, resolved, points, inside, job);
    for (size_t i = 0; i < ways.size(); ++i)
      (inside[i] ? ways[i].inside : ways[i].outside) = points[i];
  }
}

}  // namespace msq
