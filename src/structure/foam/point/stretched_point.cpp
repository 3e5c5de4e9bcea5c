// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/point/stretched_point.h"

#include "base/borrowed.h"
#include "structure/foam/point/edge_search.h"
#include "structure/foam/point/onset.h"
#include "structure/foam/point/stretched_line.h"
#include "structure/foam/seeds/cell_seeds.h"

namespace msq {

namespace {

class StretchedSpace {
 public:
  explicit StretchedSpace(const Stretch& stretch)
      : stretch_(stretch), factor_(stretch.factor()), slack_(stretched_slack(stretch)) {}

  Vec3 normal(Vec3 n) const { return stretch_.normal(n); }
  StretchedLine line(Vec3 a, Vec3 b, Vec3 c) const { return StretchedLine(factor_, a, b, c); }
  double slack() const { return slack_; }

 private:
  const Stretch& stretch_;
  const Vec3 factor_;
  const double slack_;
};

/// The seeds that may matter to a point. Points come cell by cell where the caller can arrange it.
struct Workspace {
  CellSeeds around;
  std::vector<uint32_t> found;
  std::vector<Vec3> positions;
  std::vector<NearSeed> near;

  /// In diagram units.
  const CellSeeds::Block& find(const Stretch& stretch, CellIndex cell, Vec3 q, double radius) {
    around.move_to(stretch.seeds(), cell);
    const CellSeeds::Block& block = around.find_near(q, stretch.around(radius), found);
    positions.clear();
    for (const uint32_t i : found) positions.push_back(block.position(i));
    return block;
  }

  size_t bytes() const { return around.bytes(); }
};

}  // namespace

bool stretched_point_inside(const Stretch& stretch, CellIndex cell, Vec3 q, double radius) {
  const Borrowed<Workspace> workspace;
  const Vec3 place = stretch.to_diagram(q);
  workspace->find(stretch, cell, place, radius);
  return search_edges(StretchedSpace(stretch), workspace->positions, place, q, radius, true) <
         std::numeric_limits<double>::infinity();
}

double stretched_onset(const Stretch& stretch, CellIndex cell, Vec3 q) {
  const Borrowed<Workspace> workspace;
  const Vec3 place = stretch.to_diagram(q);
  const StretchedSpace space(stretch);
  // The nearest seed's cell holds the point and has edges.
  const double most = 2 * length(stretch.reach());
  for (double radius = first_onset_radius;; radius *= 2) {
    workspace->find(stretch, cell, place, radius);
    const double found = search_edges(space, workspace->positions, place, q, radius);
    if (found <= radius) return found;
    if (radius >= most) return radius;
  }
}

void find_stretched_edges_near(const Stretch& stretch, CellIndex cell, Vec3 q, double radius,
                               std::vector<NearEdge>& struts) {
  const Borrowed<Workspace> workspace;
  struts.clear();
  const Vec3 place = stretch.to_diagram(q);
  const CellSeeds::Block& block = workspace->find(stretch, cell, place, radius);
  if (workspace->positions.size() < 3) return;
  const StretchedSpace space(stretch);
  std::vector<NearSeed>& near = workspace->near;
  find_near_planes(space, workspace->positions, place, radius, near);
  const double reach = radius + space.slack();
  const auto cell_of = [&](const NearSeed& seed) {
    const int n = static_cast<int>(workspace->found[seed.index]), x = 2 * block.half[0] + 1,
              y = 2 * block.half[1] + 1;
    return CellIndex{cell.x + n % x - block.half[0], cell.y + n / x % y - block.half[1],
                     cell.z + n / x / y - block.half[2]};
  };
  const size_t count = near.size();
  for (size_t a = 0; a < count; ++a)
    for (size_t b = a + 1; b < count; ++b) {
      if (too_far(space, near[a], near[b], reach)) continue;
      for (size_t c = b + 1; c < count; ++c) {
        if (too_far(space, near[a], near[c], reach) || too_far(space, near[b], near[c], reach))
          continue;
        const StretchedLine line = line_of(space, near[a], near[b], near[c]);
        if (!line.exists()) continue;
        LineInterval part = line.chord(q, radius * radius);
        for (size_t i = 0; i < count && line.holds(part); ++i)
          if (i != a && i != b && i != c) line.cut(near[i].position, part);
        if (!line.holds(part)) continue;
        const Vec3 d = line.way_from(part, q);
        struts.push_back({line.of_foam,
                          part,
                          {cell_of(near[a]), cell_of(near[b]), cell_of(near[c])},
                          dot(d, d)});
      }
    }
}

}  // namespace msq
