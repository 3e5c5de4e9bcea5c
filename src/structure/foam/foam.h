// SPDX-License-Identifier: Apache-2.0
// Open-cell Voronoi foam. Onset of a point: its distance to the edges of the Voronoi diagram of all
// seeds. Source: paper, section "Preprocessing for Voronoi Foams"; Martinez, Dumas and Lefebvre,
// "Procedural Voronoi foams for additive manufacturing", 2016. Where the solid differs from theirs:
// edge_line.h.
#pragma once

#include <memory>

#include "cell/context.h"
#include "field/field.h"
#include "structure/foam/graded_seeds.h"
#include "structure/foam/ray_demand.h"
#include "structure/foam/seeds.h"
#include "structure/structure.h"

namespace msq {

enum class FoamMethod : int32_t {
  automatic = 0,
  point = 1,
  method_2 = 2,
  direct = 3,
  method_1 = 4
};

class Foam final : public Structure {
 public:
  /// `density`: as in GradedSeeds. Where it is above 1 anywhere, the method is `direct`.
  Foam(Ref<Context> context, const Neighbourhood& neighbourhood, Parameter radius, double jitter,
       uint64_t seed, FoamMethod method, Parameter density = Parameter(1));
  /// Its cells leave the cache.
  ~Foam() override;

  bool inside(Vec3 p) const override;
  bool is_concurrent() const override { return is_concurrent_; }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  bool gains_by_groups() const override { return true; }
  uint64_t critical_count() const override;
  bool gains_by_layers() const override { return true; }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  /// Exact outside where the radius is constant.
  double clearance(Vec3 p) const override;
  bool has_onset() const override { return true; }
  double onset(Vec3 p) const override;
  double onset_limit() const override { return min_component(neighbourhood().cell_size); }
  double least_ray_step() const override {
    return radius_.lipschitz() < std::numeric_limits<double>::infinity()
               ? ray_tolerance()
               : Structure::least_ray_step();
  }

  void enter(RaySearch* searches, size_t count) const override;
  double leave(const Ray& ray, double from, double to) const override;
  Vec3 normal(const Ray& ray, double t) const override;

  /// One in each cell; those of the foam unless it is graded.
  const FoamSeeds& seeds() const { return seeds_; }
  /// The seeds where their density is above 1 anywhere, otherwise null.
  const std::shared_ptr<const GradedSeeds>& graded() const { return graded_; }
  /// Length of a foam unit in model units.
  double unit() const { return unit_; }
  const Parameter& radius() const { return radius_; }
  /// The greatest, in foam units.
  double most_radius() const { return radius_.range().high / unit_; }
  /// The greatest in a cell and within `margin` of it, all in foam units.
  double most_radius(CellIndex cell, double margin) const;
  RayDemand& ray_demand() const { return ray_demand_; }
  Context& context() const { return *context_; }
  /// Names in the cache, of edges for slices and for rays.
  uint64_t id() const { return id_; }
  uint64_t seeded_edges_id() const { return seeded_edges_id_; }
  /// And of the struts of a cell, where seeds are graded.
  uint64_t cell_struts_id() const { return cell_struts_id_; }
  /// Whether struts are capsules of one radius, and there is a seed in each cell and no other.
  bool has_capsules() const { return !graded_ && radius_.is_constant(); }

 private:
  bool inside(const Neighbourhood::Located& located, Vec3 p) const;
  /// Whether marching overlooks nothing.
  bool may_march() const { return radius_.lipschitz() < std::numeric_limits<double>::infinity(); }

  Ref<Context> context_;
  uint64_t id_, seeded_edges_id_, cell_struts_id_;
  Parameter radius_;
  double unit_;
  FoamSeeds seeds_;
  std::shared_ptr<const GradedSeeds> graded_;
  FoamMethod method_;
  bool is_concurrent_;
  mutable RayDemand ray_demand_;
};

}  // namespace msq
