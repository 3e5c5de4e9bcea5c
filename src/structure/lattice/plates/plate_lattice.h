// SPDX-License-Identifier: Apache-2.0
// Periodic plate lattice: the infinite tiling of a unit cell with triangles. A point is inside if
// its distance to some triangle is at most half of the thickness there times that triangle's
// factor.
#pragma once

#include <limits>
#include <vector>

#include "base/lazy.h"
#include "field/field.h"
#include "structure/common/repeating_structure.h"
#include "structure/lattice/cell/plate_cell.h"
#include "structure/lattice/cell/strut_clusters.h"
#include "structure/lattice/plates/row_plates.h"
#include "structure/structure.h"

namespace msq {

class PlateLattice final : public Structure, public RepeatingStructure {
 public:
  PlateLattice(const Neighbourhood& neighbourhood, const PlateCell& cell, Parameter thickness);

  bool inside(Vec3 p) const override;
  bool is_concurrent() const override { return thickness_.is_concurrent(); }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  bool gains_by_layers() const override { return true; }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  uint64_t row_period(const SampleGrid& grid, uint64_t y0, uint64_t y1) const override;
  void keep_repeated_rows(const RowBlock& block, uint64_t end, RowFlips& flips,
                          const Job* job) const override;
  bool knows_boxes() const override { return true; }
  BoxClass classify(const Box3& box) const override;
  /// Exact outside if the thickness is constant and the cell sizes differ by a factor of at most 8
  /// (4 if plates' factors differ).
  double distance_bound(Vec3 p) const override;
  const Parameter* sloped_parameter() const override { return &thickness_; }
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  bool has_onset() const override { return true; }
  double onset(Vec3 p) const override;
  double parameter(Vec3 p) const override { return thickness_.at(p); }
  double onset_limit() const override;
  bool is_periodic() const override { return true; }

  ThinWalls thin_walls() const override { return ThinWalls::uniform; }
  /// The plates, cut by the plane.
  LineGraph wall_lines(const WallSection& section) const override;

  /// Thickness of the thickest plates, in units of the smallest cell size.
  static constexpr double max_thickness = 4;

 private:
  void describe(HashInput& input) const override;
  const PlateClusters& clusters() const;
  const RowPlates& row_plates() const;
  /// march() with membership by clusters.
  bool find(bool wanted, const Ray& ray, double from, double to, double& t, const Job* job) const;
  /// As inside(), to the last bit.
  bool holds(const PlateClusters& clusters, Vec3 p, double thickness) const;
  /// How far all plates are, less half of their thickness `t`: negative within a plate.
  double gap(Vec3 p, double t) const;
  /// By how much that may be off.
  double slack(Vec3 p) const;

  PlateCell cell_;
  Parameter thickness_;
  std::vector<PeriodicPlate> plates_;  // in cell units, the thickest first
  double max_factor_;
  double reach_;                    // beyond which plates are not searched for distances
  double error_;                    // of distances to plates within reach_
  std::vector<LatticePlate> near_;  // those of the tiling that may reach a cell, from its corner
  Lazy<PlateClusters> clusters_;
  Lazy<PlateClusters> onsets_;   // for all thicknesses
  std::array<int, 3> row_axes_;  // of the grid, parallel to the samples' axes; all -1: turned
  Lazy<RowPlates> row_plates_;
};

}  // namespace msq
