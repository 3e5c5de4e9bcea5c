// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/edges/graded_edges.h"

#include <algorithm>
#include <utility>

#include "base/borrowed.h"
#include "structure/foam/edges/graded_cells.h"

namespace msq {

namespace {

/// Consecutive owners whose edges share a box: usually leaves of one parent.
constexpr size_t owners_in_run = 8;

/// Calls begin() and then take(edge) for the edges of each run of owners. edge.seeds is set if
/// wanted.
template <bool wants_seeds, class Begin, class Take>
void find_edges(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex corner, Begin&& begin,
                Take&& take) {
  // The density field may be the host's, which may call msq again.
  const Borrowed<GradedCells> borrowed;
  GradedCells& cells = *borrowed;
  std::vector<LeafSeed> owners;
  cells.move_to(seeds, corner);
  const bool names_seeds = names_edge_seeds(*seeds);
  const int side = seeds->brick_side();
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        cells.append_seeds({corner.x + x, corner.y + y, corner.z + z}, owners);
  for (size_t i = 0; i < owners.size(); ++i) {
    if (i % owners_in_run == 0) begin();
    const LeafSeed& own = owners[i];
    cells.find(own);
    for (const GradedCells::Edge& edge : cells.owned_edges()) {
      const Vec3 a = own.position + edge.from * cells.unit(),
                 b = own.position + edge.to * cells.unit();
      GradedEdge taken;
      for (int axis = 0; axis < 3; ++axis) {
        taken.a[static_cast<size_t>(axis)] = static_cast<float>(a[axis]);
        taken.b[static_cast<size_t>(axis)] = static_cast<float>(b[axis]);
      }
      taken.knows_seeds = edge.is_sure && names_seeds;
      if constexpr (wants_seeds) {
        taken.seeds[0] = name_of(own);
        for (size_t n = 0; n < 2; ++n)
          taken.seeds[n + 1] = name_of({{}, edge.others[n].level, edge.others[n].order});
        if (edge.others[0].order > edge.others[1].order) std::swap(taken.seeds[1], taken.seeds[2]);
      }
      take(taken);
    }
  }
}

}  // namespace

bool names_edge_seeds(const GradedSeeds& seeds) {
  return !seeds.placed() || seeds.cells().jitter() > 0;
}

std::shared_ptr<const EdgeBrick> graded_edge_brick(const std::shared_ptr<const GradedSeeds>& seeds,
                                                   CellIndex corner) {
  std::vector<FloatSegment> edges;
  std::vector<uint32_t> starts;
  find_edges<false>(
      seeds, corner, [&] { starts.push_back(static_cast<uint32_t>(edges.size())); },
      [&](const GradedEdge& edge) {
        FloatSegment& added = edges.emplace_back();
        std::copy_n(edge.a.data(), 3, added.a);
        std::copy_n(edge.b.data(), 3, added.b);
      });
  return std::make_shared<const EdgeBrick>(edges, starts);
}

std::shared_ptr<const GradedEdges> graded_edges(const std::shared_ptr<const GradedSeeds>& seeds,
                                                CellIndex corner) {
  std::vector<GradedEdge> edges;
  find_edges<true>(
      seeds, corner, [] {}, [&](const GradedEdge& edge) { edges.push_back(edge); });
  edges.shrink_to_fit();
  return std::make_shared<const GradedEdges>(std::move(edges));
}

}  // namespace msq
