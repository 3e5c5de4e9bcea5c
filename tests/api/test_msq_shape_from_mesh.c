/* SPDX-License-Identifier: Apache-2.0
 * msq_mesh_def_init, msq_shape_from_mesh. The diagnosis of meshes: test_msq_shape_info.c. */
#include "definitions.h"

static double corners[8][3];

static int set_corners(void** state) {
  (void)state;
  cube_corners(0, 4, corners);
  return 0;
}

static msq_mesh_def cube_def(void) {
  return mesh_def((const double(*)[3])corners, 8, cube_triangles(), 12);
}

static void defaults_are_those_of_the_header(void** state) {
  msq_mesh_def def;
  (void)state;
  assert_ok(msq_mesh_def_init(&def, sizeof def));
  assert_int_equal(def.coordinate_type, MSQ_FLOAT64);
  assert_int_equal(def.winding_rule, MSQ_WINDING_AUTO);
  assert_int_equal(def.vertex_stride, 0);
  assert_null(def.vertices);
  assert_null(def.triangles);
}

/* An older caller without triangles has none. */
static void assert_same_points(const msq_model* a, const msq_model* b, const msq_points_def* points,
                               uint64_t count) {
  uint8_t *in_a = (uint8_t*)malloc(count), *in_b = (uint8_t*)malloc(count);
  assert_ok(msq_set_membership(a, points, NULL, in_a, count, NULL));
  assert_ok(msq_set_membership(b, points, NULL, in_b, count, NULL));
  assert_memory_equal(in_a, in_b, count);
  free(in_a);
  free(in_b);
}

static void cube_is_the_box_away_from_its_boundary(void** state) {
  const msq_points_def points = grid_points(-0.55, 4.55, 31); /* steps of 0.17 */
  msq_context* context = make_context();
  msq_model* cube = make_shape_model(context, make_cube_mesh(context));
  msq_model* box = make_box_model(context);
  (void)state;
  assert_same_points(cube, box, &points, 31 * 31 * 31);
  msq_model_release(cube);
  msq_model_release(box);
  msq_context_release(context);
}

static void boundary_is_closed_in_x_and_half_open_in_y_and_z(void** state) {
  msq_context* context = make_context();
  msq_model* cube = make_shape_model(context, make_cube_mesh(context));
  (void)state;
  assert_int_equal(is_inside(cube, 0, 1, 1.5), 1);
  assert_int_equal(is_inside(cube, 4, 1, 1.5), 1);
  assert_int_equal(is_inside(cube, 1, 0, 1.5), 1);
  assert_int_equal(is_inside(cube, 1, 4, 1.5), 0);
  assert_int_equal(is_inside(cube, 1, 1.5, 0), 1);
  assert_int_equal(is_inside(cube, 1, 1.5, 4), 0);
  assert_int_equal(is_inside(cube, 0, 0, 0), 1);
  assert_int_equal(is_inside(cube, 4, 0, 0), 1);
  assert_int_equal(is_inside(cube, nextafter(4, 5), 1, 1.5), 0);
  assert_int_equal(is_inside(cube, -5e-324, 1, 1.5), 0);
  assert_int_equal(is_inside(cube, 2, 2, 2), 1); /* on diagonals of four sides */
  msq_model_release(cube);
  msq_context_release(context);
}

/* Float coordinates, or doubles, `stride` bytes apart at an odd address. */
static void check_strided(msq_context* context, int32_t type, uint64_t stride) {
  const msq_points_def points = grid_points(-0.55, 4.55, 16);
  unsigned char bytes[8 * 64 + 1];
  msq_mesh_def def = cube_def();
  memset(bytes, struct_pattern, sizeof bytes);
  for (int i = 0; i < 8; ++i) {
    float single[3];
    for (int axis = 0; axis < 3; ++axis) single[axis] = (float)corners[i][axis];
    if (type == MSQ_FLOAT32)
      memcpy(bytes + 1 + (uint64_t)i * stride, single, sizeof single);
    else
      memcpy(bytes + 1 + (uint64_t)i * stride, corners[i], sizeof corners[i]);
  }
  def.vertices = bytes + 1;
  def.vertex_stride = stride;
  def.coordinate_type = type;
  msq_shape* shape = make_mesh(context, &def);
  assert_true(info_of(shape).volume == 64);
  msq_model *strided = make_shape_model(context, shape), *box = make_box_model(context);
  assert_same_points(strided, box, &points, 16 * 16 * 16);
  msq_model_release(strided);
  msq_model_release(box);
}

