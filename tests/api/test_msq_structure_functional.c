/* SPDX-License-Identifier: Apache-2.0
 * msq_functional_def_init, msq_structure_functional. */
#include "definitions.h"

static msq_functional_def functional_def(int32_t function, double level) {
  msq_functional_def def;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.function = function;
  def.level.value = level;
  return def;
}

static msq_functional_def expression_def(const char* text) {
  msq_functional_def def = functional_def(MSQ_FUNCTION_EXPRESSION, 0);
  def.expression = text;
  return def;
}

DEFINE_CREATE(structure, structure_functional, functional_def)

static void defaults_are_those_of_the_header(void** state) {
  msq_functional_def def;
  (void)state;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  assert_int_equal(def.function, MSQ_FUNCTION_GYROID);
  assert_int_equal(def.kind, MSQ_FUNCTIONAL_NETWORK);
  assert_int_equal(def.clusters, 0);
  assert_default_grid(&def.grid);
  assert_true(def.level.value == 0);
  assert_null(def.level.field);
  assert_true(def.thickness.value == 0);
  assert_null(def.thickness.field);
  assert_null(def.expression);
  assert_null(def.parameters);
  assert_int_equal(def.parameter_count, 0);
  assert_null(def.period);
  assert_null(def.warp);
}

/* ---- the solid, against the C library's functions */

static const double turn = 6.283185307179586;

static double function_at(int32_t function, double x, double y, double z) {
  const double cx = cos(x), cy = cos(y), cz = cos(z), sx = sin(x), sy = sin(y), sz = sin(z);
  const double c2x = cos(2 * x), c2y = cos(2 * y), c2z = cos(2 * z);
  const double s2x = sin(2 * x), s2y = sin(2 * y), s2z = sin(2 * z);
  const double pairs = c2x * c2y + c2y * c2z + c2z * c2x;
  switch (function) {
    case MSQ_FUNCTION_GYROID:
      return sx * cy + sy * cz + sz * cx;
    case MSQ_FUNCTION_SCHWARZ_P:
      return cx + cy + cz;
    case MSQ_FUNCTION_DIAMOND:
      return sx * sy * sz + sx * cy * cz + cx * sy * cz + cx * cy * sz;
    case MSQ_FUNCTION_I_WP:
      return 2 * (cx * cy + cy * cz + cz * cx) - (c2x + c2y + c2z);
    case MSQ_FUNCTION_NEOVIUS:
      return 3 * (cx + cy + cz) + 4 * cx * cy * cz;
    case MSQ_FUNCTION_F_RD:
      return 4 * cx * cy * cz - pairs;
    case MSQ_FUNCTION_LIDINOID:
      return 0.5 * (s2x * cy * sz + s2y * cz * sx + s2z * cx * sy) - 0.5 * pairs + 0.15;
    case MSQ_FUNCTION_SPLIT_P:
      return 1.1 * (s2x * sz * cy + s2y * sx * cz + s2z * sy * cx) - 0.2 * pairs -
             0.4 * (c2x + c2y + c2z);
    case MSQ_FUNCTION_FISCHER_KOCH_S:
      return c2x * sy * cz + c2y * sz * cx + c2z * sx * cy;
    case MSQ_FUNCTION_C_Y:
      return s2x * sy + s2y * sz + s2z * sx + s2x * cz + s2y * cx + s2z * cy - sx * sy * sz -
             cx * cy * cz;
    case MSQ_FUNCTION_C_PLUS_MINUS_Y:
      return s2x * sy + s2y * sz + s2z * sx - 2 * cx * cy * cz;
    case MSQ_FUNCTION_KARCHER_K:
      return 0.3 * (cx + cy + cz) + 0.3 * (cx * cy + cy * cz + cz * cx) - 0.4 * (c2x + c2y + c2z) +
             0.2;
    case MSQ_FUNCTION_G_PRIME:
      return s2x * cy * sz + s2y * cz * sx + s2z * cx * sy + 0.32;
    case MSQ_FUNCTION_DOUBLE_GYROID:
      return pairs - 2.75 * (s2x * cy * sz + s2y * cz * sx + s2z * cx * sy) + 0.95;
    case MSQ_FUNCTION_DOUBLE_DIAMOND:
      return -0.5 * (sx * sy + sy * sz + sz * sx) - 0.5 * cx * cy * cz;
    case MSQ_FUNCTION_DOUBLE_P:
      return -0.5 * (cx * cy + cy * cz + cz * cx) - 0.2 * (c2x + c2y + c2z);
    case MSQ_FUNCTION_HONEYCOMB:
      return c2y + 2 * cx * cy + 0.5;
    case MSQ_FUNCTION_RODS:
      return 1 - cx - cy;
    default:
      return NAN;
  }
}

