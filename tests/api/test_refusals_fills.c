/* SPDX-License-Identifier: Apache-2.0
 * What fill lines refuse. */
#include "fills.h"
#include "wrong_values.h"

static msq_context* context;

static void fill_lines(void** state) {
  const int64_t most = (int64_t)1 << 53;
  msq_context* small = make_context_of(1, 0, 20000);
  msq_structure *foam = make_foam_of(context, 5), *lattice = make_lattice(context);
  msq_structure* gyroid = make_sheet(context, MSQ_FUNCTION_GYROID, 8);
  msq_structure *of_small = make_foam_of(small, 5), *united, *within, *blended, *plates, *distant;
  msq_plate_lattice_def plate_def;
  msq_foam_def foam_def;
  const msq_structure* members[2];
  const msq_param half = {0.5, NULL};
  const msq_fill_def square = square_def(1);
  msq_fill* made = make_fill(context, foam, &square);
  (void)state;
  assert_ok(msq_plate_lattice_def_init(&plate_def, sizeof plate_def));
  plate_def.thickness.value = 0.1;
  assert_ok(msq_structure_plate_lattice(context, &plate_def, &plates));
  assert_ok(msq_foam_def_init(&foam_def, sizeof foam_def));
  foam_def.radius.value = 0.1;
  set_cell(&foam_def.grid, 0.5);
  foam_def.grid.origin[0] = foam_def.grid.origin[1] = 1e308;
  assert_ok(msq_structure_foam(context, &foam_def, &distant));
  members[0] = lattice;
  members[1] = foam;
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, members, 2, &united));
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_INTERSECTION, members, 2, &within));
  assert_ok(msq_structure_blend(foam, gyroid, &half, &blended));
  REFUSALS("msq_fill_lines") {
    msq_ring rings[2] = {square_rings[0], square_rings[1]};
    int64_t hole[4][2];
    msq_context* in = context;
    const msq_structure* structure = foam;
    msq_fill_def* def = (msq_fill_def*)definition(0);
    msq_fill** fill = (msq_fill**)output(0);
    msq_job* job = NULL;
    memcpy(hole, hole_nm, sizeof hole);
    *def = square;
    def->rings = rings;
    rings[1].points = hole;
    wrong_sizes(table, def, offsetof(msq_fill_def, corner_distance), sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    WRONG(ARGUMENT, "fill is NULL", fill = NULL);
    WRONG(UNSUPPORTED, "use its contours", structure = lattice);
    WRONG(UNSUPPORTED, "use its contours", structure = blended);
    WRONG(UNSUPPORTED, "structure 0 of the union|contours", structure = united);
    WRONG(UNSUPPORTED, "structure 0, the first one|contours", structure = within);
    WRONG(ARGUMENT, "ring_count is 0", def->ring_count = 0);
    WRONG(ARGUMENT, "rings is NULL", def->rings = NULL);
    WRONG(ARGUMENT, "ring 1 has 2 points", rings[1].count = 2);
    WRONG(ARGUMENT, "ring 1 are NULL", rings[1].points = NULL);
    WRONG(LIMIT, "the rings up to ring 1|2147483648", rings[1].count = (uint64_t)1 << 31);
    WRONG(ARGUMENT, "ring 1 are on one line", hole[0][0] = 3; hole[0][1] = 1; hole[1][0] = 6;
          hole[1][1] = 2; hole[2][0] = 6; hole[2][1] = 2; hole[3][0] = 300000003;
          hole[3][1] = 100000001);
    WRONG(ARGUMENT, "ring 1 are on one line", memcpy(hole[1], hole[0], sizeof hole[0]);
          memcpy(hole[2], hole[0], sizeof hole[0]); rings[1].count = 3);
    WRONG(ARGUMENT, "point_stride is 15 bytes; a point has 16", def->point_stride = 15);
    WRONG(ARGUMENT, "coordinate_type is 2", def->coordinate_type = MSQ_FLOAT64);
    wrong_number(table, &def->scale, "scale");
    wrong_number(table, &def->origin[0], "origin");
    wrong_number(table, &def->origin[1], "origin");
    wrong_number(table, &def->z, "z is");
    wrong_number(table, &def->tolerance, "tolerance");
    WRONG(ARGUMENT, "pair_distance is 1.7e+308|1.80144e+16", def->pair_distance = 1.7e308);
    WRONG(ARGUMENT, "corner_distance is 1e+20|1.80144e+16", def->corner_distance = 1e20);
    wrong_number(table, &def->min_length, "min_length");
    wrong_number(table, &def->pair_distance, "pair_distance");
    wrong_number(table, &def->corner_distance, "corner_distance");
    WRONG(ARGUMENT, "scale is 0", def->scale = 0);
    WRONG(ARGUMENT, "scale is 2e+75", def->scale = 2e75);
    WRONG(ARGUMENT, "tolerance is -1", def->tolerance = -1);
    WRONG(ARGUMENT, "min_length is -2", def->min_length = -2);
    WRONG(ARGUMENT, "pair_distance is -3", def->pair_distance = -3);
    WRONG(ARGUMENT, "corner_distance is -4", def->corner_distance = -4);
    /* coordinates overflow */
    for (int i = 0; i < 2; ++i) {
      WRONG(LIMIT, "1e+308|z 1 is too far from the grid's origin|1.67772e+07 cells",
            def->origin[i] = 1e308);
      WRONG(LIMIT, "-1e+308|z 1 is too far|1.67772e+07 cells", structure = gyroid;
            def->origin[i] = -1e308);
      WRONG(LIMIT, "1e+308|z 1 is too far|1.67772e+07 cells", structure = plates;
            def->origin[i] = 1e308);
    }
    WRONG(LIMIT, "at z 1e+308 is too far from the grid's origin (0, 0, 0)", def->z = 1e308);
    WRONG(LIMIT, "1e+308) at z 1e+308 is too far", structure = gyroid;
          def->origin[0] = def->origin[1] = def->z = 1e308);
    WRONG(LIMIT, "too far from the grid's origin (1e+308, 1e+308, 0)", structure = distant);
    WRONG(LIMIT, "from cell 2e+199 to cell 2e+199 along axis 1; the limit is 1.67772e+07",
          def->origin[1] = 1e200);
    /* a cell is 8e60 units wide, and a line runs through the corner */
    WRONG(LIMIT, "the limit is 2^60", structure = gyroid; def->z = 0; def->scale = 1e-60);
    WRONG(LIMIT, "memory_limit", in = small; structure = of_small);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    WRONG(CANCELLED, "cancelled", structure = gyroid; job = cancelled_job());
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_fill_lines(in, structure, def, fill, job))) msq_fill_release(*fill);
  }
  REFUSALS("msq_fill_lines") { /* coordinates at the limit */
    int64_t corners[3][2] = {{-most, -most}, {-most + 9, -most}, {-most, -most + 9}};
    const msq_ring ring = {corners, 3};
    msq_fill_def* def = (msq_fill_def*)definition(0);
    msq_fill** fill = (msq_fill**)output(0);
    *def = square;
    def->rings = &ring;
    def->ring_count = 1;
    def->scale = 1e-9;
    WRONG(LIMIT, "point 2 of ring 0 has the coordinate|-9007199254740993",
          corners[2][1] = -most - 1);
    WRONG(LIMIT, "the limit is 2^53", corners[2][1] = INT64_MIN);
    WRONG(LIMIT, "cells from the grid's origin", def->scale = 1); /* 9e15 cells away */
    if (TRY(msq_fill_lines(context, foam, def, fill, NULL))) msq_fill_release(*fill);
  }
  REFUSALS("msq_fill_info") {
    const msq_fill* fill = made;
    msq_fill_report* report = (msq_fill_report*)output(0);
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "fill is NULL", fill = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    TRY(msq_fill_info(fill, report));
  }
  msq_fill_release(made);
  msq_structure_release(distant);
  msq_structure_release(plates);
  msq_structure_release(blended);
  msq_structure_release(within);
  msq_structure_release(united);
  msq_structure_release(of_small);
  msq_structure_release(gyroid);
  msq_structure_release(lattice);
  msq_structure_release(foam);
  msq_context_release(small);
}

