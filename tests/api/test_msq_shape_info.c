/* SPDX-License-Identifier: Apache-2.0
 * msq_shape_info: the diagnosis of clean and dirty meshes. Primitives: the tests of their
 * constructors. */
#include "soups.h"

static uint32_t add_vertex(soup* mesh, double x, double y, double z) {
  double* vertex = mesh->vertices[mesh->vertex_count];
  vertex[0] = x;
  vertex[1] = y;
  vertex[2] = z;
  return (uint32_t)mesh->vertex_count++;
}

static void add_triangle(soup* mesh, uint32_t a, uint32_t b, uint32_t c) {
  uint32_t* triangle = mesh->triangles[mesh->triangle_count++];
  triangle[0] = a;
  triangle[1] = b;
  triangle[2] = c;
}

static void flip(soup* mesh, int i) {
  const uint32_t kept = mesh->triangles[i][0];
  mesh->triangles[i][0] = mesh->triangles[i][1];
  mesh->triangles[i][1] = kept;
}

static msq_shape_report diagnosis(const soup* mesh) {
  msq_context* context = make_context();
  msq_shape* shape = make_soup(context, mesh);
  const msq_shape_report report = info_of(shape);
  assert_int_equal(report.is_mesh, 1);
  assert_int_equal(report.reserved, 0);
  msq_shape_release(shape);
  msq_context_release(context);
  return report;
}

static void assert_edges(const msq_shape_report* report, uint64_t open, uint64_t non_manifold,
                         uint64_t flipped, int32_t closed) {
  assert_int_equal(report->open_edges, open);
  assert_int_equal(report->non_manifold_edges, non_manifold);
  assert_int_equal(report->flipped_edges, flipped);
  assert_int_equal(report->closed, closed);
}

static void assert_counts(const msq_shape_report* report, uint64_t vertices, uint64_t triangles,
                          uint64_t degenerate, uint64_t duplicate) {
  assert_int_equal(report->vertices, vertices);
  assert_int_equal(report->triangles, triangles);
  assert_int_equal(report->degenerate_triangles, degenerate);
  assert_int_equal(report->duplicate_triangles, duplicate);
}

static void clean_cube_is_closed(void** state) {
  const soup mesh = unit_cube();
  const msq_shape_report report = diagnosis(&mesh);
  (void)state;
  assert_counts(&report, 8, 12, 0, 0);
  assert_edges(&report, 0, 0, 0, 1);
  for (int axis = 0; axis < 3; ++axis) {
    assert_true(report.min[axis] == 0);
    assert_true(report.max[axis] == 1);
  }
  assert_near(report.volume, 1, 1e-15);
  assert_near(report.area, 6, 1e-15);
}

static void volume_is_exact_far_from_the_origin(void** state) {
  soup mesh;
  (void)state;
  memset(&mesh, 0, sizeof mesh);
  add_cube(&mesh, 1 << 30, -(1 << 30), 1 << 29);
  const msq_shape_report report = diagnosis(&mesh);
  assert_near(report.volume, 1, 1e-12);
  assert_near(report.area, 6, 1e-12);
}

static void inside_out_cube_has_negative_volume(void** state) {
  soup mesh = unit_cube();
  (void)state;
  for (int i = 0; i < 12; ++i) flip(&mesh, i);
  const msq_shape_report report = diagnosis(&mesh);
  assert_near(report.volume, -1, 1e-15);
  assert_edges(&report, 0, 0, 0, 1);
}

static void missing_triangle_leaves_three_open_edges(void** state) {
  soup mesh = unit_cube();
  (void)state;
  --mesh.triangle_count;
  const msq_shape_report report = diagnosis(&mesh);
  assert_counts(&report, 8, 11, 0, 0);
  assert_edges(&report, 3, 0, 0, 0);
}

static void flipped_triangle_has_three_flipped_edges(void** state) {
  soup mesh = unit_cube();
  (void)state;
  flip(&mesh, 4);
  const msq_shape_report report = diagnosis(&mesh);
  assert_counts(&report, 8, 12, 0, 0);
  assert_edges(&report, 0, 0, 3, 0);
}

static void duplicate_triangle_is_kept_and_counted(void** state) {
  (void)state;
  for (int is_flipped = 0; is_flipped < 2; ++is_flipped) { /* the order of vertices is no matter */
    soup mesh = unit_cube();
    add_triangle(&mesh, mesh.triangles[3][1], mesh.triangles[3][2], mesh.triangles[3][0]);
    if (is_flipped) flip(&mesh, 12);
    const msq_shape_report report = diagnosis(&mesh);
    assert_counts(&report, 8, 13, 0, 1);
    assert_edges(&report, 0, 3, 0, 0);
  }
}

