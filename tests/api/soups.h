/* SPDX-License-Identifier: Apache-2.0
 * Small meshes that are changed triangle by triangle. */
#ifndef SOUPS_H
#define SOUPS_H

#include "fixtures.h"

enum { max_vertices = 40, max_triangles = 40 };

typedef struct soup {
  double vertices[max_vertices][3];
  uint32_t triangles[max_triangles][3];
  uint64_t vertex_count, triangle_count;
} soup;

/* A unit cube with vertices of its own. */
static inline void add_cube(soup* mesh, double x, double y, double z) {
  const uint32_t first = (uint32_t)mesh->vertex_count;
  cube_corners(0, 1, mesh->vertices + first);
  for (int i = 0; i < 8; ++i) {
    mesh->vertices[first + (uint32_t)i][0] += x;
    mesh->vertices[first + (uint32_t)i][1] += y;
    mesh->vertices[first + (uint32_t)i][2] += z;
  }
  for (int i = 0; i < 12; ++i)
    for (int v = 0; v < 3; ++v)
      mesh->triangles[mesh->triangle_count + (uint64_t)i][v] = first + cube_triangles()[i][v];
  mesh->vertex_count += 8;
  mesh->triangle_count += 12;
}

static inline soup unit_cube(void) {
  soup mesh;
  memset(&mesh, 0, sizeof mesh);
  add_cube(&mesh, 0, 0, 0);
  return mesh;
}

static inline msq_shape* make_soup(msq_context* context, const soup* mesh) {
  const msq_mesh_def def = mesh_def((const double(*)[3])mesh->vertices, mesh->vertex_count,
                                    (const uint32_t(*)[3])mesh->triangles, mesh->triangle_count);
  return make_mesh(context, &def);
}

#endif