static void fill_calibrations(void** state) {
  const double widths[] = {0, -1, NAN, INFINITY}, densities[] = {0, -1, 1.01, NAN};
  msq_structure *foam = make_foam_of(context, 1), *lattice = make_lattice(context), *graded, *full;
  msq_structure *warped, *united;
  const msq_structure* members[2];
  msq_warp_def warp;
  msq_field* field = ramp_of(context, 1, 3);
  msq_foam_def foam_def;
  msq_functional_def functional_def;
  (void)state;
  assert_ok(msq_foam_def_init(&foam_def, sizeof foam_def));
  foam_def.radius.value = 0.1;
  foam_def.density.field = field;
  assert_ok(msq_structure_foam(context, &foam_def, &graded));
  assert_ok(msq_functional_def_init(&functional_def, sizeof functional_def));
  functional_def.level.value = 9;
  assert_ok(msq_structure_functional(context, &functional_def, &full));
  assert_ok(msq_warp_def_init(&warp, sizeof warp));
  warp.count = 6;
  functional_def.warp = &warp;
  assert_ok(msq_structure_functional(context, &functional_def, &warped));
  members[0] = members[1] = foam;
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, members, 2, &united));
  REFUSALS("msq_fill_calibrate") {
    msq_context* in = context;
    const msq_structure* structure = foam;
    double line_width = 0.4, density = 0.2;
    double* cell_size = (double*)output(0);
    msq_job* job = NULL;
    WRONG(ARGUMENT, "context", in = NULL);
    WRONG(ARGUMENT, "structure", structure = NULL);
    WRONG(ARGUMENT, "cell_size", cell_size = NULL);
    for (int i = 0; i < 4; ++i) {
      WRONG(ARGUMENT, "line_width is", line_width = widths[i]);
      WRONG(ARGUMENT, "density is", density = densities[i]);
    }
    WRONG(UNSUPPORTED, "contours", structure = lattice);
    WRONG(UNSUPPORTED, "without the field", structure = graded);
    WRONG(UNSUPPORTED, "warp", structure = warped);
    WRONG(UNSUPPORTED, "no cell size of its own", structure = united);
    WRONG(LIMIT, "no wall", structure = full);
    WRONG(CANCELLED, "cancel", job = cancelled_job());
    TRY(msq_fill_calibrate(in, structure, line_width, density, cell_size, job));
  }
  msq_structure_release(united);
  msq_structure_release(warped);
  msq_structure_release(full);
  msq_structure_release(graded);
  msq_structure_release(lattice);
  msq_structure_release(foam);
  msq_field_release(field);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fill_lines),
      cmocka_unit_test(fill_calibrations),
  };
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_context_release(context);
  return failed;
}
