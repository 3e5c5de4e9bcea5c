// SPDX-License-Identifier: Apache-2.0
#include "api/definitions.h"
#include "api/guard.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr uint32_t max_scales = 64;

/// Sizes of msq_scale_def: in version 0.2, which never changes, and before it had a skin.
constexpr uint32_t default_scale_size =
    offsetof(msq_scale_def, skin_material) + sizeof(msq_scale_def::skin_material);
constexpr uint32_t min_scale_size = offsetof(msq_scale_def, skin);

msq_model_def model_defaults() {
  return {};
}

/// Scale i of a host whose msq_scale_def may be of another version.
msq_scale_def read_scale(const msq_model_def& def, uint32_t i) {
  const auto* bytes =
      reinterpret_cast<const unsigned char*>(def.scales) + static_cast<size_t>(i) * def.scale_size;
  msq_scale_def scale{};
  std::memcpy(&scale, bytes, std::min<size_t>(sizeof scale, def.scale_size));
  for (size_t b = sizeof scale; b < def.scale_size; ++b)
    if (bytes[b] != 0)
      fail(Status::argument, "scale %u uses a field that this version of msq does not know", i);
  return scale;
}

/// Throws Error(argument) unless it is a length nowhere negative.
Parameter read_skin(const msq_param& skin, uint32_t scale) {
  Parameter thickness = skin.field ? Parameter(Ref<const Field>(&object(skin.field, "field")))
                                   : Parameter(require_finite(skin.value, "skin"));
  if (thickness.range().low < 0)
    fail(Status::argument, "the skin of scale %u is %g%s; it must not be negative", scale,
         thickness.range().low, skin.field ? " somewhere" : "");
  return thickness;
}

/// Another handle of an object.
template <class Handle, class Object>
Handle* shared(const Object& object) {
  object.retain();
  return reinterpret_cast<Handle*>(const_cast<Object*>(&object));
}

/// NULL: none.
Ref<const Material> read_material(const msq_material* material) {
  return material ? Ref<const Material>(&object(material, "material")) : Ref<const Material>();
}

}  // namespace

msq_status msq_model_def_init(msq_model_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, model_defaults(), "msq_model_def"); });
}

msq_status msq_model_create(msq_context* context, const msq_model_def* def, msq_model** model) {
  return guard([&] {
    Context& owner = object(context, "context");
    require(model, "model");
    msq_model_def known = read_def(def, model_defaults(), "def");
    if (known.scale_size == 0) known.scale_size = default_scale_size;
    require_reserved(known.reserved, "reserved");
    if (known.scale_count < 1 || known.scale_count > max_scales)
      fail(Status::argument, "scale_count is %u; it must be from 1 to %u", known.scale_count,
           max_scales);
    require(known.scales, "scales");
    if (known.scale_size < min_scale_size || known.scale_size > 4096 ||
        known.scale_size % alignof(msq_scale_def) != 0)
      fail(Status::argument,
           "scale_size is %u; it must be sizeof(msq_scale_def), a multiple of %zu from %u to 4096",
           known.scale_size, alignof(msq_scale_def), min_scale_size);
    Ref<const Shape> shape;
    Ref<const Material> coarse;
    std::vector<Model::ScaleParts> scales;
    std::vector<msq_scale_def> read;
    for (uint32_t i = 0; i < known.scale_count; ++i) {
      const msq_scale_def& scale = read.emplace_back(read_scale(known, i));
      if (i == 0 ? !scale.shape || scale.structure : !scale.structure || scale.shape)
        fail(Status::argument, "scale %u must have a %s and no %s", i,
             i == 0 ? "shape" : "structure", i == 0 ? "structure" : "shape");
      if (i == 0 && (scale.skin.value != 0 || scale.skin.field))
        fail(Status::argument, "scale 0 is to leave a skin; only finer ones can");
      if (i == 0 && scale.skin_material)
        fail(Status::argument, "scale 0 has a skin_material; only finer ones can");
      Ref<const Material> material = read_material(scale.material);
      if (i == 0) {
        shape = Ref<const Shape>(&object(scale.shape, "shape"));
        coarse = std::move(material);
      } else {
        scales.push_back({Ref<const Structure>(&object(scale.structure, "structure")),
                          read_skin(scale.skin, i), std::move(material),
                          read_material(scale.skin_material)});
      }
    }
    const auto made = make_ref<Model>(Ref<Context>(&owner), std::move(shape), std::move(scales),
                                      std::move(coarse));
    keep(*made, ModelDef{read.data(), known.scale_count, nullptr, 0});
    *model = new_handle<msq_model>(made);
  });
}

