// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include "api/contours_def.h"
#include "api/guard.h"
#include "api/neighbourhood.h"
#include "api/warnings.h"
#include "api/window.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr uint32_t max_outputs = 64;
constexpr size_t max_channel_name = 255;

msq_slicer_def slicer_defaults() {
  msq_slicer_def def{};
  def.output = MSQ_LAYER_BITS;
  def.grey_samples = 4;
  def.grey_gamma = 1;
  return def;
}

msq_output_def output_defaults() {
  msq_output_def def{};
  def.output = MSQ_LAYER_BITS;
  def.grey_samples = 4;
  def.grey_gamma = 1;
  def.onset_value = MSQ_ONSET_PLAIN;
  return def;
}

GreyScale read_grey(uint32_t samples, double gamma, uint32_t threshold) {
  if (samples != 2 && samples != 4 && samples != 8 && samples != 16)
    fail(Status::argument, "grey_samples is %u; it must be 2, 4, 8 or 16", samples);
  if (!(gamma >= 0.1 && gamma <= 10))
    fail(Status::argument, "grey_gamma is %g; it must be from 0.1 to 10", gamma);
  if (threshold > 255)
    fail(Status::argument, "grey_threshold is %u; it must be at most 255", threshold);
  return {samples, gamma, threshold};
}

OutputPlan read_output(const msq_output_def& def) {
  OutputPlan plan;
  plan.format = static_cast<LayerFormat>(
      require_range(def.output, MSQ_LAYER_BITS, MSQ_LAYER_CHANNEL, "output"));
  plan.grey = read_grey(def.grey_samples, def.grey_gamma, def.grey_threshold);
  plan.onset_scale = def.onset_scale;
  plan.is_onset_signed = require_range(def.onset_value, MSQ_ONSET_PLAIN, MSQ_ONSET_SIGNED,
                                       "onset_value") == MSQ_ONSET_SIGNED;
  const bool has_contours = plan.format == LayerFormat::contours;
  if (has_contours != (def.contours != nullptr))
    fail(Status::argument, "output is %d and contours is %s; CONTOURS (%d) needs it, and no other",
         def.output, def.contours ? "given" : "NULL", MSQ_LAYER_CONTOURS);
  if (has_contours) plan.contours = read_slicer_contours(def.contours, "contours");
  const bool has_channel = plan.format == LayerFormat::channel;
  if (has_channel != (def.channel != nullptr))
    fail(Status::argument, "output is %d and channel is %s; CHANNEL (%d) needs it, and no other",
         def.output, def.channel ? "given" : "NULL", MSQ_LAYER_CHANNEL);
  // No material has a longer name.
  if (has_channel) plan.channel.assign(def.channel, strnlen(def.channel, max_channel_name + 1));
  return plan;
}

/// What each layer holds, by either of the two ways to say so.
std::vector<OutputPlan> read_outputs(const msq_slicer_def& def) {
  const GreyScale grey = read_grey(def.grey_samples, def.grey_gamma, def.grey_threshold);
  if (!def.outputs) {
    if (def.output_count > 0)
      fail(Status::argument, "outputs is NULL and output_count is %u", def.output_count);
    OutputPlan plan;
    plan.format = static_cast<LayerFormat>(
        require_range(def.output, MSQ_LAYER_BITS, MSQ_LAYER_ONSET, "output"));
    plan.grey = grey;
    return {plan};
  }
  if (def.output != MSQ_LAYER_BITS)
    fail(Status::argument, "output is %d and outputs is given; it must then be %d", def.output,
         MSQ_LAYER_BITS);
  if (def.output_count < 1 || def.output_count > max_outputs)
    fail(Status::argument, "output_count is %u; it must be from 1 to %u", def.output_count,
         max_outputs);
  const uint32_t size = def.outputs->struct_size;
  const auto* bytes = reinterpret_cast<const unsigned char*>(def.outputs);
  std::vector<OutputPlan> plans;
  for (uint32_t i = 0; i < def.output_count; ++i) {
    const std::string name = "outputs[" + std::to_string(i) + "]";
    const auto* element = reinterpret_cast<const msq_output_def*>(bytes + size_t{size} * i);
    const msq_output_def read = read_def(element, output_defaults(), name.c_str());
    if (element->struct_size != size)
      fail(Status::argument, "the struct_size of %s is %u; it must be that of outputs[0], %u",
           name.c_str(), element->struct_size, size);
    plans.push_back(read_output(read));
  }
  return plans;
}

