// SPDX-License-Identifier: Apache-2.0
#include "panel.h"

#include <algorithm>
#include <cmath>

using namespace msq_io;

namespace msq_io {

msq_io_panel_def panel_defaults() {
  msq_io_panel_def def{};
  def.struct_size = sizeof def;
  def.portrait = 1;
  def.pixels[0] = 2560;
  def.pixels[1] = 1440;
  def.size[0] = 120.96;
  def.size[1] = 68.04;
  def.mirror[0] = 1;
  return def;
}

msq_io_panel_def read_panel(const msq_io_panel_def* host_def) {
  const msq_io_panel_def def = read_def(host_def, panel_defaults(), "panel");
  require_range(def.portrait, 0, 1, "portrait");
  for (int axis = 0; axis < 2; ++axis) {
    require_range<uint32_t>(def.pixels[axis], 1, 0x7fffffff, "pixels of the panel");
    require_positive(def.size[axis], "size of the panel");
    require_range(def.mirror[axis], 0, 1, "mirror of the panel");
  }
  return def;
}

namespace {

/// Bounds of a model along the axes of a plan: those of its box in the frame, as slicers have them.
void find_bounds(const msq_model& model, const msq_slicer_def& plan, double (&min)[3],
                 double (&max)[3]) {
  check_msq(msq_model_bounds(&model, min, max));
  for (int axis = 0; axis < 3; ++axis) {
    min[axis] -= plan.frame_origin[axis];
    max[axis] -= plan.frame_origin[axis];
  }
  const double* const axes = plan.frame_axes;
  if (std::all_of(axes, axes + 9, [](double number) { return number == 0; })) return;
  double middle[3], half[3];
  for (int axis = 0; axis < 3; ++axis) {
    half[axis] = (max[axis] - min[axis]) / 2;
    middle[axis] = min[axis] + half[axis];
  }
  for (int row = 0; row < 3; ++row) {
    double at = 0, reach = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double part = axes[3 * row + axis];
      at += part * middle[axis];
      if (part != 0) reach += std::abs(part) * half[axis];
    }
    min[row] = at - reach;
    max[row] = at + reach;
  }
}

}  // namespace

}  // namespace msq_io

msq_status msq_io_panel_def_init(msq_io_panel_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, panel_defaults(), "msq_io_panel_def"); });
}

msq_status msq_io_panel_plan(const msq_model* model, const msq_io_panel_def* host_panel,
                             msq_slicer_def* host_plan) {
  return guard([&] {
    require(host_plan, "plan");
    constexpr size_t least = offsetof(msq_slicer_def, output_count);
    const size_t size = host_plan->struct_size;
    if (size < least || size > max_size)
      fail(MSQ_E_ARGUMENT, "the struct_size of plan is %zu; it must be %zu to %zu", size, least,
           max_size);
    msq_slicer_def copy{};
    msq_slicer_def* const plan = &copy;
    std::memcpy(plan, host_plan, std::min(size, sizeof copy));
    const msq_io_panel_def panel = read_panel(host_panel);
    const double height =
        plan->layer_z ? 0 : require_positive(plan->layer_height, "layer_height of plan");
    double min[3], max[3];
    find_bounds(require(model, "model"), copy, min, max);
    for (int axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(max[axis] - min[axis]))
        fail(MSQ_E_ARGUMENT, "the model fills all space; a panel needs one with bounds");
      if (axis < 2 && max[axis] - min[axis] > panel.size[axis])
        fail(MSQ_E_ARGUMENT, "the model is %s mm wide along %c; the panel has %s mm",
             text_of(max[axis] - min[axis]).c_str(), "xy"[axis], text_of(panel.size[axis]).c_str());
    }
    for (int axis = 0; axis < 2; ++axis) {
      const double middle = min[axis] + (max[axis] - min[axis]) / 2;
      plan->region_min[axis] = middle - panel.size[axis] / 2;
      plan->region_max[axis] = middle + panel.size[axis] / 2;
      plan->resolution[axis] = panel.pixels[axis];
      plan->pitch[axis] = 0;
    }
    plan->region_min[2] = min[2];
    plan->region_max[2] = max[2];
    if (!plan->layer_z) {
      // A last layer that only rounding would make is left out.
      const double layers = std::fmax(std::ceil((max[2] - min[2]) / height - 1e-6), 1);
      plan->region_max[2] = min[2] + layers * height;
      if (plan->layer_count == 0) {
        if (!(layers < 2147483648.0))
          fail(MSQ_E_LIMIT, "%s layers; the limit is 2147483647", text_of(layers).c_str());
        plan->layer_count = static_cast<uint64_t>(layers);
      }
    }
    plan->has_region = 1;
    // PrusaSlicer (libslic3r/SLA/RasterBase.hpp): the first row is that of the largest y, and
    // turning mirrors x.
    const bool mirrors_x = (panel.mirror[0] != 0) != (panel.portrait != 0);
    const bool mirrors_y = panel.mirror[1] == 0;
    plan->orientation = 0;
    if (mirrors_x) plan->orientation |= MSQ_LAYER_MIRROR_X;
    if (mirrors_y) plan->orientation |= MSQ_LAYER_MIRROR_Y;
    if (panel.portrait) plan->orientation |= MSQ_LAYER_TRANSPOSE;
    if (!plan->outputs && plan->output == MSQ_LAYER_BITS) plan->output = MSQ_LAYER_GREY;
    std::memcpy(host_plan, plan, std::min(size, sizeof copy));
  });
}
