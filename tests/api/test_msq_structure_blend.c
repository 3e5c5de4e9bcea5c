/* SPDX-License-Identifier: Apache-2.0
 * msq_structure_blend. */
#include "combined.h"
#include "struts.h"

/* From 0 at x = 1 to 1 at x = 3. */
static msq_field* rising(msq_context* context) {
  const double from[3] = {1, 0, 0}, to[3] = {3, 0, 0};
  msq_field* field;
  assert_ok(msq_field_gradient(context, from, 0, to, 1, &field));
  return field;
}

static msq_structure* blend_of(const msq_structure* a, const msq_structure* b, double fraction,
                               const msq_field* field) {
  const msq_param part = {fraction, field};
  msq_structure* made;
  assert_ok(msq_structure_blend(a, b, &part, &made));
  return made;
}

/* The sign of the blended distances is the membership. */
static void distances_are_blended(void** state) {
  msq_context* context = make_context();
  msq_structure* foam = make_foam_with(context, 0.15, 0);
  msq_structure* gyroid = make_gyroid(context);
  msq_field* field = rising(context);
  msq_structure* made = blend_of(foam, gyroid, 0, field);
  msq_model *a = in_all_space(context, foam), *b = in_all_space(context, gyroid);
  msq_model* model = in_all_space(context, made);
  uint64_t random = 3;
  size_t held = 0, between = 0;
  (void)state;
  for (size_t n = 0; n < 5000; ++n) {
    double p[3], of_a, of_b, distance;
    for (int axis = 0; axis < 3; ++axis) p[axis] = random_between(&random, 0, 4);
    const double f = fmin(fmax((p[0] - 1) / 2, 0), 1);
    assert_ok(msq_point_distance(a, p, NULL, &of_a));
    assert_ok(msq_point_distance(b, p, NULL, &of_b));
    assert_ok(msq_point_distance(model, p, NULL, &distance));
    const int in = is_inside(model, p[0], p[1], p[2]);
    const double value = (1 - f) * of_a + f * of_b;
    if (fabs(value) > 1e-12) assert_int_equal(in, value <= 0);
    assert_true(in ? distance <= 0 : distance > 0);
    assert_true(fabs(distance) <= fmax(fabs(value), fmin(fabs(of_a), fabs(of_b))) + 1e-12);
    if ((of_a <= 0) == (of_b <= 0)) assert_int_equal(in, of_a <= 0);
    between += (of_a <= 0) != (of_b <= 0) && in;
    held += (size_t)in;
  }
  assert_in_range(held, 100, 4900);
  assert_true(between > 50);
  msq_model_release(model);
  msq_model_release(b);
  msq_model_release(a);
  msq_structure_release(made);
  msq_field_release(field);
  msq_structure_release(gyroid);
  msq_structure_release(foam);
  msq_context_release(context);
}

/* Layers are those of a where the fraction is 0, those of b where it is 1, and between the two in
 * between; with a number that is 0 or 1 they are the bytes of one of them. */
static void layers_change_from_one_to_the_other(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.2);
  msq_structure* foam = make_foam_with(context, 0.2, 0);
  msq_field* field = rising(context);
  msq_structure* made[4] = {blend_of(lattice, foam, 0, NULL), blend_of(lattice, foam, 1, NULL),
                            blend_of(lattice, foam, 0, field), blend_of(lattice, foam, 0.5, NULL)};
  layer_stack a = layers_of(context, lattice), b = layers_of(context, foam), of[4];
  const uint64_t bytes = a.taken * a.plan.layer_bytes;
  size_t mixed = 0;
  (void)state;
  for (int i = 0; i < 4; ++i) of[i] = layers_of(context, made[i]);
  assert_memory_equal(of[0].data, a.data, bytes);
  assert_memory_equal(of[1].data, b.data, bytes);
  for (uint64_t i = 0; i < bytes; ++i)
    for (int n = 2; n < 4; ++n) {
      const unsigned in = of[n].data[i], both = a.data[i] & b.data[i];
      assert_int_equal(in & both, both);
      assert_int_equal(in & ~(a.data[i] | b.data[i]), 0);
      if (n == 2) {
        const uint64_t first = i % a.plan.stride * 8; /* 150 pixels over 4 */
        if (first + 7 < 37) assert_int_equal(in, a.data[i]);
        if (first > 112) assert_int_equal(in, b.data[i]);
      }
      mixed += in != a.data[i] && in != b.data[i];
    }
  assert_true(mixed > 20);
  for (int i = 0; i < 4; ++i) {
    free_stack(&of[i]);
    msq_structure_release(made[i]);
  }
  free_stack(&a);
  free_stack(&b);
  msq_field_release(field);
  msq_structure_release(foam);
  msq_structure_release(lattice);
  msq_context_release(context);
}

