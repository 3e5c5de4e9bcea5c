// SPDX-License-Identifier: Apache-2.0
// Source: paper, section "Fine-scale Structures" (Voronoi Foams), after Martinez, Dumas and
// Lefebvre 2016: find the seeds of the neighbourhood; find the nearest one; project the point onto
// the line of every triplet that has it; last, check that the projection is on an edge of the
// diagram.
//
// Two things differ, since the solid is that of capsules (edge_line.h). First, the edges within r
// of p may be those of other seeds than the nearest one. Their seeds are within d0 + 2 r of p
// (reaching_seeds.h), and here each of these takes the role of the nearest one in turn, with all
// pairs of other seeds. Second, the projection is a chord, not a foot: the part of the line within
// r of p. The test of validity must leave a part of it. All seeds of a triplet are within d0 + 2 r,
// and only seeds within that distance can clip its chord. The definition (point.h) makes use of
// this; the paper's query does not, and neither does this one. The triplets and clips that it tries
// beyond those of the definition change no bit: a triplet with a seed farther than that is clipped
// away by a margin, and a clip by such a seed does not bind.
#include "structure/foam/paper/naive_point.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/paper/halo.h"
#include "structure/foam/paper/reaching_seeds.h"
#include "structure/foam/point/edge_line.h"

namespace msq {

namespace {

struct Workspace {
  std::vector<Vec3> gathered;
  std::vector<uint32_t> order;
  ReachingSeeds near;
};

}  // namespace

bool naive_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius) {
  const Borrowed<Workspace> borrowed;
  auto& [gathered, order, near] = *borrowed;

  // Gather the seeds of the halo.
  halo_seeds(seeds, cell, radius, gathered);
  const size_t count = gathered.size();

  // The nearest seed and those that may take its role come first.
  near.find(gathered, q, radius);
  order.resize(count);
  for (uint32_t i = 0; i < count; ++i) order[i] = i;
  const ReachingSeeds& reaching = near;
  const auto rest = std::stable_partition(
      order.begin(), order.end(), [&reaching](uint32_t seed) { return reaching.has(seed); });
  const size_t near_count = static_cast<size_t>(rest - order.begin());

  // Triplets with at least one of them, each once.
  const double r2 = radius * radius;
  for (size_t a = 0; a < near_count; ++a)
    for (size_t b = a + 1; b < count; ++b) {
      check_cancelled();
      for (size_t c = b + 1; c < count; ++c) {
        std::array<uint32_t, 3> triplet = {order[a], order[b], order[c]};
        std::sort(triplet.begin(), triplet.end());
        const EdgeLine line(gathered[triplet[0]], gathered[triplet[1]], gathered[triplet[2]]);
        if (!line.exists()) continue;

        // Projection.
        LineInterval part = line.chord(q, r2);

        // Validity.
        for (uint32_t i = 0; i < count && line.holds(part); ++i)
          if (i != triplet[0] && i != triplet[1] && i != triplet[2]) line.cut(gathered[i], part);
        if (line.holds(part)) return true;
      }
    }
  return false;
}

namespace {

bool inside(const FoamData& foam, Vec3 p) {
  const Neighbourhood::Located located = foam.neighbourhood().locate(p);
  return naive_point_inside(foam.seeds(), located.cell, located.fraction * foam.seeds().scale(),
                            foam.radius().at(p) / foam.unit());
}

}  // namespace

void naive_keep_points(const FoamData& foam, const Vec3* points, uint8_t* alive, size_t count) {
  for (size_t i = 0; i < count; ++i)
    if (alive[i] && !inside(foam, points[i])) alive[i] = 0;
}

void naive_keep_rows(const FoamData& foam, const RowBlock& block, const Job* job) {
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j)
      for (size_t w = 0; w < block.row_words(); ++w) {
        uint64_t& word = block.row(j, k)[w];
        for (uint64_t rest = word; rest; rest &= rest - 1) {
          check_cancelled(job);
          const unsigned bit = static_cast<unsigned>(std::countr_zero(rest));
          if (!inside(foam, block.grid->at(w * bits_per_word + bit, j, k)))
            word &= ~(uint64_t{1} << bit);
        }
      }
}

}  // namespace msq
