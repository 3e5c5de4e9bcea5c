// SPDX-License-Identifier: Apache-2.0
// What the benchmarks build before they measure.
#pragma once

#include <cmath>
#include <vector>

#include "bench.h"

namespace bench {

inline msq_context* make_context(uint32_t threads = 2, uint64_t cache_bytes = uint64_t{1} << 30,
                                 int32_t cache_policy = MSQ_CACHE_FIFO) {
  msq_context_def def;
  check(msq_context_def_init(&def, sizeof def));
  def.threads = threads;
  def.cache_bytes = cache_bytes;
  def.cache_policy = cache_policy;
  msq_context* context;
  check(msq_context_create(&def, &context));
  return context;
}

/// From the origin.
inline msq_shape* make_cube(msq_context* context, double extent = 1) {
  const double low[3] = {0, 0, 0}, high[3] = {extent, extent, extent};
  msq_shape* shape;
  check(msq_shape_from_box(context, low, high, &shape));
  return shape;
}

/// Takes over the shape and the structures, the second within the first; they may be null.
inline msq_model* make_model(msq_context* context, msq_shape* shape, msq_structure* structure,
                             msq_param skin = {0, nullptr}, msq_structure* finer = nullptr) {
  msq_scale_def scales[3] = {};
  scales[0].shape = shape;
  scales[1].structure = structure;
  scales[1].skin = skin;
  scales[2].structure = finer;
  msq_model_def def;
  check(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = finer ? 3 : structure ? 2 : 1;
  def.scale_size = sizeof scales[0];
  msq_model* model;
  check(msq_model_create(context, &def, &model));
  msq_structure_release(finer);
  msq_structure_release(structure);
  msq_shape_release(shape);
  return model;
}

/// Layers along z of a cube, whose pixels are as wide as the layers are high.
inline msq_slicer_def slices_of(uint32_t resolution, double extent = 1) {
  msq_slicer_def def;
  check(msq_slicer_def_init(&def, sizeof def));
  def.resolution[0] = def.resolution[1] = resolution;
  def.layer_height = extent / resolution;
  return def;
}

inline msq_slicer* make_slicer(const msq_model* model, const msq_slicer_def& def) {
  msq_slicer* slicer;
  check(msq_slicer_create(model, &def, &slicer));
  return slicer;
}

/// About two axes, by no angle that anything repeats at.
inline void turn(msq_neighbourhood& grid) {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(0.4), t = std::sin(0.4);
  const double rotation[9] = {c, -s * d, s * t, s, c * d, -c * t, 0, t, d};
  for (int i = 0; i < 9; ++i) grid.rotation[i] = rotation[i];
}

inline void put_in_middle(msq_neighbourhood& grid) {
  for (double& x : grid.origin) x = 0.5;
}

/// Cells around the grid's z axis or its origin, about as wide as high halfway to the cube's side,
/// from a tenth of its side on. `kind` 0: not to be used.
inline msq_warp_def warp_of(int32_t kind, double cells) {
  msq_warp_def def;
  check(msq_warp_def_init(&def, sizeof def));
  def.kind = kind;
  def.count = static_cast<uint32_t>(1.57 * cells);
  def.count_polar = kind == MSQ_WARP_SPHERICAL ? static_cast<uint32_t>(0.78 * cells) : 0;
  def.inner_radius = kind == MSQ_WARP_SAMPLED ? 0 : 0.1;
  return def;
}

/// Sheared and bent cells in the unit cube, by 65^3 samples that reach beyond it. The fields live
/// as long as this.
class SampledCells {
 public:
  SampledCells(msq_context* context, double cells) {
    constexpr uint64_t n = 65;
    std::vector<double> values(n * n * n);
    for (int axis = 0; axis < 3; ++axis) {
      for (uint64_t i = 0; i < values.size(); ++i) {
        const double x = at(i % n), y = at(i / n % n), z = at(i / n / n);
        values[i] = cells * (axis == 0   ? x + 0.3 * y + 0.05 * std::sin(3 * z)
                             : axis == 1 ? y + 0.06 * std::sin(3 * x) + 0.1 * x * z
                                         : z - 0.1 * x + 0.05 * y * y);
      }
      msq_grid_field_def def;
      check(msq_grid_field_def_init(&def, sizeof def));
      def.image.values = values.data();
      def.image.value_type = MSQ_FLOAT64;
      for (int i = 0; i < 3; ++i) {
        def.image.size[i] = n;
        def.image.grid.origin[i] = at(0);
        def.image.grid.cell_size[i] = at(1) - at(0);
      }
      check(msq_field_grid(context, &def, &fields_[axis]));
    }
  }
  ~SampledCells() {
    for (msq_field* field : fields_) msq_field_release(field);
  }
  SampledCells(const SampledCells&) = delete;
  SampledCells& operator=(const SampledCells&) = delete;

  void set(msq_warp_def& def) const {
    def.count = 0;
    def.u = fields_[0];
    def.v = fields_[1];
    def.w = fields_[2];
  }

 private:
  static double at(uint64_t i) { return (static_cast<double>(i) - 3) / 58; }
  msq_field* fields_[3] = {};
};

}  // namespace bench
