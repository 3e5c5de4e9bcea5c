/* SPDX-License-Identifier: Apache-2.0 */
#include "documents.h"
#include "images.h"
#include "samples.h"
#include "surfaces.h"

static const double corner[3] = {0, 0, 0};

static void def_init_sets_defaults(void** state) {
  msq_surface_def def;
  (void)state;
  memset(&def, 0xa5, sizeof def);
  assert_ok(msq_surface_def_init(&def, sizeof def));
  assert_int_equal(def.struct_size, sizeof def);
  assert_filled((const char*)&def + sizeof def.struct_size, sizeof def - sizeof def.struct_size, 0);
}

static void a_box_is_exact(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_box_model(context);
  const double pitches[] = {0.5, 0.37, 4, 100};
  (void)state;
  for (size_t i = 0; i < sizeof pitches / sizeof pitches[0]; ++i) {
    const msq_surface_def def = surface_def(pitches[i]);
    surface all = surface_of(model, &def);
    assert_manifold(&all);
    assert_near(surface_volume(&all), 64, 1e-9);
    for (uint64_t v = 0; v < all.vertex_count; ++v) {
      int faces = 0;
      double size = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double x = all.vertices[3 * v + (uint64_t)axis];
        const float n = all.normals[3 * v + (uint64_t)axis];
        faces += x == 0 || x == 4;
        if (n != 0) assert_true(x == (n < 0 ? 0 : 4));
        size += fabs((double)n);
      }
      assert_true(faces >= 1 && size == 1);
    }
    free_surface(&all);
  }
  msq_model_release(model);
  msq_context_release(context);
}

/* Edges and corners of a turned box are kept, except for a few cells that few edges cross. */
static void features_are_kept(void** state) {
  const double c = cos(0.4), s = sin(0.4);
  const double matrix[12] = {c, -s * c, s * s, 1, s, c * c, -c * s, 2, 0, s, c, 3};
  msq_context* context = make_context();
  msq_shape *box = make_box(context), *turned;
  assert_ok(msq_shape_placed(box, matrix, &turned));
  msq_model* model = make_shape_model(context, turned);
  const msq_surface_def def = surface_def(0.23);
  surface all = surface_of(model, &def);
  (void)state;
  assert_manifold(&all);
  assert_near(surface_volume(&all), 64, 0.05); /* rounded edges: more than 0.1 */
  msq_shape_release(box);
  free_surface(&all);
  msq_model_release(model);
  msq_context_release(context);
}

static void normals_are_those_of_the_surface(void** state) {
  const double centre[3] = {1, 2, 3};
  msq_context* context = make_context();
  msq_shape* ball;
  assert_ok(msq_shape_from_sphere(context, centre, 2, &ball));
  msq_model* model = make_shape_model(context, ball);
  msq_surface_def def = surface_def(0.1);
  (void)state;
  def.has_box = 1; /* half of it */
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = -10;
    def.max[axis] = 10;
  }
  def.max[0] = 1;
  surface all = surface_of(model, &def);
  assert_manifold(&all);
  assert_near(surface_volume(&all), 2 * pi / 3 * 8, 0.02);
  uint64_t on_cap = 0;
  for (uint64_t v = 0; v < all.vertex_count; ++v) {
    const double* p = all.vertices + 3 * v;
    const float* n = all.normals + 3 * v;
    const double out[3] = {p[0] - 1, p[1] - 2, p[2] - 3};
    const double radius = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
    assert_true(p[0] <= 1);
    if (p[0] == 1 && n[0] == 1) {
      assert_true(radius < 2 + 1e-9);
      ++on_cap;
      continue;
    }
    assert_near(radius, 2, 1e-4);
    for (int axis = 0; axis < 3; ++axis) assert_near(n[axis], out[axis] / 2, 1e-4);
  }
  assert_true(on_cap > 500);
  free_surface(&all);
  msq_model_release(model);
  msq_context_release(context);
}

static msq_structure* make_gyroid(msq_context* context) {
  msq_functional_def def;
  msq_structure* gyroid;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.function = MSQ_FUNCTION_GYROID;
  def.kind = MSQ_FUNCTIONAL_SHEET;
  set_cell(&def.grid, 2);
  def.level.value = 0.3;
  assert_ok(msq_structure_functional(context, &def, &gyroid));
  return gyroid;
}

/* Manifold, on the boundary, with the volume of samples, of which chords of thin struts cut
 * off some; the same bytes in other slabs and
 * with other threads. */
