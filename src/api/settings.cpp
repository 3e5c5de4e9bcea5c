// SPDX-License-Identifier: Apache-2.0
// The settings for slices and pictures in a document, member by member.
#include "api/definitions.h"

namespace msq::api {

namespace {

constexpr Choice layer_outputs[] = {
    {"bits", MSQ_LAYER_BITS},         {"bytes", MSQ_LAYER_BYTES},       {"grey", MSQ_LAYER_GREY},
    {"distance", MSQ_LAYER_DISTANCE}, {"material", MSQ_LAYER_MATERIAL}, {"onset", MSQ_LAYER_ONSET},
    {"contours", MSQ_LAYER_CONTOURS}, {"channel", MSQ_LAYER_CHANNEL}};
constexpr Choice orientations[] = {{"mirror_x", MSQ_LAYER_MIRROR_X},
                                   {"mirror_y", MSQ_LAYER_MIRROR_Y},
                                   {"transpose", MSQ_LAYER_TRANSPOSE}};
constexpr Choice onset_values[] = {{"plain", MSQ_ONSET_PLAIN}, {"signed", MSQ_ONSET_SIGNED}};
constexpr Choice contour_types[] = {
    {"int32", MSQ_INT32}, {"int64", MSQ_INT64}, {"float64", MSQ_FLOAT64}};
constexpr Choice projections[] = {{"orthographic", MSQ_CAMERA_ORTHOGRAPHIC},
                                  {"perspective", MSQ_CAMERA_PERSPECTIVE}};
constexpr Choice colourings[] = {{"plain", MSQ_COLOUR_PLAIN},
                                 {"scale", MSQ_COLOUR_SCALE},
                                 {"material", MSQ_COLOUR_MATERIAL},
                                 {"normal", MSQ_COLOUR_NORMAL}};

/// Members without which a section would be empty.
void nothing(DefinitionWalk&) {}

void walk_contours(DefinitionWalk& in, msq_contours_def& def) {
  in.choice("type", def.type, contour_types);
  in.whole("axis", def.axis);
  def.has_window = in.section(
      "window", def.has_window,
      [&](DefinitionWalk& of) {
        of.numbers("min", def.window_min);
        of.numbers("max", def.window_max);
      },
      nothing);
  in.number("tolerance", def.tolerance);
  in.number("pitch", def.pitch);
  in.number("units", def.units);
  in.number("length_scale", def.length_scale);
  in.whole("topology_samples", def.topology_samples);
}

void walk_output(DefinitionWalk& in, msq_output_def& def) {
  in.choice("output", def.output, layer_outputs);
  in.whole("grey_samples", def.grey_samples);
  in.whole("grey_threshold", def.grey_threshold);
  in.number("grey_gamma", def.grey_gamma);
  in.whole("onset_scale", def.onset_scale);
  in.choice("onset_value", def.onset_value, onset_values);
  in.optional("contours", def.contours, defaults_of<msq_contours_def>(), walk_contours);
  in.text("channel", def.channel);
}

void walk_camera(DefinitionWalk& in, msq_camera& camera) {
  in.choice("projection", camera.projection, projections);
  in.numbers("eye", camera.eye);
  in.numbers("target", camera.target);
  in.numbers("up", camera.up);
  in.number("height", camera.height);
  in.number("field_of_view", camera.field_of_view);
  in.number("clip_near", camera.clip_near);
  in.number("clip_far", camera.clip_far);
}

bool is_given(const msq_window& window) {
  return window.count[0] || window.count[1] || window.count[2] || window.first[0] ||
         window.first[1] || window.first[2];
}

bool is_given(const double (&axes)[9]) {
  for (double a : axes)
    if (a != 0) return true;
  return false;
}

}  // namespace

#define MSQ_DEFAULTS(Def, init) \
  template <>                   \
  Def defaults_of() {           \
    Def def{};                  \
    init(&def, sizeof def);     \
    return def;                 \
  }
MSQ_DEFAULTS(msq_contours_def, msq_contours_def_init)
MSQ_DEFAULTS(msq_output_def, msq_output_def_init)
MSQ_DEFAULTS(msq_slicer_def, msq_slicer_def_init)
MSQ_DEFAULTS(msq_camera, msq_camera_init)
MSQ_DEFAULTS(msq_render_def, msq_render_def_init)
#undef MSQ_DEFAULTS
template <>
ViewDef defaults_of() {
  return {defaults_of<msq_camera>(), defaults_of<msq_render_def>(), 0, {}};
}

void walk(DefinitionWalk& in, msq_slicer_def& def) {
  in.choice("output", def.output, layer_outputs);
  in.numbers("pitch", def.pitch, true);
  uint64_t resolution[2] = {def.resolution[0], def.resolution[1]};
  in.wholes("resolution", resolution, UINT32_MAX);
  for (int axis = 0; axis < 2; ++axis)
    def.resolution[axis] = static_cast<uint32_t>(resolution[axis]);
  in.number("layer_height", def.layer_height);
  in.whole("layer_count", def.layer_count);
  def.has_region = in.section(
      "region", def.has_region,
      [&](DefinitionWalk& of) {
        of.numbers("min", def.region_min);
        of.numbers("max", def.region_max);
      },
      nothing);
  in.whole("slab_layers", def.slab_layers);
  in.tuples("layer_z", def.layer_z, def.layer_z_count, 1);
  in.number("length_scale", def.length_scale);
  in.section(
      "window", is_given(def.window),
      [&](DefinitionWalk& of) {
        of.wholes("first", def.window.first, UINT64_MAX);
        of.wholes("count", def.window.count, UINT64_MAX);
      },
      nothing);
  in.whole("grey_samples", def.grey_samples);
  in.whole("grey_threshold", def.grey_threshold);
  in.number("grey_gamma", def.grey_gamma);
  in.flags("orientation", def.orientation, orientations);
  in.structs("outputs", def.outputs, def.output_count, defaults_of<msq_output_def>(), walk_output);
  in.section(
      "frame",
      is_given(def.frame_axes) || def.frame_origin[0] != 0 || def.frame_origin[1] != 0 ||
          def.frame_origin[2] != 0,
      [&](DefinitionWalk& of) {
        of.numbers("origin", def.frame_origin);
        of.numbers("axes", def.frame_axes);
      },
      nothing);
}

void walk(DefinitionWalk& in, ViewDef& def) {
  msq_render_def& render = def.render;
  in.members(
      "camera", [&](DefinitionWalk& of) { walk_camera(of, def.camera); },
      [](DefinitionWalk& of) {
        auto defaults = defaults_of<msq_camera>();
        walk_camera(of, defaults);
      });
  def.has_direction = in.optional_numbers("direction", def.has_direction, def.direction);
  in.whole("width", render.width);
  in.whole("height", render.height);
  in.whole("samples", render.samples);
  in.choice("colour_by", render.colour_by, colourings);
  in.tuples("colours", render.colours, render.colour_count, 3);
  in.numbers("background", render.background);
  in.numbers("light", render.light);
  in.number("ambient", render.ambient);
  in.truth("shadows", render.shadows);
  in.whole("occlusion_rays", render.occlusion_rays);
  in.number("occlusion_distance", render.occlusion_distance);
}

}  // namespace msq::api
