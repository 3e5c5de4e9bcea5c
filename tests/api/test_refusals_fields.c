/* SPDX-License-Identifier: Apache-2.0
 * What functions of fields and materials refuse. */
#include "hosts.h" /* before headers of the system */

#include "images.h"
#include "materials.h"
#include "wrong_values.h"

static msq_context* context;

static void gradients(void** state) {
  (void)state;
  REFUSALS("msq_field_gradient") {
    msq_context* in = context;
    double a[3] = {1, 2, 3}, b[3] = {4, 2, 3}, from_value = 1, to_value = 2;
    const double *from = a, *to = b;
    msq_field** field = (msq_field**)output(0);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "from is NULL", from = NULL);
    WRONG(ARGUMENT, "to is NULL", to = NULL);
    WRONG(ARGUMENT, "field is NULL", field = NULL);
    wrong_vector(table, a, "from is (");
    wrong_vector(table, b, "to is (");
    wrong_number(table, &from_value, "from_value|finite");
    wrong_number(table, &to_value, "to_value");
    WRONG(ARGUMENT, "(1, 2, 3) are 0 apart", to = a);
    WRONG(ARGUMENT, "are 1e-160 apart|1e-140", memset(a, 0, sizeof a); memset(b, 0, sizeof b);
          b[1] = 1e-160);
    RIGHT(b[1] = 1e154);
    WRONG(ARGUMENT, "are 1e+155 apart|1e-140 to 1.3e154", b[1] = 1e155);
    WRONG(ARGUMENT, "difference", from_value = -1e308; to_value = 1e308);
    if (TRY(msq_field_gradient(in, from, from_value, to, to_value, field)))
      msq_field_release(*field);
  }
  REFUSALS("msq_field_radial") {
    msq_context* in = context;
    msq_radial_field_def* def = (msq_radial_field_def*)definition(0);
    msq_field** field = (msq_field**)output(0);
    assert_ok(msq_radial_field_def_init(def, sizeof *def));
    def->center[0] = 1;
    def->from_radius = 1;
    def->from_value = 10;
    def->to_radius = 3;
    def->to_value = 20;
    double* const numbers[] = {&def->from_radius, &def->from_value, &def->to_radius,
                               &def->to_value};
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "field is NULL", field = NULL);
    wrong_vector(table, def->center, "finite");
    wrong_vector(table, def->axis, "finite");
    for (int i = 0; i < 4; ++i) wrong_number(table, numbers[i], "finite");
    WRONG(ARGUMENT, "from_radius is -0.25", def->from_radius = -0.25);
    WRONG(ARGUMENT, "to_radius is 3", def->from_radius = 3);
    WRONG(ARGUMENT, "reserved is 7", def->reserved = 7);
    WRONG(ARGUMENT, "difference", def->from_value = -1e308; def->to_value = 1e308);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_field_radial(in, def, field))) msq_field_release(*field);
  }
}

static void curves(void** state) {
  msq_field* ramp = ramp_of(context, 0, 10);
  (void)state;
  REFUSALS("msq_field_map") {
    msq_context* in = context;
    const msq_field* argument = ramp;
    double pairs[6] = {0, 1, 2, 3, 4, 5}, *curve = pairs;
    uint64_t count = 3;
    msq_field** field = (msq_field**)output(0);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "argument is NULL", argument = NULL);
    WRONG(ARGUMENT, "curve is NULL", curve = NULL);
    WRONG(ARGUMENT, "field is NULL", field = NULL);
    WRONG(ARGUMENT, "curve_count is 0", count = 0);
    WRONG(ARGUMENT, "65536", count = 65537);
    for (int i = 0; i < 6; ++i) wrong_number(table, pairs + i, "finite");
    WRONG(ARGUMENT, "ascend|pair 2", pairs[4] = 2);
    WRONG(ARGUMENT, "ascend|pair 2", pairs[4] = 1.5);
    WRONG(ARGUMENT, "difference", pairs[1] = -1e308; pairs[3] = 1e308);
    if (TRY(msq_field_map(in, argument, curve, count, field))) msq_field_release(*field);
  }
  msq_field_release(ramp);

  msq_context* small = make_context_of(1, 0, 100000);
  msq_shape *shape = make_box(context), *shape_of_small = make_box(small);
  REFUSALS("msq_field_shape_distance") {
    static const double repeated[4] = {1, 0, 1, 2}, falling[4] = {1, 0, 0.5, 2};
    double curve[6] = {-1, 0, 0, 1, 2, 3};
    msq_context* in = context;
    msq_shape_distance_field_def* def = (msq_shape_distance_field_def*)definition(0);
    msq_field** field = (msq_field**)output(0);
    msq_job* job = NULL;
    assert_ok(msq_shape_distance_field_def_init(def, sizeof *def));
    def->shape = shape;
    def->curve = curve;
    def->curve_count = 3;
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "field is NULL", field = NULL);
    WRONG(ARGUMENT, "reserved is 3", def->reserved = 3);
    WRONG(ARGUMENT, "shape is NULL", def->shape = NULL);
    WRONG(ARGUMENT, "curve is NULL", def->curve = NULL);
    WRONG(ARGUMENT, "curve_count is 0", def->curve_count = 0);
    WRONG(ARGUMENT, "ascend", def->curve = repeated; def->curve_count = 2);
    WRONG(ARGUMENT, "0.5", def->curve = falling; def->curve_count = 2);
    for (int i = 0; i < 6; ++i) wrong_number(table, curve + i, "finite");
    wrong_number(table, &def->step, "step");
    WRONG(ARGUMENT, "step is -1", def->step = -1);
    WRONG(ARGUMENT, "1048576", def->step = 1e-9);
    WRONG(LIMIT, "samples of a distance", in = small; def->shape = shape_of_small;
          def->step = 0.01);
    WRONG(CANCELLED, "cancelled", job = cancelled_job(); def->step = 0.5);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_field_shape_distance(in, def, field, job))) msq_field_release(*field);
  }
  msq_shape_release(shape);
  msq_shape_release(shape_of_small);
  msq_context_release(small);
}

