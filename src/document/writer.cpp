// SPDX-License-Identifier: Apache-2.0
#include "document/writer.h"

#include "api/passive_walk.h"
#include "document/member_writer.h"
#include "field/grid.h"
#include "shape/mesh.h"
#include "shape/voxels.h"

namespace msq::document {

namespace {

using namespace api;

/// Calls body(key, definition) for the definition that an object keeps, if it is one of these.
template <class Def, class Body>
bool if_kept(const Described& object, const char* key, Body& body) {
  const Def* def = kept_definition<Def>(object);
  if (def) body(key, *def);
  return def;
}

int32_t type_of(const uint8_t*) {
  return MSQ_UINT8;
}
int32_t type_of(const int16_t*) {
  return MSQ_INT16;
}
int32_t type_of(const uint16_t*) {
  return MSQ_UINT16;
}
int32_t type_of(const float*) {
  return MSQ_FLOAT32;
}
int32_t type_of(const double*) {
  return MSQ_FLOAT64;
}

/// A definition of an image with the values that the object has copied.
void give_values(const Image& image, msq_image& def) {
  image.visit([&](const auto* values) {
    def.values = values;
    def.value_type = type_of(values);
  });
}

/// Calls body(key, definition) for the definition that an object keeps. Returns whether it keeps
/// one.
template <class Body>
bool visit(const Shape& shape, Body&& body) {
  const auto mesh = [&](const char* key, msq_mesh_def def) {
    const auto& with_arrays = dynamic_cast<const Mesh&>(shape);
    def.vertices = with_arrays.vertices().data();
    def.vertex_count = with_arrays.vertices().size();
    def.triangles = with_arrays.triangles()[0].data();
    def.triangle_count = with_arrays.triangles().size();
    body(key, def);
  };
  const auto voxels = [&](const char* key, VoxelsDef def) {
    give_values(dynamic_cast<const Voxels&>(shape).image(), def.def.image);
    body(key, def);
  };
  return if_kept<FileDef>(shape, "file", body) || if_kept<msq_mesh_def>(shape, "mesh", mesh) ||
         if_kept<BoxDef>(shape, "box", body) || if_kept<SphereDef>(shape, "sphere", body) ||
         if_kept<CylinderDef>(shape, "cylinder", body) ||
         if_kept<AllSpaceDef>(shape, "all_space", body) ||
         if_kept<VoxelsDef>(shape, "voxels", voxels) || if_kept<PlacedDef>(shape, "placed", body) ||
         if_kept<BooleanDef>(shape, "boolean", body) || if_kept<OffsetDef>(shape, "offset", body);
}

template <class Body>
bool visit(const Field& field, Body&& body) {
  const auto grid = [&](const char* key, GridDef def) {
    give_values(dynamic_cast<const GridField&>(field).image(), def.def.image);
    body(key, def);
  };
  return if_kept<GradientDef>(field, "gradient", body) ||
         if_kept<msq_radial_field_def>(field, "radial", body) ||
         if_kept<MapDef>(field, "map", body) || if_kept<GridDef>(field, "grid", grid) ||
         if_kept<msq_expression_field_def>(field, "expression", body) ||
         if_kept<msq_shape_distance_field_def>(field, "shape_distance", body);
}

template <class Body>
bool visit(const Structure& structure, Body&& body) {
  return if_kept<msq_lattice_def>(structure, "lattice", body) ||
         if_kept<msq_plate_lattice_def>(structure, "plate_lattice", body) ||
         if_kept<msq_foam_def>(structure, "foam", body) ||
         if_kept<msq_functional_def>(structure, "functional", body) ||
         if_kept<msq_waves_def>(structure, "waves", body) ||
         if_kept<msq_beams_def>(structure, "beams", body) ||
         if_kept<StructureBooleanDef>(structure, "boolean", body) ||
         if_kept<StructureBlendDef>(structure, "blend", body) ||
         if_kept<StructureSmoothBooleanDef>(structure, "smooth_boolean", body);
}

template <class Body>
bool visit(const Material& material, Body&& body) {
  return if_kept<msq_material_def>(material, "plain", body) ||
         if_kept<BlendDef>(material, "blend", body);
}

template <class Body>
bool visit(const Model& model, Body&& body) {
  return if_kept<ModelDef>(model, "model", body);
}

}  // namespace

/// Counts how often each object is used in a model, as far as objects keep definitions.
class ModelWriter::Counter final : public PassiveWalk {
 public:
  explicit Counter(std::unordered_map<const Described*, Use>& uses) : uses_(uses) {}

