// SPDX-License-Identifier: Apache-2.0
// Periodic strut lattice: the infinite tiling of a unit cell with struts. A point is inside if its
// distance to some strut is at most the radius there times that strut's factor.
#pragma once

#include <vector>

#include "base/lazy.h"
#include "field/field.h"
#include "structure/common/repeating_structure.h"
#include "structure/lattice/cell/strut_clusters.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/graph/lattice_graph.h"
#include "structure/lattice/rays/part_lists.h"
#include "structure/lattice/rows/row_struts.h"
#include "structure/structure.h"
#include "strut/segment.h"

namespace msq {

class Lattice final : public Structure, public RepeatingStructure {
 public:
  /// `clusters`: number along an axis of the cell, for sets of points; 1: none, 0: the most
  /// efficient number.
  Lattice(const Neighbourhood& neighbourhood, const UnitCell& cell, Parameter radius,
          int clusters = 0);

  bool inside(Vec3 p) const override;
  bool is_concurrent() const override { return radius_.is_concurrent(); }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  /// Then rows are drawn strut by strut, or the radius is bounded block by block.
  bool gains_by_layers() const override { return row_axes_[0] < 0 || !radius_.is_constant(); }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  uint64_t row_period(const SampleGrid& grid, uint64_t y0, uint64_t y1) const override;
  void keep_repeated_rows(const RowBlock& block, uint64_t end, RowFlips& flips,
                          const Job* job) const override;
  /// For grids along the axes only: a box about a turned grid's layer holds far more cells than the
  /// layer.
  bool has_struts() const override { return row_axes_[0] >= 0 && radius_.is_constant(); }
  void for_each_strut(const Box3& box, const TakeStrut& take, const Job* job) const override;
  std::unique_ptr<StrutParts> struts(const StrutSelection& selection) const override;
  /// Exact outside if the radius is constant and the cell sizes differ by a factor of at most 8 (4
  /// if struts' factors differ).
  double distance_bound(Vec3 p) const override;
  const Parameter* sloped_parameter() const override { return &radius_; }
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  bool has_onset() const override { return true; }
  double onset(Vec3 p) const override;
  double parameter(Vec3 p) const override { return radius_.at(p); }
  double onset_limit() const override;
  bool is_periodic() const override { return true; }

  /// The maximum radius of a strut, in the smallest cell sizes.
  static constexpr double max_radius = 4;

 private:
  void describe(HashInput& input) const override;
  const StrutClusters& clusters() const;
  const CellParts& parts() const;
  const RowStruts& row_struts() const;

  UnitCell cell_;
  Parameter radius_;
  std::vector<PeriodicStrut> struts_;  // in cell units, the thickest first
  LatticeGraph graph_;
  double max_factor_;
  Box3 reach_;                      // of all of them
  std::vector<LatticeStrut> near_;  // those of the tiling that may reach a cell, from its corner
  int side_;                        // of the clusters
  Lazy<StrutClusters> clusters_;
  Lazy<StrutClusters> onsets_;   // for all radii
  std::array<int, 3> row_axes_;  // of the grid, parallel to the samples' axes; all -1: turned
  Lazy<RowStruts> row_struts_;
  Lazy<CellParts> parts_;  // for rays
};

}  // namespace msq
