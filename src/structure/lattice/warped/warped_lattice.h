// SPDX-License-Identifier: Apache-2.0
// Strut lattice in cells that vary in size or are bent. The nodes of the unit cell are placed in
// each cell; a strut is the capsule about the straight line between two nodes. A point is inside if
// its distance to some strut of any cell is at most the radius there times that strut's factor.
//
// A cell's struts lie in the bounds of the cell, a box in grid coordinates. For each cell that is
// evaluated, or each cube if cells have no simple bounds, the cache keeps the struts that come
// within the greatest radius of its bounds. Points and rays use these lists. Distances, rows and
// struts of boxes place the cells themselves.
#pragma once

#include <memory>

#include "cell/context.h"
#include "field/field.h"
#include "structure/lattice/warped/near_struts.h"
#include "structure/structure.h"

namespace msq {

class WarpedLattice final : public Structure {
 public:
  WarpedLattice(Ref<Context> context, std::unique_ptr<const CellPlaces> places,
                const UnitCell& cell, Parameter radius);
  ~WarpedLattice() override;

  bool inside(Vec3 p) const override;
  CellIndex cell_of(Vec3 p) const override { return places_->cell_of(neighbourhood().to_grid(p)); }
  bool is_concurrent() const override { return radius_.is_concurrent(); }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  bool gains_by_groups() const override { return true; }
  bool gains_by_layers() const override { return true; }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  bool has_struts() const override { return radius_.is_constant(); }
  void for_each_strut(const Box3& box, const TakeStrut& take, const Job* job) const override;
  std::unique_ptr<StrutParts> struts(const StrutSelection& selection) const override;
  /// Exact outside if the radius is constant, up to max_distance times the smallest cell size.
  double distance_bound(Vec3 p) const override;
  static constexpr double max_distance = 8;
  const Parameter* sloped_parameter() const override { return &radius_; }
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  bool has_onset() const override { return true; }
  bool is_alike_from_origin() const override { return places_->is_alike_from_origin(); }
  double onset(Vec3 p) const override;
  double parameter(Vec3 p) const override { return radius_.at(p); }
  double onset_limit() const override;

  /// The maximum radius of a strut, in the smallest cell sizes.
  static constexpr double max_radius = 4;

  using List = std::shared_ptr<const NearStruts>;
  /// The struts that may contain a point of the list, or of its box.
  List near(CellIndex list) const;
  /// The list of a point.
  CellIndex list_of(Vec3 p) const { return places_->list_of(neighbourhood().to_grid(p)); }

 private:
  void describe(HashInput& input) const override;
  /// The least of measure(distance to the axis, factor) of all struts, infinity if there is none.
  /// `q`: in grid coordinates. reach(least so far) bounds the distance of struts with less. Looks
  /// at the cells near the point, the nearest first, and at few others.
  template <class Measure, class Reach>
  double least(Vec3 q, Measure&& measure, Reach&& reach) const;
  double widened() const { return 2e-6 * min_component(neighbourhood().cell_size); }
  /// Calls visit(cell) for the cells whose struts may touch a box in model coordinates, for as long
  /// as goes_on() is true.
  template <class Visit, class GoesOn>
  void for_each_cell(const Box3& box, Visit&& visit, GoesOn&& goes_on) const;

  const Ref<Context> context_;
  const uint64_t id_;  // in the cache
  const std::unique_ptr<const CellPlaces> places_;
  const UnitCell cell_;
  const Parameter radius_;
  const PlacedGraph graph_;
};

}  // namespace msq
