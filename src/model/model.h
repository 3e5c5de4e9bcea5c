// SPDX-License-Identifier: Apache-2.0
// A coarse shape and the structures that fill it, scale by scale; the solid is the shape cut with
// each structure, save for the skin that a scale may leave.
// Source: paper, section "Multiscale Shape-Material Modeling API".
#pragma once

#include <limits>
#include <vector>

#include "cell/context.h"
#include "model/scale.h"
#include "shape/shape.h"

namespace msq {

class Model final : public RefCounted {
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
  /// Throws Error(limit) if a structure has more than max_cell_index cells across the shape,
  /// Error(unsupported) if a skin is asked for whose depth the shape does not know.
  Model(Ref<Context> context, Ref<const Shape> shape, std::vector<ScaleParts> scales,
        Ref<const Material> material = {});
  /// Structures alone.
  Model(Ref<Context> context, Ref<const Shape> shape,
        const std::vector<Ref<const Structure>>& structures)
      : Model(std::move(context), std::move(shape),
              std::vector<ScaleParts>(structures.begin(), structures.end())) {}

  Context& context() const { return *context_; }
  /// Who computes the answers of this model: the context's threads, or the calling thread alone
  /// where an object that the host defines wants no other.
  const Executor& executor() const {
    return context_->executor_for(is_concurrent_);
  }
  const Shape& shape() const { return *shape_; }
  const Box3& bounds() const { return shape_->bounds(); }
  size_t scale_count() const { return 1 + scales_.size(); }
  /// Of scale 0: infinite.
  double scale_length(size_t scale) const {
    return scale == 0 ? std::numeric_limits<double>::infinity()
                      : scales_[scale - 1].structure->characteristic_length();
  }

  /// The scales but the coarsest that a query at a length scale resolves.
  Scales resolved(double length_scale) const;

  /// Membership of a finite point: the definition.
  bool inside(Vec3 p, const Scales& resolved) const;
  /// Signed distance of a finite point: at most 0 where inside(p, resolved), positive elsewhere,
  /// and never larger in magnitude than the distance from p to the model's boundary.
  double distance(Vec3 p, const Scales& resolved) const;
  /// The material of a point inside: that of the finest of these scales that has one. May be null
  /// only where has_material() is false. `part`: as in Skin::find().
  const Material* material(Vec3 p, const Scales& resolved, uint32_t& part) const;
  /// Whether there is one wherever a point is.
  bool has_material(const Scales& resolved) const;
  /// All that points may have.
  std::vector<const Material*> materials(const Scales& resolved) const;
  /// Builds what answers of these scales need of the shape's depth, if anything. What else they ask
  /// would find out on a worker, with answers written already.
  void prepare_skins(const Scales& resolved) const;

 private:
  Ref<Context> context_;
  Ref<const Shape> shape_;
  Ref<const Material> material_;
  std::vector<Scale> scales_;
  bool is_concurrent_;
};

}  // namespace msq
