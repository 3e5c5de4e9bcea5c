// SPDX-License-Identifier: Apache-2.0
// The data that the folders of a foam work on: seeds, grid, radius, graph and the ids of its data
// in the cell cache. Foam (foam.h) adds only the choice between the folders.
#pragma once

#include <memory>

#include "cell/context.h"
#include "field/field.h"
#include "structure/foam/foam_graph.h"
#include "structure/foam/seeds/graded_seeds.h"
#include "structure/foam/seeds/seeds.h"
#include "structure/foam/seeds/stretch.h"
#include "structure/structure.h"

namespace msq {

class FoamData : public Structure {
 public:
  /// One seed in each cell; these are the foam's seeds unless it is graded.
  const FoamSeeds& seeds() const { return seeds_; }
  /// The graded seeds if the density exceeds 1 anywhere, or a map places the seeds; otherwise null.
  const std::shared_ptr<const GradedSeeds>& graded() const { return graded_; }
  /// Null where no map places the seeds.
  const PlacedSeeds* placed() const { return placed_.get(); }
  /// Of the cells; null where the diagram is that of model space.
  const Stretch* stretch() const { return stretch_.get(); }
  /// The seeds in the space of the diagram (seeds/stretch.h), and points, in foam units, there.
  const FoamSeeds& diagram_seeds() const { return stretch_ ? stretch_->seeds() : seeds_; }
  Vec3 to_diagram(Vec3 q) const { return stretch_ ? stretch_->to_diagram(q) : q; }
  Vec3 from_diagram(Vec3 p) const { return stretch_ ? p * stretch_->factor() : p; }
  /// Whether the diagram is a power diagram (seeds/seeds.h).
  bool is_weighted() const { return seeds_.is_weighted(); }
  const FoamGraph& graph() const { return *graph_; }
  /// Length of a foam unit in model units.
  double unit() const { return unit_; }
  const Parameter& radius() const { return radius_; }
  /// The maximum radius, in foam units.
  double max_radius() const { return radius_.range().high / unit_; }
  /// The maximum radius in a cell and within `margin` of it, all in foam units.
  double max_radius(CellIndex cell, double margin) const;
  Context& context() const { return *context_; }
  /// Ids in the cache: of edges for slices, of edges for single layers, of edges for rays, of the
  /// struts of a cell if seeds are graded, of the count of rays, and of cells of the paper's
  /// methods.
  uint64_t id() const { return id_; }
  uint64_t brick_parts_id() const { return brick_parts_id_; }
  uint64_t ray_bricks_id() const { return ray_bricks_id_; }
  uint64_t cell_lists_id() const { return cell_lists_id_; }
  uint64_t ray_demand_id() const { return ray_demand_id_; }
  uint64_t paper_cells_id() const { return paper_cells_id_; }
  /// An edge that touches a box has a point in it, and its owner lies within this distance of that
  /// point: in a ball, and, if cells are stretched, along each of the grid's axes. Model units.
  double owner_distance() const;
  Vec3 owner_reach() const;
  /// Whether struts are capsules of one radius, and each cell has exactly one seed.
  bool has_capsules() const { return !graded_ && radius_.is_constant(); }

  CellIndex cell_of(Vec3 p) const override;
  void for_each_grid(const TakeGrid& take) const override {
    take(placed_ ? placed_->smallest() : neighbourhood());
  }

 protected:
  /// `density`: as in GradedSeeds. `stretch`: of the cells, along the axes of the grid; only with a
  /// density of at most 1. `weight`: of the seeds (seeds/seeds.h), in model units, at most the
  /// smallest cell size; above 0 only without a stretch and with a density of at most 1. `placed`:
  /// null, or where a map places the seeds; then the neighbourhood is that of its boxes, and there
  /// are no density above 1, stretch or weight.
  FoamData(Ref<Context> context, const Neighbourhood& neighbourhood, Parameter radius,
           double jitter, uint64_t seed, Parameter density, Vec3 stretch, double weight,
           std::shared_ptr<const PlacedSeeds> placed);
  /// Removes the data from the cache.
  ~FoamData() override;

 private:
  const Ref<Context> context_;
  const uint64_t id_, brick_parts_id_, ray_bricks_id_, cell_lists_id_, ray_demand_id_,
      paper_cells_id_;
  const Parameter radius_;
  const double unit_;
  const FoamSeeds seeds_;
  const std::shared_ptr<const PlacedSeeds> placed_;
  const std::shared_ptr<const GradedSeeds> graded_;
  const std::unique_ptr<const Stretch> stretch_;
  const std::unique_ptr<const FoamGraph> graph_;
};

}  // namespace msq
