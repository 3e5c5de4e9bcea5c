// SPDX-License-Identifier: Apache-2.0
// The seeds whose faces may be near a point, for foams with one seed per cell, stretched, weighted
// or neither, and for graded ones. Points and seeds are in the space of the diagram
// (seeds/stretch.h), lengths in foam units.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "structure/foam/seeds/graded_seeds.h"
#include "structure/foam/seeds/seeds.h"
#include "structure/foam/seeds/stretch.h"

namespace msq {

class NearSeeds {
 public:
  /// `graded`: null where there is one seed in each cell, as there must be with a weight.
  NearSeeds(const FoamSeeds& seeds, std::shared_ptr<const GradedSeeds> graded)
      : seeds_(seeds), graded_(std::move(graded)) {}
  /// Of a stretched foam.
  explicit NearSeeds(const Stretch& stretch) : seeds_(stretch.seeds()), stretch_(stretch) {}

  const FoamSeeds& seeds() const { return seeds_; }
  const std::shared_ptr<const GradedSeeds>& graded() const { return graded_; }
  /// Null where no map places the seeds.
  const PlacedSeeds* placed() const { return graded_ ? graded_->placed() : nullptr; }
  /// Null where the diagram is that of model space.
  const Stretch* stretch() const { return stretch_ ? &*stretch_ : nullptr; }
  /// The normal of a plane of the diagram moved back to model space, in foam units.
  Vec3 normal(Vec3 apart) const { return stretch_ ? stretch_->normal(apart) : apart; }

  /// Fills `near`, in the order of seeds, with all seeds that are no farther from a point than its
  /// nearest one by `more` and near_slack (seeds.h); of a stretched foam, by that over the least
  /// factor. The point: q from the corner of `cell`; so are the seeds.
  void find(CellIndex cell, Vec3 q, double more, std::vector<Vec3>& near) const;
  /// The same of a weighted foam, by lifted distances (seeds/seeds.h).
  void find(CellIndex cell, Vec3 q, double more, std::vector<LiftedSeed>& near) const;
  bool is_weighted() const { return seeds_.is_weighted(); }
  /// The size of the leaf that holds the point: how far apart seeds are there, about.
  double spacing(CellIndex cell, Vec3 q) const;

 private:
  const FoamSeeds seeds_;
  const std::shared_ptr<const GradedSeeds> graded_;
  const std::optional<Stretch> stretch_;
};

}  // namespace msq
