// SPDX-License-Identifier: Apache-2.0
// Source: paper, section "Preprocessing for Voronoi Foams", Method 2. Per cell: pairs of adjacent
// tetrahedra of the cell's Delaunay triangulation; an edge between their circumcentres, with the
// ids of the three seeds of the shared facet. Per sample: only the edges of the nearest seed's
// neighbourhood are tested (reaching_seeds.h: more than the paper's, for struts that reach in from
// other cells).
//
// The triangulation is that of the seeds that decide about the cell (halo.h). Its edges may extend
// beyond their true ends, but nowhere within r of the cell.
#include "structure/foam/paper/method_2.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/paper/cell_data_method.h"
#include "structure/foam/paper/delaunay.h"
#include "structure/foam/paper/halo.h"
#include "structure/foam/paper/reaching_seeds.h"
#include "structure/foam/point/edge_line.h"

namespace msq {

namespace {

class CellEdges final : public CellData {
 public:
  CellEdges(const FoamSeeds& seeds, CellIndex cell, double max_radius);

  bool inside(Vec3 q, double radius) const;
  uint64_t bytes() const override {
    return sizeof *this + seeds_.capacity() * sizeof(Vec3) + edges_.capacity() * sizeof(Edge);
  }

 private:
  struct Edge {
    EdgeLine line;
    LineInterval part;  // between the circumcentres of the two tetrahedra
    std::array<uint32_t, 3> seeds;
  };

  std::vector<Vec3> seeds_;
  std::vector<Edge> edges_;
};

CellEdges::CellEdges(const FoamSeeds& seeds, CellIndex cell, double max_radius) {
  halo_seeds(seeds, cell, max_radius, seeds_);
  seeds_.shrink_to_fit();
  const Vec3 centre = seeds.scale() * 0.5;
  const double ball = length(centre) + max_radius + halo_slack;  // all points within r of the cell
  for (const DelaunayFacet& facet : delaunay_facets(seeds_)) {
    const auto [a, b, c] = facet.seeds;
    Edge edge{EdgeLine(seeds_[a], seeds_[b], seeds_[c]), {-1e300, 1e300}, facet.seeds};
    if (!edge.line.exists()) continue;
    for (int64_t opposite : facet.opposite)
      if (opposite >= 0) edge.line.cut(seeds_[static_cast<size_t>(opposite)], edge.part);
    LineInterval near = edge.line.chord(centre, ball * ball);
    near.low = std::max(near.low, edge.part.low);
    near.high = std::min(near.high, edge.part.high);
    if (edge.line.holds(near)) edges_.push_back(edge);
  }
  edges_.shrink_to_fit();
}

bool CellEdges::inside(Vec3 q, double radius) const {
  const Borrowed<ReachingSeeds> borrowed;
  ReachingSeeds& near = *borrowed;
  near.find(seeds_, q, radius);
  const double r2 = radius * radius;
  for (const Edge& edge : edges_) {
    if (!near.has(edge.seeds)) continue;
    LineInterval part = edge.line.chord(q, r2);
    if (!edge.line.holds(part)) continue;
    part.low = std::max(part.low, edge.part.low);
    part.high = std::min(part.high, edge.part.high);
    if (edge.line.holds(part)) return true;
  }
  return false;
}

}  // namespace

void method_2_keep_points(const FoamData& foam, const Vec3* points, uint8_t* alive, size_t count) {
  keep_points_by_cell<CellEdges>(foam, points, alive, count);
}

}  // namespace msq
