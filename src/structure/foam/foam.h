// SPDX-License-Identifier: Apache-2.0
// Open-cell Voronoi foam. The onset of a point is its distance to the edges of the Voronoi diagram
// of all seeds. Source: paper, section "Preprocessing for Voronoi Foams"; Martinez, Dumas and
// Lefebvre, "Procedural Voronoi foams for additive manufacturing", 2016. point/edge_line.h says
// where the solid differs from theirs.
//
// The folders follow the flow of data: seeds/ (positions of seeds), point/ (the definition), edges/
// (edges, each built once), joints/ (struts as a graph), sets/ (rows of samples and arrays of
// points), rays/, section/ (faces cut by a plane); paper/ holds the methods of the paper. This file
// chooses between them. walls/ closes cells; walled_foam.h joins struts and walls.
#pragma once

#include "structure/foam/foam_data.h"

namespace msq {

enum class FoamMethod : int32_t {
  automatic = 0,
  point = 1,
  method_2 = 2,
  direct = 3,
  method_1 = 4
};

class Foam final : public FoamData {
 public:
  /// `density`, `stretch`, `weight`, `placed`: as in FoamData. If the density exceeds 1 anywhere,
  /// or cells are stretched, or seeds weighted or placed by a map, the method is `direct`.
  Foam(Ref<Context> context, const Neighbourhood& neighbourhood, Parameter radius, double jitter,
       uint64_t seed, FoamMethod method, const Parameter& density = Parameter(1),
       Vec3 stretch = {1, 1, 1}, double weight = 0,
       std::shared_ptr<const PlacedSeeds> placed = nullptr);

  bool inside(Vec3 p) const override;
  bool is_concurrent() const override { return is_concurrent_; }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  bool gains_by_groups() const override { return true; }
  uint64_t critical_count() const override;
  bool gains_by_layers() const override { return true; }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  void draw_rows(const RowBlock& block, const Job* job) const override;
  /// The struts of stretched cells have larger errors than contours are drawn with.
  bool has_struts() const override { return radius().is_constant() && !stretch(); }
  void for_each_strut(const Box3& box, const TakeStrut& take, const Job* job) const override;
  std::unique_ptr<StrutParts> struts(const StrutSelection& selection) const override;
  /// Exact outside where the radius is constant.
  double distance_bound(Vec3 p) const override;
  bool has_onset() const override { return true; }
  double onset(Vec3 p) const override;
  double parameter(Vec3 p) const override { return radius().at(p); }
  double onset_limit() const override {
    return min_component((placed() ? placed()->smallest() : neighbourhood()).cell_size);
  }
  const Parameter* sloped_parameter() const override { return &radius(); }

  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;

  ThinWalls thin_walls() const override {
    return graded() ? ThinWalls::varying : ThinWalls::uniform;
  }
  /// The faces of the Voronoi diagram.
  LineGraph wall_lines(const WallSection& section) const override;

 private:
  void describe(HashInput& input) const override;
  bool inside(const Neighbourhood::Located& located, Vec3 p) const;
  /// Whether the coordinates of a ray are so small that their rounding fits the lists of struts.
  bool fits_struts(const Ray& ray, double to) const;
  /// Whether it is clear that this holds for all of these rays.
  bool all_fit_struts(const RaySearch* searches, size_t count) const;
  /// Errors of onsets, foam units.
  double onset_error() const;
  /// Whether sets of points and single rays may rely on the seeds of cells: one in each, and not
  /// stretched, and seeds without weights.
  bool is_plain() const { return !graded() && !stretch() && !is_weighted(); }
  /// Finds the entry by marching. Returns false if it may have missed struts, or if its result may
  /// differ from that of walk_cells(). Then the caller searches by cells.
  bool enter_by_steps(RaySearch& search, const Job* job) const;
  /// Whether marching misses nothing.
  bool may_march() const { return radius().lipschitz() < std::numeric_limits<double>::infinity(); }

  FoamMethod method_;
  bool is_concurrent_;
};

}  // namespace msq