/* A box filled with the structure. */
static msq_model* fill_box(msq_context* context, const msq_functional_def* def) {
  const double low[3] = {-2, -2, -2}, high[3] = {2, 2, 2};
  msq_shape* box;
  msq_structure* structure;
  msq_model_def model_def;
  msq_model* model;
  assert_ok(msq_shape_from_box(context, low, high, &box));
  assert_ok(msq_structure_functional(context, def, &structure));
  const msq_scale_def scales[2] = {{.shape = box}, {.structure = structure}};
  assert_ok(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  assert_ok(msq_model_create(context, &model_def, &model));
  msq_structure_release(structure);
  msq_shape_release(box);
  return model;
}

enum { side = 24, samples = side * side * side };

static void sample(const msq_model* model, double points[][3], uint8_t* inside) {
  msq_points_def def;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    def.origin[axis] = -1.9 + 0.01 * axis;
    def.spacing[axis] = 0.157;
    def.counts[axis] = side;
  }
  for (int i = 0; i < samples; ++i) {
    const int index[3] = {i % side, i / side % side, i / side / side};
    for (int axis = 0; axis < 3; ++axis)
      points[i][axis] = def.origin[axis] + index[axis] * def.spacing[axis];
  }
  assert_ok(msq_set_membership(model, &def, NULL, inside, samples, NULL));
}

static double points[samples][3];
static uint8_t first[samples], second[samples];

