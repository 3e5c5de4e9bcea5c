/* SPDX-License-Identifier: Apache-2.0
 * What functions of structures made of structures and of struts refuse. */
#include "struts.h"
#include "wrong_values.h"

static msq_context* context;

static void structures_of_structures(void** state) {
  msq_structure *lattice = make_lattice(context), *gyroid = make_gyroid(context), *nested[65];
  msq_structure* twice[13]; /* of 2^i lattices */
  (void)state;
  nested[0] = lattice;
  for (int i = 1; i < 65; ++i) {
    const msq_structure* const pair[2] = {nested[i - 1], gyroid};
    assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, pair, 2, &nested[i]));
  }
  msq_structure_retain(twice[0] = lattice);
  for (int i = 1; i < 13; ++i) {
    const msq_structure* const pair[2] = {twice[i - 1], twice[i - 1]};
    assert_ok(msq_structure_boolean(MSQ_BOOLEAN_INTERSECTION, pair, 2, &twice[i]));
  }
  REFUSALS("msq_structure_boolean") {
    const msq_structure* list[2] = {lattice, gyroid};
    const msq_structure* const* structures = list;
    int32_t operation = MSQ_BOOLEAN_UNION;
    uint64_t count = 2;
    msq_structure** structure = (msq_structure**)output(0);
    wrong_enum(table, &operation, "operation", 1, 3);
    WRONG(ARGUMENT, "structures is NULL", structures = NULL);
    WRONG(ARGUMENT, "count is 0", count = 0);
    WRONG(ARGUMENT, "4097|4096", count = 4097);
    WRONG(ARGUMENT, "structures[0] is NULL", list[0] = NULL);
    WRONG(ARGUMENT, "structures[1] is NULL", list[1] = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    RIGHT(list[1] = nested[63]);
    WRONG(LIMIT, "65 structures|the limit is 64", list[1] = nested[64]);
    RIGHT(list[0] = list[1] = twice[11]);
    WRONG(LIMIT, "4097 structures|the limit is 4096", list[0] = twice[12]);
    if (TRY(msq_structure_boolean(operation, structures, count, structure)))
      msq_structure_release(*structure);
  }
  msq_field *ramp = ramp_of(context, 0, 1), *low = ramp_of(context, -0.25, 1),
            *high = ramp_of(context, 0, 1.25);
  msq_expression_field_def expression;
  msq_field* waves;
  assert_ok(msq_expression_field_def_init(&expression, sizeof expression));
  expression.expression = "0.2 + 0.1 * sin(x)";
  expression.low = 0.1;
  expression.high = 0.3;
  assert_ok(msq_field_expression(context, &expression, &waves));
  msq_lattice_def wavy_def;
  msq_structure* wavy;
  assert_ok(msq_lattice_def_init(&wavy_def, sizeof wavy_def));
  wavy_def.radius.field = waves;
  assert_ok(msq_structure_lattice(context, &wavy_def, &wavy));
  REFUSALS("msq_structure_blend") {
    const msq_structure *a = lattice, *b = gyroid;
    msq_param own = {0.5, NULL}, *fraction = &own;
    msq_structure** structure = (msq_structure**)output(0);
    WRONG(ARGUMENT, "a is NULL", a = NULL);
    WRONG(ARGUMENT, "b is NULL", b = NULL);
    WRONG(ARGUMENT, "fraction is NULL", fraction = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    wrong_number(table, &own.value, "fraction");
    WRONG(ARGUMENT, "fraction is from -0.5 to -0.5", own.value = -0.5);
    WRONG(ARGUMENT, "fraction is from 1.5 to 1.5|within 0 and 1", own.value = 1.5);
    RIGHT(own.value = 0);
    RIGHT(own.value = 1);
    RIGHT(own.field = ramp);
    RIGHT(own.field = waves);
    WRONG(ARGUMENT, "fraction is from -0.25 to 1", own.field = low);
    WRONG(ARGUMENT, "fraction is from 0 to 1.25", own.field = high);
    WRONG(UNSUPPORTED, "the distance of a has no Lipschitz constant", a = wavy);
    WRONG(UNSUPPORTED, "the distance of b has no Lipschitz constant", b = wavy);
    WRONG(LIMIT, "65 structures|the limit is 64", b = nested[64]);
    WRONG(LIMIT, "4097 structures|the limit is 4096", b = twice[12]);
    if (TRY(msq_structure_blend(a, b, fraction, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_smooth_boolean") {
    const msq_structure *a = lattice, *b = gyroid;
    int32_t operation = MSQ_BOOLEAN_UNION;
    msq_param own = {0.5, NULL}, *radius = &own;
    msq_structure** structure = (msq_structure**)output(0);
    wrong_enum(table, &operation, "operation", 1, 3);
    WRONG(ARGUMENT, "a is NULL", a = NULL);
    WRONG(ARGUMENT, "b is NULL", b = NULL);
    WRONG(ARGUMENT, "radius is NULL", radius = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    wrong_number(table, &own.value, "radius");
    WRONG(ARGUMENT, "radius is from -0.5 to -0.5|at least 0", own.value = -0.5);
    RIGHT(own.value = 0);
    RIGHT(own.value = 1e300);
    RIGHT(own.field = ramp);
    RIGHT(own.field = waves);
    WRONG(ARGUMENT, "radius is from -0.25 to 1", own.field = low);
    WRONG(UNSUPPORTED, "the distance of a has no Lipschitz constant", a = wavy);
    WRONG(UNSUPPORTED, "the distance of b has no Lipschitz constant", b = wavy);
    WRONG(LIMIT, "65 structures|the limit is 64", b = nested[64]);
    WRONG(LIMIT, "4097 structures|the limit is 4096", b = twice[12]);
    if (TRY(msq_structure_smooth_boolean(operation, a, b, radius, structure)))
      msq_structure_release(*structure);
  }
  msq_structure_release(wavy);
  msq_field_release(waves);
  msq_field_release(high);
  msq_field_release(low);
  msq_field_release(ramp);
  for (int i = 0; i < 65; ++i) msq_structure_release(nested[i]);
  for (int i = 0; i < 13; ++i) msq_structure_release(twice[i]);
  msq_structure_release(gyroid);
}

static int32_t take_no_struts(void* user, const msq_strut* struts, uint64_t count) {
  (void)user, (void)struts, (void)count;
  return 0;
}

static msq_struts_def* struts_of(double low, double high) {
  msq_struts_def* def = (msq_struts_def*)definition(0);
  assert_ok(msq_struts_def_init(def, sizeof *def));
  *def = struts_def(low, high);
  return def;
}

/* Of a structure with cells of size 1. */
static void wrong_struts(refusals* table, msq_struts_def* def) {
  wrong_sizes(table, def, sizeof *def, sizeof *def);
  wrong_enum(table, &def->selection, "selection", 0, 1);
  wrong_vector(table, def->min, "min is (");
  wrong_vector(table, def->max, "max is (");
  for (int axis = 0; axis < 3; ++axis) {
    WRONG(ARGUMENT, "min is 2.5 and max is 2", def->min[axis] = 2.5);
    WRONG(LIMIT, "1.67772e+07", def->max[axis] = 1e8);
    WRONG(LIMIT, "the limit is", def->max[axis] = 1e300);
  }
}

static void struts(void** state) {
  msq_structure *lattice = make_lattice(context), *gyroid = make_gyroid(context),
                *walls = make_foam_with(context, 0, 0.05), *foam = make_foam_with(context, 0.1, 0);
  const msq_structure *both[2] = {lattice, foam}, *one[2] = {lattice, gyroid};
  msq_structure *joined, *common, *partly;
  (void)state;
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, both, 2, &joined));
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_INTERSECTION, both, 2, &common));
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, one, 2, &partly));
  REFUSALS("msq_structure_struts") {
    msq_context* in = context;
    msq_structure* structure = lattice;
    msq_struts_def* def = struts_of(0, 2);
    msq_struts_fn callback = take_no_struts;
    wrong_struts(table, def);
    RIGHT(structure = foam);
    WRONG(LIMIT, "the limit is", structure = foam; def->max[1] = 1e300);
    WRONG(UNSUPPORTED, "no struts", structure = gyroid);
    WRONG(UNSUPPORTED, "no struts", structure = walls);
    RIGHT(structure = joined);
    WRONG(LIMIT, "the limit is", structure = joined; def->max[1] = 1e300);
    WRONG(UNSUPPORTED, "no struts|unions of these", structure = common);
    WRONG(UNSUPPORTED, "no struts|unions of these", structure = partly);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    WRONG(ARGUMENT, "callback is NULL", callback = NULL);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    TRY(msq_structure_struts(in, structure, def, callback, NULL, NULL));
  }
  REFUSALS("msq_structure_strut_graph") {
    msq_context* in = context;
    msq_structure* structure = lattice;
    msq_struts_def* def = struts_of(0, 2);
    msq_strut_graph** graph = (msq_strut_graph**)output(0);
    msq_job* job = NULL;
    wrong_struts(table, def);
    WRONG(UNSUPPORTED, "no struts", structure = gyroid);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    WRONG(ARGUMENT, "graph is NULL", graph = NULL);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_structure_strut_graph(in, structure, def, graph, job)))
      msq_strut_graph_release(*graph);
  }
  msq_strut_graph* made;
  const msq_struts_def whole = struts_def(0, 2);
  assert_ok(msq_structure_strut_graph(context, lattice, &whole, &made, NULL));
  REFUSALS("msq_strut_graph_info") {
    msq_strut_graph* graph = made;
    msq_strut_graph_report* report = (msq_strut_graph_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "struct_size", report->struct_size = 4);
    WRONG(ARGUMENT, "graph is NULL", graph = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_strut_graph_info(graph, report));
  }
  msq_strut_graph_release(made);
  msq_structure_release(foam);
  msq_structure_release(walls);
  msq_structure_release(partly);
  msq_structure_release(common);
  msq_structure_release(joined);
  msq_structure_release(gyroid);
  msq_structure_release(lattice);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(structures_of_structures),
      cmocka_unit_test(struts),
  };
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_context_release(context);
  return failed;
}