static void vertices_have_any_type_and_stride(void** state) {
  msq_context* context = make_context();
  (void)state;
  check_strided(context, MSQ_FLOAT64, 24);
  check_strided(context, MSQ_FLOAT64, 25);
  check_strided(context, MSQ_FLOAT64, 63);
  check_strided(context, MSQ_FLOAT32, 12);
  check_strided(context, MSQ_FLOAT32, 13);
  check_strided(context, MSQ_FLOAT32, 32);
  msq_context_release(context);
}

static void arrays_are_copied(void** state) {
  double own[8][3];
  uint32_t triangles[12][3];
  msq_context* context = make_context();
  (void)state;
  memcpy(own, corners, sizeof own);
  memcpy(triangles, cube_triangles(), sizeof triangles);
  const msq_mesh_def def =
      mesh_def((const double(*)[3])own, 8, (const uint32_t(*)[3])triangles, 12);
  msq_shape* shape = make_mesh(context, &def);
  memset(own, 0xff, sizeof own);
  memset(triangles, 0xff, sizeof triangles);
  msq_model* model = make_shape_model(context, shape);
  assert_int_equal(is_inside(model, 1, 2, 3), 1);
  assert_int_equal(is_inside(model, 1, 2, 4.5), 0);
  msq_model_release(model);
  msq_context_release(context);
}

/* Which of the rules NONZERO, EVEN_ODD, POSITIVE have the point inside, as bits 1, 2, 4. AUTO is
 * NONZERO for closed meshes. */
static int rules_at(msq_context* context, msq_mesh_def def, double x, double y, double z) {
  int rules = 0;
  for (int32_t rule = MSQ_WINDING_NONZERO; rule <= MSQ_WINDING_AUTO; ++rule) {
    def.winding_rule = rule;
    msq_model* model = make_shape_model(context, make_mesh(context, &def));
    rules |= is_inside(model, x, y, z) << rule;
    msq_model_release(model);
  }
  assert_int_equal(rules >> MSQ_WINDING_AUTO, rules & 1);
  return rules & 7;
}

/* The cube without its side at x = 4. */
static msq_mesh_def half_open_cube_def(uint32_t (*triangles)[3]) {
  uint32_t count = 0;
  for (int i = 0; i < 12; ++i) {
    const uint32_t* t = cube_triangles()[i];
    if (corners[t[0]][0] + corners[t[1]][0] + corners[t[2]][0] < 12)
      memcpy(triangles[count++], t, sizeof *triangles);
  }
  assert_int_equal(count, 10);
  return mesh_def((const double(*)[3])corners, 8, (const uint32_t(*)[3])triangles, count);
}

/* Seen from inside, the missing side takes less than half of all directions. */
static void cube_without_a_side_is_the_box_by_auto(void** state) {
  const msq_points_def points = grid_points(-0.55, 4.55, 31);
  uint32_t triangles[12][3];
  msq_context* context = make_context();
  msq_mesh_def def = half_open_cube_def(triangles);
  (void)state;
  msq_model* cube = make_shape_model(context, make_mesh(context, &def));
  msq_model* box = make_box_model(context);
  assert_same_points(cube, box, &points, 31 * 31 * 31);
  msq_model_release(cube);
  /* By NONZERO rays to +x leave through the hole. */
  def.winding_rule = MSQ_WINDING_NONZERO;
  msq_model* leaking = make_shape_model(context, make_mesh(context, &def));
  assert_int_equal(is_inside(leaking, 1, 2, 3), 0);
  msq_model_release(leaking);
  msq_model_release(box);
  msq_context_release(context);
}

/* In the plane of the hole, at x = 4, the winding number is 1/2 except for rounding. Few rays
 * meet struts of the lattice, so each part of the cube that rounding makes is left for the next
 * one. */
static void rays_in_the_plane_of_a_hole_end(void** state) {
  enum { count = 64 };
  uint32_t triangles[12][3];
  double origins[count][3], directions[count][3];
  msq_ray_hit hits[count];
  msq_rays_def rays;
  msq_context* context = make_context();
  const msq_mesh_def def = half_open_cube_def(triangles);
  msq_model* model = make_model(context, make_mesh(context, &def),
                                make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 3, 0.01), NULL);
  (void)state;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.09 * i;
    directions[i][0] = 0;
    directions[i][1] = cos(angle);
    directions[i][2] = sin(angle);
    origins[i][0] = 4;
    origins[i][1] = 2 + 0.02 * i - 3 * directions[i][1];
    origins[i][2] = 2 - 3 * directions[i][2];
  }
  assert_ok(msq_rays_def_init(&rays, sizeof rays));
  rays.count = count;
  rays.origins = origins;
  rays.directions = directions;
  assert_ok(msq_ray_cast(model, &rays, NULL, hits, count, NULL));
  /* Some meet struts along x that cross the plane. */
  int met = 0;
  for (int i = 0; i < count; ++i)
    if (hits[i].scale >= 0) {
      assert_true(hits[i].t > 0 && hits[i].t < 7);
      ++met;
    }
  assert_true(met < count / 4);
  msq_model_release(model);
  msq_context_release(context);
}

