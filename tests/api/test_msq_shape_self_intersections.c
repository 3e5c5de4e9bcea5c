/* SPDX-License-Identifier: Apache-2.0
 * msq_shape_self_intersections: which pairs of triangles count, and what the call promises. On
 * larger meshes it is compared with CGAL's own: tests/unit/test_self_intersections_cgal.cpp. */
#include "soups.h"

#if MSQ_WITH_CGAL

static uint64_t pairs_of(const soup* mesh) {
  uint64_t pairs = UINT64_MAX;
  msq_context* context = make_context();
  msq_shape* shape = make_soup(context, mesh);
  assert_ok(msq_shape_self_intersections(shape, &pairs, NULL));
  msq_shape_release(shape);
  msq_context_release(context);
  return pairs;
}

static void clean_cube_has_none(void** state) {
  const soup mesh = unit_cube();
  (void)state;
  assert_int_equal(pairs_of(&mesh), 0);
}

static void open_cube_has_none(void** state) {
  soup mesh = unit_cube();
  (void)state;
  mesh.triangle_count -= 3;
  assert_int_equal(pairs_of(&mesh), 0);
}

static void cubes_apart_have_none(void** state) {
  soup mesh = unit_cube();
  (void)state;
  add_cube(&mesh, 1.25, 0, 0);
  assert_int_equal(pairs_of(&mesh), 0);
}

static void overlapping_cubes_have_some(void** state) {
  soup mesh = unit_cube();
  (void)state;
  add_cube(&mesh, 0.5, 0.25, 0.375);
  assert_true(pairs_of(&mesh) > 0);
}

/* Welded, the two squares of the face are the same two triangles twice. */
static void cubes_that_touch_in_a_face_have_its_triangles(void** state) {
  soup mesh = unit_cube();
  (void)state;
  add_cube(&mesh, 1, 0, 0);
  assert_int_equal(pairs_of(&mesh), 2);
}

static void cubes_that_share_an_edge_have_none(void** state) {
  soup mesh = unit_cube();
  (void)state;
  add_cube(&mesh, 1, 1, 0);
  assert_int_equal(pairs_of(&mesh), 0);
}

/* Triangle (0, 0, 0), (4, 0, 0), (0, 4, 0) and another; equal vertices are one. */
static void two_triangles(void** state) {
  static const struct {
    const char* what;
    double other[3][3];
    uint64_t pairs;
  } cases[] = {
      {"apart, boxes meet", {{3, 3, -1}, {4, 4, 0}, {3, 3, 1}}, 0},
      {"crossing", {{1, 1, -1}, {2, 1, 1}, {1, 2, 1}}, 1},
      {"a vertex inside", {{1, 1, 0}, {1, 2, 3}, {2, 1, 3}}, 1},
      {"a vertex on an edge", {{2, 0, 0}, {1, -2, 3}, {3, -2, 3}}, 1},
      {"flat, overlapping", {{1, 1, 0}, {5, 1, 0}, {1, 5, 0}}, 1},
      {"flat, one inside the other", {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}}, 1},
      {"flat, apart", {{3, 3, 0}, {5, 3, 0}, {3, 5, 0}}, 0},
      {"a shared vertex", {{0, 0, 0}, {1, 1, 1}, {1, 2, 1}}, 0},
      {"a shared vertex, flat", {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}}, 0},
      {"a shared vertex, flat, overlapping", {{0, 0, 0}, {1, 1, 0}, {1, 2, 0}}, 1},
      {"a shared vertex, edge through", {{0, 0, 0}, {1, 1, -1}, {1, 1, 1}}, 1},
      {"a shared vertex, edge through the other way", {{0, 0, 0}, {9, 9, -1}, {9, 9, 1}}, 1},
      {"a shared vertex, along an edge", {{0, 0, 0}, {2, 0, 0}, {1, -1, 2}}, 1},
      {"a shared edge", {{0, 0, 0}, {4, 0, 0}, {1, 1, 2}}, 0},
      {"a shared edge, flat, beside", {{4, 0, 0}, {0, 0, 0}, {1, -3, 0}}, 0},
      {"a shared edge, folded flat", {{4, 0, 0}, {0, 0, 0}, {1, 7, 0}}, 1},
      {"a shared edge, folded flat, the other way round", {{0, 0, 0}, {4, 0, 0}, {1, 7, 0}}, 1},
      {"a shared edge, all but flat", {{4, 0, 0}, {0, 0, 0}, {1, 7, 1e-300}}, 0},
      {"the same", {{4, 0, 0}, {0, 4, 0}, {0, 0, 0}}, 1},
      {"the same, flipped", {{0, 4, 0}, {4, 0, 0}, {0, 0, 0}}, 1},
      {"without area, through the inside", {{1, 1, -1}, {1, 1, 1}, {1, 1, 3}}, 0},
      {"without area, on a shared edge", {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}, 0},
  };
  (void)state;
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i)
    for (uint32_t turn = 0; turn < 6; ++turn) { /* whichever is first, from whichever vertex */
      const double first[3][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
      soup mesh;
      memset(&mesh, 0, sizeof mesh);
      memcpy(mesh.vertices, first, sizeof first);
      memcpy(mesh.vertices + 3, cases[i].other, sizeof cases[i].other);
      mesh.vertex_count = 6;
      mesh.triangle_count = 2;
      for (uint32_t v = 0; v < 3; ++v) {
        mesh.triangles[turn % 2][v] = v;
        mesh.triangles[1 - turn % 2][v] = 3 + (v + turn) % 3;
      }
      const uint64_t pairs = pairs_of(&mesh);
      if (pairs != cases[i].pairs)
        fail_msg("%s, turn %u: %llu pairs", cases[i].what, (unsigned)turn,
                 (unsigned long long)pairs);
    }
}

