/* SPDX-License-Identifier: Apache-2.0
 * What functions of structures, except lattices and foams, refuse. */
#include "hosts.h" /* before headers of the system */

#include "beams.h"
#include "struts.h"
#include "wrong_values.h"

static msq_context* context;

static void sums_of_waves(void** state) {
  msq_field* both_signs = ramp_of(context, -0.1, 0.1);
  (void)state;
  REFUSALS("msq_structure_waves") {
    msq_context* in = context;
    msq_waves_def* def = (msq_waves_def*)definition(0);
    msq_structure** structure = (msq_structure**)output(0);
    assert_ok(msq_waves_def_init(def, sizeof *def));
    def->count = 8;
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    wrong_enum(table, &def->kind, "kind", 1, 2);
    RIGHT(def->count = 1);
    WRONG(ARGUMENT, "count is 0|from 1 to 4096", def->count = 0);
    WRONG(ARGUMENT, "count is 4097", def->count = 4097);
    RIGHT(def->tile[2] = 1 << 20);
    WRONG(ARGUMENT, "tile[2] is 1048577|1048576", def->tile[2] = (1 << 20) + 1);
    WRONG(ARGUMENT, "cone_angles[0] is 91", def->cone_angles[0] = 91);
    WRONG(ARGUMENT, "cone_angles[1] is 0.05|0.1 to 90", def->cone_angles[1] = 0.05);
    WRONG(ARGUMENT, "cone_angles[2] is nan", def->cone_angles[2] = NAN);
    WRONG(ARGUMENT, "cone_angles[2] is -1", def->cone_angles[2] = -1);
    WRONG(ARGUMENT, "cone_angles are all 0", def->cone_angles[0] = 0);
    wrong_grid(table, &def->grid);
    wrong_number(table, &def->level.value, "level is ");
    WRONG(ARGUMENT, "level|-1.5", def->kind = MSQ_FUNCTIONAL_SHEET; def->level.value = -1.5);
    WRONG(ARGUMENT, "0 everywhere", def->kind = MSQ_FUNCTIONAL_SHEET);
    WRONG(ARGUMENT, "level runs from -0.1", def->kind = MSQ_FUNCTIONAL_SHEET;
          def->level.field = both_signs);
    RIGHT(def->volume_fraction = 0.999);
    WRONG(ARGUMENT, "volume_fraction is 1;", def->volume_fraction = 1);
    WRONG(ARGUMENT, "volume_fraction is -0.5", def->volume_fraction = -0.5);
    WRONG(ARGUMENT, "volume_fraction is nan", def->volume_fraction = NAN);
    WRONG(ARGUMENT, "both level and volume_fraction", def->volume_fraction = 0.5;
          def->level.value = 0.1);
    WRONG(ARGUMENT, "both level and volume_fraction", def->volume_fraction = 0.5;
          def->level.field = both_signs);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_structure_waves(in, def, structure))) msq_structure_release(*structure);
  }
  msq_field_release(both_signs);
}

static msq_functional_def* functional_of(int32_t function, double level) {
  msq_functional_def* def = (msq_functional_def*)definition(0);
  assert_ok(msq_functional_def_init(def, sizeof *def));
  def->function = function;
  def->level.value = level;
  def->clusters = 1;
  return def;
}

