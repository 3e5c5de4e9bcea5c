// SPDX-License-Identifier: Apache-2.0
// Limits of queries of models of all space: the cells of structures have indices only up to some
// distance from the origins of their grids. Shapes with bounds keep all queries within these
// limits.
#pragma once

#include "model/model.h"
#include "query/point_set.h"

namespace msq {

/// Throws Error(limit) if a structure's cells, or coordinates, are out of range at a point of the
/// box; the message calls the box by `name`. Does nothing if the model has bounds.
void require_reach(const Model& model, const Scales& resolved, const Box3& box, const char* name);
/// The same for points; `around` is the distance to which a query goes from them.
void require_reach(const Model& model, const Scales& resolved, const PointSet& points,
                   double around = 0);
/// The same of a structure alone.
void require_reach(const Structure& structure, const Executor& executor, const PointSet& points,
                   double around);

}  // namespace msq