static void every_pair_of_duplicates_counts(void** state) {
  soup mesh = unit_cube();
  (void)state;
  for (uint64_t copy = 12; copy < 15; ++copy)
    memcpy(mesh.triangles[copy], mesh.triangles[4], sizeof mesh.triangles[4]);
  mesh.triangle_count = 15;
  assert_int_equal(pairs_of(&mesh), 6);
}

/* The largest and smallest coordinates that msq takes: nothing overflows into a wrong answer. */
static void size_is_no_matter(void** state) {
  const double sizes[] = {1e100, 1e-200, 1e-320};
  (void)state;
  for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i)
    for (int overlapping = 0; overlapping < 2; ++overlapping) {
      soup mesh = unit_cube();
      add_cube(&mesh, overlapping ? -0.5 : -1.5, overlapping ? -0.25 : 0, 0.375);
      for (int v = 0; v < 16; ++v)
        for (int axis = 0; axis < 3; ++axis) mesh.vertices[v][axis] *= sizes[i] / 1.5;
      assert_int_equal(pairs_of(&mesh) > 0, overlapping);
    }
}

#else

static void mesh_is_unsupported(void** state) {
  msq_context* context = make_context();
  msq_shape* mesh = make_cube_mesh(context);
  uint64_t pairs = 7;
  (void)state;
  assert_refused(msq_shape_self_intersections(mesh, &pairs, NULL), MSQ_E_UNSUPPORTED,
                 "MSQ_WITH_CGAL");
  assert_int_equal(pairs, 7);
  msq_shape_release(mesh);
  msq_context_release(context);
}

#endif

static void primitives_have_none(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {1, 2, 3};
  msq_context* context = make_context();
  msq_shape* shapes[3];
  (void)state;
  shapes[0] = make_box(context);
  assert_ok(msq_shape_from_sphere(context, from, 2, &shapes[1]));
  assert_ok(msq_shape_from_cylinder(context, from, to, 2, &shapes[2]));
  for (int i = 0; i < 3; ++i) {
    uint64_t pairs = 7;
    assert_ok(msq_shape_self_intersections(shapes[i], &pairs, NULL));
    assert_int_equal(pairs, 0);
    msq_shape_release(shapes[i]);
  }
  msq_context_release(context);
}

static void progress_ends_at_1(void** state) {
  msq_context* context = make_context();
  msq_shape* shape = MSQ_WITH_CGAL ? make_cube_mesh(context) : make_box(context);
  uint64_t pairs = 7;
  msq_job* job;
  (void)state;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_shape_self_intersections(shape, &pairs, job));
  assert_int_equal(pairs, 0);
  assert_true(progress_of(job) == 1);
  msq_job_release(job);
  msq_shape_release(shape);
  msq_context_release(context);
}

static void cancelled_job_stops_at_once(void** state) {
  msq_context* context = make_context();
  msq_shape* shapes[2] = {make_cube_mesh(context), make_box(context)};
  uint64_t pairs = 7;
  msq_job* job;
  (void)state;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_job_cancel(job));
  for (int i = 0; i < 2; ++i) {
    assert_refused(msq_shape_self_intersections(shapes[i], &pairs, job), MSQ_E_CANCELLED,
                   "cancelled");
    assert_int_equal(pairs, 7);
    assert_true(progress_of(job) == 0);
    msq_shape_release(shapes[i]);
  }
  msq_job_release(job);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
#if MSQ_WITH_CGAL
    cmocka_unit_test(clean_cube_has_none),
    cmocka_unit_test(open_cube_has_none),
    cmocka_unit_test(cubes_apart_have_none),
    cmocka_unit_test(overlapping_cubes_have_some),
    cmocka_unit_test(cubes_that_touch_in_a_face_have_its_triangles),
    cmocka_unit_test(cubes_that_share_an_edge_have_none),
    cmocka_unit_test(two_triangles),
    cmocka_unit_test(every_pair_of_duplicates_counts),
    cmocka_unit_test(size_is_no_matter),
#else
    cmocka_unit_test(mesh_is_unsupported),
#endif
    cmocka_unit_test(primitives_have_none),
    cmocka_unit_test(progress_ends_at_1),
    cmocka_unit_test(cancelled_job_stops_at_once),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
