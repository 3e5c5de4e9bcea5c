// SPDX-License-Identifier: Apache-2.0
// Foams in the unit cube, and views of it by rays.
#pragma once

#include <array>
#include <vector>

#include "setup.h"

namespace bench {

/// Foam of cells^3 cells, r = 0.1 cell.
inline msq_model* make_foam_model(msq_context* context, int cells, int32_t method = MSQ_FOAM_AUTO) {
  msq_foam_def def;
  check(msq_foam_def_init(&def, sizeof def));
  def.method = method;
  for (double& size : def.grid.cell_size) size = 1.0 / cells;
  def.radius.value = 0.1 / cells;
  msq_structure* foam;
  check(msq_structure_foam(context, &def, &foam));
  return make_model(context, make_cube(context), foam);
}

inline msq_cache_report cache_of(const msq_context* context) {
  msq_cache_report report{};
  report.struct_size = sizeof report;
  check(msq_cache_stats(context, &report));
  return report;
}

/// A square picture of the model, seen along the direction, as large as just fits; parallel rays.
inline msq_camera fit_camera(const msq_model* model, std::array<double, 3> direction,
                             uint32_t side) {
  msq_camera camera;
  check(msq_camera_init(&camera, sizeof camera));
  check(msq_camera_fit(model, direction.data(), nullptr, side, side, &camera));
  return camera;
}

/// Depth and normals of a square picture.
struct Picture {
  explicit Picture(uint32_t of_side)
      : side(of_side), depth(size_t{side} * side), normal(3 * depth.size()) {}

  void render(const msq_model* model, const msq_camera& camera) {
    msq_render_def def;
    check(msq_render_def_init(&def, sizeof def));
    def.width = def.height = side;
    msq_frame frame;
    check(msq_frame_init(&frame, sizeof frame));
    frame.depth = depth.data();
    frame.normal = normal.data();
    check(msq_render(model, &camera, &def, nullptr, &frame, nullptr, nullptr, nullptr));
  }
  double rays() const { return static_cast<double>(depth.size()); }

  uint32_t side;
  std::vector<float> depth, normal;
};

}  // namespace bench
