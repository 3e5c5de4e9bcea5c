// SPDX-License-Identifier: Apache-2.0
// Triangles of a model's boundary, slab by slab. No vertex, triangle or number of one depends on
// slabs or threads.
#pragma once

#include <cstdint>
#include <functional>

#include "base/job.h"
#include "model/model.h"
#include "surface/mesh_grid.h"

namespace msq {

/// Part of a mesh. Triangles have vertices of this part or of those before it.
struct MeshSlab {
  uint64_t first_vertex, vertex_count;
  const Vec3* vertices;
  const float* normals;  ///< x, y, z of each vertex
  uint64_t first_triangle, triangle_count;
  const uint32_t* triangles;  ///< three vertices of the mesh each
  /// The vertices from this number on are known here, up to the end of the part: all those of its
  /// triangles.
  uint64_t first_known;
  const Vec3* known;
};

struct MeshSize {
  uint64_t vertices = 0, triangles = 0;
};

/// Calls take(slab) for each part with triangles, in order, on this thread. What take() throws ends
/// the run and is passed on.
void make_mesh(const Model& model, const MeshPlan& plan,
               const std::function<void(const MeshSlab&)>& take, JobPart progress);

/// Counts what make_mesh() makes, without places.
MeshSize count_mesh(const Model& model, const MeshPlan& plan, JobPart progress);

}  // namespace msq