static void check_model(msq_model* (*make)(msq_context*), double pitch, double tolerance) {
  surface first;
  memset(&first, 0, sizeof first);
  const uint32_t slabs[] = {0, 1, 7};
  const uint32_t threads[] = {2, 1, 2};
  for (int i = 0; i < 3; ++i) {
    msq_context* context = make_context_of(threads[i], i == 2 ? 0 : (uint64_t)1 << 28, 0);
    msq_model* model = make(context);
    msq_surface_def def = surface_def(pitch);
    def.slab_layers = slabs[i];
    surface all = surface_of(model, &def);
    if (i == 0) {
      first = all;
      assert_true(all.triangle_count > 100);
      assert_manifold(&all);
      double min[3], max[3];
      assert_ok(msq_model_bounds(model, min, max));
      assert_on_boundary(model, &all, pitch, min, max, test_count(3000) + 50);
      const msq_points_def sample = sample_of(0, 4, 64, 2);
      msq_estimate part;
      assert_ok(msq_volume_fraction(model, &sample, NULL, MSQ_PHASE_SOLID, &part, NULL));
      assert_near(surface_volume(&all) / (64 * part.value), 1, tolerance);
    } else {
      assert_true(slabs[i] != 1 || all.calls > 10);
      assert_int_equal(all.vertex_count, first.vertex_count);
      assert_int_equal(all.triangle_count, first.triangle_count);
      assert_memory_equal(all.vertices, first.vertices, all.vertex_count * 3 * sizeof(double));
      assert_memory_equal(all.normals, first.normals, all.vertex_count * 3 * sizeof(float));
      assert_memory_equal(all.triangles, first.triangles,
                          all.triangle_count * 3 * sizeof(uint32_t));
      free_surface(&all);
    }
    msq_model_release(model);
    msq_context_release(context);
  }
  free_surface(&first);
}

static msq_model* lattice_model(msq_context* context) {
  return make_lattice_model(context);
}
static msq_model* foam_model(msq_context* context) {
  return make_foam_model(context, MSQ_FOAM_AUTO);
}
static msq_model* gyroid_model(msq_context* context) {
  return make_model(context, make_box(context), make_gyroid(context), NULL);
}
static msq_model* nested_model(msq_context* context) {
  return make_model(context, make_box(context), make_gyroid(context),
                    make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 0.5, 0.1));
}
/* Voxels of noise: every kind of cell, and ambiguous faces of every kind. */
static msq_model* noise_model(msq_context* context) {
  static float values[17 * 17 * 17];
  uint64_t state = 7;
  for (size_t i = 0; i < sizeof values / sizeof values[0]; ++i)
    values[i] = (float)random_between(&state, -1, 1);
  msq_voxels_def def;
  msq_shape* shape;
  assert_ok(msq_voxels_def_init(&def, sizeof def));
  def.image.values = values;
  def.image.value_type = MSQ_FLOAT32;
  for (int axis = 0; axis < 3; ++axis) {
    def.image.size[axis] = 17;
    def.image.grid.cell_size[axis] = 0.25;
  }
  assert_ok(msq_shape_from_voxels(context, &def, &shape));
  return make_shape_model(context, shape);
}
static msq_model* region_model(msq_context* context) {
  const double centre[3] = {2, 2, 2};
  msq_shape* ball;
  msq_model* both;
  assert_ok(msq_shape_from_sphere(context, centre, 1.5, &ball));
  msq_model* regions[2] = {make_model(context, ball, make_gyroid(context), NULL),
                           lattice_model(context)};
  assert_ok(msq_model_regions(context, (const msq_model* const*)regions, 2, &both));
  msq_model_release(regions[0]);
  msq_model_release(regions[1]);
  return both;
}

/* A wall along the diagonals of cells, thinner than the pitch: a vertex is on both its sides. */
static void normals_of_thin_walls_have_length_1(void** state) {
  static const double nodes[12] = {0, 0, 0, 1, 1, 0, 1, 1, 1, 0, 0, 1};
  static const uint32_t faces[6] = {0, 1, 2, 0, 2, 3};
  msq_context* context = make_context();
  msq_plate_lattice_def walls;
  msq_structure* structure;
  const msq_surface_def def = surface_def(0.25);
  (void)state;
  assert_ok(msq_plate_lattice_def_init(&walls, sizeof walls));
  walls.plate_cell = MSQ_PLATE_CELL_CUSTOM;
  walls.nodes = nodes;
  walls.node_count = 4;
  walls.faces = faces;
  walls.face_count = 2;
  walls.thickness.value = 0.02;
  assert_ok(msq_structure_plate_lattice(context, &walls, &structure));
  msq_model* model = make_model(context, make_box(context), structure, NULL);
  surface all = surface_of(model, &def);
  assert_manifold(&all);
  assert_true(all.vertex_count > 500);
  for (uint64_t v = 0; v < all.vertex_count; ++v) {
    const float* n = all.normals + 3 * v;
    assert_near(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-5);
  }
  free_surface(&all);
  msq_model_release(model);
  msq_context_release(context);
}

