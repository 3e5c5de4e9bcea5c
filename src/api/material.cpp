// SPDX-License-Identifier: Apache-2.0
#include "model/material.h"

#include "api/definitions.h"
#include "api/points.h"
#include "query/material.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr uint64_t max_channels = 256;
constexpr size_t max_name = 255;
constexpr unsigned max_blends = 64;
constexpr uint64_t max_terms = 4096;

msq_material_def material_defaults() {
  return {};
}

uint32_t require_id(uint32_t id) {
  if (id == MSQ_MATERIAL_VOID) fail(Status::argument, "id is 0; it must be positive");
  return id;
}

std::string_view require_name(const char* name, const char* what, uint64_t index) {
  if (!name)
    fail(Status::argument, "%s %llu is NULL", what, static_cast<unsigned long long>(index));
  const size_t size = strnlen(name, max_name + 1);
  if (size < 1 || size > max_name)
    fail(Status::argument, "%s %llu has %s; it must have 1 to %zu bytes", what,
         static_cast<unsigned long long>(index), size ? "more" : "none", max_name);
  return {name, size};
}

/// Checks the channels that a query names against the materials that its points may have.
std::vector<std::string_view> read_channels(const Model& model, const Scales& resolved,
                                            const char* const* channels, uint64_t count) {
  require_material(model, resolved, "the query is for materials");
  if (count > max_channels)
    fail(Status::argument, "channel_count is %llu; it must be at most %llu",
         static_cast<unsigned long long>(count), static_cast<unsigned long long>(max_channels));
  if (count > 0) require(channels, "channels");
  std::vector<std::string_view> names;
  for (uint64_t c = 0; c < count; ++c) {
    names.push_back(require_name(channels[c], "the name of channel", c));
    bool is_known = false;
    for (const Material* material : model.materials(resolved))
      is_known = is_known || material->find(names.back());
    if (!is_known)
      fail(Status::argument, "no material of the model has a channel called %s", channels[c]);
  }
  return names;
}

}  // namespace

msq_status msq_material_def_init(msq_material_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, material_defaults(), "msq_material_def"); });
}

msq_status msq_material_create(msq_context* context, const msq_material_def* def,
                               msq_material** material) {
  return guard([&] {
    object(context, "context");
    const msq_material_def known = read_def(def, material_defaults(), "def");
    require(material, "material");
    require_id(known.id);
    if (known.channel_count > max_channels)
      fail(Status::argument, "channel_count is %llu; it must be at most %llu",
           static_cast<unsigned long long>(known.channel_count),
           static_cast<unsigned long long>(max_channels));
    if (known.channel_count > 0) require(known.channels, "channels");
    std::vector<std::string> names;
    std::vector<Parameter> parameters;
    for (uint64_t c = 0; c < known.channel_count; ++c) {
      const msq_channel& channel = known.channels[c];
      const std::string name(require_name(channel.name, "the name of channel", c));
      if (std::find(names.begin(), names.end(), name) != names.end())
        fail(Status::argument, "two channels are called %s", name.c_str());
      names.push_back(name);
      parameters.push_back(channel.value.field
                               ? Parameter(Ref<const Field>(&object(channel.value.field, "field")))
                               : Parameter(require_finite(channel.value.value, name.c_str())));
    }
    const Ref<Material> made =
        make_ref<PlainMaterial>(known.id, std::move(names), std::move(parameters));
    keep(*made, known);
    *material = new_handle<msq_material>(made);
  });
}

msq_status msq_material_blend(msq_context* context, uint32_t id, const msq_material* a,
                              const msq_material* b, const msq_param* fraction,
                              msq_material** material) {
  return guard([&] {
    object(context, "context");
    require_id(id);
    const Ref<const Material> first(&object(a, "a")), second(&object(b, "b"));
    require(fraction, "fraction");
    require(material, "material");
    const Parameter part = fraction->field
                               ? Parameter(Ref<const Field>(&object(fraction->field, "field")))
                               : Parameter(require_finite(fraction->value, "fraction"));
    const Interval range = part.range();
    if (!(range.low >= 0 && range.high <= 1))
      fail(Status::argument, "the fraction is from %g to %g; it must be within 0 and 1", range.low,
           range.high);
    for (const auto& [one, other] :
         {std::pair(first.get(), second.get()), std::pair(second.get(), first.get())})
      for (const std::string& channel : one->channels())
        if (!other->find(channel))
          fail(Status::argument, "only one of the materials has a channel called %s",
               channel.c_str());
    if (std::max(first->depth(), second->depth()) >= max_blends)
      fail(Status::limit, "%u blends would be within each other; the limit is %u",
           std::max(first->depth(), second->depth()) + 1, max_blends);
    if (const uint64_t terms = first->terms() + second->terms(); terms > max_terms)
      fail(
          Status::limit,
          "each value would be made of those of %llu materials, the same counted as often as it is "
          "asked; the limit is %llu",
          static_cast<unsigned long long>(terms), static_cast<unsigned long long>(max_terms));
    const Ref<Material> made = make_ref<MaterialBlend>(id, first, second, part);
    keep(*made, BlendDef{id, a, b, *fraction});
    *material = new_handle<msq_material>(made);
  });
}

void msq_material_retain(msq_material* material) {
  retain(material);
}
void msq_material_release(msq_material* material) {
  release(material);
}

msq_status msq_point_material(const msq_model* model, const double point[3],
                              const msq_query_def* query, const char* const* channels,
                              uint64_t channel_count, uint32_t* id, double* values) {
  return guard([&] {
    const Model& known = object(model, "model");
    const Ref<const Model> keep(&known);
    const Vec3 p = require_vector(point, "point");
    const Scales resolved = known.resolved(read_query(query).length_scale);
    const auto names = read_channels(known, resolved, channels, channel_count);
    require(id, "id");
    if (!names.empty()) require(values, "values");
    require_point(known, resolved, p);
    std::vector<double> found(names.size());
    uint32_t part = 0;
    const Material* material =
        known.inside(p, resolved) ? known.material(p, resolved, part) : nullptr;
    for (size_t c = 0; material && c < names.size(); ++c)
      if (const auto channel = material->find(names[c]))
        material->values(*channel, &p, 1, &found[c]);
    *id = material ? material->id() : static_cast<uint32_t>(MSQ_MATERIAL_VOID);
    std::copy(found.begin(), found.end(), values);
  });
}

msq_status msq_set_material(const msq_model* model, const msq_points_def* points,
                            const msq_query_def* query, const char* const* channels,
                            uint64_t channel_count, uint32_t* ids, uint64_t id_count,
                            double* values, uint64_t value_count, msq_job* job) {
  return guard([&] {
    const Model& known = object(model, "model");
    const auto names = read_channels(known, known.resolved(read_query(query).length_scale),
                                     channels, channel_count);
    if (value_count != checked_product(id_count, channel_count, "values"))
      fail(Status::argument, "value_count is %llu; id_count times channel_count is %llu",
           static_cast<unsigned long long>(value_count),
           static_cast<unsigned long long>(id_count * channel_count));
    if (value_count > 0) {
      require(values, "values");
      require_apart(points, values, value_count * sizeof *values, "values");
    }
    ask_set(model, points, query, ids, "ids", id_count, "id_count", job,
            [&](const Model& of, const Scales& resolved, const PointSet& set, const QueryPlan& plan,
                uint32_t* out,
                Job* work) { set_material(of, resolved, set, plan, names, out, values, work); });
  });
}
