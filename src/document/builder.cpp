// SPDX-License-Identifier: Apache-2.0
#include "document/builder.h"

#include <cstdlib>
#include <filesystem>

#include "api/definitions.h"
#include "document/reader.h"

namespace msq::document {

namespace {

using namespace api;
using ValueKind = JsonValue::Kind;

/// Definitions within each other: the engine's own limit is 64 for shapes, curves and blends.
constexpr unsigned max_nesting = 64;

msq_status create(Builder& builder, FileDef& def, msq_shape** shape) {
  def.how.max_bytes = builder.bytes_left();
  def.how.max_triangles = builder.max_triangles();
  if (def.how.max_bytes == 0) fail(Status::limit, "the files have more bytes than max_file_bytes");
  const msq_status status =
      msq_shape_from_file(builder.context(), def.file, &def.how, shape, builder.job());
  std::error_code error;
  const auto bytes = std::filesystem::file_size(def.file, error);
  if (!error) builder.count_bytes(bytes);
  return status;
}
msq_status create(Builder& builder, msq_mesh_def& def, msq_shape** shape) {
  return msq_shape_from_mesh(builder.context(), &def, shape);
}
msq_status create(Builder& builder, BoxDef& def, msq_shape** shape) {
  return msq_shape_from_box(builder.context(), def.min, def.max, shape);
}
msq_status create(Builder& builder, SphereDef& def, msq_shape** shape) {
  return msq_shape_from_sphere(builder.context(), def.center, def.radius, shape);
}
msq_status create(Builder& builder, CylinderDef& def, msq_shape** shape) {
  return msq_shape_from_cylinder(builder.context(), def.from, def.to, def.radius, shape);
}
msq_status create(Builder& builder, AllSpaceDef&, msq_shape** shape) {
  return msq_shape_all_space(builder.context(), shape);
}
msq_status create(Builder& builder, VoxelsDef& def, msq_shape** shape) {
  const msq_status status = msq_shape_from_voxels(builder.context(), &def.def, shape);
  if (status == MSQ_OK) keep(api::object(*shape, "shape"), def);  // with the name of the file
  return status;
}
msq_status create(Builder&, PlacedDef& def, msq_shape** shape) {
  return msq_shape_placed(def.original, def.matrix, shape);
}
msq_status create(Builder&, BooleanDef& def, msq_shape** shape) {
  return msq_shape_boolean(def.operation, def.shapes, def.count, shape);
}
msq_status create(Builder&, OffsetDef& def, msq_shape** shape) {
  return msq_shape_offset(def.original, def.distance, shape);
}

msq_status create(Builder& builder, GradientDef& def, msq_field** field) {
  return msq_field_gradient(builder.context(), def.from, def.from_value, def.to, def.to_value,
                            field);
}
msq_status create(Builder& builder, msq_radial_field_def& def, msq_field** field) {
  return msq_field_radial(builder.context(), &def, field);
}
msq_status create(Builder& builder, MapDef& def, msq_field** field) {
  return msq_field_map(builder.context(), def.argument, def.curve, def.curve_count, field);
}
msq_status create(Builder& builder, GridDef& def, msq_field** field) {
  const msq_status status = msq_field_grid(builder.context(), &def.def, field);
  if (status == MSQ_OK) keep(api::object(*field, "field"), def);
  return status;
}
msq_status create(Builder& builder, msq_expression_field_def& def, msq_field** field) {
  return msq_field_expression(builder.context(), &def, field);
}
msq_status create(Builder& builder, msq_shape_distance_field_def& def, msq_field** field) {
  return msq_field_shape_distance(builder.context(), &def, field, builder.job());
}

msq_status create(Builder& builder, msq_lattice_def& def, msq_structure** structure) {
  return msq_structure_lattice(builder.context(), &def, structure);
}
msq_status create(Builder& builder, msq_plate_lattice_def& def, msq_structure** structure) {
  return msq_structure_plate_lattice(builder.context(), &def, structure);
}
msq_status create(Builder& builder, msq_foam_def& def, msq_structure** structure) {
  return msq_structure_foam(builder.context(), &def, structure);
}
msq_status create(Builder& builder, msq_functional_def& def, msq_structure** structure) {
  return msq_structure_functional(builder.context(), &def, structure);
}
msq_status create(Builder& builder, msq_waves_def& def, msq_structure** structure) {
  return msq_structure_waves(builder.context(), &def, structure);
}
msq_status create(Builder& builder, msq_beams_def& def, msq_structure** structure) {
  return msq_structure_beams(builder.context(), &def, structure, builder.job());
}

msq_status create(Builder&, StructureBooleanDef& def, msq_structure** structure) {
  return msq_structure_boolean(def.operation, def.structures, def.count, structure);
}

msq_status create(Builder&, StructureBlendDef& def, msq_structure** structure) {
  return msq_structure_blend(def.a, def.b, &def.fraction, structure);
}

msq_status create(Builder&, StructureSmoothBooleanDef& def, msq_structure** structure) {
  return msq_structure_smooth_boolean(def.operation, def.a, def.b, &def.radius, structure);
}

msq_status create(Builder& builder, msq_material_def& def, msq_material** material) {
  return msq_material_create(builder.context(), &def, material);
}
msq_status create(Builder& builder, BlendDef& def, msq_material** material) {
  return msq_material_blend(builder.context(), def.id, def.a, def.b, &def.fraction, material);
}

msq_status create(Builder& builder, ModelDef& def, msq_model** model) {
  if (def.regions)
    return msq_model_regions(builder.context(), def.regions, def.region_count, model);
  msq_model_def scales;
  const msq_status status = msq_model_def_init(&scales, sizeof scales);
  if (status != MSQ_OK) return status;
  scales.scales = def.scales;
  scales.scale_count = def.scale_count;
  scales.scale_size = sizeof(msq_scale_def);
  return msq_model_create(builder.context(), &scales, model);
}

void release(msq_shape* handle) {
  msq_shape_release(handle);
}
void release(msq_field* handle) {
  msq_field_release(handle);
}
void release(msq_structure* handle) {
  msq_structure_release(handle);
}
void release(msq_material* handle) {
  msq_material_release(handle);
}
void release(msq_model* handle) {
  msq_model_release(handle);
}

}  // namespace

template <class Handle>
struct KindOf {
  const char* name;
  Handle* (*make)(Builder&, uint32_t);
};

namespace {

/// Makes an object of the definition that a value holds.
template <class Handle, class Def>
Handle* make_of(Builder& builder, uint32_t value) {
  Arena arena;
  Reader reader(builder, value, arena);
  Def def = defaults_of<Def>();
  walk(reader, def);
  reader.finish();
  check_cancelled(builder.job() ? &object(builder.job(), "job") : nullptr);
  Handle* handle = nullptr;
  try {
    const msq_status status = create(builder, def, &handle);
    if (status != MSQ_OK) builder.refuse_call(value, status);
  } catch (...) {
    release(handle);
    throw;
  }
  return handle;
}

// Keys are the tails of the names of the functions in msq.h.
constexpr KindOf<msq_shape> shape_kinds[] = {
    {"file", make_of<msq_shape, FileDef>},         {"mesh", make_of<msq_shape, msq_mesh_def>},
    {"box", make_of<msq_shape, BoxDef>},           {"sphere", make_of<msq_shape, SphereDef>},
    {"cylinder", make_of<msq_shape, CylinderDef>}, {"all_space", make_of<msq_shape, AllSpaceDef>},
    {"voxels", make_of<msq_shape, VoxelsDef>},     {"placed", make_of<msq_shape, PlacedDef>},
    {"boolean", make_of<msq_shape, BooleanDef>},   {"offset", make_of<msq_shape, OffsetDef>}};
constexpr KindOf<msq_field> field_kinds[] = {
    {"gradient", make_of<msq_field, GradientDef>},
    {"radial", make_of<msq_field, msq_radial_field_def>},
    {"map", make_of<msq_field, MapDef>},
    {"grid", make_of<msq_field, GridDef>},
    {"expression", make_of<msq_field, msq_expression_field_def>},
    {"shape_distance", make_of<msq_field, msq_shape_distance_field_def>}};
constexpr KindOf<msq_structure> structure_kinds[] = {
    {"lattice", make_of<msq_structure, msq_lattice_def>},
    {"plate_lattice", make_of<msq_structure, msq_plate_lattice_def>},
    {"foam", make_of<msq_structure, msq_foam_def>},
    {"functional", make_of<msq_structure, msq_functional_def>},
    {"waves", make_of<msq_structure, msq_waves_def>},
    {"beams", make_of<msq_structure, msq_beams_def>},
    {"boolean", make_of<msq_structure, StructureBooleanDef>},
    {"blend", make_of<msq_structure, StructureBlendDef>},
    {"smooth_boolean", make_of<msq_structure, StructureSmoothBooleanDef>}};
constexpr KindOf<msq_material> material_kinds[] = {
    {"plain", make_of<msq_material, msq_material_def>}, {"blend", make_of<msq_material, BlendDef>}};

/// The value that the message of a failed call begins with: a member of the object, and members and
/// elements of that, as in "grid.cell_size[1] is 0". The object itself if there is none.
uint32_t value_of_message(const JsonTree& tree, uint32_t object, std::string_view message) {
  uint32_t found = object;
  unsigned long long pair = 0;
  int length = 0;
  if (std::sscanf(std::string(message.substr(0, 80)).c_str(), "pair %llu of %n", &pair, &length) ==
          1 &&
      length > 0) {
    const std::string_view rest = message.substr(static_cast<size_t>(length));
    const uint32_t list = tree.member(object, rest.substr(0, rest.find(' ')));
    const uint32_t element = list ? tree.element(list, pair) : 0;
    return element ? element : object;
  }
  while (true) {
    const size_t end = message.find_first_of(" .[],;:");
    const std::string_view part = message.substr(0, end);
    const uint32_t member = part.empty() ? 0 : tree.member(found, part);
    if (!member) return found;
    found = member;
    message.remove_prefix(part.size());
    if (message.starts_with('[')) {
      const uint64_t index = std::strtoull(std::string(message.substr(1, 20)).c_str(), nullptr, 10);
      if (const uint32_t element = tree.element(found, index)) found = element;
      return found;
    }
    if (!message.starts_with('.')) return found;
    message.remove_prefix(1);
  }
}

}  // namespace

template <class Handle>
const Handle* Builder::hold(Handle* handle) {
  try {
    held_.emplace_back(handle, [](void* of) { release(static_cast<Handle*>(of)); });
  } catch (...) {
    release(handle);
    throw;
  }
  return handle;
}

Builder::~Builder() {
  for (const auto& [handle, free] : held_) free(handle);
}

void Builder::refuse(uint32_t value, Status status, const std::string& why) const {
  const std::string path = tree_.path(value);
  throw Error(status,
              tree_.place(value) + ": " + (path.empty() ? "the document" : path) + ": " + why);
}

void Builder::refuse_call(uint32_t object, msq_status status) const {
  const std::string message = msq_error_message();
  if (status == MSQ_E_CANCELLED) throw Error(Status::cancelled, message);
  const uint32_t value = value_of_message(tree_, object, message);
  const std::string path = tree_.path(value);
  throw Error(static_cast<Status>(status),
              tree_.place(value) + ": " + (path.empty() ? "the document" : path) + ": " + message);
}

template <class Handle>
const Handle* Builder::make(uint32_t value, std::span<const KindOf<Handle>> kinds) {
  std::string names;
  for (const auto& kind : kinds) names.append(names.empty() ? "" : ", ").append(kind.name);
  const JsonValue& found = tree_[value];
  if (found.kind != ValueKind::object || found.count != 1)
    refuse(value, Status::argument,
           "must be the name of a definition or an object with one key of " + names);
  if (depth_ >= max_nesting)
    refuse(value, Status::limit,
           "is within " + std::to_string(depth_) + " other definitions; the limit is " +
               std::to_string(max_nesting));
  for (const auto& kind : kinds)
    if (tree_.key(found.first) == kind.name) {
      ++depth_;
      const Handle* handle = hold(kind.make(*this, found.first));
      --depth_;
      return handle;
    }
  refuse(found.first, Status::argument, "is an unknown kind; it must be one of " + names);
}

uint32_t Builder::definition(const char* section, const std::string& name) {
  const auto [names, is_new] = names_.try_emplace(section);
  const uint32_t definitions = is_new ? tree_.member(0, section) : 0;
  if (definitions && tree_[definitions].kind == ValueKind::object && tree_[definitions].count > 0)
    for (uint32_t value = tree_[definitions].first; value; value = tree_[value].next)
      names->second.emplace(tree_.key(value), value);
  const auto found = names->second.find(name);
  return found == names->second.end() ? 0 : found->second;
}

template <class Handle>
const Handle* Builder::handle(uint32_t value, const char* section,
                              std::span<const KindOf<Handle>> kinds) {
  if (tree_[value].kind != ValueKind::text) return make(value, kinds);
  const std::string& name = tree_.text(tree_[value].text);
  const uint32_t definition = this->definition(section, name);
  if (!definition)
    refuse(value, Status::argument,
           "is " + json_quoted(name.substr(0, 100)) + ", which is not in " + section);
  if (const auto known = named_.find(definition); known != named_.end()) {
    if (!known->second) refuse(value, Status::argument, "makes a definition contain itself");
    return static_cast<const Handle*>(known->second);
  }
  named_.emplace(definition, nullptr);
  const Handle* made = make(definition, kinds);
  named_[definition] = made;
  return made;
}

const msq_shape* Builder::shape(uint32_t value) {
  return handle<msq_shape>(value, "shapes", shape_kinds);
}
const msq_field* Builder::field(uint32_t value) {
  return handle<msq_field>(value, "fields", field_kinds);
}
const msq_structure* Builder::structure(uint32_t value) {
  return handle<msq_structure>(value, "structures", structure_kinds);
}
const msq_material* Builder::material(uint32_t value) {
  return handle<msq_material>(value, "materials", material_kinds);
}

const msq_model* Builder::model(uint32_t value, const std::vector<std::string>& others) {
  if (depth_ >= max_nesting)
    refuse(value, Status::limit,
           "is within " + std::to_string(depth_) + " other definitions; the limit is " +
               std::to_string(max_nesting));
  ++depth_;
  Arena arena;
  Reader reader(*this, value, arena);
  const bool has_scales = tree_.member(value, "scales"),
             has_regions = tree_.member(value, "regions");
  ModelDef def{};
  walk(reader, def);
  for (const std::string& key : others) reader.allow(key);
  reader.finish();
  if (has_scales == has_regions)
    refuse(value, Status::argument,
           has_scales ? "has both scales and regions; it must have one of them"
                      : "has neither scales nor regions");
  msq_model* made = nullptr;
  if (const msq_status status = create(*this, def, &made); status != MSQ_OK)
    refuse_call(value, status);
  --depth_;
  return hold(made);
}

void Builder::build_named() {
  const auto all = [&](const char* section, auto&& build) {
    const uint32_t definitions = tree_.member(0, section);
    if (!definitions) return;
    if (tree_[definitions].kind != ValueKind::object)
      refuse(definitions, Status::argument, "must be an object");
    if (tree_[definitions].count == 0) return;
    for (uint32_t value = tree_[definitions].first; value; value = tree_[value].next)
      if (!named_.contains(value)) {
        if (tree_[value].kind != ValueKind::object)
          refuse(value, Status::argument, "must be an object");
        named_.emplace(value, nullptr);
        named_[value] = build(value);
      }
  };
  all("shapes", [&](uint32_t value) { return shape(value); });
  all("fields", [&](uint32_t value) { return field(value); });
  all("structures", [&](uint32_t value) { return structure(value); });
  all("materials", [&](uint32_t value) { return material(value); });
}

std::string Builder::path_of_file(uint32_t value) {
  if (tree_[value].kind != ValueKind::text)
    refuse(value, Status::argument, "must be a text, the path of a file");
  const std::string& path = tree_.text(tree_[value].text);
  const std::string shown = json_quoted(path.substr(0, 200));
  if (path.empty()) refuse(value, Status::argument, "is an empty path");
  if (rules_.allowed == MSQ_DOCUMENT_FILES_NONE)
    refuse(value, Status::argument, "is " + shown + "; this document may name no files");
  bool is_absolute = path[0] == '/';
#ifdef _WIN32
  is_absolute = is_absolute || path[0] == '\\' || path.find(':') != std::string::npos;
#endif
  if (rules_.allowed == MSQ_DOCUMENT_FILES_BELOW) {
    // The same on all systems: no way out of the directory by the letters of another system.
    if (is_absolute || path.find_first_of("\\:") != std::string::npos)
      refuse(value, Status::argument,
             "is " + shown + "; it must be relative, with / between its parts");
    for (size_t at = 0; at <= path.size();) {
      const size_t end = std::min(path.find('/', at), path.size());
      if (path.substr(at, end - at) == "..")
        refuse(value, Status::argument, "is " + shown + "; it must not have \"..\"");
      at = end + 1;
    }
    if (!rules_.has_base)
      refuse(value, Status::argument,
             "is " + shown + ", but there is no base_directory that it is relative to");
  }
  if (files_ >= rules_.max_files)
    refuse(value, Status::limit,
           "is one file too many; max_files is " + std::to_string(rules_.max_files));
  ++files_;
  if (is_absolute || !rules_.has_base || rules_.base.empty()) return path;
  return rules_.base.ends_with('/') ? rules_.base + path : rules_.base + "/" + path;
}

}  // namespace msq::document
