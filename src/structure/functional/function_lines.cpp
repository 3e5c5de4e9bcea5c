// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/function_lines.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "structure/common/cell_shell.h"
#include "structure/common/kept_lines.h"
#include "structure/common/level_lines.h"
#include "structure/common/plane_cells.h"
#include "structure/functional/functional.h"

namespace msq {

namespace {

/// The function, less the level of a network.
class FunctionLevel final : public LevelFunction {
 public:
  static_assert(row_points <= batch_points);

  explicit FunctionLevel(const Functional& structure)
      : structure_(structure),
        function_(structure.function()),
        program_(compile(structure.function())),
        batch_(program_) {
    for (size_t axis = 0; axis < 3; ++axis) {
      angles_[axis].resize(row_points + batch_padding);
      batch_.set_input(axis, {angles_[axis].data(), false});
    }
    if (structure.is_sheet() || structure.level().is_constant()) return;
    points_.resize(row_points);
    levels_.resize(row_points + batch_padding);
  }

  double at(Vec3 p) const override {
    const double f = msq::evaluate(function_, structure_.angles().at(p));
    return structure_.is_sheet() ? f : f - structure_.level().at(p);
  }
  void row(const double* x, double y, double z, size_t count, double* to) override {
    structure_.angles().find({x, false}, {&y, true}, {&z, true}, count,
                             {angles_[0].data(), angles_[1].data(), angles_[2].data()});
    batch_.run(count);
    const Values values = batch_.output(0);
    const Parameter& level = structure_.level();
    if (levels_.empty()) {
      const double constant = structure_.is_sheet() ? 0 : level.range().high;
      for (size_t i = 0; i < count; ++i) to[i] = values[i] - constant;
      return;
    }
    for (size_t i = 0; i < count; ++i) points_[i] = {x[i], y, z};
    level.values(points_.data(), count, levels_.data());
    for (size_t i = 0; i < count; ++i) to[i] = values[i] - levels_[i];
  }

 private:
  const Functional& structure_;
  const Tape& function_;
  const Program program_;
  Batch batch_;
  std::vector<double> angles_[3], levels_;
  std::vector<Vec3> points_;
};

constexpr double squares_per_cell = 32;

/// The cell size that the grid of squares is for. Around an axis or a point cells have any size,
/// and a shear makes them narrower. It counts as far as half of their radial size, or as far as
/// they are at the inner radius.
double smallest_in_plane(const Functional& structure) {
  const Neighbourhood& grid = structure.neighbourhood();
  const double smallest = min_component(grid.cell_size);
  const std::optional<Warp>& warp = structure.angles().warp();
  if (!warp) return smallest;
  const Warp::Shell& shell = warp->shell();
  const double least = 0.5 * grid.cell_size.x;
  double around = two_pi * shell.inner / shell.count;
  if (shell.is_sheared() && around > 0)
    around = 1 / length(Vec3{1 / around, shell.shear_outwards / grid.cell_size.x,
                             shell.shear_along / grid.cell_size.z});
  around = std::max(least, around);
  if (warp->kind() == Warp::Kind::cylindrical) return std::min(smallest, around);
  return std::min(
      {smallest, around, std::max(least, 0.5 * two_pi * shell.inner / shell.count_polar)});
}

}  // namespace

LineGraph find_function_lines(const Functional& structure, const WallSection& section) {
  require_in_cells(structure.neighbourhood(), section);
  FunctionLevel function(structure);
  LineGraph graph = LevelLines(function, smallest_in_plane(structure) / squares_per_cell,
                               !structure.is_sheet(), section)
                        .find();
  // The function goes on beyond the cells, so that lines end where these do.
  if (const std::unique_ptr<const CellShell> shell = structure.angles().shell())
    keep_parts(graph, section.tolerance, [&](Vec2 p) {
      return shell->kept({p.x, p.y, section.z});
    });
  return graph;
}

}  // namespace msq
