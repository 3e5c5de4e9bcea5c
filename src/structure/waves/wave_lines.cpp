// SPDX-License-Identifier: Apache-2.0
#include "structure/waves/wave_lines.h"

#include <algorithm>
#include <cmath>

#include "base/job.h"
#include "structure/common/level_lines.h"
#include "structure/common/plane_cells.h"
#include "structure/waves/wave_kernels.h"
#include "structure/waves/waves.h"

namespace msq {

namespace {

/// Waves are about as long as the cells, so the lines bend less than those of other functions.
constexpr double squares_per_wavelength = 16;

/// The sum, less the level of a network.
class WaveLevel final : public LevelFunction {
 public:
  WaveLevel(const Waves& structure, double magnitude) : structure_(structure) {
    if (!structure.is_sheet() && !structure.level().is_constant()) return;
    const double level = structure.is_sheet() ? 0 : structure.level().range().high;
    // Rounding of the grid's positions along x and y, of both sums, and of the levels here.
    const double slack =
        2 * (2 * structure.steepest() * 0x1p-50 * magnitude + 2 * structure.error(magnitude)) +
        0x1p-50 * std::abs(level);
    const auto network = [&](double of) {
      return make_ref<const Waves>(structure.neighbourhood(), structure.directions(),
                                   WavesKind::network, Parameter(of));
    };
    lower_ = network(level - slack);
    higher_ = network(level + slack);
  }

  double at(Vec3 p) const override {
    const double g = wave_sum(structure_.waves(), structure_.position(p));
    return structure_.is_sheet() ? g : g - structure_.level().at(p);
  }
  void row(const double* x, double y, double z, size_t count, double* to) override {
    for (size_t i = 0; i < count; ++i) to[i] = at({x[i], y, z});
  }

  bool has_signs() const override { return static_cast<bool>(lower_); }
  void find_signs(const RowBlock& inside, const RowBlock& not_outside) override {
    lower_->keep_rows(inside, current_job());
    higher_->keep_rows(not_outside, current_job());
  }

 private:
  const Waves& structure_;
  Ref<const Waves> lower_, higher_;  // networks of nearly the same level; null if it varies
};

}  // namespace

LineGraph find_wave_lines(const Waves& structure, const WallSection& section) {
  const Neighbourhood& grid = structure.neighbourhood();
  require_in_cells(grid, section);
  const double pitch = min_component(grid.cell_size) / squares_per_wavelength;
  const Box2& w = section.window;
  // The grid has nodes up to two squares beyond the window.
  const double magnitude = 2 * std::max({std::abs(w.min.x), std::abs(w.min.y), std::abs(w.max.x),
                                         std::abs(w.max.y), std::abs(section.z)}) +
                           (w.max.x - w.min.x) + (w.max.y - w.min.y) + 8 * pitch;
  WaveLevel function(structure, magnitude);
  return LevelLines(function, pitch, !structure.is_sheet(), section).find();
}

}  // namespace msq
