// SPDX-License-Identifier: Apache-2.0
// Intersections of a mesh with itself.
#pragma once

#include <cstdint>

#include "base/job.h"
#include "shape/mesh.h"

namespace msq {

/// The number of pairs of triangles that meet outside the vertices or the edge that they share by
/// index; two triangles of the same three vertices are a pair. Uses exact predicates. Triangles
/// without area are in no pair. Throws Error(cancelled), and Error(unsupported) in builds without
/// CGAL.
uint64_t count_self_intersections(const Mesh& mesh, const Job* job);

}  // namespace msq
