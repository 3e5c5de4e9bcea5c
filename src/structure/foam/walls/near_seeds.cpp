// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/near_seeds.h"

#include <cmath>

#include "base/borrowed.h"
#include "base/job.h"
#include "structure/foam/seeds/cell_seeds.h"
#include "structure/foam/seeds/seed_trees.h"

namespace msq {

namespace {

/// Points come cell by cell where the caller can arrange it: the seeds about the last one's cell.
struct NearSeedsWorkspace {
  CellSeeds around;
  std::vector<uint32_t> found;

  size_t bytes() const { return around.bytes(); }
};

void find_graded(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex cell, Vec3 q,
                 double more, std::vector<Vec3>& near) {
  const Borrowed<SeedForest> forest;  // the density may be the host's
  SeedTrees& trees = forest->of(seeds);
  LeafSeed nearest = trees.at(cell, q);
  const Vec3 d = nearest.position - q;
  double squared = dot(d, d);
  trees.nearest(cell, q, squared, nearest, [](const LeafSeed&) { return true; });
  const double reach = std::sqrt(squared) + more + near_slack, reach_squared = reach * reach;
  trees.visit(
      cell, Box3{q, q}.grown(reach),
      [&](const Box3& box) { return min_squared(box, q) <= reach_squared; },
      [&](const LeafSeed& seed) {
        const Vec3 away = seed.position - q;
        if (dot(away, away) <= reach_squared) near.push_back(seed.position);
        if (near.size() % 1024 == 0) check_cancelled();
      });
}

}  // namespace

void NearSeeds::find(CellIndex cell, Vec3 q, double more, std::vector<Vec3>& near) const {
  near.clear();
  if (graded_) return find_graded(graded_, cell, q, more, near);
  const Borrowed<NearSeedsWorkspace> workspace;
  auto& [around, found] = *workspace;
  around.move_to(seeds_, cell);
  const CellSeeds::Block& block =
      around.find_near(q, 0.5 * (stretch_ ? stretch_->around(more) : more), found);
  for (const uint32_t i : found) near.push_back(block.position(i));
}

void NearSeeds::find(CellIndex cell, Vec3 q, double more, std::vector<LiftedSeed>& near) const {
  near.clear();
  const Borrowed<NearSeedsWorkspace> workspace;
  auto& [around, found] = *workspace;
  around.move_to(seeds_, cell);
  const CellSeeds::Block& block = around.find_near(q, 0.5 * more, found);
  for (const uint32_t i : found) near.push_back(block.lifted(i));
}

double NearSeeds::spacing(CellIndex cell, Vec3 q) const {
  if (!graded_) return 1;
  const Borrowed<SeedForest> forest;
  return std::ldexp(1.0, -forest->of(graded_).at(cell, q).level);
}

}  // namespace msq
