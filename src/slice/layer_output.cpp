// SPDX-License-Identifier: Apache-2.0
#include "slice/layer_output.h"

#include "base/status.h"
#include "query/material.h"

namespace msq {

SampleGrid divided(const SampleGrid& pixels, unsigned across) {
  SampleGrid samples = pixels;
  for (int axis = 0; axis < 2; ++axis) {
    samples.spacing[axis] = pixels.spacing[axis] / across;
    samples.origin[axis] = pixels.origin[axis] + (0.5 / across - 0.5) * pixels.spacing[axis];
    samples.first[static_cast<size_t>(axis)] *= across;
  }
  samples.nx *= across;
  samples.ny *= across;
  return samples;
}

namespace {

/// The structure whose onset an output is.
const Structure& onset_structure(const OutputPlan& plan, const Model& model,
                                 const Scales& resolved) {
  if (!model.regions().empty())
    fail(Status::unsupported,
         "the output is an onset, and the model has %zu regions; it must be one",
         model.regions().size());
  if (plan.onset_scale == 0 && resolved.empty())
    fail(Status::argument, "the output is an onset, and no structure is resolved");
  const Scale* found = plan.onset_scale == 0 ? resolved.back() : nullptr;
  for (const Scale* scale : resolved)
    if (model.number(*scale) == plan.onset_scale) found = scale;
  if (!found)
    fail(Status::argument, "onset_scale is %zu; the slicer resolves %zu scales beside the shape",
         plan.onset_scale, resolved.size());
  if (!found->structure->has_onset())
    fail(Status::unsupported, "the output is an onset, and the structure of scale %zu has none",
         model.number(*found));
  return *found->structure;
}

}  // namespace

namespace {

void require_channel(const std::string& channel, const Model& model, const Scales& resolved) {
  require_material(model, resolved, "the output is a channel");
  for (const Material* material : model.materials(resolved))
    if (material->find(channel)) return;
  fail(Status::argument, "the output is channel %s, and no material of the model has it",
       channel.c_str());
}

}  // namespace

std::unique_ptr<const LayerOutput> make_layer_output(const OutputPlan& plan, const Model& model,
                                                     const Scales& resolved) {
  switch (plan.format) {
    case LayerFormat::bits:
      return make_bit_output();
    case LayerFormat::bytes:
      return make_byte_output();
    case LayerFormat::grey:
      return make_grey_output(plan.grey);
    case LayerFormat::distance:
      return make_distance_output();
    case LayerFormat::material:
      require_material(model, resolved, "the output is materials");
      return make_material_output();
    case LayerFormat::onset:
      return make_onset_output(onset_structure(plan, model, resolved), plan.is_onset_signed);
    case LayerFormat::channel:
      require_channel(plan.channel, model, resolved);
      return make_channel_output(plan.channel);
    case LayerFormat::contours:
      break;
  }
  return nullptr;
}

}  // namespace msq
