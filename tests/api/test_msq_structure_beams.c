/* SPDX-License-Identifier: Apache-2.0
 * msq_beams_def_init, msq_structure_beams. Trees, distances and rays of beams: unit/test_beams.cpp.
 */

#include "beams.h"

static void defaults_are_those_of_the_header(void** state) {
  msq_beams_def def, zero;
  (void)state;
  memset(&zero, 0, sizeof zero);
  zero.struct_size = sizeof zero;
  zero.cap = MSQ_CAP_SPHERE;
  zero.coordinate_type = MSQ_FLOAT64;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  assert_memory_equal(&def, &zero, sizeof def);
}

/* ---- the solid */

static void a_beam_ends_in_its_caps(void** state) {
  /* Beside the axis, beyond an end on the axis, beyond an end beside the axis. */
  msq_context* context = make_context();
  (void)state;
  for (int32_t cap = MSQ_CAP_SPHERE; cap <= MSQ_CAP_BUTT; ++cap) {
    const msq_beams_def def = beam_def(0.5, cap);
    msq_model* model = model_of(context, &def);
    const int is_round = cap != MSQ_CAP_BUTT;
    assert_int_equal(is_inside(model, 0, 0, 0), 1);
    assert_int_equal(is_inside(model, 0.25, 0.5, 0), 1); /* the boundary */
    assert_int_equal(is_inside(model, 0.25, 0.501, 0), 0);
    assert_int_equal(is_inside(model, 1, 0, 0.499), 1);
    for (int side = -1; side <= 1; side += 2) {
      assert_int_equal(is_inside(model, side * 1.0, 0, -0.499), 1);
      assert_int_equal(is_inside(model, side * 1.001, 0, 0), is_round);
      assert_int_equal(is_inside(model, side * 1.499, 0, 0), is_round);
      assert_int_equal(is_inside(model, side * 1.35, 0.35, 0), is_round);
      assert_int_equal(is_inside(model, side * 1.501, 0, 0), 0);
      assert_int_equal(is_inside(model, side * 1.36, 0.36, 0), 0);
    }
    msq_model_release(model);
  }
  msq_context_release(context);
}

/* Radius 1 at x = -1, 0.25 at x = 1. */
static void unlike_radii_are_linear_between(void** state) {
  const double unlike[2] = {1, 0.25};
  msq_context* context = make_context();
  (void)state;
  for (int32_t cap = MSQ_CAP_SPHERE; cap <= MSQ_CAP_BUTT; ++cap) {
    msq_beams_def def = beam_def(NAN, cap);
    def.radii = unlike;
    def.radius = 0;
    msq_model* model = model_of(context, &def);
    assert_int_equal(is_inside(model, 0, 0.624, 0), 1);
    assert_int_equal(is_inside(model, 0, 0.626, 0), 0);
    assert_int_equal(is_inside(model, 0.5, 0, 0.437), 1);
    assert_int_equal(is_inside(model, 0.5, 0, 0.438), 0);
    /* The ball of the thicker end protrudes from the side. */
    assert_int_equal(is_inside(model, -0.8, 0.96, 0), cap == MSQ_CAP_SPHERE);
    assert_int_equal(is_inside(model, -1.99, 0, 0), cap != MSQ_CAP_BUTT);
    assert_int_equal(is_inside(model, 1.24, 0, 0), cap != MSQ_CAP_BUTT);
    assert_int_equal(is_inside(model, 1.26, 0, 0), 0);
    msq_model_release(model);
  }
  msq_context_release(context);
}

/* A frustum of a list, with its caps. */
static int beam_holds(const double p[3], const double a[3], const double b[3], const double r[2],
                      const uint8_t cap[2]) {
  double squared = 0, along = 0, from_a = 0, from_b = 0, off = 0;
  for (int k = 0; k < 3; ++k) {
    squared += (b[k] - a[k]) * (b[k] - a[k]);
    along += (p[k] - a[k]) * (b[k] - a[k]);
    from_a += (p[k] - a[k]) * (p[k] - a[k]);
    from_b += (p[k] - b[k]) * (p[k] - b[k]);
  }
  const double t = squared > 0 ? along / squared : 0;
  const int beyond_a = squared == 0 || t < 0, beyond_b = squared == 0 || t > 1;
  if (cap[0] != MSQ_CAP_BUTT && (cap[0] == MSQ_CAP_SPHERE || beyond_a) && from_a <= r[0] * r[0])
    return 1;
  if (cap[1] != MSQ_CAP_BUTT && (cap[1] == MSQ_CAP_SPHERE || beyond_b) && from_b <= r[1] * r[1])
    return 1;
  if (beyond_a || beyond_b) return 0;
  for (int k = 0; k < 3; ++k) {
    const double away = p[k] - a[k] - t * (b[k] - a[k]);
    off += away * away;
  }
  return sqrt(off) <= r[0] + t * (r[1] - r[0]);
}

