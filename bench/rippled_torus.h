// SPDX-License-Identifier: Apache-2.0
// The mesh that the benchmarks of coarse shapes ask.
#pragma once

#include <cmath>

#include "bench.h"

namespace bench {

struct MeshArrays {
  std::vector<double> vertices;
  std::vector<uint32_t> triangles;
};

/// A torus with ripples about the middle of the unit cube: no two triangles alike, none along the
/// axes.
inline MeshArrays rippled_torus(uint32_t around, uint32_t across) {
  MeshArrays mesh;
  const double turn = 2 * std::acos(-1.0);
  for (uint32_t i = 0; i < around; ++i)
    for (uint32_t j = 0; j < across; ++j) {
      const double u = turn * i / around, v = turn * j / across;
      const double r = 0.18 + 0.02 * std::sin(9 * u) * std::cos(5 * v);
      const double ring = 0.3 + r * std::cos(v);
      mesh.vertices.insert(mesh.vertices.end(), {0.5 + ring * std::cos(u), 0.5 + ring * std::sin(u),
                                                 0.5 + r * std::sin(v)});
      const uint32_t a = i * across + j, b = i * across + (j + 1) % across;
      const uint32_t c = (i + 1) % around * across + j,
                     d = (i + 1) % around * across + (j + 1) % across;
      mesh.triangles.insert(mesh.triangles.end(), {a, c, d, a, d, b});
    }
  return mesh;
}

inline msq_shape* make_shape(msq_context* context, const MeshArrays& mesh) {
  msq_mesh_def def;
  check(msq_mesh_def_init(&def, sizeof def));
  def.vertices = mesh.vertices.data();
  def.vertex_count = mesh.vertices.size() / 3;
  def.triangles = mesh.triangles.data();
  def.triangle_count = mesh.triangles.size() / 3;
  msq_shape* shape;
  check(msq_shape_from_mesh(context, &def, &shape));
  return shape;
}

}  // namespace bench