static int32_t host_values(void* user, const double* points, uint64_t count, double* values) {
  (void)points;
  memset(values, 0, count * sizeof *values);
  return note_call((host_log*)user, count);
}

static int32_t failing_values(void* user, const double* points, uint64_t count, double* values) {
  (void)user, (void)points, (void)count, (void)values;
  return -42;
}

static void host_fields(void** state) {
  (void)state;
  REFUSALS("msq_field_host") {
    msq_context* in = context;
    host_log log = make_log();
    msq_host_field_def* def = (msq_host_field_def*)definition(0);
    msq_field** field = (msq_field**)output(0);
    assert_ok(msq_host_field_def_init(def, sizeof *def));
    def->evaluate = host_values;
    def->user = &log;
    def->release = note_release;
    def->low = 0.25;
    def->high = 0.75;
    wrong_sizes(table, def, offsetof(msq_host_field_def, hash_key), sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "field is NULL", field = NULL);
    WRONG(ARGUMENT, "evaluate is NULL", def->evaluate = NULL);
    WRONG(ARGUMENT, "concurrent is 2", def->concurrent = 2);
    WRONG(ARGUMENT, "low is 0.875 and high is 0.75", def->low = 0.875);
    wrong_number(table, &def->low, "low");
    wrong_number(table, &def->high, "high");
    WRONG(ARGUMENT, "lipschitz is -0.5", def->lipschitz = -0.5);
    WRONG(ARGUMENT, "lipschitz", def->lipschitz = NAN);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    const int is_made = TRY(msq_field_host(in, def, field));
    if (is_made) msq_field_release(*field);
    assert_int_equal(log.released, is_made); /* what is refused is not released */
    assert_int_equal(log.calls, 0);
  }
}

static void images(void** state) {
  msq_context* tiny = make_context_of(1, 0, 20);
  (void)state;
  REFUSALS("msq_field_grid") {
    msq_context* in = context;
    msq_grid_field_def* def = (msq_grid_field_def*)definition(0);
    msq_field** field = (msq_field**)output(0);
    assert_ok(msq_grid_field_def_init(def, sizeof *def));
    def->image = small_image();
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "field is NULL", field = NULL);
    WRONG(ARGUMENT, "reserved is 5", def->reserved = 5);
    wrong_image(table, &def->image, 1);
    WRONG(LIMIT, "an image of", in = tiny);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_field_grid(in, def, field))) msq_field_release(*field);
    assert_int_equal(memory_of(context).bytes, 0);
    assert_int_equal(memory_of(tiny).bytes, 0);
  }
  msq_context_release(tiny);
}

static void expressions(void** state) {
  (void)state;
  REFUSALS("msq_field_expression") {
    msq_context* in = context;
    msq_named_value values[2] = {{"a", 1}, {"b", 2}};
    msq_expression_field_def* def = (msq_expression_field_def*)definition(0);
    msq_field** field = (msq_field**)output(0);
    assert_ok(msq_expression_field_def_init(def, sizeof *def));
    def->expression = "x + a * b";
    def->parameters = values;
    def->parameter_count = 2;
    def->high = 100;
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "field is NULL", field = NULL);
    WRONG(ARGUMENT, "reserved is 3", def->reserved = 3);
    WRONG(ARGUMENT, "expression is NULL", def->expression = NULL);
    WRONG(ARGUMENT, "character 5", def->expression = "x + ");
    WRONG(ARGUMENT, "parameters is NULL", def->parameters = NULL);
    WRONG(ARGUMENT, "parameter 1 is NULL", values[1].name = NULL);
    wrong_number(table, &values[1].value, "finite");
    wrong_number(table, &def->low, "low");
    wrong_number(table, &def->high, "high");
    WRONG(ARGUMENT, "low is 101 and high is 100", def->low = 101);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_field_expression(in, def, field))) msq_field_release(*field);
  }
}

