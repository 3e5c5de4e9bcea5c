// SPDX-License-Identifier: Apache-2.0
#include "document/document.h"

#include "document/reader.h"

namespace msq::document {

using namespace api;

Document::Document(std::string_view text, msq_context* context, const FileRules& rules,
                   const JsonLimits& limits, msq_job* job)
    : slicing_(defaults_of<msq_slicer_def>()), view_(defaults_of<ViewDef>()) {
  const JsonTree tree(text, limits, job ? &object(job, "job") : nullptr);
  Builder builder(tree, context, rules, job);
  constexpr uint32_t root = 0;
  Reader reader(builder, root, arena_);
  // The version first: a later one may have anything else.
  const uint32_t version = tree.member(root, "msq_model");
  if (!version)
    builder.refuse(root, Status::argument,
                   "has no key msq_model with the version of the format, 1");
  if (whole_number(tree[version]) != document_version)
    builder.refuse(version, Status::unsupported,
                   given(tree[version]) + "; this msq reads version 1");
  const char *title = "", *ignored = nullptr;
  reader.text("title", title);
  reader.text("$schema", ignored);
  title_ = title;
  builder.build_named();
  const msq_model* model = builder.model(root, {"msq_model", "$schema", "title", "shapes", "fields",
                                                "structures", "materials", "slicing", "view"});
  model_ = Ref<const Model>(&object(model, "model"));
  has_slicing_ = reader.section(
      "slicing", false, [&](DefinitionWalk& in) { walk(in, slicing_); }, [](DefinitionWalk&) {});
  if (const uint32_t view = tree.member(root, "view")) {
    has_view_ = reader.section(
        "view", false, [&](DefinitionWalk& in) { walk(in, view_); }, [](DefinitionWalk&) {});
    read_view(builder, view, model);
  }
  files_ = builder.files();
}

void Document::read_view(Builder& builder, uint32_t value, const msq_model* model) {
  const JsonTree& tree = builder.tree();
  const uint32_t camera = tree.member(value, "camera");
  const msq_render_def& render = view_.render;
  if (view_.has_direction) {
    for (const char* key : {"eye", "target", "height"})
      if (const uint32_t fixed = camera ? tree.member(camera, key) : 0)
        builder.refuse(fixed, Status::argument, "is given, but direction fits it to the model");
    const bool has_up = camera && tree.member(camera, "up");
    const msq_status status =
        msq_camera_fit(model, view_.direction, has_up ? view_.camera.up : nullptr, render.width,
                       render.height, &view_.camera);
    if (status != MSQ_OK) builder.refuse_call(value, status);
    return;
  }
  if (!camera) builder.refuse(value, Status::argument, "has neither camera nor direction");
  // Checks the camera: the ray itself is not needed.
  const double middle[2] = {0, 0};
  double origin[3], direction[3];
  const msq_status status =
      msq_camera_ray(&view_.camera, render.width, render.height, middle, origin, direction);
  if (status != MSQ_OK) builder.refuse_call(camera, status);
}

}  // namespace msq::document
