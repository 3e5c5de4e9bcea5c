// SPDX-License-Identifier: Apache-2.0
// Functional structures: triply periodic functions of the position within the cell, mostly close to
// minimal surfaces. The onset of a point is the function g (network) or its magnitude (sheet); the
// solid is where the onset is at most the level. A point where g is NaN is outside.
#pragma once

#include <array>
#include <optional>

#include "base/lazy.h"
#include "expression/program.h"
#include "expression/ray_bounds.h"
#include "expression/slope.h"
#include "field/field.h"
#include "structure/common/max_clusters.h"
#include "structure/common/repeating_structure.h"
#include "structure/functional/cell_angles.h"
#include "structure/functional/clusters.h"
#include "structure/functional/row_plan.h"
#include "structure/functional/trigonometric_form.h"
#include "structure/structure.h"

namespace msq {

enum class FunctionalKind : int32_t { network = 1, sheet = 2 };

class Functional final : public Structure, public RepeatingStructure {
 public:
  /// `clusters`: number along an axis of the cell; 1: none, 0: the most efficient number. A period
  /// takes the place of the cell size along its axis.
  Functional(const Neighbourhood& neighbourhood, const Tape& function, FunctionalKind kind,
             Parameter level, int clusters, CellShape cells = {});

  bool inside(Vec3 p) const override;
  CellIndex cell_of(Vec3 p) const override { return angles_.cell_of(p); }
  bool is_concurrent() const override { return level_.is_concurrent(); }
  /// The difference of onset and level over the sum of their Lipschitz constants. The onset's
  /// constant is that of the whole cell; in cells of varying size, of all cells that are as near as
  /// the distance. Along axes on which the function is not periodic by
  /// itself, at most the distance to the cell's border. 0 everywhere if the slope is unbounded. In
  /// warped cells the shell that they fill counts, too; 0 near the axis and the poles. Of a sampled
  /// map the box of the samples counts, and the steepest place of the map.
  double distance_bound(Vec3 p) const override;
  bool has_steady_distance() const override;
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  double min_ray_step() const override;
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  /// Then the level is bounded block by block, or tables serve all layers of a block.
  bool gains_by_layers() const override { return !level_.is_constant() || angles_.is_mapped(); }
  void keep_rows(const RowBlock& block, const Job* job) const override;
  /// Of rows with the same angles, bit for bit: there are no flips.
  uint64_t row_period(const SampleGrid& grid, uint64_t y0, uint64_t y1) const override;
  void keep_repeated_rows(const RowBlock& block, uint64_t, RowFlips&,
                          const Job* job) const override {
    keep_rows(block, job);
  }
  /// Only in warped and sampled cells.
  BoxClass classify(const Box3& box) const override;
  bool knows_boxes() const override { return angles_.is_mapped(); }
  uint64_t critical_count() const override { return 3; }
  bool has_onset() const override { return true; }
  double onset(Vec3 p) const override;
  void onsets(const Vec3* points, size_t count, double* to) const override;
  double parameter(Vec3 p) const override { return level_.at(p); }
  bool is_periodic() const override { return angles_.is_uniform(); }
  bool is_alike_from_origin() const override { return !angles_.is_mapped(); }
  ThinWalls thin_walls() const override {
    return angles_.is_uniform() && (is_sheet() || level_.is_constant()) ? ThinWalls::uniform
                                                                        : ThinWalls::varying;
  }
  /// Of sheets the lines where the function is 0, of networks those where it is the level.
  LineGraph wall_lines(const WallSection& section) const override;

  bool is_sheet() const { return kind_ == FunctionalKind::sheet; }
  /// That the onset is made of.
  const Tape& function() const { return function_; }
  const Tape& onset() const { return onset_; }
  const Program& program() const { return program_; }
  const RayProgram& ray_program() const { return ray_program_; }
  const Parameter& level() const { return level_; }
  const CellAngles& angles() const { return angles_; }
  /// Whether onset and level have no jumps, except at borders of cells.
  bool is_continuous() const { return is_continuous_; }
  /// For each axis, whether the onset is periodic along it by itself.
  const std::array<bool, 3>& repeats() const { return repeats_; }
  /// Built by the first call, on its thread.
  const Clusters& clusters() const { return prepared().clusters; }
  /// How the onset is evaluated in rows along which these cell coordinates change, bit by bit, and
  /// the others do not: 3, or 4 for the last alone. For warped cells.
  const RowPlan& warped_plan(unsigned changing) const;
  /// For each axis of the grid, the axis of the samples parallel to it; all -1 if the grid is
  /// turned.
  const std::array<int, 3>& sample_axis() const { return sample_axis_; }
  /// One for each of the clusters' tapes; empty if the grid is turned.
  const std::vector<RowPlan>& row_plans() const { return prepared().row_plans; }

  /// How the onset is evaluated in rows, if it is a single wave there (RowPlan::wave); null
  /// otherwise.
  const RowPlan* wave_plan() const;

  /// The form of the onset; none for tapes of another form. In cells of one size there is none
  /// unless the grid is turned, in sheared cells and in those of a sampled map none if it is
  /// turned.
  const std::optional<TrigonometricForm>& form() const { return form_; }

 private:
  void describe(HashInput& input) const override;
  /// In cells that have frequency(n), or less, along the period's axis, or around the axis.
  const Slope& slope(size_t n) const;
  const Slope& steepest() const { return slope(slopes_ - 1); }
  double frequency(size_t n) const;
  double steady_distance_of(double gap, Vec3 p) const;
  /// Where the cells with frequency(n) are, and beyond, in warped cells.
  double axis_distance(size_t n) const;
  double sampled_distance(double gap, bool is_inside, Vec3 fraction, Vec3 p) const;
  double warped_distance(double gap, bool is_inside, Vec3 fraction, Vec3 p) const;
  /// Data for rows along the axes.
  struct Prepared {
    Clusters clusters;
    std::vector<RowPlan> row_plans;
  };
  const Prepared& prepared() const;
  /// The value of the onset's tape.
  double value(Vec3 p) const;

  CellAngles angles_;
  Parameter level_;
  FunctionalKind kind_;
  Tape function_, onset_;
  Program program_;
  RayProgram ray_program_;
  std::array<int, 3> sample_axis_;
  int side_;  // of the clusters
  std::optional<TrigonometricForm> form_;
  std::array<bool, 3> repeats_;
  bool is_continuous_;
  // Frequencies a factor of sqrt(2) apart: 1024 is the largest ratio of cell sizes of a period.
  // Those of warped cells range from what does not matter to the inner radius, if there are so
  // many.
  std::array<Lazy<Slope>, 41> slope_;
  size_t slopes_ = 1;
  bool has_steepest_ = true;  // whether the last frequency is the largest there is
  Lazy<Prepared> prepared_;
  std::array<Lazy<RowPlan>, 2> warped_plans_;
  Lazy<std::optional<RowPlan>> wave_plan_;
};

}  // namespace msq
