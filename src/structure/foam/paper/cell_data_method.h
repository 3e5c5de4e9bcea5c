// SPDX-License-Identifier: Apache-2.0
// The common part of the paper's set methods: points are grouped by cell, data is built once per
// cell and kept in the cell cache, and each point is evaluated with its cell's data. Source: paper,
// section "Preprocessing for Voronoi Foams".
#pragma once

#include <memory>

#include "structure/common/group_by_cell.h"
#include "structure/foam/foam_data.h"

namespace msq {

/// Structure::keep_points by cell data. Data is a CellData made from (seeds, cell, maximum radius
/// in foam units). It evaluates whether a point, in foam units from the cell's corner, is inside.
template <class Data>
void keep_points_by_cell(const FoamData& foam, const Vec3* points, uint8_t* alive, size_t count) {
  const double max_radius = foam.max_radius();
  const auto grouped = group_by_cell(foam.neighbourhood(), points, alive, count);
  for_each_cell(grouped, [&](CellIndex cell, std::span<const LocatedPoint> group) {
    const auto data = foam.context().cache.fetch(foam.paper_cells_id(), cell, [&] {
      return std::make_shared<const Data>(foam.seeds(), cell, max_radius);
    });
    const auto& known = static_cast<const Data&>(*data);
    for (const LocatedPoint& point : group) {
      check_cancelled();  // precedes a microsecond of work, or hundreds
      const Vec3 q = point.located.fraction * foam.seeds().scale();
      const double r = foam.radius().at(points[point.index]) / foam.unit();
      if (!known.inside(q, r)) alive[point.index] = 0;
    }
  });
}

}  // namespace msq