/* Whether all points of a half-ball about a direction are inside (1), outside (0) or neither. */
static int side_of(const msq_model* model, const double* p, const float* n, double radius) {
  int inside = 0, count = 0;
  for (int k = 0; k < 27; ++k) {
    const double way[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
    const double along = way[0] * n[0] + way[1] * n[1] + way[2] * n[2];
    if (along < 0.6) continue;
    double q[3];
    int32_t is_inside;
    for (int axis = 0; axis < 3; ++axis) q[axis] = p[axis] + radius * way[axis];
    assert_ok(msq_point_membership(model, q, NULL, &is_inside));
    inside += is_inside;
    ++count;
  }
  return inside == count ? 1 : inside == 0 ? 0 : -1;
}

static void check_sides(const msq_model* model, double pitch, double radius) {
  const msq_surface_def def = surface_def(pitch);
  surface all = surface_of(model, &def);
  uint64_t smooth = 0;
  for (uint64_t v = 0; v < all.vertex_count; ++v) {
    const float* n = all.normals + 3 * v;
    const float back[3] = {-n[0], -n[1], -n[2]};
    const double* p = all.vertices + 3 * v;
    const int ahead = side_of(model, p, n, radius), behind = side_of(model, p, back, radius);
    if (ahead == 1 && behind == 0) fail_msg("normal of (%g, %g, %g) is turned", p[0], p[1], p[2]);
    smooth += ahead == 0 && behind == 1;
  }
  assert_true(smooth > all.vertex_count / 3);
  free_surface(&all);
}

/* Where walls are about as thin as the pitch, vertices move from one side to the other. */
static void normals_of_thin_walls_look_outwards(void** state) {
  (void)state;
  msq_context* context = make_context();
  msq_model* model = make_model(context, make_box(context), make_gyroid(context), NULL);
  check_sides(model, 0.4, 2e-3);
  msq_model_release(model);
  msq_context_release(context);
}

/* There, ways to the boundary begin on a face of the box, inside the model. */
static void normals_beside_the_faces_of_a_box_look_outwards(void** state) {
  static const char* const structures[] = {
      "{\"functional\": {\"kind\": \"sheet\", \"thickness\": 0.1}}",
      "{\"plate_lattice\": {\"thickness\": 0.08, \"radius\": 0.1}}",
      "{\"foam\": {\"radius\": 0.1, \"wall_thickness\": 0.06}}"};
  (void)state;
  if (!MSQ_WITH_JSON) skip(); /* models are documents */
  msq_context* context = make_context();
  for (int i = 0; i < 3; ++i) {
    char text[512];
    snprintf(text, sizeof text,
             "{\"msq_model\": 1, \"scales\": [{\"shape\": {\"box\": {\"min\": [0, 0, 0], \"max\": "
             "[1.53, 1.57, 1.61]}}}, {\"structure\": %s}]}",
             structures[i]);
    msq_model* model = model_of(read_document(context, text));
    check_sides(model, 0.12, 5e-4);
    msq_model_release(model);
  }
  msq_context_release(context);
}

static void lattices(void** state) {
  (void)state;
  check_model(lattice_model, 0.08, 0.03);
}
static void foams(void** state) {
  (void)state;
  check_model(foam_model, 0.08, 0.04);
}
static void functions(void** state) {
  (void)state;
  check_model(gyroid_model, 0.08, 0.02);
}
static void nested_scales(void** state) {
  (void)state;
  check_model(nested_model, 0.05, 0.1);
}
static void noise(void** state) {
  (void)state;
  check_model(noise_model, 0.1, 0.02);
}
static void noise_at_its_pitch(void** state) {
  (void)state;
  check_model(noise_model, 0.249, 0.1);
}
static void regions(void** state) {
  (void)state;
  check_model(region_model, 0.08, 0.03);
}
/* Struts thinner than the pitch: pieces, but a manifold. */
static void too_coarse(void** state) {
  (void)state;
  check_model(foam_model, 0.31, 0.4);
}

/* Where cells are larger than 2^26 pitches, rays are less exact than vertices. */
static void huge_cells(void** state) {
  const double sizes[] = {1e8, 1e9};
  (void)state;
  for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; ++i) {
    msq_context* context = make_context();
    msq_shape* all_space;
    assert_ok(msq_shape_all_space(context, &all_space));
    msq_model* model = make_model(context, all_space,
                                  make_lattice_of(context, MSQ_UNIT_CELL_BCC, sizes[i], 1.3), NULL);
    msq_surface_def def = surface_def(0.5);
    def.has_box = 1;
    for (int axis = 0; axis < 3; ++axis) {
      def.min[axis] = -4.1 + 0.1 * axis;
      def.max[axis] = 4.3;
    }
    surface all = surface_of(model, &def);
    assert_true(all.vertex_count > 500);
    assert_manifold(&all);
    assert_on_boundary(model, &all, def.pitch, def.min, def.max, test_count(3000) + 50);
    free_surface(&all);
    msq_model_release(model);
    msq_context_release(context);
  }
}

