// SPDX-License-Identifier: Apache-2.0
// The seeds whose faces may be near a point, for foams with one seed per cell and for graded ones.
#pragma once

#include <memory>
#include <vector>

#include "structure/foam/seeds/graded_seeds.h"
#include "structure/foam/seeds/seeds.h"

namespace msq {

class NearSeeds {
 public:
  /// `graded`: null where there is one seed in each cell.
  NearSeeds(const FoamSeeds& seeds, std::shared_ptr<const GradedSeeds> graded)
      : seeds_(seeds), graded_(std::move(graded)) {}

  const FoamSeeds& seeds() const { return seeds_; }
  const std::shared_ptr<const GradedSeeds>& graded() const { return graded_; }

  /// Fills `near`, in the order of seeds, with all seeds that are no farther from a point than its
  /// nearest one by `more` and near_slack (seeds.h). The point: q from the corner of `cell`; so are
  /// the seeds. Foam units.
  void find(CellIndex cell, Vec3 q, double more, std::vector<Vec3>& near) const;
  /// The size of the leaf that holds the point: how far apart seeds are there, about.
  double spacing(CellIndex cell, Vec3 q) const;

 private:
  const FoamSeeds seeds_;
  const std::shared_ptr<const GradedSeeds> graded_;
};

}  // namespace msq