static void inside_out_cube_has_winding_minus_1(void** state) {
  uint32_t flipped[12][3];
  msq_context* context = make_context();
  (void)state;
  for (int i = 0; i < 12; ++i) {
    flipped[i][0] = cube_triangles()[i][0];
    flipped[i][1] = cube_triangles()[i][2];
    flipped[i][2] = cube_triangles()[i][1];
  }
  const msq_mesh_def def =
      mesh_def((const double(*)[3])corners, 8, (const uint32_t(*)[3])flipped, 12);
  assert_int_equal(rules_at(context, def, 1, 2, 3), 1 | 2);
  assert_int_equal(rules_at(context, def, 1, 2, 4.5), 0);
  msq_context_release(context);
}

/* Two cubes, the second turned as told: the first from 0 to 4, the other from 2 to 6. */
static void check_two_cubes(int is_second_flipped, int in_first, int in_both, int in_second) {
  double vertices[16][3];
  uint32_t triangles[24][3];
  msq_context* context = make_context();
  cube_corners(0, 4, vertices);
  cube_corners(2, 6, vertices + 8);
  for (int i = 0; i < 12; ++i)
    for (int v = 0; v < 3; ++v) {
      triangles[i][v] = cube_triangles()[i][v];
      triangles[12 + i][is_second_flipped ? 2 - v : v] = cube_triangles()[i][v] + 8;
    }
  const msq_mesh_def def =
      mesh_def((const double(*)[3])vertices, 16, (const uint32_t(*)[3])triangles, 24);
  assert_int_equal(rules_at(context, def, 1, 1.2, 1.3), in_first);
  assert_int_equal(rules_at(context, def, 3, 3.2, 3.3), in_both);
  assert_int_equal(rules_at(context, def, 5, 5.2, 5.3), in_second);
  assert_int_equal(rules_at(context, def, 5, 1.2, 1.3), 0);
  msq_context_release(context);
}

static void overlapping_cubes_have_winding_2(void** state) {
  (void)state;
  check_two_cubes(0, 1 | 2 | 4, 1 | 4, 1 | 2 | 4);
}

static void cubes_of_opposite_turn_cancel(void** state) {
  (void)state;
  check_two_cubes(1, 1 | 2 | 4, 0, 1 | 2);
}

/* On a slanted face rounding decides; next to it the side does, and on faces along the axes, above,
 * nothing but the rule. */
static void slanted_faces_hold_to_rounding(void** state) {
  const double vertices[4][3] = {{0, 0, 0}, {3, 0, 0}, {0, 5, 0}, {0, 0, 7}};
  const uint32_t triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  msq_context* context = make_context();
  msq_mesh_def def;
  uint64_t random = 3;
  int inside = 0, outside = 0;
  (void)state;
  assert_ok(msq_mesh_def_init(&def, sizeof def));
  def.vertices = vertices;
  def.vertex_count = 4;
  def.triangles = triangles[0];
  def.triangle_count = 4;
  msq_model* model = make_shape_model(context, make_mesh(context, &def));
  for (int i = 0; i < 1000; ++i) {
    const double a = random_between(&random, 0.1, 0.8);
    const double b = random_between(&random, 0.05, 0.9 - a);
    const double y = 5 * a, z = 7 * b, x = 3 * (1 - a - b);
    assert_int_equal(is_inside(model, x * (1 - 1e-14), y, z), 1);
    assert_int_equal(is_inside(model, x + 1e-14, y, z), 0);
    if (is_inside(model, x, y, z))
      ++inside;
    else
      ++outside;
  }
  assert_in_range(inside, 1, 999);
  assert_in_range(outside, 1, 999);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(cube_is_the_box_away_from_its_boundary),
      cmocka_unit_test(boundary_is_closed_in_x_and_half_open_in_y_and_z),
      cmocka_unit_test(vertices_have_any_type_and_stride),
      cmocka_unit_test(arrays_are_copied),
      cmocka_unit_test(cube_without_a_side_is_the_box_by_auto),
      cmocka_unit_test(rays_in_the_plane_of_a_hole_end),
      cmocka_unit_test(inside_out_cube_has_winding_minus_1),
      cmocka_unit_test(overlapping_cubes_have_winding_2),
      cmocka_unit_test(cubes_of_opposite_turn_cancel),
      cmocka_unit_test(slanted_faces_hold_to_rounding),
  };
  return cmocka_run_group_tests(tests, set_corners, NULL);
}