static int frame_holds(const double p[3]) {
  const uint8_t sphere[2] = {MSQ_CAP_SPHERE, MSQ_CAP_SPHERE};
  for (int i = 0; i < beam_count; ++i)
    if (beam_holds(p, nodes[beams[i][0]], nodes[beams[i][1]], radii[i], caps[i])) return 1;
  for (int i = 0; i < ball_count; ++i) {
    const double both[2] = {ball_radii[i], ball_radii[i]};
    if (beam_holds(p, nodes[balls[i]], nodes[balls[i]], both, sphere)) return 1;
  }
  return 0;
}

/* Whether rounding may decide. */
static int is_near_boundary(const double p[3]) {
  const int here = frame_holds(p);
  for (int k = 0; k < 6; ++k) {
    double moved[3] = {p[0], p[1], p[2]};
    moved[k / 2] += k % 2 ? 1e-9 : -1e-9;
    if (frame_holds(moved) != here) return 1;
  }
  return 0;
}

enum { side = 24, sample_count = side * side * side };

static void ask_grid(const msq_model* model, uint8_t* inside) {
  const msq_points_def grid = grid_points(-3.03125, 3.03125, side);
  assert_ok(msq_set_membership(model, &grid, NULL, inside, sample_count, NULL));
}

static void lists_are_the_union_of_beams_and_balls(void** state) {
  const size_t count = test_count(20000);
  double(*points)[3] = (double(*)[3])malloc(count * sizeof *points);
  uint8_t* inside = (uint8_t*)malloc(count);
  uint64_t random = 5;
  size_t held = 0;
  msq_context* context = make_context();
  const msq_beams_def def = frame_def();
  msq_model* model = model_of(context, &def);
  msq_points_def array;
  (void)state;
  for (size_t i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = random_between(&random, -3.5, 3.5);
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.coordinates = points;
  array.count = count;
  assert_ok(msq_set_membership(model, &array, NULL, inside, count, NULL));
  for (size_t i = 0; i < count; ++i) {
    assert_int_equal(inside[i], is_inside(model, points[i][0], points[i][1], points[i][2]));
    if (is_near_boundary(points[i])) continue;
    assert_int_equal(inside[i], frame_holds(points[i]));
    held += inside[i];
  }
  assert_in_range(held, count / 50, count / 2);
  msq_model_release(model);
  msq_context_release(context);
  free(points);
  free(inside);
}

static void grids_and_slices_are_membership_of_points(void** state) {
  static uint8_t inside[sample_count];
  const double low = -3.03125, step = 6.0625 / (side - 1);
  msq_context* context = make_context();
  const msq_beams_def def = frame_def();
  msq_model* model = model_of(context, &def);
  const msq_slicer_def plan = slicer_def(MSQ_LAYER_BITS, 90, 70, 0.4);
  (void)state;
  ask_grid(model, inside);
  for (int i = 0; i < sample_count; ++i)
    assert_int_equal(inside[i],
                     is_inside(model, low + i % side * step, low + i / side % side * step,
                               low + i / side / side * step));
  msq_slicer* slicer = make_slicer(model, &plan);
  layer_stack stack = run_all(slicer, MSQ_LAYER_BITS);
  assert_true(count_bits(stack.data, stack.taken * stack.plan.layer_bytes) > 1000);
  assert_layers_of(&stack, model, slicer, 0, 1);
  free_stack(&stack);
  msq_slicer_release(slicer);
  msq_model_release(model);
  msq_context_release(context);
}

/* `count` elements of `bytes` bytes, each `stride` after the last, from an odd address on. */
static void* spread(const void* data, size_t count, size_t bytes, size_t stride) {
  unsigned char* made = (unsigned char*)malloc(count * stride + 1);
  assert_non_null(made);
  memset(made, 0xff, count * stride + 1);
  for (size_t i = 0; i < count; ++i)
    memcpy(made + 1 + i * stride, (const unsigned char*)data + i * bytes, bytes);
  return made;
}

/* float32 or float64, with strides or packed, from any thread count; and copied. */
static void layouts_change_no_answer(void** state) {
  static uint8_t expected[sample_count], inside[sample_count];
  static float small_nodes[node_count][3], small_radii[beam_count][2], small_balls[ball_count];
  (void)state;
  for (int i = 0; i < node_count * 3; ++i) small_nodes[i / 3][i % 3] = (float)nodes[i / 3][i % 3];
  for (int i = 0; i < beam_count * 2; ++i) small_radii[i / 2][i % 2] = (float)radii[i / 2][i % 2];
  for (int i = 0; i < ball_count; ++i) small_balls[i] = (float)ball_radii[i];
  for (int which = 0; which < 6; ++which) {
    const int is_small = which & 1;
    const size_t bytes = is_small ? sizeof(float) : sizeof(double);
    msq_context* context = make_context_of(which < 4 ? 1 : 2, 0, 0);
    msq_beams_def def = frame_def();
    unsigned char* kept[6] = {NULL};
    if (is_small) {
      def.coordinate_type = MSQ_FLOAT32;
      def.nodes = small_nodes;
      def.radii = small_radii;
      def.ball_radii = small_balls;
    }
    if (which >= 2) {
      def.node_stride = 3 * bytes + 5;
      def.beam_stride = 11;
      def.radius_stride = 2 * bytes + 1;
      def.cap_stride = 3;
      def.ball_stride = 7;
      def.ball_radius_stride = bytes + 3;
      kept[0] = (unsigned char*)spread(def.nodes, node_count, 3 * bytes, def.node_stride);
      kept[1] = (unsigned char*)spread(def.beams, beam_count, 8, def.beam_stride);
      kept[2] = (unsigned char*)spread(def.radii, beam_count, 2 * bytes, def.radius_stride);
      kept[3] = (unsigned char*)spread(def.caps, beam_count, 2, def.cap_stride);
      kept[4] = (unsigned char*)spread(def.balls, ball_count, 4, def.ball_stride);
      kept[5] = (unsigned char*)spread(def.ball_radii, ball_count, bytes, def.ball_radius_stride);
      def.nodes = kept[0] + 1;
      def.beams = (const uint32_t*)(const void*)(kept[1] + 1);
      def.radii = kept[2] + 1;
      def.caps = kept[3] + 1;
      def.balls = (const uint32_t*)(const void*)(kept[4] + 1);
      def.ball_radii = kept[5] + 1;
    }
    msq_model* model = model_of(context, &def);
    for (int i = 0; i < 6; ++i) free(kept[i]);
    ask_grid(model, which == 0 ? expected : inside);
    if (which > 0) assert_memory_equal(inside, expected, sample_count);
    msq_model_release(model);
    assert_int_equal(memory_of(context).bytes, 0);
    msq_context_release(context);
  }
}

static void balls_stand_alone(void** state) {
  const double centres[2][3] = {{0, 0, 0}, {2, 0, 0}};
  const uint32_t both[2] = {0, 1};
  msq_context* context = make_context();
  msq_beams_def def;
  double length;
  (void)state;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = centres;
  def.node_count = 2;
  def.balls = both;
  def.ball_count = 2;
  def.ball_radius = 0.5;
  msq_model* model = model_of(context, &def);
  assert_int_equal(is_inside(model, 0, 0.499, 0), 1);
  assert_int_equal(is_inside(model, 2.499, 0, 0), 1);
  assert_int_equal(is_inside(model, 1, 0, 0), 0);
  assert_int_equal(is_inside(model, 0, 0.36, 0.36), 0);
  assert_ok(msq_model_scale_length(model, 1, &length));
  assert_true(length == 1);
  msq_model_release(model);
  msq_context_release(context);
}

/* A beam of length 1, and one of 0.25. */
static void shorter_beams_are_dropped(void** state) {
  const double some[4][3] = {{-1, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 0, 0.25}};
  const uint32_t pairs[2][2] = {{0, 1}, {2, 3}}, ball = 3;
  const double lengths[] = {0, 0.25, 0.2500001, 1, 1.5};
  msq_context* context = make_context();
  msq_beams_def def;
  (void)state;
  assert_ok(msq_beams_def_init(&def, sizeof def));
  def.nodes = some;
  def.node_count = 4;
  def.beams = pairs[0];
  def.beam_count = 2;
  def.radius = 0.125;
  for (int i = 0; i < 4; ++i) {
    def.min_length = lengths[i];
    msq_model* model = model_of(context, &def);
    assert_int_equal(is_inside(model, -0.5, 0, 0), 1);
    assert_int_equal(is_inside(model, 2, 0, 0.125), i < 2);
    msq_model_release(model);
  }
  def.min_length = lengths[4];
  assert_refused(create(context, &def), MSQ_E_ARGUMENT, "2 beams and balls");
  assert_message_has("min_length");
  def.balls = &ball; /* which have no length, and stay */
  def.ball_count = 1;
  def.ball_radius = 0.125;
  msq_model* model = model_of(context, &def);
  assert_int_equal(is_inside(model, -0.5, 0, 0), 0);
  assert_int_equal(is_inside(model, 2, 0, 0.2), 1);
  msq_model_release(model);
  msq_context_release(context);
}

static void scale_has_the_length_that_is_given(void** state) {
  const double radius[] = {0.5, 1.5, 0.5}, given[] = {0, 0, 0.25}, expected[] = {2, 3, 0.25};
  msq_context* context = make_context();
  (void)state;
  for (int i = 0; i < 3; ++i) {
    msq_beams_def def = beam_def(radius[i], MSQ_CAP_SPHERE);
    double length;
    def.length_scale = given[i];
    msq_model* model = model_of(context, &def);
    assert_ok(msq_model_scale_length(model, 1, &length));
    assert_true(length == expected[i]);
    msq_model_release(model);
  }
  msq_context_release(context);
}

static void rays_and_distances_meet_the_beam(void** state) {
  const double origins[3][3] = {{0, 3, 0}, {-3, 0, 0}, {0, 3, 1}};
  const double directions[3][3] = {{0, -2, 0}, {1, 0, 0}, {0, -1, 0}};
  const double above[3] = {0, 2, 0}, beyond[3] = {2, 1, 0}, within[3] = {0, 0.125, 0};
  msq_context* context = make_context();
  const msq_beams_def def = beam_def(0.5, MSQ_CAP_SPHERE);
  msq_model* model = model_of(context, &def);
  msq_rays_def rays;
  msq_ray_hit hits[3];
  double distance;
  (void)state;
  assert_ok(msq_rays_def_init(&rays, sizeof rays));
  rays.origins = origins;
  rays.directions = directions;
  rays.count = 3;
  assert_ok(msq_ray_cast(model, &rays, NULL, hits, 3, NULL));
  assert_near(hits[0].t, 1.25, 1e-9);
  assert_near(hits[0].normal[1], 1, 1e-9);
  assert_near(hits[1].t, 1.5, 1e-9);
  assert_near(hits[1].normal[0], -1, 1e-9);
  assert_true(isinf(hits[2].t));
  for (int i = 0; i < 2; ++i) {
    assert_int_equal(hits[i].scale, 1);
    assert_int_equal(hits[i].starts_inside, 0);
    for (int axis = 0; axis < 3; ++axis) assert_int_equal(hits[i].cell[axis], 0);
  }
  assert_ok(msq_point_distance(model, above, NULL, &distance));
  assert_near(distance, 1.5, 1e-9);
  assert_ok(msq_point_distance(model, beyond, NULL, &distance));
  assert_near(distance, sqrt(2) - 0.5, 1e-9);
  assert_ok(msq_point_distance(model, within, NULL, &distance));
  assert_near(distance, -0.375, 1e-9);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(a_beam_ends_in_its_caps),
      cmocka_unit_test(unlike_radii_are_linear_between),
      cmocka_unit_test(lists_are_the_union_of_beams_and_balls),
      cmocka_unit_test(grids_and_slices_are_membership_of_points),
      cmocka_unit_test(layouts_change_no_answer),
      cmocka_unit_test(balls_stand_alone),
      cmocka_unit_test(shorter_beams_are_dropped),
      cmocka_unit_test(scale_has_the_length_that_is_given),
      cmocka_unit_test(rays_and_distances_meet_the_beam),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