  void object(const char*, const msq_shape*& value) override { count(value); }
  void object(const char*, const msq_field*& value) override { count(value); }
  void object(const char*, const msq_structure*& value) override { count(value); }
  void object(const char*, const msq_material*& value) override { count(value); }
  void objects(const char*, const msq_shape* const*& values, uint64_t& count) override {
    for (uint64_t i = 0; values && i < count; ++i) this->count(values[i]);
  }
  void objects(const char*, const msq_structure* const*& values, uint64_t& count) override {
    for (uint64_t i = 0; values && i < count; ++i) this->count(values[i]);
  }
  void objects(const char*, const msq_model* const*& values, uint64_t& count) override {
    for (uint64_t i = 0; values && i < count; ++i) walk_in(api::object(values[i], "a region"));
  }

  template <class Object>
  void walk_in(const Object& object) {
    visit(object, [&](const char*, const auto& def) {
      auto copy = def;
      walk(*this, copy);
    });
  }

 private:
  template <class Handle>
  void count(const Handle* handle) {
    if (!handle) return;
    const auto& known = api::object(handle, "an object");
    if (uses_[&known].count++ == 0) walk_in(known);
  }

  std::unordered_map<const Described*, Use>& uses_;
};

template <class Def>
Output ModelWriter::members_of(const Def& def) {
  return written(
      *this,
      [&](DefinitionWalk& in) {
        Def copy = def;
        walk(in, copy);
      },
      [](DefinitionWalk& in) {
        Def defaults = defaults_of<Def>();
        walk(in, defaults);
      });
}
template Output ModelWriter::members_of(const msq_slicer_def& def);
template Output ModelWriter::members_of(const ViewDef& def);

template <class Object, class Define>
Output ModelWriter::named(const Object& object, Section& section, Define&& define) {
  Use& use = uses_[&object];
  if (use.count < 2) return define();
  if (use.name.empty()) {
    Output definition = define();  // which may name others of the section first
    use.name.append(section.one)
        .append("_")
        .append(std::to_string(section.named.members.size() + 1));
    section.named.add(use.name, std::move(definition));
  }
  return Output::of_raw(json_quoted(use.name));
}

#define MSQ_WRITE(Object, section)                                               \
  Output ModelWriter::object(const Object& object) {                             \
    return named(object, section, [&] {                                          \
      Output kind;                                                               \
      const bool is_kept = visit(object, [&](const char* key, const auto& def) { \
        const Within within(*this, key);                                         \
        kind.add(key, members_of(def));                                          \
      });                                                                        \
      if (!is_kept) refuse("a " + std::string(section.one));                     \
      return kind;                                                               \
    });                                                                          \
  }
MSQ_WRITE(Shape, shapes_)
MSQ_WRITE(Field, fields_)
MSQ_WRITE(Structure, structures_)
MSQ_WRITE(Material, materials_)
#undef MSQ_WRITE

Output ModelWriter::object(const Model& model) {
  Output members;
  if (!visit(model, [&](const char*, const ModelDef& def) { members = members_of(def); }))
    refuse("a model");
  return members;
}

ModelWriter::Within::Within(ModelWriter& writer, std::string_view key)
    : writer_(writer), size_(writer.place_.size()) {
  writer.place_ = writer.place_of(key);
}

ModelWriter::Within::Within(ModelWriter& writer, uint64_t item)
    : writer_(writer), size_(writer.place_.size()) {
  writer.place_.append("[").append(std::to_string(item)).append("]");
}

std::string ModelWriter::place_of(std::string_view key) const {
  std::string place = place_;
  if (!place.empty()) place += '.';
  return place.append(key);
}

void ModelWriter::refuse(const std::string& what) const {
  fail(Status::unsupported,
       "%s: %s is computed by the host, or is too large for msq to keep its definition; it cannot "
       "be written",
       place_.empty() ? "the document" : place_.c_str(), what.c_str());
}

std::string ModelWriter::text(std::string_view key, std::string_view text) const {
  try {
    return json_quoted(text);
  } catch (const Error& error) {
    throw Error(error.status, place_of(key) + ": " + error.what());
  }
}

std::string ModelWriter::path(const char* file) const {
  std::string path(file);
  if (options_.base.empty() || !path.starts_with(options_.base)) return path;
  size_t at = options_.base.size();
  if (!options_.base.ends_with('/') && (at >= path.size() || path[at++] != '/')) return path;
  at = path.find_first_not_of('/', at);  // several are as one
  return at < path.size() ? path.substr(at) : path;
}

void ModelWriter::check_count(const char* key, uint64_t numbers) const {
  if (numbers > options_.max_numbers)
    fail(Status::limit,
         "%s would be %llu numbers in the document; max_numbers is %llu. Shapes and images that "
         "were read from files are written as the paths of these",
         place_of(key).c_str(), static_cast<unsigned long long>(numbers),
         static_cast<unsigned long long>(options_.max_numbers));
}

void ModelWriter::write(const Model& model, Output& document) {
  Counter(uses_).walk_in(model);
  Output written = object(model);
  for (Section* section : {&shapes_, &fields_, &structures_, &materials_})
    if (!section->named.members.empty()) document.add(section->name, std::move(section->named));
  for (auto& [key, value] : written.members) document.add(key, std::move(value));
}

}  // namespace msq::document
