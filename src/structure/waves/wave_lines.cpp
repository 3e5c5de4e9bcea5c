// SPDX-License-Identifier: Apache-2.0
#include "structure/waves/wave_lines.h"

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
  explicit WaveLevel(const Waves& structure) : structure_(structure) {}

  double at(Vec3 p) const override {
    const double g = wave_sum(structure_.waves(), structure_.position(p));
    return structure_.is_sheet() ? g : g - structure_.level().at(p);
  }
  void row(const double* x, double y, double z, size_t count, double* to) override {
    for (size_t i = 0; i < count; ++i) to[i] = at({x[i], y, z});
  }

 private:
  const Waves& structure_;
};

}  // namespace

LineGraph find_wave_lines(const Waves& structure, const WallSection& section) {
  const Neighbourhood& grid = structure.neighbourhood();
  require_in_cells(grid, section);
  WaveLevel function(structure);
  return LevelLines(function, min_component(grid.cell_size) / squares_per_wavelength,
                    !structure.is_sheet(), section)
      .find();
}

}  // namespace msq
