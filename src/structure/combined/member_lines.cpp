// SPDX-License-Identifier: Apache-2.0
#include "structure/combined/member_lines.h"

#include <algorithm>

#include "base/infinity.h"
#include "structure/common/kept_lines.h"
#include "structure/common/plane_cells.h"

namespace msq {

namespace {

constexpr double weld_distance = 1e-9;  // of the smallest cell size

/// Of structures that are evaluated at the points of lines.
void require_in_cells_of(const Structure& structure, const LineGraph& graph, double z) {
  Box2 box{graph.points[0], graph.points[0]};
  for (const Vec2 p : graph.points)
    box = {{std::min(box.min.x, p.x), std::min(box.min.y, p.y)},
           {std::max(box.max.x, p.x), std::max(box.max.y, p.y)}};
  structure.for_each_grid([&](const Neighbourhood& grid) {
    require_in_cells(grid, WallSection{z, box, 1});
  });
}

/// How many of the structures give lines, from the first on.
size_t lined_members(BooleanStructure::Operation operation, const StructureList& members) {
  return operation == BooleanStructure::Operation::united ? members.size() : 1;
}

}  // namespace

ThinWalls walls_of_members(BooleanStructure::Operation operation, const StructureList& members) {
  const auto end = members.begin() + static_cast<std::ptrdiff_t>(lined_members(operation, members));
  const bool have_walls = std::all_of(members.begin(), end, [](const Ref<const Structure>& member) {
    return member->thin_walls() != ThinWalls::none;
  });
  return have_walls ? ThinWalls::varying : ThinWalls::none;
}

LineGraph lines_of_members(BooleanStructure::Operation operation, const StructureList& members,
                           const WallSection& section) {
  const bool is_union = operation == BooleanStructure::Operation::united;
  const size_t count = lined_members(operation, members);
  for (size_t i = 0; i < count; ++i)
    if (members[i]->thin_walls() == ThinWalls::none)
      fail(Status::unsupported,
           is_union ? "structure %zu of the union has no thin walls whose middle lines are known; "
                      "use the contours of the union"
                    : "structure %zu, the first one, has no thin walls whose middle lines are "
                      "known, and those of the others only bound it; use contours",
           i);
  LineGraph graph;
  double smallest = infinity;
  for (size_t i = 0; i < count; ++i) {
    const LineGraph part = members[i]->wall_lines(section);
    const auto first = static_cast<uint32_t>(graph.points.size());
    graph.points.insert(graph.points.end(), part.points.begin(), part.points.end());
    for (const auto& [a, b] : part.lines) graph.lines.push_back({first + a, first + b});
    smallest = std::min(smallest, min_component(members[i]->neighbourhood().cell_size));
  }
  // Structures may share walls.
  if (count > 1) graph.weld(weld_distance * smallest);
  if (is_union || members.size() == 1 || graph.lines.empty()) return graph;
  for (size_t i = 1; i < members.size(); ++i) require_in_cells_of(*members[i], graph, section.z);
  const bool wanted = operation == BooleanStructure::Operation::intersected;
  keep_parts(graph, section.tolerance, [&](Vec2 at) {
    const Vec3 p{at.x, at.y, section.z};
    // As far as all others stay as they are, or as one stays that is not as wanted.
    double steady = infinity;
    for (size_t i = 1; i < members.size(); ++i) {
      const double distance = members[i]->distance(p);
      if ((distance <= 0) != wanted) return KeptPoint{false, std::abs(distance)};
      steady = std::min(steady, std::abs(distance));
    }
    return KeptPoint{true, steady};
  });
  return graph;
}

}  // namespace msq
