// SPDX-License-Identifier: Apache-2.0
// Source: paper, section "Preprocessing for Voronoi Foams", Method 2: pairs of adjacent tetrahedra
// of the cell's Delaunay triangulation, an edge between their circumcentres, with the ids of the
// three seeds of the shared facet; per sample, only the edges near its nearest seed are tested.
//
// Which seeds a cell needs: as in point.cpp, only seeds within d0 + 2 r of a point p decide, and
// the edges' own within d0 + r of a point that is itself within r of p. With d0 at most the empty
// radius e (the cell's diagonal), a point v of an edge with |v - p| <= r has its three seeds within
// e of v, hence within e + r of p. The block of cells that reaches e + r about every point of the
// cell holds them and all seeds that could make v invalid. Edges of that block's triangulation may
// run on past their true ends, but nowhere within r of the cell.
#include "structure/foam/method_2.h"

#include <algorithm>
#include <vector>

#include "structure/foam/delaunay.h"
#include "structure/foam/edge_line.h"
#include "structure/group_by_cell.h"

namespace msq {

namespace {

class CellEdges final : public CellData {
 public:
  struct Edge {
    EdgeLine line;
    LineInterval part;  // between the circumcentres of the two tetrahedra
    uint32_t seed;      // of the line's first seed
  };

  CellEdges(const FoamSeeds& seeds, CellIndex cell, double most_radius);

  bool inside(Vec3 q, double radius) const;
  uint64_t bytes() const override {
    return sizeof *this + seeds_.capacity() * sizeof(Vec3) + edges_.capacity() * sizeof(Edge);
  }

 private:
  std::vector<Vec3> seeds_;
  std::vector<Edge> edges_;
};

CellEdges::CellEdges(const FoamSeeds& seeds, CellIndex cell, double most_radius) {
  const Vec3 scale = seeds.scale();
  const double reach = seeds.empty_radius() + most_radius + 1e-9;
  int half[3];
  for (int axis = 0; axis < 3; ++axis)
    half[axis] = static_cast<int>(std::ceil(reach / scale[axis]));
  for (int dz = -half[2]; dz <= half[2]; ++dz)
    for (int dy = -half[1]; dy <= half[1]; ++dy)
      for (int dx = -half[0]; dx <= half[0]; ++dx) seeds_.push_back(seeds.at(cell, dx, dy, dz));

  const Vec3 centre = scale * 0.5;
  const double ball = length(centre) + most_radius + 1e-9;  // holds all points within r of the cell
  for (const DelaunayFacet& facet : delaunay_facets(seeds_)) {
    const auto [a, b, c] = facet.seeds;
    Edge edge{EdgeLine(seeds_[a], seeds_[b], seeds_[c]), {-1e300, 1e300}, a};
    if (!edge.line.exists()) continue;
    for (int64_t opposite : facet.opposite)
      if (opposite >= 0) edge.line.cut(seeds_[opposite], edge.part);
    LineInterval near = edge.line.chord(centre, ball * ball);
    near.low = std::max(near.low, edge.part.low);
    near.high = std::min(near.high, edge.part.high);
    if (edge.line.holds(near)) edges_.push_back(edge);
  }
  edges_.shrink_to_fit();
  seeds_.shrink_to_fit();
}

bool CellEdges::inside(Vec3 q, double radius) const {
  double nearest_squared = 1e300;
  thread_local std::vector<double> distance_squared;
  distance_squared.resize(seeds_.size());
  for (size_t i = 0; i < seeds_.size(); ++i) {
    const Vec3 d = seeds_[i] - q;
    distance_squared[i] = dot(d, d);
    nearest_squared = std::min(nearest_squared, distance_squared[i]);
  }
  const double needed = std::sqrt(nearest_squared) + 2 * radius + 1e-9;
  const double needed_squared = needed * needed, r2 = radius * radius;
  for (const Edge& edge : edges_) {
    if (distance_squared[edge.seed] > needed_squared) continue;
    LineInterval part = edge.line.chord(q, r2);
    if (!edge.line.holds(part)) continue;
    part.low = std::max(part.low, edge.part.low);
    part.high = std::min(part.high, edge.part.high);
    if (edge.line.holds(part)) return true;
  }
  return false;
}

}  // namespace

void method_2_keep_points(const Foam& foam, const Vec3* points, uint8_t* alive, size_t count) {
  const double most_radius = foam.radius().range().high / foam.unit();
  const auto grouped = group_by_cell(foam.neighbourhood(), points, alive, count);
  for_each_cell(grouped, [&](CellIndex cell, std::span<const LocatedPoint> group) {
    const auto data = foam.context().cache.fetch(foam.id(), cell, [&] {
      return std::make_shared<const CellEdges>(foam.seeds(), cell, most_radius);
    });
    const auto& edges = static_cast<const CellEdges&>(*data);
    for (const LocatedPoint& point : group) {
      const Vec3 q = point.located.fraction * foam.seeds().scale();
      const double r = foam.radius().at(points[point.index]) / foam.unit();
      if (!edges.inside(q, r)) alive[point.index] = 0;
    }
  });
}

}  // namespace msq
