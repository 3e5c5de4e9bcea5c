// SPDX-License-Identifier: Apache-2.0
#include "slice/contours.h"

#include "api/contours_def.h"
#include "api/guard.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_contours_def contours_defaults() {
  msq_contours_def def{};
  def.type = MSQ_FLOAT64;
  def.axis = 2;
  def.units = 1;
  return def;
}

ContourFormat read_type(int32_t type) {
  if (type == MSQ_INT32) return ContourFormat::int32;
  if (type == MSQ_INT64) return ContourFormat::int64;
  if (type == MSQ_FLOAT64) return ContourFormat::float64;
  fail(Status::argument, "type is %d; it must be MSQ_INT32, MSQ_INT64 or MSQ_FLOAT64", type);
}

int32_t type_of(ContourFormat format) {
  return format == ContourFormat::int32   ? MSQ_INT32
         : format == ContourFormat::int64 ? MSQ_INT64
                                          : MSQ_FLOAT64;
}

ContourPlan read_plan(const msq_contours_def& def) {
  ContourPlan plan;
  plan.format = read_type(def.type);
  plan.plane.axis = require_range(def.axis, 0, 2, "axis");
  plan.has_window = require_range(def.has_window, 0, 1, "has_window") != 0;
  for (int i = 0; i < 2; ++i) {
    const char axis = "uv"[i];
    const double low = def.window_min[i], high = def.window_max[i];
    if (!plan.has_window && (low != 0 || high != 0))
      fail(Status::argument, "a window is given from %g to %g along %c, and has_window is 0", low,
           high, axis);
    if (plan.has_window && (!std::isfinite(low) || !std::isfinite(high) || !(low < high)))
      fail(Status::argument,
           "the window is from %g to %g along %c; it must be finite and not empty", low, high,
           axis);
    plan.window_min[i] = low;
    plan.window_max[i] = high;
  }
  plan.tolerance = require_positive(def.tolerance, "tolerance");
  if (def.pitch != 0) plan.pitch = require_positive(def.pitch, "pitch");
  plan.units = require_positive(def.units, "units");
  plan.length_scale = require_zero_or_more(def.length_scale, "length_scale");
  plan.topology_samples = def.topology_samples;
  if (plan.topology_samples != 0 && plan.topology_samples != 2 && plan.topology_samples != 4 &&
      plan.topology_samples != 8 && plan.topology_samples != 16)
    fail(Status::argument, "topology_samples is %u; it must be 0, 2, 4, 8 or 16",
         plan.topology_samples);
  return plan;
}

}  // namespace

namespace msq::api {

ContourPlan read_contours(const msq_contours_def* def, const char* name) {
  return read_plan(read_def(def, contours_defaults(), name));
}

ContourPlan read_slicer_contours(const msq_contours_def* def, const char* name) {
  const ContourPlan plan = read_contours(def, name);
  if (plan.plane.axis != 2)
    fail(Status::argument, "axis is %d; layers of a slicer are normal to axis 2", plan.plane.axis);
  if (plan.length_scale != 0)
    fail(Status::argument, "length_scale is %g; it must be 0, since the slicer has one",
         plan.length_scale);
  return plan;
}

}  // namespace msq::api

msq_status msq_contours_def_init(msq_contours_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, contours_defaults(), "msq_contours_def"); });
}

msq_status msq_layer_contours(const msq_model* model, double height, const msq_contours_def* def,
                              msq_contours** contours, msq_job* job) {
  return guard([&] {
    const Model& known = object(model, "model");
    const Ref<const Model> keep(&known);
    require(contours, "contours");
    ContourPlan plan = read_contours(def, "def");
    plan.plane.height = require_finite(height, "height");
    *contours =
        new_handle<msq_contours>(layer_contours(known, plan, job ? &object(job, "job") : nullptr));
  });
}

msq_status msq_slicer_contours(const msq_slicer* slicer, uint64_t index,
                               const msq_contours_def* def, msq_contours** contours, msq_job* job) {
  return guard([&] {
    const Slicer& known = object(slicer, "slicer");
    const Ref<const Slicer> keep(&known);
    const SampleGrid& grid = known.grid();
    require(contours, "contours");
    const ContourPlan plan = read_slicer_contours(def, "def");
    if (index >= grid.nz)
      fail(Status::argument, "layer %llu does not exist; there are %llu layers",
           static_cast<unsigned long long>(index), static_cast<unsigned long long>(grid.nz));
    *contours =
        new_handle<msq_contours>(known.contours(index, plan, job ? &object(job, "job") : nullptr));
  });
}

void msq_contours_retain(msq_contours* contours) {
  retain(contours);
}
void msq_contours_release(msq_contours* contours) {
  release(contours);
}

msq_status msq_contours_info(const msq_contours* contours, msq_contours_report* report) {
  return guard([&] {
    const Contours& known = object(contours, "contours");
    msq_contours_report written{};
    written.type = type_of(known.format());
    written.ring_count = known.ring_count();
    written.point_count = known.point_count();
    written.points = known.points();
    written.starts = known.starts();
    written.parents = known.parents();
    written.holes = known.holes();
    written.unresolved_count = known.unresolved();
    written.pitch = known.pitch();
    written.topology_count = known.topology();
    written.topology_samples = known.topology_samples();
    write_report(report, written, "report");
  });
}
