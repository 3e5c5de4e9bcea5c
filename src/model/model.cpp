// SPDX-License-Identifier: Apache-2.0
#include "model/model.h"

#include "base/signed_distance.h"
#include "base/status.h"
#include "shape/boolean.h"

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
    parts.structure->for_each_grid([&](const Neighbourhood& grid) {
      if (!shape_->is_bounded()) return;
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
    });
    scales_.push_back({std::move(parts.structure), Skin(shape_, std::move(parts.skin)),
                       std::move(parts.material), std::move(parts.skin_material)});
    if (!scales_.back().skin.is_none() && !shape_->is_bounded())
      fail(Status::unsupported, "scale %zu is to leave a skin; all space has no surface",
           scales_.size());
    if (!scales_.back().skin.is_none() && !shape_->knows_depth())
      fail(Status::unsupported, "scale %zu is to leave a skin in a shape whose depth is not known",
           scales_.size());
  }
  all_scales_ = resolved(0);
}

namespace {

std::vector<Ref<const Model>> flattened(const std::vector<Ref<const Model>>& regions) {
  std::vector<Ref<const Model>> flat;
  for (const Ref<const Model>& region : regions)
    if (region->regions().empty())
      flat.push_back(region);
    else
      flat.insert(flat.end(), region->regions().begin(), region->regions().end());
  if (flat.size() > Model::max_regions)
    fail(Status::limit, "%zu regions; the limit is %zu", flat.size(), Model::max_regions);
  return flat;
}

Ref<const Shape> union_of(const std::vector<Ref<const Model>>& regions) {
  std::vector<Ref<const Shape>> shapes;
  shapes.reserve(regions.size());
  for (const Ref<const Model>& region : regions) shapes.emplace_back(&region->shape());
  return make_ref<BooleanShape>(BooleanShape::Operation::united, std::move(shapes));
}

}  // namespace

Model::Model(Ref<Context> context, const std::vector<Ref<const Model>>& regions)
    : context_(std::move(context)),
      regions_(flattened(regions)),
      shape_(union_of(regions_)),
      is_concurrent_(true) {
  for (const Ref<const Model>& region : regions_)
    is_concurrent_ = is_concurrent_ && region->is_concurrent_;
  all_scales_ = resolved(0);
}

size_t Model::region_at(Vec3 p) const {
  if (regions_.empty()) return shape_->inside(p) ? 0 : no_region;
  for (size_t r = 0; r < regions_.size(); ++r)
    if (regions_[r]->shape_->inside(p)) return r;
  return no_region;
}

size_t Model::scale_count() const {
  size_t most = 1 + scales_.size();
  for (const Ref<const Model>& region : regions_) most = std::max(most, region->scale_count());
  return most;
}

double Model::scale_length(size_t scale) const {
  if (scale == 0) return std::numeric_limits<double>::infinity();
  if (regions_.empty()) return scales_[scale - 1].structure->characteristic_length();
  double largest = 0;
  for (const Ref<const Model>& region : regions_)
    if (scale < region->scale_count()) largest = std::max(largest, region->scale_length(scale));
  return largest;
}

Scales Model::resolved(double length_scale) const {
  Scales resolved;
  for (const Ref<const Model>& region : regions_) {
    resolved.regions.push_back(region->resolved(length_scale));
    const Scales& own = resolved.regions.back();
    resolved.insert(resolved.end(), own.begin(), own.end());
  }
  for (const Scale& scale : scales_)
    if (scale.structure->characteristic_length() >= length_scale) resolved.push_back(&scale);
  return resolved;
}

bool Model::scales_hold(Vec3 p, const Scales& resolved) const {
  for (const Scale* scale : resolved)
    if (!scale->inside(p)) return false;
  return true;
}

bool Model::inside(Vec3 p, const Scales& resolved) const {
  if (regions_.empty()) return shape_->inside(p) && scales_hold(p, resolved);
  const size_t region = region_at(p);
  return region != no_region && regions_[region]->scales_hold(p, resolved.regions[region]);
}

