// SPDX-License-Identifier: Apache-2.0
#include "api/guard.h"
#include "api/warnings.h"
#include "api/window.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_slicer_def slicer_defaults() {
  msq_slicer_def def{};
  def.output = MSQ_LAYER_BITS;
  def.grey_samples = 4;
  def.grey_gamma = 1;
  return def;
}

GreyScale read_grey(const msq_slicer_def& def) {
  if (def.grey_samples != 2 && def.grey_samples != 4 && def.grey_samples != 8 &&
      def.grey_samples != 16)
    fail(Status::argument, "grey_samples is %u; it must be 2, 4, 8 or 16", def.grey_samples);
  if (!(def.grey_gamma >= 0.1 && def.grey_gamma <= 10))
    fail(Status::argument, "grey_gamma is %g; it must be from 0.1 to 10", def.grey_gamma);
  if (def.grey_threshold > 255)
    fail(Status::argument, "grey_threshold is %u; it must be at most 255", def.grey_threshold);
  return {def.grey_samples, def.grey_gamma, def.grey_threshold};
}

Orientation read_orientation(uint32_t flags) {
  constexpr uint32_t all = MSQ_LAYER_MIRROR_X | MSQ_LAYER_MIRROR_Y | MSQ_LAYER_TRANSPOSE;
  if (flags & ~all)
    fail(Status::argument, "orientation is %u; it must be a sum of msq_layer_orientation", flags);
  return {(flags & MSQ_LAYER_MIRROR_X) != 0, (flags & MSQ_LAYER_MIRROR_Y) != 0,
          (flags & MSQ_LAYER_TRANSPOSE) != 0};
}

double require_not_negative(double value, const char* name) {
  if (!(value >= 0) || !std::isfinite(value))
    fail(Status::argument, "%s is %g; it must be finite and not negative", name, value);
  return value;
}

SlicePlan read_plan(const msq_slicer_def& def) {
  SlicePlan plan;
  plan.format = static_cast<LayerFormat>(
      require_range(def.output, MSQ_LAYER_BITS, MSQ_LAYER_MATERIAL, "output"));
  for (int axis = 0; axis < 2; ++axis) {
    plan.pitch[axis] = require_not_negative(def.pitch[axis], "pitch");
    plan.resolution[axis] = def.resolution[axis];
  }
  plan.layer_count = def.layer_count;
  plan.slab_layers = def.slab_layers;
  if (!(def.length_scale >= 0))
    fail(Status::argument, "length_scale is %g; it must not be negative", def.length_scale);
  plan.length_scale = def.length_scale;
  plan.window = read_window(def.window);
  plan.grey = read_grey(def);
  plan.orientation = read_orientation(def.orientation);
  require_reserved(def.reserved, "reserved");
  plan.has_region = require_range(def.has_region, 0, 1, "has_region") != 0;
  for (int axis = 0; axis < 3; ++axis)
    if (!plan.has_region && (def.region_min[axis] != 0 || def.region_max[axis] != 0))
      fail(Status::argument, "a region is given from %g to %g along axis %d, and has_region is 0",
           def.region_min[axis], def.region_max[axis], axis);
  if (plan.has_region)
    plan.region = {require_vector(def.region_min, "region_min"),
                   require_vector(def.region_max, "region_max")};
  if (!def.layer_z && def.layer_z_count)
    fail(Status::argument, "layer_z is NULL and layer_z_count is %llu",
         static_cast<unsigned long long>(def.layer_z_count));
  if (!def.layer_z) {
    plan.layer_height = require_positive(def.layer_height, "layer_height");
    return plan;
  }
  if (def.layer_z_count < 1 || def.layer_z_count > INT32_MAX)
    fail(Status::argument, "layer_z_count is %llu; it must be from 1 to %d",
         static_cast<unsigned long long>(def.layer_z_count), INT32_MAX);
  if (def.layer_count && def.layer_count != def.layer_z_count)
    fail(Status::argument, "layer_count is %llu and layer_z_count is %llu",
         static_cast<unsigned long long>(def.layer_count),
         static_cast<unsigned long long>(def.layer_z_count));
  for (uint64_t i = 0; i < def.layer_z_count; ++i) {
    require_finite(def.layer_z[i], "layer_z");
    if (i > 0 && !(def.layer_z[i] > def.layer_z[i - 1]))
      fail(Status::argument, "layer_z[%llu] is %g, after %g; layer_z must ascend",
           static_cast<unsigned long long>(i), def.layer_z[i], def.layer_z[i - 1]);
  }
  plan.heights.assign(def.layer_z, def.layer_z + def.layer_z_count);
  return plan;
}

