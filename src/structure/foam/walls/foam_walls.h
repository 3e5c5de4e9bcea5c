// SPDX-License-Identifier: Apache-2.0
// The walls of a closed-cell Voronoi foam: the points that are within half a thickness of a face of
// the Voronoi diagram of all seeds, except in holes (vents.h). Onset of a point: twice its distance
// to the nearest face whose hole does not hold it.
#pragma once

#include "cell/context.h"
#include "field/field.h"
#include "structure/foam/walls/near_seeds.h"
#include "structure/foam/walls/vents.h"
#include "structure/foam/walls/wall_point.h"
#include "structure/structure.h"

namespace msq {

class FoamWalls final : public Structure {
 public:
  /// `density`: as in GradedSeeds. `vent_radius`: of the holes. `stretch`: of the cells, along the
  /// axes of the grid; only without holes and with a density of at most 1. `weight`: of the seeds
  /// (seeds/seeds.h), at most the smallest cell size; above 0 only without a stretch, without holes
  /// and with a density of at most 1. `placed`: null, or where a map places the seeds; then the
  /// neighbourhood is that of its boxes, and there are no density above 1, stretch or weight.
  FoamWalls(Ref<Context> context, const Neighbourhood& neighbourhood, Parameter thickness,
            double jitter, uint64_t seed, const Parameter& density = Parameter(1),
            Parameter vent_radius = Parameter(0), Vec3 stretch = {1, 1, 1}, double weight = 0,
            std::shared_ptr<const PlacedSeeds> placed = nullptr);
  ~FoamWalls() override;

  bool inside(Vec3 p) const override;
  CellIndex cell_of(Vec3 p) const override;
  void for_each_grid(const TakeGrid& take) const override;
  bool is_concurrent() const override { return is_concurrent_; }
  /// Exact in the voids where the thickness is constant and there are no holes.
  double distance_bound(Vec3 p) const override;
  bool has_onset() const override { return true; }
  double onset(Vec3 p) const override;
  double parameter(Vec3 p) const override { return thickness_.at(p); }
  double onset_limit() const override {
    const PlacedSeeds* const placed = seeds_.placed();
    return min_component((placed ? placed->smallest() : neighbourhood()).cell_size);
  }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  bool gains_by_groups() const override { return true; }
  bool gains_by_layers() const override { return true; }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  bool knows_boxes() const override { return true; }
  BoxClass classify(const Box3& box) const override;
  const Parameter* sloped_parameter() const override { return &thickness_; }

  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;

  ThinWalls thin_walls() const override {
    return seeds_.graded() || !vents_.radius().is_constant() ? ThinWalls::varying
                                                             : ThinWalls::uniform;
  }
  /// The walls, with their holes, cut by the plane.
  LineGraph wall_lines(const WallSection& section) const override;

  const NearSeeds& seeds() const { return seeds_; }
  const Parameter& thickness() const { return thickness_; }
  const Vents& vents() const { return vents_; }
  /// Length of a foam unit in model units.
  double unit() const { return unit_; }
  Context& context() const { return *context_; }
  /// Of the faces of cells in the cache.
  uint64_t id() const { return id_; }

 private:
  void describe(HashInput& input) const override;
  bool inside(const Neighbourhood::Located& located, Vec3 p) const;
  NearFace face_near(Vec3 p) const;
  /// By how much distances may be off, in model units.
  double slack(Vec3 p, double distance) const;
  void enter(RaySearch& search, const Job* job) const;
  /// As Structure::march(), in smaller steps where the thickness has a slope in boxes alone; with
  /// holes, from void to void.
  bool find(bool wanted, const Ray& ray, double from, double to, double& t, const Job* job) const;
  /// A length along a ray from p, which is in the void, within which the ray does not meet a wall
  /// with holes; less than a cell. For thicknesses that vary.
  double way_in_void(Vec3 p, Vec3 direction, double tolerance) const;
  /// As enter() with holes: from void to void.
  void enter_vented(RaySearch& search, const Job* job) const;

  const Ref<Context> context_;
  const uint64_t id_;
  const Parameter thickness_;
  const double unit_;
  const NearSeeds seeds_;
  const Vents vents_;
  const bool is_concurrent_;
};

}  // namespace msq
