// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/vent_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/job.h"
#include "structure/foam/walls/foam_walls.h"

namespace msq {

namespace {

/// The wall whose face holds a point, found by the two seeds nearest to it; one without a hole if
/// they are not certain, which is so next to an edge of the diagram.
VentedWall wall_at(const FoamWalls& walls, const Neighbourhood::Located& located, Vec3 q,
                   std::vector<Vec3>& near) {
  const NearSeeds& seeds = walls.seeds();
  seeds.find(located.cell, q, 1e-6, near);
  VentedWall whole;
  whole.is_there = true;
  if (near.size() != 2) return whole;
  return walls.vents().wall(seeds, located.cell, near[0], near[1]);
}

}  // namespace

void cut_vents(const FoamWalls& walls, double z, LineGraph& graph) {
  const Neighbourhood& grid = walls.neighbourhood();
  CountedVector<std::array<uint32_t, 2>> lines;
  std::swap(lines, graph.lines);
  std::vector<Vec3> near;
  JobPoll poll(current_job());
  const auto keep = [&](uint32_t a, uint32_t b, double from, double to) {
    if (!(from < to)) return;
    const Vec2 p = graph.points[a], way = graph.points[b] - p;
    const auto end = [&](double t, uint32_t known) {
      if (t == 0 || t == 1) return known;
      graph.points.push_back(p + way * t);
      return static_cast<uint32_t>(graph.points.size() - 1);
    };
    const uint32_t first = end(from, a), last = end(to, b);
    graph.lines.push_back({first, last});
  };
  for (auto [a, b] : lines) {
    poll();
    // The same way in every window.
    const auto key = [&](uint32_t i) { return std::pair(graph.points[i].x, graph.points[i].y); };
    if (key(b) < key(a)) std::swap(a, b);
    const Vec2 p = graph.points[a], way = graph.points[b] - p, middle = p + way * 0.5;
    const Neighbourhood::Located located = grid.locate({middle.x, middle.y, z});
    const Vec3 q = located.fraction * walls.seeds().seeds().scale();
    const VentedWall wall = wall_at(walls, located, q, near);
    if (!wall.is_there) continue;
    if (!(wall.radius > 0)) {
      graph.lines.push_back({a, b});
      continue;
    }
    // From the hole's axis to the middle of the line, and along the line, across the axis.
    const auto across = [&](Vec3 v) { return v - wall.along * dot(v, wall.along); };
    const Vec3 off = across(q - wall.middle);
    const Vec3 step = across(grid.rotation.apply_inverse({way.x, way.y, 0}) * (1 / walls.unit()));
    // Holes are where |off + (t - 1/2) step| < radius.
    const double squared = dot(step, step), half = dot(off, step) / squared;
    const double root = half * half - (dot(off, off) - wall.radius * wall.radius) / squared;
    if (!(root > 0)) {
      graph.lines.push_back({a, b});
      continue;
    }
    const double from = 0.5 - half - std::sqrt(root), to = 0.5 - half + std::sqrt(root);
    keep(a, b, 0, std::clamp(from, 0.0, 1.0));
    keep(a, b, std::clamp(to, 0.0, 1.0), 1);
  }
}

}  // namespace msq
