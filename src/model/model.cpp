// SPDX-License-Identifier: Apache-2.0
#include "model/model.h"

#include "base/status.h"

namespace msq {

Model::Model(Ref<Context> context, Ref<const Shape> shape,
             std::vector<Ref<const Structure>> structures)
    : context_(std::move(context)),
      shape_(std::move(shape)),
      structures_(std::move(structures)),
      is_concurrent_(shape_->is_concurrent()) {
  for (size_t i = 0; i < structures_.size(); ++i) {
    is_concurrent_ = is_concurrent_ && structures_[i]->is_concurrent();
    const Neighbourhood& grid = structures_[i]->neighbourhood();
    const Box3 box = grid.to_grid(bounds());
    for (int axis = 0; axis < 3; ++axis) {
      const double cells =
          std::max(std::abs(box.min[axis]), std::abs(box.max[axis])) / grid.cell_size[axis];
      if (!(cells < max_cell_index))
        fail(Status::limit,
             "the shape reaches %g cells of scale %zu from its grid's origin along axis %d; the "
             "limit is %g",
             cells, i + 1, axis, max_cell_index);
    }
  }
}

std::vector<const Structure*> Model::resolved(double length_scale) const {
  std::vector<const Structure*> resolved;
  for (const auto& structure : structures_)
    if (structure->characteristic_length() >= length_scale) resolved.push_back(structure.get());
  return resolved;
}

bool Model::inside(Vec3 p, const std::vector<const Structure*>& resolved) const {
  if (!shape_->inside(p)) return false;
  for (const Structure* structure : resolved)
    if (!structure->inside(p)) return false;
  return true;
}

// The solid is an intersection. Outside a scale, no part of the solid is nearer than that scale's
// own: the coarsest such scale answers, as in the paper, and none but it is asked about points
// where it has nothing. Inside all, the boundary is that of one of them: the nearest is near
// enough.
double Model::distance(Vec3 p, const std::vector<const Structure*>& resolved) const {
  double distance = shape_->distance(p);
  for (const Structure* structure : resolved) {
    if (distance > 0) break;
    const double of_scale = structure->distance(p);
    distance = of_scale > 0 ? of_scale : std::max(distance, of_scale);
  }
  return distance;
}

}  // namespace msq
