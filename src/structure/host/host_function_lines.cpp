// SPDX-License-Identifier: Apache-2.0
#include "structure/host/host_function_lines.h"

#include <vector>

#include "structure/common/level_lines.h"
#include "structure/common/plane_cells.h"
#include "structure/host/host_function.h"

namespace msq {

namespace {

constexpr double squares_per_cell = 32;  // as of functions that msq evaluates

class HostLevel final : public LevelFunction {
 public:
  explicit HostLevel(const HostFunction& structure) : structure_(structure), points_(row_points) {}

  double at(Vec3 p) const override {
    double value;
    structure_.differences(&p, 1, &value);
    return value;
  }
  void row(const double* x, double y, double z, size_t count, double* to) override {
    for (size_t i = 0; i < count; ++i) points_[i] = {x[i], y, z};
    structure_.differences(points_.data(), count, to);
  }

 private:
  const HostFunction& structure_;
  std::vector<Vec3> points_;
};

}  // namespace

LineGraph find_host_function_lines(const HostFunction& structure, const WallSection& section) {
  const Neighbourhood& grid = structure.neighbourhood();
  require_in_cells(grid, section);
  HostLevel function(structure);
  return LevelLines(function, min_component(grid.cell_size) / squares_per_cell,
                    !structure.is_sheet(), section)
      .find();
}

}  // namespace msq