Orientation read_orientation(uint32_t flags) {
  constexpr uint32_t all = MSQ_LAYER_MIRROR_X | MSQ_LAYER_MIRROR_Y | MSQ_LAYER_TRANSPOSE;
  if (flags & ~all)
    fail(Status::argument, "orientation is %u; it must be a sum of msq_layer_orientation", flags);
  return {(flags & MSQ_LAYER_MIRROR_X) != 0, (flags & MSQ_LAYER_MIRROR_Y) != 0,
          (flags & MSQ_LAYER_TRANSPOSE) != 0};
}

/// Axes are all zeros, or an orthonormal matrix of either handedness.
LayerFrame read_frame(const msq_slicer_def& def) {
  LayerFrame frame;
  frame.origin = require_vector(def.frame_origin, "frame_origin");
  const double* m = def.frame_axes;
  if (std::all_of(m, m + 9, [](double value) { return value == 0; })) return frame;
  double rows[9];
  std::copy_n(m, 9, rows);
  const bool is_left_handed =
      dot({m[0], m[1], m[2]}, cross({m[3], m[4], m[5]}, {m[6], m[7], m[8]})) < 0;
  for (int i = 6; i < 9 && is_left_handed; ++i) rows[i] = -rows[i];
  const Rotation nearest = read_rotation(rows, "frame_axes");
  for (size_t i = 0; i < 3; ++i) {
    const double sign = i == 2 && is_left_handed ? -1 : 1;
    frame.axes[i] = Vec3{nearest.m[3 * i], nearest.m[3 * i + 1], nearest.m[3 * i + 2]} * sign;
  }
  return frame;
}

SlicePlan read_plan(const msq_slicer_def& def) {
  SlicePlan plan;
  plan.outputs = read_outputs(def);
  plan.frame = read_frame(def);
  for (int axis = 0; axis < 2; ++axis) {
    plan.pitch[axis] = require_not_negative(def.pitch[axis], "pitch");
    plan.resolution[axis] = def.resolution[axis];
  }
  plan.layer_count = def.layer_count;
  plan.slab_layers = def.slab_layers;
  plan.length_scale = require_zero_or_more(def.length_scale, "length_scale");
  plan.window = read_window(def.window);
  plan.orientation = read_orientation(def.orientation);
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

msq_status msq_output_def_init(msq_output_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, output_defaults(), "msq_output_def"); });
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
    written.stride = known.stride(0);
    written.layer_bytes = known.layer_bytes(0);
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
    std::vector<msq_output> outputs(known.output_count());
    std::vector<const msq_output*> pointers;
    pointers.reserve(outputs.size());
    for (const msq_output& output : outputs) pointers.push_back(&output);
    const auto take = [&](const Layer& layer) {
      for (size_t i = 0; i < outputs.size(); ++i) {
        const LayerPart& part = layer.parts[i];
        msq_output& output = outputs[i];
        output.struct_size = sizeof output;
        output.output = static_cast<int32_t>(known.format(i));
        output.data = part.data;
        output.stride = known.stride(i);
        output.inside_count = part.inside_count;
        output.contours = reinterpret_cast<msq_contours*>(part.contours);
      }
      const msq_output& first_output = outputs.front();
      msq_layer view{};
      view.struct_size = sizeof view;
      view.output = first_output.output;
      view.index = layer.index;
      view.z = layer.z;
      view.data = first_output.data;
      view.stride = first_output.stride;
      view.width = static_cast<uint32_t>(known.width());
      view.height = static_cast<uint32_t>(known.height());
      view.inside_count = first_output.inside_count;
      view.output_count = outputs.size();
      view.outputs = pointers.data();
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
    if (known.format(0) == LayerFormat::contours)
      fail(Status::argument, "output 0 is contours; msq_slicer_run returns them");
    if (buffer_bytes < known.layer_bytes(0))
      fail(Status::argument, "buffer_bytes is %llu; a layer has %llu",
           static_cast<unsigned long long>(buffer_bytes),
           static_cast<unsigned long long>(known.layer_bytes(0)));
    known.slice_layer(index, buffer, job ? &object(job, "job") : nullptr);
    warn_of_cache(known.model().context());
  });
}