static void cubes_that_share_an_edge_are_not_manifold(void** state) {
  soup mesh = unit_cube();
  (void)state;
  add_cube(&mesh, 1, 1, 0);
  const msq_shape_report report = diagnosis(&mesh);
  assert_counts(&report, 14, 24, 0, 0);
  assert_edges(&report, 0, 1, 0, 1);
  assert_near(report.volume, 2, 1e-14);
}

static void triangle_of_two_vertices_is_dropped(void** state) {
  soup mesh = unit_cube();
  (void)state;
  add_triangle(&mesh, 0, 0, 1);
  add_triangle(&mesh, 5, 2, 5);
  add_triangle(&mesh, 7, 7, 7);
  const msq_shape_report report = diagnosis(&mesh);
  assert_counts(&report, 8, 12, 3, 0);
  assert_edges(&report, 0, 0, 0, 1);
}

static void vertices_of_dropped_triangles_are_not_of_the_mesh(void** state) {
  soup mesh = unit_cube();
  (void)state;
  const uint32_t far_away = add_vertex(&mesh, 9, -9, 9);
  add_triangle(&mesh, far_away, far_away, 3);
  const msq_shape_report report = diagnosis(&mesh);
  assert_counts(&report, 8, 12, 1, 0);
  for (int axis = 0; axis < 3; ++axis) {
    assert_true(report.min[axis] == 0);
    assert_true(report.max[axis] == 1);
  }
}

/* A vertex on the edge from corner 0 to corner 1, on one side of it alone: the triangle without
 * area between them closes the surface. */
static void collinear_triangle_is_kept_where_it_closes_the_surface(void** state) {
  soup mesh = unit_cube();
  (void)state;
  assert_int_equal(mesh.triangles[4][0], 0); /* 0, 1, 5 */
  assert_int_equal(mesh.triangles[4][1], 1);
  const uint32_t middle = add_vertex(&mesh, 0.5, 0, 0);
  mesh.triangles[4][1] = middle;
  add_triangle(&mesh, middle, 1, 5);
  add_triangle(&mesh, 0, 1, middle);
  const msq_shape_report report = diagnosis(&mesh);
  assert_counts(&report, 9, 14, 1, 0);
  assert_edges(&report, 0, 0, 0, 1);
  assert_near(report.volume, 1, 1e-15);
}

static void equal_vertices_are_welded(void** state) {
  const soup cube = unit_cube();
  soup mesh;
  (void)state;
  memset(&mesh, 0, sizeof mesh);
  for (int i = 0; i < 12; ++i) {
    uint32_t v[3];
    for (int c = 0; c < 3; ++c) {
      const double* p = cube.vertices[cube.triangles[i][c]];
      /* -0 is 0 */
      v[c] = add_vertex(&mesh, p[0] == 0 && i % 2 ? -0.0 : p[0], p[1], p[2]);
    }
    add_triangle(&mesh, v[0], v[1], v[2]);
  }
  const msq_shape_report report = diagnosis(&mesh);
  assert_counts(&report, 8, 12, 0, 0);
  assert_edges(&report, 0, 0, 0, 1);
}

static void unused_vertices_count_for_nothing(void** state) {
  soup mesh = unit_cube();
  (void)state;
  add_vertex(&mesh, 100, 100, 100);
  const msq_shape_report report = diagnosis(&mesh);
  assert_counts(&report, 8, 12, 0, 0);
  assert_true(report.max[0] == 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(clean_cube_is_closed),
      cmocka_unit_test(volume_is_exact_far_from_the_origin),
      cmocka_unit_test(inside_out_cube_has_negative_volume),
      cmocka_unit_test(missing_triangle_leaves_three_open_edges),
      cmocka_unit_test(flipped_triangle_has_three_flipped_edges),
      cmocka_unit_test(duplicate_triangle_is_kept_and_counted),
      cmocka_unit_test(cubes_that_share_an_edge_are_not_manifold),
      cmocka_unit_test(triangle_of_two_vertices_is_dropped),
      cmocka_unit_test(vertices_of_dropped_triangles_are_not_of_the_mesh),
      cmocka_unit_test(collinear_triangle_is_kept_where_it_closes_the_surface),
      cmocka_unit_test(equal_vertices_are_welded),
      cmocka_unit_test(unused_vertices_count_for_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