static void values_of_fields(void** state) {
  msq_host_field_def host;
  msq_field *rise = ramp_of(context, 0, 6), *bad;
  (void)state;
  assert_ok(msq_host_field_def_init(&host, sizeof host));
  host.evaluate = failing_values;
  host.low = 0;
  host.high = 1;
  assert_ok(msq_field_host(context, &host, &bad));
  REFUSALS("msq_field_evaluate") {
    msq_context* in = context;
    const msq_field* field = rise;
    msq_points_def* points = some_points(0);
    double* values = (double*)output(0);
    uint64_t count = some_count;
    msq_job* job = NULL;
    WRONG(ARGUMENT, "context", in = NULL);
    WRONG(ARGUMENT, "field", field = NULL);
    WRONG(ARGUMENT, "values begins 0 bytes after coordinates",
          values = (double*)of_some_points(points, 0));
    WRONG(ARGUMENT, "values", values = NULL);
    WRONG(ARGUMENT, "value_count is 9", count = 9);
    WRONG(ARGUMENT, "value_count is 7", count = 7);
    WRONG(ARGUMENT, "value_count is 9", set_grid(points); count = 9);
    WRONG(HOST, "-42", field = bad);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(points->count = count = 0; values = NULL);
    wrong_points(table, points);
    WRONG(ARGUMENT, "points", points = NULL);
    TRY(msq_field_evaluate(in, field, points, values, count, job));
    if (field == bad) assert_int_equal(msq_error_host_code(), -42);
  }
  msq_field_release(bad);
  msq_field_release(rise);
}

static void materials(void** state) {
  static char name[257];
  msq_material *steel = make_material(context, 1, 100, 1),
               *nylon = make_material(context, 2, 300, 5);
  const msq_channel density = {"density", {1, NULL}};
  const msq_material_def bare_def = material_def(5, &density, 1);
  msq_material* bare;
  (void)state;
  assert_ok(msq_material_create(context, &bare_def, &bare));
  REFUSALS("msq_material_create") {
    msq_context* in = context;
    msq_channel channels[257] = {{"density", {1, NULL}}, {"modulus", {-2, NULL}}};
    msq_material_def* def = (msq_material_def*)definition(0);
    msq_material** material = (msq_material**)output(0);
    *def = material_def(7, channels, 2);
    memset(name, 'a', sizeof name);
    name[256] = 0;
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "material is NULL", material = NULL);
    WRONG(ARGUMENT, "id is 0", def->id = 0);
    WRONG(ARGUMENT, "channel_count is 257", def->channel_count = 257);
    WRONG(ARGUMENT, "channels is NULL", def->channels = NULL);
    WRONG(ARGUMENT, "channel 1 is NULL", channels[1].name = NULL);
    WRONG(ARGUMENT, "channel 1 has none", channels[1].name = "");
    WRONG(ARGUMENT, "channel 1 has more", channels[1].name = name);
    RIGHT(name[255] = 0; channels[1].name = name);
    WRONG(ARGUMENT, "two channels are called density", channels[1].name = "density");
    wrong_number(table, &channels[1].value.value, "modulus");
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_material_create(in, def, material))) msq_material_release(*material);
  }
  REFUSALS("msq_material_blend") {
    msq_context* in = context;
    uint32_t id = 9;
    const msq_material *a = steel, *b = nylon;
    msq_param part = {0.5, NULL}, *fraction = &part;
    msq_material** material = (msq_material**)output(0);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "id is 0", id = 0);
    WRONG(ARGUMENT, "a is NULL", a = NULL);
    WRONG(ARGUMENT, "b is NULL", b = NULL);
    WRONG(ARGUMENT, "fraction is NULL", fraction = NULL);
    WRONG(ARGUMENT, "material is NULL", material = NULL);
    WRONG(ARGUMENT, "modulus", b = bare);
    WRONG(ARGUMENT, "modulus", a = bare);
    WRONG(ARGUMENT, "1.25", part.value = 1.25);
    WRONG(ARGUMENT, "-0.5", part.value = -0.5);
    WRONG(ARGUMENT, "fraction", part.value = NAN);
    if (TRY(msq_material_blend(in, id, a, b, fraction, material))) msq_material_release(*material);
  }
  msq_material_release(steel);
  msq_material_release(nylon);
  msq_material_release(bare);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gradients),   cmocka_unit_test(curves),
      cmocka_unit_test(host_fields), cmocka_unit_test(images),
      cmocka_unit_test(expressions), cmocka_unit_test(values_of_fields),
      cmocka_unit_test(materials),
  };
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_context_release(context);
  return failed;
}