static void boxes_cut_and_are_closed(void** state) {
  msq_context* context = make_context();
  msq_shape* all_space;
  assert_ok(msq_shape_all_space(context, &all_space));
  msq_model* model = make_model(context, all_space, make_lattice(context), NULL);
  msq_surface_def def = surface_def(0.07);
  (void)state;
  def.has_box = 1;
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = -1.3 + 0.1 * axis;
    def.max[axis] = 1.17;
  }
  surface all = surface_of(model, &def);
  assert_manifold(&all);
  assert_on_boundary(model, &all, def.pitch, def.min, def.max, test_count(3000) + 50);
  free_surface(&all);
  /* Nothing there. */
  msq_model* box = make_box_model(context);
  for (int axis = 0; axis < 3; ++axis) {
    def.min[axis] = 5;
    def.max[axis] = 6;
  }
  all = surface_of(box, &def);
  assert_int_equal(all.calls, 0);
  msq_model_release(box);
  msq_model_release(model);
  msq_context_release(context);
}

static void callbacks_stop_it(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  msq_surface_def def = surface_def(0.1);
  surface all;
  msq_job* job;
  (void)state;
  def.slab_layers = 4;
  memset(&all, 0, sizeof all);
  all.stop_with = -7;
  assert_ok(msq_job_create(&job));
  assert_refused(msq_surface_mesh(model, &def, take_surface, &all, job), MSQ_E_HOST, "-7");
  assert_int_equal(msq_error_host_code(), -7);
  assert_int_equal(all.calls, 1);
  assert_true(progress_of(job) < 1);
  free_surface(&all);
  assert_ok(msq_surface_mesh(model, &def, take_surface, &all, job));
  assert_true(progress_of(job) == 1);
  free_surface(&all);
  msq_job_release(job);
  msq_model_release(model);
  msq_context_release(context);
}

/* What is accounted does not grow with the height of the model. */
static void memory_is_bounded(void** state) {
  uint64_t peak[2];
  (void)state;
  for (int tall = 0; tall < 2; ++tall) {
    const double max[3] = {4, 4, tall ? 32 : 8};
    msq_context* context = make_context_of(1, 0, 0);
    msq_shape* box;
    assert_ok(msq_shape_from_box(context, corner, max, &box));
    msq_model* model = make_model(context, box, make_lattice(context), NULL);
    msq_surface_def def = surface_def(0.125);
    def.slab_layers = 8;
    surface all = surface_of(model, &def);
    peak[tall] = memory_of(context).peak_bytes;
    free_surface(&all);
    msq_model_release(model);
    msq_context_release(context);
  }
  assert_true((double)peak[1] < 1.05 * (double)peak[0]);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(def_init_sets_defaults),
      cmocka_unit_test(a_box_is_exact),
      cmocka_unit_test(features_are_kept),
      cmocka_unit_test(normals_are_those_of_the_surface),
      cmocka_unit_test(normals_of_thin_walls_have_length_1),
      cmocka_unit_test(normals_of_thin_walls_look_outwards),
      cmocka_unit_test(normals_beside_the_faces_of_a_box_look_outwards),
      cmocka_unit_test(lattices),
      cmocka_unit_test(foams),
      cmocka_unit_test(functions),
      cmocka_unit_test(nested_scales),
      cmocka_unit_test(noise),
      cmocka_unit_test(noise_at_its_pitch),
      cmocka_unit_test(huge_cells),
      cmocka_unit_test(regions),
      cmocka_unit_test(too_coarse),
      cmocka_unit_test(boxes_cut_and_are_closed),
      cmocka_unit_test(callbacks_stop_it),
      cmocka_unit_test(memory_is_bounded),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