void require_layer(const Slicer& slicer, uint64_t index) {
  if (index >= slicer.grid().nz)
    fail(Status::argument, "layer %llu does not exist; there are %llu layers",
         static_cast<unsigned long long>(index), static_cast<unsigned long long>(slicer.grid().nz));
}

}  // namespace

msq_status msq_slicer_def_init(msq_slicer_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, slicer_defaults(), "msq_slicer_def"); });
}

msq_status msq_slicer_create(const msq_model* model, const msq_slicer_def* def,
                             msq_slicer** slicer) {
  return guard([&] {
    const Model& known = object(model, "model");
    require(slicer, "slicer");
    SlicePlan plan = read_plan(read_def(def, slicer_defaults(), "def"));
    Ref<Slicer> made = make_ref<Slicer>(Ref<const Model>(&known), std::move(plan));
    warn_of_pitch(*made);
    *slicer = new_handle<msq_slicer>(std::move(made));
  });
}

void msq_slicer_retain(msq_slicer* slicer) {
  retain(slicer);
}
void msq_slicer_release(msq_slicer* slicer) {
  release(slicer);
}

msq_status msq_slicer_info(const msq_slicer* slicer, msq_slicer_report* report) {
  return guard([&] {
    const Slicer& known = object(slicer, "slicer");
    const SampleGrid& grid = known.grid();
    msq_slicer_report written{};
    written.slab_layers = static_cast<uint32_t>(known.slab_layers());
    written.width = static_cast<uint32_t>(known.width());
    written.height = static_cast<uint32_t>(known.height());
    written.layer_count = grid.nz;
    written.stride = known.stride();
    written.layer_bytes = known.layer_bytes();
    for (int axis = 0; axis < 2; ++axis) {
      written.origin[axis] = grid.origin[axis];
      written.pitch[axis] = grid.spacing[axis];
    }
    const uint64_t counts[3] = {grid.nx, grid.ny, grid.nz};
    for (size_t axis = 0; axis < 3; ++axis) {
      written.window.first[axis] = grid.first[axis];
      written.window.count[axis] = counts[axis];
      written.whole[axis] = known.whole()[axis];
    }
    write_report(report, written, "report");
  });
}

msq_status msq_slicer_layer_z(const msq_slicer* slicer, uint64_t index, double* z) {
  return guard([&] {
    const Slicer& known = object(slicer, "slicer");
    require_layer(known, index);
    require(z, "z") = known.grid().z(index);
  });
}

msq_status msq_slicer_run(const msq_slicer* slicer, uint64_t first, uint64_t count, msq_layer_fn fn,
                          void* user, msq_job* job) {
  return guard([&] {
    const Slicer& known = object(slicer, "slicer");
    // The callback may release the host's last references.
    const Ref<const Slicer> keep(&known);
    const Ref<Job> work(job ? &object(job, "job") : nullptr);
    const SampleGrid& grid = known.grid();
    if (!fn) fail(Status::argument, "fn is NULL");
    if (first > grid.nz || (count != UINT64_MAX && count > grid.nz - first))
      fail(Status::argument, "layers %llu to %llu + %llu do not exist; there are %llu layers",
           static_cast<unsigned long long>(first), static_cast<unsigned long long>(first),
           static_cast<unsigned long long>(count), static_cast<unsigned long long>(grid.nz));
    const uint64_t last = count == UINT64_MAX ? grid.nz : first + count;
    const auto take = [&](const Layer& layer) {
      msq_layer view{};
      view.struct_size = sizeof view;
      view.output = static_cast<int32_t>(known.format());
      view.index = layer.index;
      view.z = layer.z;
      view.data = layer.data;
      view.stride = known.stride();
      view.width = static_cast<uint32_t>(known.width());
      view.height = static_cast<uint32_t>(known.height());
      view.inside_count = layer.inside_count;
      const int32_t code = call_host(fn, user, &view);
      if (code != 0)
        throw Error(Status::host,
                    "the layer callback returned " + std::to_string(code) + " at layer " +
                        std::to_string(layer.index),
                    code);
    };
    known.run(first, last, take, work.get());
    warn_of_cache(known.model().context());
  });
}

msq_status msq_slice_layer(const msq_slicer* slicer, uint64_t index, uint8_t* buffer,
                           uint64_t buffer_bytes, msq_job* job) {
  return guard([&] {
    const Slicer& known = object(slicer, "slicer");
    const Ref<const Slicer> keep(&known);
    require_layer(known, index);
    require(buffer, "buffer");
    if (buffer_bytes < known.layer_bytes())
      fail(Status::argument, "buffer_bytes is %llu; a layer has %llu",
           static_cast<unsigned long long>(buffer_bytes),
           static_cast<unsigned long long>(known.layer_bytes()));
    known.slice_layer(index, buffer, job ? &object(job, "job") : nullptr);
    warn_of_cache(known.model().context());
  });
}