/* A fraction that has no Lipschitz constant, or one in boxes only: the same membership in sets,
 * grids and points, and a distance whose balls meet no boundary. */
static void any_field_may_blend(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice_of(context, MSQ_UNIT_CELL_OCTET, 1, 0.1);
  msq_structure* gyroid = make_gyroid(context);
  const char* const texts[2] = {"0.5 + 0.5 * sin(2 * x + y) * cos(z)", "sqrt(max(0, x - 2) / 2)"};
  (void)state;
  for (int n = 0; n < 2; ++n) {
    msq_expression_field_def def;
    msq_field* field;
    assert_ok(msq_expression_field_def_init(&def, sizeof def));
    def.expression = texts[n];
    def.low = 0;
    def.high = 1;
    assert_ok(msq_field_expression(context, &def, &field));
    msq_structure* made = blend_of(lattice, gyroid, 0, field);
    msq_model* model = model_with(context, make_box(context), made);
    const msq_points_def points = grid_points(0.3, 3.7, 23);
    int32_t* inside = (int32_t*)calloc(23 * 23 * 23, sizeof *inside);
    uint8_t* bytes = (uint8_t*)inside;
    uint64_t random = 11;
    size_t held = 0;
    assert_ok(msq_set_membership(model, &points, NULL, bytes, 23 * 23 * 23, NULL));
    for (int i = 0; i < 23 * 23 * 23; ++i) {
      double p[3];
      for (int axis = 0, rest = i; axis < 3; ++axis, rest /= 23)
        p[axis] = points.origin[axis] + rest % 23 * points.spacing[axis];
      assert_int_equal(bytes[i], is_inside(model, p[0], p[1], p[2]));
      held += bytes[i];
      if (i % 7) continue;
      double distance, way[3], length = 0;
      assert_ok(msq_point_distance(model, p, NULL, &distance));
      for (int axis = 0; axis < 3; ++axis) {
        way[axis] = random_between(&random, -1, 1);
        length += way[axis] * way[axis];
      }
      const double s = fabs(distance) * (1 - 1e-9) / sqrt(length);
      if (fabs(distance) > 1e-12)
        assert_int_equal(bytes[i],
                         is_inside(model, p[0] + s * way[0], p[1] + s * way[1], p[2] + s * way[2]));
    }
    assert_in_range(held, 500, 11000);
    free(inside);
    msq_model_release(model);
    msq_structure_release(made);
    msq_field_release(field);
  }
  msq_structure_release(gyroid);
  msq_structure_release(lattice);
  msq_context_release(context);
}

/* 0.5 in the box, and beyond it what the definition forbids. */
static int32_t half_in_the_box(void* user, const double* points, uint64_t count, double* values) {
  (void)user;
  for (uint64_t i = 0; i < count; ++i) values[i] = points[3 * i] <= 4 ? 0.5 : 7;
  return 0;
}