msq_status msq_model_regions(msq_context* context, const msq_model* const* regions, uint64_t count,
                             msq_model** model) {
  return guard([&] {
    Context& owner = object(context, "context");
    if (count < 1 || count > Model::max_regions)
      fail(Status::argument, "count is %llu; it must be from 1 to %zu",
           static_cast<unsigned long long>(count), Model::max_regions);
    require(regions, "regions");
    require(model, "model");
    std::vector<Ref<const Model>> known;
    for (uint64_t r = 0; r < count; ++r) {
      if (!regions[r])
        fail(Status::argument, "regions[%llu] is NULL", static_cast<unsigned long long>(r));
      known.emplace_back(&object(regions[r], "regions"));
      if (!known.back()->shape().is_bounded())
        fail(Status::unsupported,
             "regions[%llu] has no coarse shape; a region needs one with bounds",
             static_cast<unsigned long long>(r));
    }
    const auto made = make_ref<Model>(Ref<Context>(&owner), known);
    // As deep as the model itself is, not as its host has built it.
    std::vector<const msq_model*> flat;
    for (uint64_t r = 0; r < count; ++r) {
      const ModelDef* of_region = kept_definition<ModelDef>(*known[r]);
      if (of_region && of_region->regions)
        flat.insert(flat.end(), of_region->regions, of_region->regions + of_region->region_count);
      else
        flat.push_back(regions[r]);
    }
    keep(*made, ModelDef{nullptr, 0, flat.data(), flat.size()});
    *model = new_handle<msq_model>(made);
  });
}

void msq_model_retain(msq_model* model) {
  retain(model);
}
void msq_model_release(msq_model* model) {
  release(model);
}

msq_status msq_model_bounds(const msq_model* model, double min[3], double max[3]) {
  return guard([&] {
    const Box3& bounds = object(model, "model").bounds();
    require(min, "min");
    require(max, "max");
    for (int axis = 0; axis < 3; ++axis) {
      min[axis] = bounds.min[axis];
      max[axis] = bounds.max[axis];
    }
  });
}

msq_status msq_model_scale_length(const msq_model* model, uint32_t scale, double* length) {
  return guard([&] {
    const Model& known = object(model, "model");
    require(length, "length");
    if (scale >= known.scale_count())
      fail(Status::argument, "scale is %u; the model has %zu", scale, known.scale_count());
    *length = known.scale_length(scale);
  });
}

msq_status msq_model_scale(const msq_model* model, uint32_t region, uint32_t scale,
                           msq_shape** shape, msq_structure** structure) {
  return guard([&] {
    const Model& known = object(model, "model");
    const size_t region_count = std::max<size_t>(known.regions().size(), 1);
    if (region >= region_count)
      fail(Status::argument, "region is %u; the model has %zu", region, region_count);
    const Model& part = known.regions().empty() ? known : *known.regions()[region];
    if (scale >= part.scale_count())
      fail(Status::argument, "scale is %u; region %u has %zu", scale, region, part.scale_count());
    const Structure* fine = scale == 0 ? nullptr : part.all_scales()[scale - 1]->structure.get();
    if (shape) *shape = scale == 0 ? shared<msq_shape>(part.shape()) : nullptr;
    if (structure) *structure = fine ? shared<msq_structure>(*fine) : nullptr;
  });
}
