// SPDX-License-Identifier: Apache-2.0
// Source: paper, section "Fine-scale Structures" (Voronoi Foams), after Martinez, Dumas and
// Lefebvre 2016: find the seeds of the neighbourhood; find the nearest one; project the point onto
// the line of every triplet that has it; last, check that the place is on an edge of the diagram.
//
// Two things differ, since the solid is that of capsules (edge_line.h). The edges within r of p may
// be those of other seeds than the nearest one: their seeds are within d0 + 2 r of p
// (reaching_seeds.h), and here every one of these takes the nearest one's part in turn, with all
// pairs of other seeds. And the projection is a chord, not a foot: the part of the line within r of
// p, of which validity must leave something. All seeds of a triplet are within d0 + 2 r, and only
// those that are can clip its chord, which is what the definition (point.h) makes use of; the
// paper's query does not, and neither does this one. What it tries beyond the definition's triplets
// and clips changes no bit: a triplet with a seed farther than that is clipped away by a margin,
// and a clip by one does not bind.
#include "structure/foam/naive_point.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "structure/foam/edge_line.h"
#include "structure/foam/halo.h"
#include "structure/foam/reaching_seeds.h"

namespace msq {

bool naive_point_inside(const FoamSeeds& seeds, CellIndex cell, Vec3 q, double radius) {
  thread_local std::vector<Vec3> gathered;
  thread_local std::vector<uint32_t> order;
  thread_local ReachingSeeds near;

  // Gather the seeds of the halo.
  halo_seeds(seeds, cell, radius, gathered);
  const size_t count = gathered.size();

  // The nearest seed, and those that may stand in for it: first in order.
  near.find(gathered, q, radius);
  order.resize(count);
  for (uint32_t i = 0; i < count; ++i) order[i] = i;
  const auto rest = std::stable_partition(order.begin(), order.end(),
                                          [](uint32_t seed) { return near.has(seed); });
  const size_t near_count = static_cast<size_t>(rest - order.begin());

  // Triplets with one of them, each once.
  const double r2 = radius * radius;
  for (size_t a = 0; a < near_count; ++a)
    for (size_t b = a + 1; b < count; ++b)
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
  return false;
}

namespace {

bool inside(const Foam& foam, Vec3 p) {
  const Neighbourhood::Located located = foam.neighbourhood().locate(p);
  return naive_point_inside(foam.seeds(), located.cell, located.fraction * foam.seeds().scale(),
                            foam.radius().at(p) / foam.unit());
}

}  // namespace

void naive_keep_points(const Foam& foam, const Vec3* points, uint8_t* alive, size_t count) {
  for (size_t i = 0; i < count; ++i)
    if (alive[i] && !inside(foam, points[i])) alive[i] = 0;
}

void naive_keep_rows(const Foam& foam, const RowBlock& block, const Job* job) {
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
