/* SPDX-License-Identifier: Apache-2.0
 * Meshes that msq_surface_mesh returns, and what every one must be like. */
#ifndef SURFACES_H
#define SURFACES_H

#include "fixtures.h"

typedef struct surface {
  double* vertices;
  float* normals;
  uint32_t* triangles;
  uint64_t vertex_count, triangle_count, calls;
  int32_t stop_with;
} surface;

/* Parts follow one another, and their triangles have no vertex that is yet to come. */
static inline int32_t take_surface(void* user, const msq_surface_slab* slab) {
  surface* all = (surface*)user;
  if (slab->struct_size != sizeof *slab || slab->reserved != 0) return -100;
  if (slab->first_vertex != all->vertex_count) return -101;
  if (slab->first_triangle != all->triangle_count) return -102;
  const size_t vertices = (size_t)(all->vertex_count + slab->vertex_count);
  const size_t triangles = (size_t)(all->triangle_count + slab->triangle_count);
  all->vertices = (double*)realloc(all->vertices, vertices * 3 * sizeof(double) + 1);
  all->normals = (float*)realloc(all->normals, vertices * 3 * sizeof(float) + 1);
  all->triangles = (uint32_t*)realloc(all->triangles, triangles * 3 * sizeof(uint32_t) + 1);
  if (!all->vertices || !all->normals || !all->triangles) return -103;
  if (slab->vertex_count) {
    memcpy(all->vertices + 3 * all->vertex_count, slab->vertices,
           (size_t)slab->vertex_count * 3 * sizeof(double));
    memcpy(all->normals + 3 * all->vertex_count, slab->normals,
           (size_t)slab->vertex_count * 3 * sizeof(float));
  }
  for (uint64_t i = 0; i < 3 * slab->triangle_count; ++i) {
    if (slab->triangles[i] >= vertices) return -104;
    all->triangles[3 * all->triangle_count + i] = slab->triangles[i];
  }
  all->vertex_count = vertices;
  all->triangle_count = triangles;
  ++all->calls;
  return all->stop_with;
}

static inline void free_surface(surface* all) {
  free(all->vertices);
  free(all->normals);
  free(all->triangles);
  memset(all, 0, sizeof *all);
}

static inline msq_surface_def surface_def(double pitch) {
  msq_surface_def def;
  assert_ok(msq_surface_def_init(&def, sizeof def));
  def.pitch = pitch;
  return def;
}

static inline surface surface_of(const msq_model* model, const msq_surface_def* def) {
  surface all;
  memset(&all, 0, sizeof all);
  assert_ok(msq_surface_mesh(model, def, take_surface, &all, NULL));
  return all;
}

/* A side of a triangle: from one vertex to the next, and the third. */
typedef struct half_edge {
  uint32_t from, to, third;
} half_edge;

static inline int compare_half_edges(const void* a, const void* b) {
  const half_edge *x = (const half_edge*)a, *y = (const half_edge*)b;
  if (x->from != y->from) return x->from < y->from ? -1 : 1;
  return x->to < y->to ? -1 : x->to > y->to;
}

/* Each edge has two triangles, which run through it in opposite directions; the triangles of each
 * vertex are one ring; there is no vertex without triangles. */
