// SPDX-License-Identifier: Apache-2.0
// A coarse shape and the structures that fill it, scale by scale; the solid is the shape cut with
// each structure, save for the skin that a scale may leave. Or several such models, the regions: a
// point belongs to the first whose shape holds it, and is inside where that region is.
// Source: paper, section "Multiscale Shape-Material Modeling API".
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "cell/context.h"
#include "model/scale.h"
#include "shape/shape.h"

#include "base/described.h"

namespace msq {

class Model final : public Described {
 public:
  /// What a scale but the coarsest is made of.
  struct ScaleParts {
    ScaleParts(Ref<const Structure> structure, Parameter skin = {},
               Ref<const Material> material = {}, Ref<const Material> skin_material = {})
        : structure(std::move(structure)),
          skin(std::move(skin)),
          material(std::move(material)),
          skin_material(std::move(skin_material)) {}

    Ref<const Structure> structure;
    Parameter skin;  ///< its thickness
    Ref<const Material> material, skin_material;
  };
  /// Throws Error(limit) if a structure has more than max_cell_index cells across the shape where
  /// that has bounds (otherwise query/reach.h checks each query),
  /// Error(unsupported) if a skin is requested whose depth the shape does not know.
  Model(Ref<Context> context, Ref<const Shape> shape, std::vector<ScaleParts> scales,
        Ref<const Material> material = {});
  /// Structures alone.
  Model(Ref<Context> context, Ref<const Shape> shape,
        const std::vector<Ref<const Structure>>& structures)
      : Model(std::move(context), std::move(shape),
              std::vector<ScaleParts>(structures.begin(), structures.end())) {}

  /// A model of regions, the first of which goes before the others. Regions that are models of
  /// regions are replaced by these. At least one, at most max_regions: Error(limit).
  Model(Ref<Context> context, const std::vector<Ref<const Model>>& regions);
  static constexpr size_t max_regions = 4096;

  Context& context() const { return *context_; }
  /// Who computes the answers of this model: the context's threads, or the calling thread alone
  /// where an object that the host defines wants no other.
  const Executor& executor() const { return context_->executor_for(is_concurrent_); }
  /// Of regions: the union of theirs.
  const Shape& shape() const { return *shape_; }
  const Box3& bounds() const { return shape_->bounds(); }
  /// Models of one region each; none where this is one itself.
  const std::vector<Ref<const Model>>& regions() const { return regions_; }
  static constexpr size_t no_region = SIZE_MAX;
  /// The region that a finite point belongs to, 0 of a model that is one; or no_region.
  size_t region_at(Vec3 p) const;

  /// Of regions: the most of any.
  size_t scale_count() const;
  /// Of scale 0: infinite. Of regions: the largest of those that have the scale.
  double scale_length(size_t scale) const;

  /// Which one a scale of resolved() is; the coarsest is 0.
  size_t number(const Scale& scale) const {
    return 1 + static_cast<size_t>(&scale - scales_.data());
  }

  /// The scales but the coarsest that a query at a length scale resolves.
  Scales resolved(double length_scale) const;
  /// The same for a length scale of 0, which resolves all: for single points, without a copy.
  const Scales& all_scales() const { return all_scales_; }

  /// Membership of a finite point: the definition.
  bool inside(Vec3 p, const Scales& resolved) const;
  /// Signed distance of a finite point: at most 0 where inside(p, resolved), positive elsewhere,
  /// and never larger in magnitude than the distance from p to the model's boundary.
  double distance(Vec3 p, const Scales& resolved) const;
  /// The material of a point inside: that of the finest of these scales that has one. May be null
  /// only where has_material() is false. `part`: as in Skin::find().
  const Material* material(Vec3 p, const Scales& resolved, uint32_t& part) const;
  /// Whether there is one wherever a point is. Of a model without regions.
  bool has_material(const Scales& resolved) const;
  /// All that points may have.
  std::vector<const Material*> materials(const Scales& resolved) const;
  /// Builds what answers of these scales need of the shape's depth, if anything. What else they ask
  /// would find out on a worker, with answers written already.
  void prepare_skins(const Scales& resolved, const Job* job) const;
  /// Builds what rows of the shape need.
  void prepare_rows(const Job* job) const;

 private:
  void describe(HashInput& input) const override;
  /// Membership of a point of the shape.
  bool scales_hold(Vec3 p, const Scales& resolved) const;
  double distance_of_regions(Vec3 p, const Scales& resolved) const;

  Ref<Context> context_;
  std::vector<Ref<const Model>> regions_;
  Ref<const Shape> shape_;
  Ref<const Material> material_;
  std::vector<Scale> scales_;
  Scales all_scales_;
  bool is_concurrent_;
};

}  // namespace msq
