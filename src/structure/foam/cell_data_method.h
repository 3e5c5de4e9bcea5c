// SPDX-License-Identifier: Apache-2.0
// What the set methods of the paper share: points grouped by cell, data built once per cell and
// kept in the cell cache, each point answered from its cell's data. Source: paper, section
// "Preprocessing for Voronoi Foams".
#pragma once

#include <memory>

#include "structure/foam/foam.h"
#include "structure/group_by_cell.h"

namespace msq {

/// Structure::keep_points by the data of cells. Data is a CellData made from (seeds, cell, greatest
/// radius in foam units) that says of a point, in foam units from the cell's corner, whether it is
/// inside.
template <class Data>
void keep_points_by_cell(const Foam& foam, const Vec3* points, uint8_t* alive, size_t count) {
  const double most_radius = foam.most_radius();
  const auto grouped = group_by_cell(foam.neighbourhood(), points, alive, count);
  for_each_cell(grouped, [&](CellIndex cell, std::span<const LocatedPoint> group) {
    const auto data = foam.context().cache.fetch(foam.id(), cell, [&] {
      return std::make_shared<const Data>(foam.seeds(), cell, most_radius);
    });
    const auto& known = static_cast<const Data&>(*data);
    for (const LocatedPoint& point : group) {
      const Vec3 q = point.located.fraction * foam.seeds().scale();
      const double r = foam.radius().at(points[point.index]) / foam.unit();
      if (!known.inside(q, r)) alive[point.index] = 0;
    }
  });
}

}  // namespace msq
