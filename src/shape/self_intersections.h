// SPDX-License-Identifier: Apache-2.0
// Where a mesh meets itself.
#pragma once

#include <cstdint>

#include "base/job.h"
#include "shape/mesh.h"

namespace msq {

/// Number of pairs of triangles that meet other than in vertices or an edge that they share by
/// index; two triangles of the same three vertices are a pair. Exact in its decisions. Triangles
/// without area are in no pair. Throws Error(cancelled), and Error(unsupported) in builds without
/// CGAL.
uint64_t count_self_intersections(const Mesh& mesh, const Job* job);

}  // namespace msq