static void named_functions_are_those_of_the_header(void** state) {
  msq_context* context = make_context();
  const double c = cos(0.5), s = sin(0.5);
  const double rotation[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  (void)state;
  for (int32_t function = MSQ_FUNCTION_GYROID; function <= MSQ_FUNCTION_RODS; ++function)
    for (int kind = MSQ_FUNCTIONAL_NETWORK; kind <= MSQ_FUNCTIONAL_SHEET; ++kind)
      for (int is_turned = 0; is_turned < 2; ++is_turned) {
        msq_functional_def def = functional_def(function, 0.25);
        int held = 0;
        def.kind = kind;
        def.grid.cell_size[0] = 1.25;
        def.grid.cell_size[2] = 0.75;
        def.grid.origin[1] = 0.3;
        if (is_turned) memcpy(def.grid.rotation, rotation, sizeof rotation);
        msq_model* model = fill_box(context, &def);
        sample(model, points, first);
        for (int i = 0; i < samples; ++i) {
          const double x = points[i][0], y = points[i][1] - 0.3, z = points[i][2];
          const double gx = is_turned ? c * x + s * y : x, gy = is_turned ? c * y - s * x : y;
          const double g = function_at(function, turn * gx / 1.25, turn * gy, turn * z / 0.75);
          const double onset = kind == MSQ_FUNCTIONAL_SHEET ? fabs(g) : g;
          held += first[i];
          if (fabs(onset - 0.25) > 1e-12) assert_int_equal(first[i], onset <= 0.25);
        }
        assert_in_range(held, 1, samples - 1);
        msq_model_release(model);
      }
  msq_context_release(context);
}

static void an_expression_is_its_function(void** state) {
  /* By other signs and brackets of the same operations, the same bits. */
  msq_context* context = make_context();
  const msq_named_value values[2] = {{"two", 2}, {"share", 0.5}};
  const char* texts[2] = {
      " sin(x) * cos(y) + sin(y)*cos(z) + (sin(z)*cos(x)) ",
      "share*(sin(two*x)*cos(y)*sin(z)+sin(two*y)*cos(z)*sin(x)+sin(two*z)*cos(x)*sin(y))-"
      "share*(cos(two*x)*cos(two*y)+cos(two*y)*cos(two*z)+cos(two*z)*cos(two*x))+0.15"};
  const int32_t functions[2] = {MSQ_FUNCTION_GYROID, MSQ_FUNCTION_LIDINOID};
  (void)state;
  for (int i = 0; i < 2; ++i) {
    const msq_functional_def named = functional_def(functions[i], 0.1);
    msq_functional_def written = expression_def(texts[i]);
    written.level.value = 0.1;
    written.parameters = values;
    written.parameter_count = 2;
    msq_model* a = fill_box(context, &named);
    msq_model* b = fill_box(context, &written);
    sample(a, points, first);
    sample(b, points, second);
    assert_memory_equal(first, second, sizeof first);
    msq_model_release(a);
    msq_model_release(b);
  }
  msq_context_release(context);
}

static void expressions_repeat_with_the_cell(void** state) {
  /* x alone: the first part of each cell, up to the level. */
  msq_context* context = make_context();
  msq_functional_def def = expression_def("x");
  (void)state;
  def.level.value = turn / 4;
  msq_model* model = fill_box(context, &def);
  sample(model, points, first);
  for (int i = 0; i < samples; ++i) {
    const double part = points[i][0] - floor(points[i][0]);
    if (fabs(part - 0.25) > 1e-12) assert_int_equal(first[i], part <= 0.25);
  }
  msq_model_release(model);
  /* No number: outside. */
  def = expression_def("sqrt(x-pi)-10");
  model = fill_box(context, &def);
  sample(model, points, first);
  for (int i = 0; i < samples; ++i) {
    const double part = points[i][0] - floor(points[i][0]);
    if (fabs(part - 0.5) > 1e-12) assert_int_equal(first[i], part >= 0.5);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void inputs_are_copied(void** state) {
  msq_context* context = make_context();
  char text[] = "cos(x)+shift", name[] = "shift";
  msq_named_value value = {name, 0.5};
  msq_functional_def def = expression_def(text);
  (void)state;
  def.parameters = &value;
  def.parameter_count = 1;
  msq_model* model = fill_box(context, &def);
  sample(model, points, first);
  memset(text, '?', sizeof text - 1);
  memset(name, '?', sizeof name - 1);
  value.value = -5;
  sample(model, points, second);
  assert_memory_equal(first, second, sizeof first);
  msq_model_release(model);
  msq_context_release(context);
}

static void level_may_be_a_field(void** state) {
  msq_context* context = make_context();
  const double from[3] = {-2, 0, 0}, to[3] = {2, 0, 0};
  msq_functional_def def = functional_def(MSQ_FUNCTION_GYROID, 99);
  msq_field* field;
  (void)state;
  assert_ok(msq_field_gradient(context, from, -1, to, 1, &field));
  def.level.field = field;
  msq_model* model = fill_box(context, &def);
  msq_field_release(field);
  sample(model, points, first);
  for (int i = 0; i < samples; ++i) {
    const double* p = points[i];
    const double g = function_at(MSQ_FUNCTION_GYROID, turn * p[0], turn * p[1], turn * p[2]);
    if (fabs(g - p[0] / 2) > 1e-12) assert_int_equal(first[i], g <= p[0] / 2);
  }
  msq_model_release(model);
  msq_context_release(context);
}

/* Walls of constant thickness: |sin x| <= c has two of 2 asin(c) / 2 pi cells. */
static void thickness_is_that_of_the_walls(void** state) {
  msq_context* context = make_context();
  msq_functional_def def = expression_def("sin(x)");
  (void)state;
  def.kind = MSQ_FUNCTIONAL_SHEET;
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = 2;
  def.thickness.value = 0.3;
  msq_model* model = fill_box(context, &def);
  sample(model, points, first);
  int held = 0;
  for (int i = 0; i < samples; ++i) {
    const double off = fabs(points[i][0] - round(points[i][0]));
    held += first[i];
    if (fabs(off - 0.15) > 1e-3) assert_int_equal(first[i], off <= 0.15);
  }
  assert_in_range(held, 1, samples - 1);
  msq_model_release(model);
  msq_context_release(context);
}

static void thickness_may_be_a_field(void** state) {
  msq_context* context = make_context();
  const double from[3] = {0, -2, 0}, to[3] = {0, 2, 0};
  msq_functional_def def = expression_def("sin(x)");
  msq_field* field;
  (void)state;
  def.kind = MSQ_FUNCTIONAL_SHEET;
  assert_ok(msq_field_gradient(context, from, 0, to, 0.4, &field));
  def.thickness.field = field;
  msq_model* model = fill_box(context, &def);
  msq_field_release(field);
  sample(model, points, first);
  for (int i = 0; i < samples; ++i) {
    const double off = fabs(2 * points[i][0] - round(2 * points[i][0])) / 2;
    const double half = (points[i][1] + 2) * 0.05;
    if (fabs(off - half) > 1e-3) assert_int_equal(first[i], off <= half);
  }
  msq_model_release(model);
  msq_context_release(context);
}

/* A sum of waves, of which the text is longer than 4096 bytes, against the C library. */
static void expressions_may_be_long(void** state) {
  enum { waves = 300 };
  msq_context* context = make_context();
  char text[65536] = "0";
  size_t length = 1;
  msq_functional_def def = expression_def(text);
  (void)state;
  for (int i = 0; i < waves; ++i)
    length += (size_t)snprintf(text + length, sizeof text - length,
                               "+0.05*cos(%d*x+%d*y-%d*z+0.%d)", i % 5, i / 5 % 4, i / 20 % 3, i);
  assert_true(length > 4096);
  def.level.value = 0.25;
  def.clusters = 4;
  msq_model* model = fill_box(context, &def);
  sample(model, points, first);
  int held = 0;
  for (int n = 0; n < samples; ++n) {
    double sum = 0;
    for (int i = 0; i < waves; ++i) {
      const double phase = i < 10 ? i / 10.0 : i < 100 ? i / 100.0 : i / 1000.0;
      sum +=
          0.05 *
          cos(turn * (i % 5 * points[n][0] + i / 5 % 4 * points[n][1] - i / 20 % 3 * points[n][2]) +
              phase);
    }
    if (fabs(sum - 0.25) > 1e-10) assert_int_equal(first[n], sum <= 0.25);
    if (n < 200) /* one by one: more than 1024 operations */
      assert_int_equal(is_inside(model, points[n][0], points[n][1], points[n][2]), first[n]);
    held += first[n];
  }
  assert_in_range(held, samples / 10, samples - 1);
  msq_model_release(model);
  msq_context_release(context);
}

/* Steps, a mean of two functions by a choice, and what 3MF calls select: against C. */
static void expressions_may_choose(void** state) {
  msq_context* context = make_context();
  msq_functional_def def = expression_def(
      "select(mod(x, pi) < 1, 0.6 - hypot(sin(y), cos(z)), tanh(2*cos(x)) * atan2(sin(y), cos(z)))"
      "+ 0.2*round(2*sin(z)) - (y >= z)");
  (void)state;
  msq_model* model = fill_box(context, &def);
  sample(model, points, first);
  int held = 0;
  for (int n = 0; n < samples; ++n) {
    double a[3];
    for (int k = 0; k < 3; ++k) a[k] = turn * (points[n][k] - floor(points[n][k]));
    const double part = fmod(a[0], turn / 2), steps = 2 * sin(a[2]) + 0.5;
    const double chosen = part < 1 ? 0.6 - hypot(sin(a[1]), cos(a[2]))
                                   : tanh(2 * cos(a[0])) * atan2(sin(a[1]), cos(a[2]));
    const double sum = chosen + 0.2 * floor(steps) - (a[1] >= a[2]);
    const int is_near = fabs(part - 1) < 1e-9 || fabs(part) < 1e-9 || fabs(sum) < 1e-9 ||
                        fabs(steps - round(steps)) < 1e-9 || fabs(a[1] - a[2]) < 1e-9;
    if (!is_near) assert_int_equal(first[n], sum <= 0);
    held += first[n];
  }
  assert_in_range(held, samples / 10, samples - samples / 10);
  msq_model_release(model);
  msq_context_release(context);
}

/* ---- refusals */

/* Numbers and variables count, equal ones once. */
static void at_most_8192_different_operations(void** state) {
  msq_context* context = make_context();
  static char text[65536] = "x";
  int operations = 1;
  msq_functional_def def = expression_def(text);
  (void)state;
  for (int n = 2; operations + 2 <= 8192; ++n, operations += 2)
    snprintf(text + strlen(text), sizeof text - strlen(text), "+%d", n);
  assert_int_equal(operations, 8191);
  strcat(text, "+2+x"); /* two sums of known operands */
  assert_refused(create(context, &def), MSQ_E_LIMIT, "more than 8192 operations");
  text[strlen(text) - 2] = 0;
  assert_ok(create(context, &def));
  msq_context_release(context);
}

static void cells_may_be_as_small_and_as_large_as_the_header_says(void** state) {
  const double sizes[] = {1e-75, 1e75};
  msq_context* context = make_context();
  msq_functional_def def = functional_def(MSQ_FUNCTION_GYROID, 0.2);
  (void)state;
  for (int i = 0; i < 2; ++i) {
    for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = sizes[i];
    assert_ok(create(context, &def));
  }
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(named_functions_are_those_of_the_header),
      cmocka_unit_test(an_expression_is_its_function),
      cmocka_unit_test(expressions_repeat_with_the_cell),
      cmocka_unit_test(expressions_may_be_long),
      cmocka_unit_test(expressions_may_choose),
      cmocka_unit_test(inputs_are_copied),
      cmocka_unit_test(level_may_be_a_field),
      cmocka_unit_test(thickness_is_that_of_the_walls),
      cmocka_unit_test(thickness_may_be_a_field),
      cmocka_unit_test(at_most_8192_different_operations),
      cmocka_unit_test(cells_may_be_as_small_and_as_large_as_the_header_says),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