static void functions(void** state) {
  static char text[70000];
  msq_field* both_signs = ramp_of(context, -0.1, 0.1);
  (void)state;
  REFUSALS("msq_structure_functional") {
    msq_context* in = context;
    msq_functional_def* def = functional_of(MSQ_FUNCTION_GYROID, 0.1);
    msq_structure** structure = (msq_structure**)output(0);
    wrong_sizes(table, def, offsetof(msq_functional_def, period), sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    WRONG(ARGUMENT, "function", def->function = -1);
    WRONG(ARGUMENT, "function", def->function = 19);
    wrong_enum(table, &def->kind, "kind", 1, 2);
    RIGHT(def->clusters = 64);
    WRONG(ARGUMENT, "clusters is 65", def->clusters = 65);
    WRONG(ARGUMENT, "clusters", def->clusters = UINT32_MAX);
    wrong_grid(table, &def->grid);
    wrong_number(table, &def->level.value, "level is ");
    RIGHT(def->level.value = -1.5);
    WRONG(ARGUMENT, "level|-1.5", def->kind = MSQ_FUNCTIONAL_SHEET; def->level.value = -1.5);
    WRONG(ARGUMENT, "0 everywhere", def->kind = MSQ_FUNCTIONAL_SHEET; def->level.value = 0);
    WRONG(ARGUMENT, "expression is given", def->expression = "x");
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_structure_functional(in, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_functional") { /* thicknesses of sheets */
    msq_functional_def* def = functional_of(MSQ_FUNCTION_GYROID, 0);
    msq_structure** structure = (msq_structure**)output(0);
    def->kind = MSQ_FUNCTIONAL_SHEET;
    def->thickness.value = 0.1;
    WRONG(ARGUMENT, "only sheets have walls", def->kind = MSQ_FUNCTIONAL_NETWORK);
    WRONG(ARGUMENT, "both level and thickness", def->level.value = 0.2);
    wrong_number(table, &def->thickness.value, "thickness is ");
    WRONG(ARGUMENT, "-0.25", def->thickness.value = -0.25);
    WRONG(ARGUMENT, "walls of 0.32|0.4", def->thickness.value = 0.4); /* all of it: 1 / 3.09 */
    WRONG(ARGUMENT, "thickness runs from -0.1", def->thickness.field = both_signs);
    WRONG(ARGUMENT, "0 nowhere", def->function = MSQ_FUNCTION_EXPRESSION;
          def->expression = "2+sin(x)");
    WRONG(ARGUMENT, "0 nowhere", def->function = MSQ_FUNCTION_EXPRESSION; def->expression = "0");
    WRONG(ARGUMENT, "1e-300", def->function = MSQ_FUNCTION_EXPRESSION;
          def->expression = "1e-306*sin(x)");
    WRONG(ARGUMENT, "0 nowhere", def->function = MSQ_FUNCTION_EXPRESSION;
          def->expression = "sqrt(-1-x)");
    if (TRY(msq_structure_functional(context, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_functional") { /* expressions and their parameters */
    msq_named_value values[2] = {{"a", 1}, {"b", 2}};
    msq_functional_def* def = functional_of(MSQ_FUNCTION_EXPRESSION, 0);
    msq_structure** structure = (msq_structure**)output(0);
    def->expression = "cos(x)+a*b";
    def->parameters = values;
    def->parameter_count = 2;
    memset(text, '(', sizeof text - 1);
    WRONG(ARGUMENT, "character 12|'q'", def->expression = "sin(x)+cos(q)");
    WRONG(ARGUMENT, "character 1", def->expression = "");
    WRONG(ARGUMENT, "expression is NULL", def->expression = NULL);
    WRONG(LIMIT, "expression has more than 65536 bytes", def->expression = text);
    WRONG(LIMIT, "nested deeper than 100", text[4000] = 0; def->expression = text);
    WRONG(ARGUMENT, "parameters is NULL", def->parameters = NULL);
    WRONG(ARGUMENT, "parameter 1 is NULL", values[1].name = NULL);
    WRONG(ARGUMENT, "parameters 0 and 1", values[1].name = "a");
    WRONG(ARGUMENT, "'cos'", values[1].name = "cos");
    WRONG(ARGUMENT, "'1b'", values[1].name = "1b");
    wrong_number(table, &values[1].value, "finite");
    WRONG(ARGUMENT, "parameter_count is 1025", def->parameter_count = 1025);
    WRONG(ARGUMENT, "parameter_count", def->parameter_count = UINT64_MAX);
    WRONG(ARGUMENT, "parameters are given", def->function = MSQ_FUNCTION_DIAMOND;
          def->expression = NULL);
    if (TRY(msq_structure_functional(context, def, structure))) msq_structure_release(*structure);
  }
  msq_field_release(both_signs);
}

static int32_t host_inside(void* user, const msq_host_points* points, uint8_t* inside) {
  memset(inside, 0, points->count);
  return note_call((host_log*)user, points->count);
}

static int32_t host_values(void* user, const double* points, uint64_t count, double* values) {
  (void)points;
  memset(values, 0, count * sizeof *values);
  return note_call((host_log*)user, count);
}

static int32_t build_cell(void* user, const int32_t index[3], void** data, uint64_t* bytes) {
  (void)index;
  *data = user;
  *bytes = 1;
  return 0;
}

static int32_t evaluate_cell(void* user, const void* data, const msq_host_points* points,
                             uint8_t* inside) {
  (void)data;
  return host_inside(user, points, inside);
}

static void free_cell(void* user, void* data) {
  (void)user, (void)data;
}

static void host_kinds(void** state) {
  (void)state;
  REFUSALS("msq_structure_host") {
    msq_context* in = context;
    host_log log = make_log();
    msq_host_structure_def* def = (msq_host_structure_def*)definition(0);
    msq_structure** structure = (msq_structure**)output(0);
    assert_ok(msq_host_structure_def_init(def, sizeof *def));
    def->inside = host_inside;
    def->build_cell = build_cell;
    def->evaluate_cell = evaluate_cell;
    def->free_cell = free_cell;
    def->user = &log;
    def->release = note_release;
    wrong_sizes(table, def, offsetof(msq_host_structure_def, hash_key), sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    WRONG(ARGUMENT, "build_cell is NULL", def->build_cell = NULL);
    WRONG(ARGUMENT, "free_cell is given", def->build_cell = NULL; def->evaluate_cell = NULL);
    WRONG(ARGUMENT, "inside and build_cell are NULL", def->build_cell = NULL;
          def->evaluate_cell = NULL; def->free_cell = NULL; def->inside = NULL);
    WRONG(ARGUMENT, "evaluate_cell is NULL", def->inside = NULL; def->evaluate_cell = NULL);
    WRONG(ARGUMENT, "concurrent is 2", def->concurrent = 2);
    wrong_grid(table, &def->grid);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    const int is_made = TRY(msq_structure_host(in, def, structure));
    if (is_made) msq_structure_release(*structure);
    assert_int_equal(log.released, is_made); /* what is refused is not released */
    assert_int_equal(log.calls, 0);
  }
  REFUSALS("msq_structure_host_function") {
    msq_context* in = context;
    host_log log = make_log();
    msq_host_function_def* def = (msq_host_function_def*)definition(0);
    msq_structure** structure = (msq_structure**)output(0);
    assert_ok(msq_host_function_def_init(def, sizeof *def));
    def->evaluate = host_values;
    def->user = &log;
    def->release = note_release;
    def->level.value = 0.25;
    wrong_sizes(table, def, offsetof(msq_host_function_def, hash_key), sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    WRONG(ARGUMENT, "evaluate is NULL", def->evaluate = NULL);
    wrong_number(table, &def->level.value, "level");
    WRONG(ARGUMENT, "level runs from 0 to 0", def->kind = MSQ_FUNCTIONAL_SHEET;
          def->level.value = 0);
    wrong_enum(table, &def->kind, "kind", 1, 2);
    WRONG(ARGUMENT, "clusters is 65", def->clusters = 65);
    WRONG(ARGUMENT, "lipschitz is -1", def->lipschitz = -1);
    WRONG(ARGUMENT, "concurrent is 2", def->concurrent = 2);
    wrong_grid(table, &def->grid);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    const int is_made = TRY(msq_structure_host_function(in, def, structure));
    if (is_made) msq_structure_release(*structure);
    assert_int_equal(log.released, is_made);
    assert_int_equal(log.calls, 0);
  }
}

static void beam_structures(void** state) {
  const double coordinates[] = {NAN, INFINITY, -INFINITY, 1.5e75, -1.5e75};
  const double numbers[] = {-0.5, 1.5e75, 1e-101, NAN, INFINITY, -INFINITY};
  const char* texts[] = {"is -0.5;", "is 1.5e+75;", "is 1e-101;", "nan", "inf", "-inf"};
  const uint32_t indices[] = {node_count, UINT32_MAX};
  (void)state;
  REFUSALS("msq_structure_beams") {
    double own_nodes[node_count][3], own_radii[beam_count][2], own_ball_radii[ball_count];
    uint32_t own_beams[beam_count][2], own_balls[ball_count];
    uint8_t own_caps[beam_count][2];
    msq_context* in = context;
    msq_beams_def* def = (msq_beams_def*)definition(0);
    msq_structure** structure = (msq_structure**)output(0);
    msq_job* job = NULL;
    memcpy(own_nodes, nodes, sizeof own_nodes);
    memcpy(own_radii, radii, sizeof own_radii);
    memcpy(own_ball_radii, ball_radii, sizeof own_ball_radii);
    memcpy(own_beams, beams, sizeof own_beams);
    memcpy(own_balls, balls, sizeof own_balls);
    memcpy(own_caps, caps, sizeof own_caps);
    *def = frame_def();
    def->nodes = own_nodes;
    def->radii = own_radii;
    def->ball_radii = own_ball_radii;
    def->beams = own_beams[0];
    def->balls = own_balls;
    def->caps = own_caps[0];
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    WRONG(ARGUMENT, "nodes is NULL, but node_count is 9", def->nodes = NULL);
    WRONG(ARGUMENT, "beams is NULL, but beam_count is 7", def->beams = NULL);
    WRONG(ARGUMENT, "balls is NULL, but ball_count is 2", def->balls = NULL);
    wrong_enum(table, &def->cap, "cap", 0, 2);
    WRONG(ARGUMENT, "coordinate_type is -1", def->coordinate_type = -1);
    WRONG(ARGUMENT, "coordinate_type is 77", def->coordinate_type = 77);
    WRONG(ARGUMENT, "reserved is 5; it must be 0", def->reserved = 5);
    WRONG(ARGUMENT, "beam_count and ball_count are 0", def->beam_count = def->ball_count = 0);
    WRONG(LIMIT, "2147483646 and ball_count 2; the limit is", def->beam_count = 2147483646);
    WRONG(LIMIT, "18446744073709551615", def->beam_count = UINT64_MAX);
    WRONG(LIMIT, "18446744073709551615", def->ball_count = UINT64_MAX);
    WRONG(ARGUMENT, "min_length is -0.5", def->min_length = -0.5);
    WRONG(ARGUMENT, "length_scale is -2", def->length_scale = -2);
    WRONG(ARGUMENT, "stride of nodes is 23 bytes; a point has 24", def->node_stride = 23);
    WRONG(ARGUMENT, "stride of beams is 7 bytes; an element has 8", def->beam_stride = 7);
    WRONG(ARGUMENT, "stride of radii is 15 bytes", def->radius_stride = 15);
    WRONG(ARGUMENT, "stride of caps is 1 bytes", def->cap_stride = 1);
    WRONG(ARGUMENT, "stride of balls is 3 bytes", def->ball_stride = 3);
    WRONG(ARGUMENT, "stride of ball_radii is 4 bytes", def->ball_radius_stride = 4);
    WRONG(LIMIT, "beams: 7 times", def->beam_stride = UINT64_MAX);
    wrong_number(table, &def->min_length, "min_length is ");
    wrong_number(table, &def->length_scale, "length_scale is ");
    wrong_number(table, &def->radius, "radius is ");
    wrong_number(table, &def->ball_radius, "ball_radius is ");
    for (int i = 0; i < 5; ++i)
      for (int axis = 0; axis < 3; ++axis)
        WRONG(ARGUMENT, "node 5 is (|finite",
              own_nodes[5][axis] = own_nodes[8][axis] = coordinates[i]);
    for (int i = 0; i < 2; ++i) {
      for (int end = 0; end < 2; ++end)
        WRONG(ARGUMENT, words_of("beam 3 is at node |%" PRIu32 "|node_count is 9", indices[i]),
              own_beams[3][end] = own_beams[6][end] = indices[i]);
      WRONG(ARGUMENT, words_of("ball 1 is at node |%" PRIu32, indices[i]),
            own_balls[1] = indices[i]);
    }
    for (int i = 0; i < 6; ++i) {
      for (int end = 0; end < 2; ++end)
        WRONG(ARGUMENT, words_of("radius %d of beam 2 |%s", end, texts[i]),
              own_radii[2][end] = numbers[i]);
      WRONG(ARGUMENT, words_of("radius of ball 0 |%s", texts[i]), own_ball_radii[0] = numbers[i]);
      WRONG(ARGUMENT, words_of("radius is |%s", texts[i] + (i < 3 ? 3 : 0)), def->radii = NULL;
            def->radius = numbers[i]);
      WRONG(ARGUMENT, words_of("ball_radius is |%s", texts[i] + (i < 3 ? 3 : 0)),
            def->ball_radii = NULL;
            def->ball_radius = numbers[i]);
    }
    WRONG(ARGUMENT, "radius is 0; without radii", def->radii = NULL);
    WRONG(ARGUMENT, "ball_radius is 0; without ball_radii", def->ball_radii = NULL);
    WRONG(ARGUMENT, "the radii of beam 4 are both 0", own_radii[4][0] = own_radii[4][1] = 0);
    WRONG(ARGUMENT, "radius of ball 1 is 0", own_ball_radii[1] = 0);
    WRONG(ARGUMENT, "cap 0 of beam 5 is 3", own_caps[5][0] = 3);
    WRONG(ARGUMENT, "cap 1 of beam 5 is 255; it must be from 0 to 2", own_caps[5][1] = 255);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_structure_beams(in, def, structure, job))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_beams") { /* one beam without length is a ball, or nothing */
    const uint32_t pair[2] = {1, 1};
    msq_beams_def* def = (msq_beams_def*)definition(0);
    msq_structure** structure = (msq_structure**)output(0);
    *def = beam_def(0.5, MSQ_CAP_HEMISPHERE);
    def->beams = pair;
    WRONG(ARGUMENT, "1 beams and balls", def->cap = MSQ_CAP_BUTT);
    if (TRY(msq_structure_beams(context, def, structure, NULL))) msq_structure_release(*structure);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(functions),
      cmocka_unit_test(sums_of_waves),
      cmocka_unit_test(host_kinds),
      cmocka_unit_test(beam_structures),
  };
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_context_release(context);
  return failed;
}
