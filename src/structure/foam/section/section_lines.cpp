// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/section/section_lines.h"

#include <algorithm>

#include "base/job.h"
#include "structure/foam/section/section_cells.h"

namespace msq {

namespace {

/// Of the reach: corners that are closer are one. Seeds without jitter have corners of four cells
/// and more.
constexpr double weld_distance = 1e-7;

bool may_meet(Vec2 a, Vec2 b, const Box2& box) {
  return std::min(a.x, b.x) <= box.max.x && std::max(a.x, b.x) >= box.min.x &&
         std::min(a.y, b.y) <= box.max.y && std::max(a.y, b.y) >= box.min.y;
}

}  // namespace

LineGraph foam_section(const SectionFoam& foam, const WallSection& section) {
  const SectionPlane plane(foam, section.z);
  const Box2 window = plane.image(section.window);
  const SectionSeeds seeds = find_section_seeds(foam, plane, window);
  SectionCells cells(seeds, window);
  const Box2 owners = window.grown(seeds.reach);
  LineGraph graph;
  JobPoll poll(current_job());
  for (uint32_t i = 0; i < seeds.seeds.size(); ++i) {
    if (!owners.contains(seeds.seeds[i].position)) continue;
    poll();
    const CountedVector<SectionCells::Corner>& cell = cells.cell(i);
    for (size_t c = 0; c < cell.size(); ++c) {
      const SectionCells::Corner &from = cell[c], &to = cell[c + 1 < cell.size() ? c + 1 : 0];
      // The first of the two seeds owns the line between them.
      if (from.beyond == SectionCells::nobody || from.beyond < i) continue;
      if (!may_meet(from.point, to.point, window)) continue;
      const uint32_t number = static_cast<uint32_t>(graph.points.size());
      graph.points.push_back(from.point);
      graph.points.push_back(to.point);
      graph.lines.push_back({number, number + 1});
    }
  }
  graph.weld(weld_distance * seeds.reach);
  for (Vec2& point : graph.points) point = plane.to_model(point);
  return graph;
}

}  // namespace msq
