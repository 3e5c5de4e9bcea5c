// SPDX-License-Identifier: Apache-2.0
// Where a shape has the triangles of a mesh, if it is a mesh that maps have placed.
#pragma once

#include <functional>

#include "base/vec.h"

namespace msq {

class Mesh;

struct MeshMap {
  const Mesh* mesh = nullptr;  ///< null: the shape is none
  /// Where a vertex of the mesh is placed, rounded. Null: where it is.
  std::function<Vec3(Vec3)> place;
  bool is_mirrored = false;
  /// Enclose the placed solid.
  Box3 bounds;
  /// Exceeds the roundings of the places of vertices, of the point that a point of the bounds is
  /// mapped back to, and of the mesh's own crossings of rows, together.
  double error = 0;
};

}  // namespace msq