/* Points that the shape drops are not asked: sets answer where single points do. */
static void dropped_points_are_not_asked(void** state) {
  enum { n = 12 };
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice_of(context, MSQ_UNIT_CELL_OCTET, 1, 0.12);
  msq_structure* gyroid = make_gyroid(context);
  msq_host_field_def def;
  msq_field* field;
  msq_structure* made[2];
  (void)state;
  assert_ok(msq_host_field_def_init(&def, sizeof def));
  def.evaluate = half_in_the_box;
  def.low = 0;
  def.high = 1;
  assert_ok(msq_field_host(context, &def, &field));
  const msq_param by_host = {0, field};
  made[0] = blend_of(lattice, gyroid, 0, field);
  assert_ok(msq_structure_smooth_boolean(MSQ_BOOLEAN_UNION, lattice, gyroid, &by_host, &made[1]));
  for (int m = 0; m < 2; ++m) {
    msq_model* model = model_with(context, make_box(context), made[m]);
    static double points[n * n * n][3];
    static uint8_t inside[n * n * n];
    size_t held = 0, beyond = 0;
    msq_points_def all;
    for (int i = 0; i < n * n * n; ++i)
      for (int axis = 0, rest = i; axis < 3; ++axis, rest /= n)
        points[i][axis] = 0.1 + 0.47 * (rest % n);
    assert_ok(msq_points_def_init(&all, sizeof all));
    all.kind = MSQ_POINTS_ARRAY;
    all.coordinates = points;
    all.count = n * n * n;
    assert_ok(msq_set_membership(model, &all, NULL, inside, sizeof inside, NULL));
    for (int i = 0; i < n * n * n; ++i) {
      assert_int_equal(inside[i], is_inside(model, points[i][0], points[i][1], points[i][2]));
      held += inside[i];
      beyond += points[i][0] > 4;
    }
    assert_in_range(held, 100, 1600);
    assert_true(beyond > 100);
    msq_model_release(model);
    msq_structure_release(made[m]);
  }
  msq_field_release(field);
  msq_structure_release(gyroid);
  msq_structure_release(lattice);
  msq_context_release(context);
}

/* Waves with a constant level, or one with a Lipschitz constant, may be blended and joined
 * smoothly. */
static void waves_may_blend(void** state) {
  msq_context* context = make_context();
  msq_structure* gyroid = make_gyroid(context);
  msq_expression_field_def wavy_def;
  msq_field *ramp = rising(context), *wavy;
  (void)state;
  assert_ok(msq_expression_field_def_init(&wavy_def, sizeof wavy_def));
  wavy_def.expression = "0.1 * sin(x)";
  wavy_def.low = -0.1;
  wavy_def.high = 0.1;
  assert_ok(msq_field_expression(context, &wavy_def, &wavy));
  const msq_field* const levels[3] = {NULL, ramp, wavy};
  for (int n = 0; n < 3; ++n) {
    const msq_param half = {0.5, NULL};
    msq_waves_def def;
    msq_structure *waves, *made[2];
    assert_ok(msq_waves_def_init(&def, sizeof def));
    def.count = 20;
    def.level.field = levels[n];
    assert_ok(msq_structure_waves(context, &def, &waves));
    if (n < 2) {
      made[0] = blend_of(waves, gyroid, 0.5, NULL);
      assert_ok(msq_structure_smooth_boolean(MSQ_BOOLEAN_UNION, waves, gyroid, &half, &made[1]));
      msq_structure_release(made[0]);
      msq_structure_release(made[1]);
    } else {
      assert_refused(msq_structure_blend(gyroid, waves, &half, &made[0]), MSQ_E_UNSUPPORTED,
                     "the distance of b has no Lipschitz constant: its radius, level");
      assert_refused(
          msq_structure_smooth_boolean(MSQ_BOOLEAN_UNION, waves, gyroid, &half, &made[0]),
          MSQ_E_UNSUPPORTED, "the distance of a has no Lipschitz constant: its radius, level");
    }
    msq_structure_release(waves);
  }
  msq_field_release(wavy);
  msq_field_release(ramp);
  msq_structure_release(gyroid);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(distances_are_blended),
      cmocka_unit_test(layers_change_from_one_to_the_other),
      cmocka_unit_test(any_field_may_blend),
      cmocka_unit_test(dropped_points_are_not_asked),
      cmocka_unit_test(waves_may_blend),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