// The solid is an intersection. Outside a scale, no part of the solid is nearer than that scale's
// own: the coarsest such scale answers, as in the paper, and none but it is queried about points
// where it has nothing. Inside all, the boundary is that of one of them: the nearest is near
// enough.
double Model::distance(Vec3 p, const Scales& resolved) const {
  if (!regions_.empty()) return distance_of_regions(p, resolved);
  double distance = shape_->distance(p);
  const double of_shape = distance;
  for (const Scale* scale : resolved) {
    if (distance > 0) break;
    const double depth = scale->skin.is_none() ? 0 : shape_->depth(p, of_shape);
    const double of_scale = scale->distance(p, depth);
    distance = of_scale > 0 ? of_scale : std::max(distance, of_scale);
  }
  return distance;
}

// Where the point belongs to region k. Up to where a region before k begins it is k's own solid
// that decides. In the void of k, the solid of a later region is no nearer than k's boundary and
// than that region is. In no region, the nearest region's solid is near enough.
double Model::distance_of_regions(Vec3 p, const Scales& resolved) const {
  // How far the box of a region is at least.
  const auto gap_of = [&](const Model& region) {
    const Box3& box = region.bounds();
    const Vec3 gap = max(max(box.min - p, p - box.max), Vec3{});
    return std::hypot(gap.x, gap.y, gap.z) * (1 - 0x1p-50);
  };
  const size_t owner = region_at(p);
  double bound = std::numeric_limits<double>::max();
  bool is_inside = false;
  if (owner != no_region) {
    const double own = regions_[owner]->distance(p, resolved.regions[owner]);
    is_inside = own <= 0;
    bound = std::abs(own);
  }
  for (size_t r = 0; r < std::min(owner, regions_.size()); ++r)
    if (gap_of(*regions_[r]) < bound) bound = std::min(bound, regions_[r]->shape_->distance(p));
  if (owner != no_region && !is_inside) {
    double depth = -1;  // in the owner's shape; not requested yet
    for (size_t r = owner + 1; r < regions_.size(); ++r) {
      if (!(gap_of(*regions_[r]) < bound)) continue;
      if (depth < 0) depth = -regions_[owner]->shape_->distance(p);
      if (!(depth < bound)) break;
      bound = std::min(bound, std::max(depth, regions_[r]->shape_->distance(p)));
    }
  }
  return signed_distance(is_inside, bound);
}

const Material* Model::material(Vec3 p, const Scales& resolved, uint32_t& part) const {
  if (!regions_.empty()) {
    const size_t region = region_at(p);
    uint32_t own_part = 0;  // parts are of one shape
    return region == no_region ? nullptr
                               : regions_[region]->material(p, resolved.regions[region], own_part);
  }
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
  for (const Ref<const Model>& region : regions_) add(region->material_);
  add(material_);
  for (const Scale* scale : resolved) {
    add(scale->material);
    add(scale->skin_material);
  }
  return all;
}

void Model::prepare_skins(const Scales& resolved, const Job* job) const {
  for (size_t r = 0; r < regions_.size(); ++r) regions_[r]->prepare_skins(resolved.regions[r], job);
  if (!regions_.empty()) return;
  for (const Scale* scale : resolved)
    if (!scale->skin.is_none()) return shape_->prepare_distance(job);
}

void Model::prepare_rows(const Job* job) const {
  for (const Ref<const Model>& region : regions_) region->prepare_rows(job);
  if (regions_.empty()) shape_->prepare_rows(job);
}

void Model::describe(HashInput& input) const {
  if (!regions_.empty()) {
    input.kind("model of regions");
    input.integer(regions_.size());
    for (const Ref<const Model>& region : regions_) input.object(*region);
    return;
  }
  input.kind("model");
  input.object(*shape_);
  input.optional(material_.get());
  input.integer(scales_.size());
  for (const Scale& scale : scales_) {
    input.object(*scale.structure);
    scale.skin.thickness().describe(input);
    input.optional(scale.material.get());
    input.optional(scale.skin_material.get());
  }
}

}  // namespace msq
