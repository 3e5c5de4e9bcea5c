// SPDX-License-Identifier: Apache-2.0
#include "model/model.h"

#include "base/status.h"

namespace msq {

Model::Model(Ref<Context> context, Ref<const Shape> shape, std::vector<ScaleParts> scales,
             Ref<const Material> material)
    : context_(std::move(context)),
      shape_(std::move(shape)),
      material_(std::move(material)),
      is_concurrent_(shape_->is_concurrent()) {
  is_concurrent_ = is_concurrent_ && (!material_ || material_->is_concurrent());
  for (ScaleParts& parts : scales) {
    is_concurrent_ =
        is_concurrent_ && parts.structure->is_concurrent() && parts.skin.is_concurrent();
    for (const Ref<const Material>& m : {parts.material, parts.skin_material})
      is_concurrent_ = is_concurrent_ && (!m || m->is_concurrent());
    const Neighbourhood& grid = parts.structure->neighbourhood();
    const Box3 box = grid.to_grid(bounds());
    for (int axis = 0; axis < 3; ++axis) {
      const double cells =
          std::max(std::abs(box.min[axis]), std::abs(box.max[axis])) / grid.cell_size[axis];
      if (!(cells < max_cell_index))
        fail(Status::limit,
             "the shape reaches %g cells of scale %zu from its grid's origin along axis %d; the "
             "limit is %g",
             cells, scales_.size() + 1, axis, max_cell_index);
    }
    scales_.push_back({std::move(parts.structure), Skin(shape_, std::move(parts.skin)),
                       std::move(parts.material), std::move(parts.skin_material)});
    if (!scales_.back().skin.is_none() && !shape_->knows_depth())
      fail(Status::unsupported, "scale %zu is to leave a skin in a shape whose depth is not known",
           scales_.size());
  }
}

Scales Model::resolved(double length_scale) const {
  Scales resolved;
  for (const Scale& scale : scales_)
    if (scale.structure->characteristic_length() >= length_scale) resolved.push_back(&scale);
  return resolved;
}

bool Model::inside(Vec3 p, const Scales& resolved) const {
  if (!shape_->inside(p)) return false;
  for (const Scale* scale : resolved)
    if (!scale->inside(p)) return false;
  return true;
}

// The solid is an intersection. Outside a scale, no part of the solid is nearer than that scale's
// own: the coarsest such scale answers, as in the paper, and none but it is asked about points
// where it has nothing. Inside all, the boundary is that of one of them: the nearest is near
// enough.
double Model::distance(Vec3 p, const Scales& resolved) const {
  double distance = shape_->distance(p);
  const double depth = -distance;
  for (const Scale* scale : resolved) {
    if (distance > 0) break;
    const double of_scale = scale->distance(p, depth);
    distance = of_scale > 0 ? of_scale : std::max(distance, of_scale);
  }
  return distance;
}

const Material* Model::material(Vec3 p, const Scales& resolved, uint32_t& part) const {
  for (size_t i = resolved.size(); i-- > 0;) {
    const Scale& scale = *resolved[i];
    if (scale.skin_material && !scale.skin.is_none() && scale.skin.find(p, part))
      return scale.skin_material.get();
    if (scale.material) return scale.material.get();
  }
  return material_.get();
}

bool Model::has_material(const Scales& resolved) const {
  for (const Scale* scale : resolved)
    if (scale->material) return true;
  return static_cast<bool>(material_);
}

std::vector<const Material*> Model::materials(const Scales& resolved) const {
  std::vector<const Material*> all;
  const auto add = [&](const Ref<const Material>& material) {
    if (material) all.push_back(material.get());
  };
  add(material_);
  for (const Scale* scale : resolved) {
    add(scale->material);
    add(scale->skin_material);
  }
  return all;
}

void Model::prepare_skins(const Scales& resolved) const {
  for (const Scale* scale : resolved)
    if (!scale->skin.is_none()) return shape_->prepare_distance();
}

}  // namespace msq
