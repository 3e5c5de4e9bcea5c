// SPDX-License-Identifier: Apache-2.0
// Copies of definitions that objects keep.
#include <cstring>
#include <vector>

#include "api/definitions.h"
#include "api/guard.h"
#include "api/passive_walk.h"

namespace msq::api {

namespace {

/// Copies what the pointers of a definition point to, and retains the handles in it.
class Keeper final : public PassiveWalk {
 public:
  void text(const char*, const char*& value) override {
    if (value) value = static_cast<const char*>(copy(value, std::strlen(value) + 1));
  }
  void file(const char* key, const char*& value) override { text(key, value); }
  void image(const char* key, msq_image& image, ImageSource& source) override {
    image.values = nullptr;  // the object itself has them
    file(key, source.file);
    if (source.file_count == 0) return;
    auto* copies = static_cast<const char**>(copy(source.files, source.file_count * sizeof(char*)));
    for (uint64_t i = 0; i < source.file_count; ++i) file(key, copies[i]);
    source.files = copies;
  }

  void object(const char*, const msq_shape*& value) override { hold(value); }
  void object(const char*, const msq_field*& value) override { hold(value); }
  void object(const char*, const msq_structure*& value) override { hold(value); }
  void object(const char*, const msq_material*& value) override { hold(value); }
  void objects(const char*, const msq_shape* const*& values, uint64_t& count) override {
    hold_all(values, count);
  }
  void objects(const char*, const msq_structure* const*& values, uint64_t& count) override {
    hold_all(values, count);
  }
  void objects(const char*, const msq_model* const*& values, uint64_t& count) override {
    hold_all(values, count);
  }

  void tuples(const char*, const double*& values, uint64_t& count, size_t width) override {
    take(values, count, width);
  }
  void tuples(const char*, const uint32_t*& values, uint64_t& count, size_t width) override {
    take(values, count, width);
  }
  void tuples(const char*, const uint8_t*& values, uint64_t& count, size_t width,
              Choices) override {
    take(values, count, width);
  }
  void named_values(const char* key, const msq_named_value*& values, uint64_t& count) override {
    if (!values || count == 0) return;
    auto* copies = static_cast<msq_named_value*>(copy(values, count * sizeof *values));
    for (uint64_t i = 0; i < count; ++i) text(key, copies[i].name);
    values = copies;
  }

 protected:
  void* room(const void* from, size_t bytes, uint64_t) override { return copy(from, bytes); }

 private:
  void* copy(const void* from, size_t bytes) {
    blocks_.push_back(std::make_unique_for_overwrite<unsigned char[]>(bytes));
    return std::memcpy(blocks_.back().get(), from, bytes);
  }
  template <class T>
  void take(const T*& values, uint64_t count, size_t width) {
    if (values) values = static_cast<const T*>(copy(values, count * width * sizeof(T)));
  }
  template <class Handle>
  void hold(const Handle* handle) {
    if (handle)
      objects_.emplace_back(static_cast<const Described*>(&msq::api::object(handle, "an object")));
  }
  template <class Handle>
  void hold_all(const Handle* const*& handles, uint64_t count) {
    if (!handles) return;
    for (uint64_t i = 0; i < count; ++i) hold(handles[i]);
    handles = static_cast<const Handle* const*>(copy(handles, count * sizeof *handles));
  }

  std::vector<std::unique_ptr<unsigned char[]>> blocks_;
  std::vector<Ref<const Described>> objects_;
};

template <class Def>
struct Kept final : Definition {
  explicit Kept(const Def& from) : def(from) { walk(keeper, def); }

  Def def;
  Keeper keeper;
};

}  // namespace

template <class Def>
void keep(Described& object, const Def& def) {
  object.define(std::make_unique<Kept<Def>>(def));
}

template <class Def>
const Def* kept_definition(const Described& object) {
  const auto* found = dynamic_cast<const Kept<Def>*>(object.definition());
  return found ? &found->def : nullptr;
}

#define MSQ_KEPT(Def)                                \
  template void keep(Described& object, const Def&); \
  template const Def* kept_definition(const Described& object);
MSQ_KEPT(FileDef)
MSQ_KEPT(msq_mesh_def)
MSQ_KEPT(BoxDef)
MSQ_KEPT(SphereDef)
MSQ_KEPT(CylinderDef)
MSQ_KEPT(AllSpaceDef)
MSQ_KEPT(VoxelsDef)
MSQ_KEPT(PlacedDef)
MSQ_KEPT(BooleanDef)
MSQ_KEPT(StructureBooleanDef)
MSQ_KEPT(StructureBlendDef)
MSQ_KEPT(StructureSmoothBooleanDef)
MSQ_KEPT(OffsetDef)
MSQ_KEPT(GradientDef)
MSQ_KEPT(msq_radial_field_def)
MSQ_KEPT(MapDef)
MSQ_KEPT(GridDef)
MSQ_KEPT(msq_expression_field_def)
MSQ_KEPT(msq_shape_distance_field_def)
MSQ_KEPT(msq_lattice_def)
MSQ_KEPT(msq_plate_lattice_def)
MSQ_KEPT(msq_foam_def)
MSQ_KEPT(msq_functional_def)
MSQ_KEPT(msq_waves_def)
MSQ_KEPT(msq_beams_def)
MSQ_KEPT(msq_material_def)
MSQ_KEPT(BlendDef)
MSQ_KEPT(ModelDef)
#undef MSQ_KEPT

}  // namespace msq::api
