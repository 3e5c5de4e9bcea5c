// SPDX-License-Identifier: Apache-2.0
// The foam that the benchmarks of foams slice.
#pragma once

#include <cmath>
#include <vector>

#include "setup.h"

namespace bench {

/// cells^3 cells to the unit cube, r = 0.1 cell.
struct FoamSetup {
  int cells;
  int32_t method;
  uint64_t cache_bytes = uint64_t{192} << 20;
  uint32_t threads = 2;
  double extent = 1;        ///< the shape: a cube from the origin with such sides
  bool is_graded = false;   ///< r from 0.05 cell at one corner of the cube to 0.15 at the other
  double wall = 0;          ///< thickness in cells, in place of struts; 0: struts
  double vent = 0;          ///< radius of holes in walls, in cells
  double weight = 0;        ///< of seeds, in cells
  uint64_t samples = 0;     ///< of a radius that waves so, along each axis; 0: none
  bool is_formula = false;  ///< r waves so by an expression
};

inline double wall_seconds(const std::function<void()>& work) {
  return median_seconds(work);
}

/// Seconds for the first `layers` layers of resolution^2 samples in the shape, from an empty cache,
/// each layer handed as bits to a callback that reads it; and the bytes held at most.
inline double foam_slice_seconds(const FoamSetup& setup, uint32_t resolution, uint64_t layers,
                                 double& peak,
                                 double (*measure)(const std::function<void()>&) = wall_seconds) {
  msq_context* context = make_context(setup.threads, setup.cache_bytes);
  msq_foam_def def;
  check(msq_foam_def_init(&def, sizeof def));
  def.method = setup.method;
  for (double& size : def.grid.cell_size) size = 1.0 / setup.cells;
  def.vent_radius.value = setup.vent / setup.cells;
  def.weight = setup.weight / setup.cells;
  if (setup.wall > 0)
    def.wall_thickness.value = setup.wall / setup.cells;
  else
    def.radius.value = 0.1 / setup.cells;
  msq_field* field = nullptr;
  if (setup.is_graded) {
    const double low[3] = {0, 0, 0}, high[3] = {setup.extent, setup.extent, setup.extent};
    check(msq_field_gradient(context, low, 0.05 / setup.cells, high, 0.15 / setup.cells, &field));
    def.radius = {0, field};
  }
  if (setup.samples) {
    msq_grid_field_def grid;
    check(msq_grid_field_def_init(&grid, sizeof grid));
    std::vector<float> values;
    const double step = 1 / static_cast<double>(setup.samples - 1);
    for (uint64_t i = 0; i < setup.samples * setup.samples * setup.samples; ++i) {
      const double x = step * static_cast<double>(i % setup.samples),
                   y = step * static_cast<double>(i / setup.samples % setup.samples),
                   z = step * static_cast<double>(i / setup.samples / setup.samples);
      const double wave = std::sin(5 * x) * std::cos(4 * y + 3 * z);
      values.push_back(static_cast<float>((0.1 + 0.05 * wave) / setup.cells));
    }
    grid.image.values = values.data();
    grid.image.value_type = MSQ_FLOAT32;
    for (int axis = 0; axis < 3; ++axis) {
      grid.image.size[axis] = setup.samples;
      grid.image.grid.cell_size[axis] = setup.extent * step;
    }
    check(msq_field_grid(context, &grid, &field));
    def.radius = {0, field};
  }
  if (setup.is_formula) {
    const msq_named_value parameters[] = {{"extent", setup.extent},
                                          {"cells", static_cast<double>(setup.cells)}};
    msq_expression_field_def waves;
    check(msq_expression_field_def_init(&waves, sizeof waves));
    waves.expression = "(0.1 + 0.05*sin(5*x/extent)*cos((4*y + 3*z)/extent)) / cells";
    waves.parameters = parameters;
    waves.parameter_count = 2;
    waves.high = 0.15 / setup.cells;
    check(msq_field_expression(context, &waves, &field));
    def.radius = {0, field};
  }
  msq_structure* structure;
  check(msq_structure_foam(context, &def, &structure));
  msq_field_release(field);
  msq_model* model = make_model(context, make_cube(context, setup.extent), structure);

  msq_slicer* slicer = make_slicer(model, slices_of(resolution, setup.extent));
  Reader reader;
  const double seconds = measure([&] {
    check(msq_cache_clear(context));
    check(msq_slicer_run(slicer, 0, layers, Reader::take, &reader, nullptr));
  });
  msq_memory_report memory{};
  memory.struct_size = sizeof memory;
  check(msq_context_memory(context, &memory));
  peak = static_cast<double>(memory.peak_bytes);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
  return seconds;
}

/// "512^3, 32^3 cells"
inline std::string foam_work(uint32_t resolution, int cells) {
  return std::to_string(resolution) + "^3, " + std::to_string(cells) + "^3 cells";
}

}  // namespace bench
