// SPDX-License-Identifier: Apache-2.0
// A coarse shape and the structures that fill it, scale by scale; the solid is their intersection.
// Source: paper, section "Multiscale Shape-Material Modeling API".
#pragma once

#include <limits>
#include <vector>

#include "cell/context.h"
#include "shape/shape.h"
#include "structure/structure.h"

namespace msq {

class Model final : public RefCounted {
 public:
  /// Throws Error(limit) if a structure has more than max_cell_index cells across the shape.
  Model(Ref<Context> context, Ref<const Shape> shape, std::vector<Ref<const Structure>> structures);

  Context& context() const { return *context_; }
  /// Who computes the answers of this model: the context's threads, or the calling thread alone
  /// where an object that the host defines wants no other.
  const Executor& executor() const {
    return is_concurrent_ ? context_->executor : context_->serial;
  }
  const Shape& shape() const { return *shape_; }
  const Box3& bounds() const { return shape_->bounds(); }
  size_t scale_count() const { return 1 + structures_.size(); }
  /// Of scale 0: infinite.
  double scale_length(size_t scale) const {
    return scale == 0 ? std::numeric_limits<double>::infinity()
                      : structures_[scale - 1]->characteristic_length();
  }

  /// The structures, coarsest first, that a query at a length scale resolves.
  std::vector<const Structure*> resolved(double length_scale) const;

  /// Membership of a finite point: the definition.
  bool inside(Vec3 p, const std::vector<const Structure*>& resolved) const;
  /// Signed distance of a finite point: at most 0 where inside(p, resolved), positive elsewhere,
  /// and never larger in magnitude than the distance from p to the model's boundary.
  double distance(Vec3 p, const std::vector<const Structure*>& resolved) const;

 private:
  Ref<Context> context_;
  Ref<const Shape> shape_;
  std::vector<Ref<const Structure>> structures_;
  bool is_concurrent_;
};

}  // namespace msq
