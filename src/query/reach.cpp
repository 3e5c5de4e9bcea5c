// SPDX-License-Identifier: Apache-2.0
#include "query/reach.h"

#include <string>

#include "base/status.h"
#include "query/first_point.h"

namespace msq {

namespace {

/// Fourth powers of lengths stay finite, as for shapes.
constexpr double max_far_coordinate = 1e75;

/// A structure, and what messages call it.
struct Limited {
  const Structure* structure;
  size_t scale;  ///< 0: it is queried by itself
};
using LimitedBy = std::vector<Limited>;

LimitedBy limits_of(const Model& model, const Scales& resolved) {
  LimitedBy limits;
  for (const Scale* scale : resolved)
    limits.push_back({scale->structure.get(), model.number(*scale)});
  return limits;
}

/// What is too far: coordinates where there is no structure.
struct TooFar {
  const Limited* limited = nullptr;
  double reach = 0;
  int axis = -1;  ///< nothing is
};

TooFar too_far(const LimitedBy& limits, const Box3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const double far = std::max(std::abs(box.min[axis]), std::abs(box.max[axis]));
    if (!(far <= max_far_coordinate)) return {nullptr, far, axis};
  }
  for (const Limited& limited : limits) {
    TooFar found;
    limited.structure->for_each_grid([&](const Neighbourhood& grid) {
      const Box3 reached = grid.to_grid(box);
      for (int axis = 0; axis < 3 && found.axis < 0; ++axis) {
        const double cells = std::max(std::abs(reached.min[axis]), std::abs(reached.max[axis])) /
                             grid.cell_size[axis];
        if (!(cells < max_cell_index)) found = {&limited, cells, axis};
      }
    });
    if (found.axis >= 0) return found;
  }
  return {};
}

void require_box(const LimitedBy& limits, const Box3& box, const char* name) {
  const TooFar far = too_far(limits, box);
  if (far.axis < 0) return;
  if (!far.limited)
    fail(Status::limit, "%s reaches a coordinate of %g along axis %d; the limit is %g", name,
         far.reach, far.axis, max_far_coordinate);
  const std::string whose =
      far.limited->scale ? "scale " + std::to_string(far.limited->scale) : "the structure";
  fail(Status::limit,
       "%s reaches %g cells of %s from its grid's origin along axis %d; the limit is %g", name,
       far.reach, whose.c_str(), far.axis, max_cell_index);
}

void require_points(const LimitedBy& limits, const Executor& executor, const PointSet& points,
                    double around) {
  if (points.count() == 0) return;
  Box3 all;
  if (points.find_bounds(all)) return require_box(limits, all.grown(around), "the set of points");
  const uint64_t first = find_first_point(points, executor, [&](Vec3 p) {
    return too_far(limits, Box3{p, p}.grown(around)).axis >= 0;
  });
  if (first == points.count()) return;
  Vec3 p;
  points.read(first, 1, &p);
  require_box(limits, Box3{p, p}.grown(around), ("point " + std::to_string(first)).c_str());
}

}  // namespace

void require_reach(const Model& model, const Scales& resolved, const Box3& box, const char* name) {
  if (!model.shape().is_bounded()) require_box(limits_of(model, resolved), box, name);
}

void require_reach(const Model& model, const Scales& resolved, const PointSet& points,
                   double around) {
  if (!model.shape().is_bounded())
    require_points(limits_of(model, resolved), model.context().executor, points, around);
}

void require_reach(const Structure& structure, const Executor& executor, const PointSet& points,
                   double around) {
  require_points({{&structure, 0}}, executor, points, around);
}

}  // namespace msq
