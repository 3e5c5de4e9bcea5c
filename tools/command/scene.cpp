// SPDX-License-Identifier: Apache-2.0
#include "scene.h"

#include <array>
#include <cmath>

#include "text.h"
#include "watch.h"

namespace command {

namespace {

void on_warning(void*, int32_t, const char* message) {
  warn(message);
}

double unit_in_mm(const Arguments& arguments) {
  struct Unit {
    std::string_view name;
    double mm;
  };
  static constexpr Unit UNITS[] = {{"um", 0.001}, {"mm", 1},    {"cm", 10},
                                   {"m", 1000},   {"in", 25.4}, {"ft", 304.8}};
  if (!arguments.has("unit")) return 1;
  for (const Unit& unit : UNITS) {
    if (arguments.text("unit") == unit.name) return unit.mm;
  }
  if (!to_number(arguments.text("unit"))) {
    arguments.refuse("unit", "'" + arguments.text("unit") +
                                 "' is none of um, mm, cm, m, in, ft, and no number of mm");
  }
  return arguments.number("unit", 1);
}

// Rotations that bring x, -x, y, -y and -z, in the order of the table, to z.
constexpr std::array<std::array<double, 12>, 6> TURNS = {{
    {0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0},    // x: (x, y, z) becomes (y, z, x)
    {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0},   // -x: (z, y, -x)
    {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0},   // y: (x, -z, y), as modellers with y upwards mean it
    {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0},   // -y: (x, z, -y)
    {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},    // z
    {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0},  // -z: (x, -y, -z)
}};

Shape read_mesh(const Arguments& arguments, msq_context* context, const std::string& path) {
  auto def = defaults(msq_file_def_init);
  def.unit_mm = unit_in_mm(arguments);
  Shape shape;
  {
    Work work("reading " + path);
    check(msq_shape_from_file(context, path.c_str(), &def, shape.out(), work.job()));
  }
  if (!arguments.has("up") || arguments.text("up") == "z") return shape;
  Shape turned;
  check(msq_shape_placed(shape.get(), TURNS[arguments.word("up")].data(), turned.out()));
  return turned;
}

constexpr std::string_view BOX = "box:";

Shape make_box(msq_context* context, const std::string& text) {
  const std::vector<std::string_view> parts = split(std::string_view(text).substr(BOX.size()), ',');
  const double min[3] = {0, 0, 0};
  double max[3] = {0, 0, 0};
  for (size_t i = 0; i < parts.size() && i < 3; ++i) max[i] = to_number(parts[i]).value_or(0);
  if (parts.size() != 3 || !(max[0] > 0) || !(max[1] > 0) || !(max[2] > 0)) {
    throw UsageError("'" + text + "' is no box: it must be box:X,Y,Z with positive numbers");
  }
  Shape shape;
  check(msq_shape_from_box(context, min, max, shape.out()), text);
  return shape;
}

void open_document(const Arguments& arguments, Scene& scene, const std::string& path) {
  for (const Group& group : arguments.command().groups) {
    if (group.title != "Structure" && group.title != "Part") continue;
    for (const Option& option : group.options) {
      if (arguments.has(option.name) && option.name != "any-files") {
        arguments.refuse(option.name, "does not apply to a model file, which has its own");
      }
    }
  }
  auto def = defaults(msq_document_def_init);
  if (arguments.has("any-files")) def.files = MSQ_DOCUMENT_FILES_ANY;
  Work work("reading " + path);
  check(msq_document_from_file(scene.context.get(), path.c_str(), &def, scene.document.out(),
                               work.job()));
  check(msq_document_model(scene.document.get(), scene.model.out()));
  msq_document_report report = {};
  report.struct_size = sizeof report;
  check(msq_document_info(scene.document.get(), &report));
  scene.has_slicing = report.has_slicing != 0;
  scene.has_view = report.has_view != 0;
}

bool has_scale(const msq_model* model, uint32_t region, uint32_t scale) {
  return msq_model_scale(model, region, scale, nullptr, nullptr) == MSQ_OK;
}

uint32_t index_of(const Arguments& arguments, const char* option, uint64_t otherwise) {
  return static_cast<uint32_t>(arguments.count(option, otherwise, 4096));
}

}  // namespace

bool is_model_file(const std::string& path) {
  return ending(path) == ".json";
}

bool is_box(const std::string& text) {
  return text.starts_with(BOX);
}

Context make_context(const Arguments& arguments) {
  if (arguments.has("quiet")) be_quiet();
  auto def = defaults(msq_context_def_init);
  def.threads = static_cast<uint32_t>(arguments.count("threads", 0, 1024));
  def.memory_limit = arguments.bytes("memory");
  def.warning = on_warning;
  Context context;
  check(msq_context_create(&def, context.out()));
  return context;
}

Scene open_model_file(const Arguments& arguments) {
  Scene scene;
  scene.context = make_context(arguments);
  open_document(arguments, scene, arguments.operand(0));
  return scene;
}

void choose_structure(const Arguments& arguments, Scene& scene) {
  const msq_model* model = scene.model.get();
  const bool is_named = arguments.has("region") || arguments.has("scale");
  uint32_t region = 0, scale = 1;
  if (is_named) {
    region = index_of(arguments, "region", 0);
    scale = index_of(arguments, "scale", 1);
    if (scale == 0) arguments.refuse("scale", "0 is the coarse shape; structures begin at 1");
  } else {
    size_t count = 0;
    for (uint32_t r = 0; has_scale(model, r, 0); ++r) {
      for (uint32_t s = 1; has_scale(model, r, s); ++s) {
        if (count++ == 0) {
          region = r;
          scale = s;
        }
      }
    }
    if (count == 0) throw UsageError(arguments.operand(0) + " has no structure");
    if (count > 1) {
      throw UsageError(arguments.operand(0) + " has " + std::to_string(count) +
                       " structures; --scale, and --region if there are several, choose one");
    }
  }
  check(msq_model_scale(model, region, 0, scene.part.out(), nullptr), "--region");
  check(msq_model_scale(model, region, scale, nullptr, scene.structure.out()), "--scale");
}

Scene open_scene(const Arguments& arguments, const std::string* mesh_path) {
  const std::string& path = arguments.operand(0);
  if (is_model_file(path)) return open_model_file(arguments);
  Scene scene;
  scene.context = make_context(arguments);
  for (const char* option : {"any-files", "region", "scale"}) {
    const bool is_allowed = mesh_path && !is_box(path);
    if (arguments.has(option) && !is_allowed) arguments.refuse(option, "is for model files");
  }
  if (is_box(path)) {
    for (const char* option : {"unit", "up"}) {
      if (arguments.has(option)) arguments.refuse(option, "does not apply to a box");
    }
    scene.part = make_box(scene.context.get(), path);
  } else {
    scene.part = read_mesh(arguments, scene.context.get(), mesh_path ? *mesh_path : path);
  }
  msq_shape_report report = {};
  report.struct_size = sizeof report;
  check(msq_shape_info(scene.part.get(), &report));
  scene.structure =
      make_structure(arguments, scene.context.get(), report.min[2], report.max[2], false);

  msq_scale_def scales[2] = {};
  scales[0].shape = scene.part.get();
  scales[1].structure = scene.structure.get();
  scales[1].skin.value = arguments.number("skin", 0);
  auto def = defaults(msq_model_def_init);
  def.scales = scales;
  def.scale_count = scene.structure ? 2 : 1;
  def.scale_size = sizeof scales[0];
  check(msq_model_create(scene.context.get(), &def, scene.model.out()));
  return scene;
}

msq_query_def make_query(const Arguments& arguments) {
  auto query = defaults(msq_query_def_init);
  query.length_scale = arguments.number("length-scale", 0);
  return query;
}

bool has_bounds(const msq_model* model) {
  double min[3], max[3];
  check(msq_model_bounds(model, min, max));
  bool is_finite = true;
  for (size_t i = 0; i < 3; ++i) is_finite = is_finite && std::isfinite(max[i] - min[i]);
  return is_finite;
}

void take_box(const Arguments& arguments, const msq_model* model, double min[3], double max[3]) {
  if (!arguments.has("box")) {
    if (!has_bounds(model)) {
      throw UsageError(arguments.operand(0) + " fills all space; msq " +
                       std::string(arguments.command().name) +
                       " needs a region of it, --box X,Y,Z,X,Y,Z");
    }
    check(msq_model_bounds(model, min, max));
    return;
  }
  const std::vector<double> corners = arguments.numbers("box", {6});
  for (size_t i = 0; i < 3; ++i) {
    min[i] = corners[i];
    max[i] = corners[i + 3];
    if (!(min[i] < max[i])) {
      arguments.refuse("box", "the lowest corner must be below the highest one, and along " +
                                  std::string(1, "xyz"[i]) + " " + exact(min[i]) +
                                  " is not below " + exact(max[i]));
    }
  }
}

}  // namespace command