static inline void assert_manifold(const surface* all) {
  const size_t count = (size_t)(3 * all->triangle_count);
  half_edge* edges = (half_edge*)malloc(count * sizeof *edges + 1);
  size_t* starts = (size_t*)calloc((size_t)all->vertex_count + 1, sizeof *starts);
  assert_non_null(edges);
  assert_non_null(starts);
  for (size_t i = 0; i < count; ++i) {
    const size_t t = i / 3 * 3;
    edges[i].from = all->triangles[i];
    edges[i].to = all->triangles[t + (i + 1) % 3];
    edges[i].third = all->triangles[t + (i + 2) % 3];
    ++starts[edges[i].from + 1];
  }
  qsort(edges, count, sizeof *edges, compare_half_edges);
  for (uint64_t v = 0; v < all->vertex_count; ++v) starts[v + 1] += starts[v];
  for (size_t i = 0; i < count; ++i) {
    const half_edge back = {edges[i].to, edges[i].from, 0};
    if (edges[i].from == edges[i].to) fail_msg("triangle with vertex %u twice", edges[i].from);
    if (i > 0 && compare_half_edges(&edges[i - 1], &edges[i]) == 0)
      fail_msg("edge %u to %u has two triangles on one side", edges[i].from, edges[i].to);
    if (!bsearch(&back, edges, count, sizeof *edges, compare_half_edges))
      fail_msg("edge %u to %u has no triangle on the other side", edges[i].from, edges[i].to);
  }
  for (uint32_t v = 0; v < all->vertex_count; ++v) {
    const size_t degree = starts[v + 1] - starts[v];
    size_t steps = 0;
    if (degree < 3) fail_msg("vertex %u has %zu triangles", v, degree);
    const half_edge* at = &edges[starts[v]];
    do { /* the triangle beyond the other side at v */
      const half_edge next = {v, at->third, 0};
      at = (const half_edge*)bsearch(&next, edges, count, sizeof *edges, compare_half_edges);
      ++steps;
    } while (at != &edges[starts[v]] && steps <= degree);
    if (steps != degree) fail_msg("the %zu triangles of vertex %u are not one ring", degree, v);
  }
  free(edges);
  free(starts);
}

static inline double surface_volume(const surface* all) {
  double volume = 0;
  for (uint64_t t = 0; t < all->triangle_count; ++t) {
    const double* p[3];
    for (int i = 0; i < 3; ++i) p[i] = all->vertices + 3 * (size_t)all->triangles[3 * t + i];
    volume += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
              p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
              p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
  }
  return volume / 6;
}

/* Membership differs within pitch / 1000 of each vertex, in the model cut with the box. Looks at
 * `most` of them. */
static inline void assert_on_boundary(const msq_model* model, const surface* all, double pitch,
                                      const double min[3], const double max[3], size_t most) {
  enum { around = 27 };
  const uint64_t step = all->vertex_count / most + 1;
  for (uint64_t v = 0; v < all->vertex_count; v += step) {
    double points[around][3];
    uint8_t inside[around];
    msq_points_def def;
    int solid = 0;
    assert_ok(msq_points_def_init(&def, sizeof def));
    def.kind = MSQ_POINTS_ARRAY;
    def.coordinates = points;
    def.count = around;
    for (int n = 0; n < around; ++n) {
      const int d[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      const double size = sqrt((double)(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]));
      for (int axis = 0; axis < 3; ++axis)
        points[n][axis] =
            all->vertices[3 * v + (uint64_t)axis] + (size > 0 ? 1e-3 * pitch * d[axis] / size : 0);
    }
    assert_ok(msq_set_membership(model, &def, NULL, inside, around, NULL));
    for (int n = 0; n < around; ++n) {
      int within = inside[n];
      for (int axis = 0; axis < 3; ++axis)
        within = within && points[n][axis] >= min[axis] && points[n][axis] <= max[axis];
      solid += within;
    }
    if (solid == 0 || solid == around)
      fail_msg("vertex %llu at %.9g, %.9g, %.9g is not on the boundary", (unsigned long long)v,
               points[13][0], points[13][1], points[13][2]);
  }
}

/* Bytes of a file. */
typedef struct file_bytes {
  uint8_t* bytes;
  uint64_t size, written, calls, end;
  int is_in_order;
  int32_t stop_with;
} file_bytes;

static inline int32_t take_file(void* user, const msq_file_part* part) {
  file_bytes* file = (file_bytes*)user;
  if (part->struct_size != sizeof *part || part->reserved != 0 || part->size == 0) return -100;
  if (file->calls == 0) {
    file->size = part->total;
    file->bytes = (uint8_t*)malloc((size_t)part->total);
    file->is_in_order = 1;
  }
  if (part->total != file->size || part->offset + part->size > file->size) return -101;
  if (part->offset != file->end) file->is_in_order = 0;
  memcpy(file->bytes + part->offset, part->bytes, (size_t)part->size);
  file->end = part->offset + part->size;
  file->written += part->size;
  ++file->calls;
  return file->stop_with;
}

static inline file_bytes file_of(const msq_model* model, const msq_surface_def* def,
                                 int32_t format) {
  file_bytes file;
  memset(&file, 0, sizeof file);
  assert_ok(msq_surface_file(model, def, format, take_file, &file, NULL));
  assert_int_equal(file.written, file.size);
  return file;
}

#endif
