// SPDX-License-Identifier: Apache-2.0
// Groups points by neighbourhood cell. Source: paper, section "Structured and Unstructured Set
// Queries".
//
// Two other sorts are for other data. Of millions of points query/point_groups makes boxes of
// cells, by counting and in parallel. structure/foam/sets/point_set.cpp has the cells of its points
// from vectors already, keeps its arrays between calls and needs the order alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cell/neighbourhood.h"

namespace msq {

struct LocatedPoint {
  Neighbourhood::Located located;
  size_t index;  ///< in the host's array
};

/// The points with alive[i] != 0. Points of one cell are adjacent; cells are in the order of their
/// indices (z, then y, then x). Points spread over more than 2^14 cells along an axis stay in their
/// own order: then few share a cell.
std::vector<LocatedPoint> group_by_cell(const Neighbourhood& grid, const Vec3* points,
                                        const uint8_t* alive, size_t count);

/// Calls visit(cell, points) for each run of points of one cell.
template <class Visit>
void for_each_cell(const std::vector<LocatedPoint>& grouped, Visit&& visit) {
  for (size_t first = 0; first < grouped.size();) {
    const CellIndex cell = grouped[first].located.cell;
    size_t last = first + 1;
    while (last < grouped.size() && grouped[last].located.cell == cell) ++last;
    visit(cell, std::span<const LocatedPoint>(grouped.data() + first, last - first));
    first = last;
  }
}

}  // namespace msq
