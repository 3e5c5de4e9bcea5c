/* SPDX-License-Identifier: Apache-2.0
 * What functions of lattices and unit cells refuse. */
#include "wrong_values.h"

static msq_context* context;

static msq_lattice_def* lattice_of(int32_t unit_cell) {
  msq_lattice_def* def = (msq_lattice_def*)definition(0);
  assert_ok(msq_lattice_def_init(def, sizeof *def));
  def->unit_cell = unit_cell;
  def->radius.value = 0.1;
  return def;
}

static void lattices(void** state) {
  const uint32_t pairs[3][2] = {{0, 4}, {UINT32_MAX, 1}, {2, 2}};
  const double outside[] = {-0.125, 1.125, NAN, INFINITY};
  const char* texts[] = {"-0.125", "1.125", "nan", "inf"};
  const uint64_t counts[] = {0, 4097, UINT64_MAX};
  msq_field* fields[3];
  (void)state;
  make_fields(context, fields, 1);
  REFUSALS("msq_structure_lattice") {
    msq_context* in = context;
    msq_lattice_def* def = lattice_of(MSQ_UNIT_CELL_BCC);
    msq_structure** structure = (msq_structure**)output(0);
    wrong_sizes(table, def, offsetof(msq_lattice_def, strut_factors), sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    wrong_enum(table, &def->unit_cell, "unit_cell", 0, 8);
    WRONG(ARGUMENT, "clusters is 65", def->clusters = 65);
    wrong_grid(table, &def->grid);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_structure_lattice(in, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_lattice") { /* radii; cells of unlike sides */
    msq_lattice_def* def = lattice_of(MSQ_UNIT_CELL_CUBIC);
    msq_structure** structure = (msq_structure**)output(0);
    def->grid.cell_size[1] = 0.25;
    wrong_radius(table, &def->radius, 1, fields);
    if (TRY(msq_structure_lattice(context, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_lattice") { /* cells of the host */
    double cell_nodes[4][3] = {{0, 0, 0}, {0.25, 0.25, 0.25}, {0.5, 0.5, 0}, {0.9, 0.1, 1}};
    uint32_t struts[3][2] = {{0, 1}, {1, 2}, {2, 3}};
    msq_lattice_def* def = lattice_of(MSQ_UNIT_CELL_CUSTOM);
    msq_structure** structure = (msq_structure**)output(0);
    def->nodes = cell_nodes[0];
    def->node_count = 4;
    def->struts = struts[0];
    def->strut_count = 3;
    WRONG(ARGUMENT, "nodes is NULL", def->nodes = NULL);
    WRONG(ARGUMENT, "struts is NULL", def->struts = NULL);
    for (int i = 0; i < 3; ++i) {
      WRONG(ARGUMENT, words_of("node_count|%" PRIu64 "|4096", counts[i]),
            def->node_count = counts[i]);
      WRONG(ARGUMENT, words_of("strut_count|%" PRIu64 "|4096", counts[i]),
            def->strut_count = counts[i]);
      WRONG(ARGUMENT, words_of("strut 1|%" PRIu32 "|%" PRIu32 "|4 nodes", pairs[i][0], pairs[i][1]),
            memcpy(struts[1], pairs[i], sizeof pairs[i]));
    }
    for (int i = 0; i < 4; ++i)
      for (int axis = 0; axis < 3; ++axis)
        WRONG(ARGUMENT, words_of("node|%s", texts[i]), cell_nodes[2][axis] = outside[i]);
    if (TRY(msq_structure_lattice(context, def, structure))) msq_structure_release(*structure);
  }
  release_fields(fields);
  REFUSALS("msq_structure_lattice") { /* factors of struts */
    const double refused[] = {0, -1, 0.00099, 1000.5, NAN, INFINITY};
    double factors[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    msq_lattice_def* def = lattice_of(MSQ_UNIT_CELL_BCC);
    msq_structure** structure = (msq_structure**)output(0);
    def->strut_factors = factors;
    def->strut_count = 8;
    WRONG(ARGUMENT, "strut_count is 0|8", def->strut_count = 0);
    for (int i = 0; i < 6; ++i)
      WRONG(ARGUMENT, "the factor of strut 5|from 0.001 to 1000", factors[5] = refused[i]);
    RIGHT(def->grid.cell_size[1] = 1048576);
    WRONG(LIMIT, "differ by 1.04858e+06 times|the limit is 1048576",
          def->grid.cell_size[1] = 1048577);
    RIGHT(factors[5] = 40); /* 4 times the smallest cell size */
    WRONG(LIMIT, "greatest strut factor|the limit is 4", factors[5] = 40.0009765625);
    if (TRY(msq_structure_lattice(context, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_lattice") { /* cells that vary in size or are bent */
    static msq_unit_cell_def cells[2];
    const double positions[2] = {0, 5}, sizes[2] = {1, 0.5};
    static msq_period_def period;
    static msq_warp_def warp;
    msq_lattice_def* def = lattice_of(MSQ_UNIT_CELL_BCC);
    msq_structure** structure = (msq_structure**)output(0);
    for (int i = 0; i < 2; ++i) cells[i] = named_cell(MSQ_UNIT_CELL_CUBIC);
    assert_ok(msq_period_def_init(&period, sizeof period));
    period.positions = positions;
    period.cell_sizes = sizes;
    period.count = 2;
    WRONG(LIMIT, "differ by 2e+06 times", def->period = &period; def->grid.cell_size[1] = 1e6);
    assert_ok(msq_warp_def_init(&warp, sizeof warp));
    warp.count = 3;
    RIGHT(def->period = &period);
    WRONG(ARGUMENT, "period.axis is 3", def->period = &period; period.axis = 3);
    RIGHT(def->period = &period; def->radius.value = 2);
    WRONG(LIMIT, "radius reaches 2.25; the limit is 2", def->period = &period;
          def->radius.value = 2.25);
    WRONG(UNSUPPORTED, "a period is given, and a library of 2", def->period = &period;
          def->cells = cells; def->cell_count = 2);
    RIGHT(def->warp = &warp);
    WRONG(ARGUMENT, "warp.kind is 0", def->warp = &warp; warp.kind = 0);
    WRONG(ARGUMENT, "warp.kind is 4", def->warp = &warp; warp.kind = 4);
    WRONG(ARGUMENT, "warp.count is 3", def->warp = &warp; warp.kind = MSQ_WARP_SAMPLED);
    WRONG(ARGUMENT, "warp.u", def->warp = &warp; warp.kind = MSQ_WARP_SAMPLED; warp.count = 0);
    WRONG(ARGUMENT, "warp.count is 0", def->warp = &warp; warp.count = 0);
    WRONG(ARGUMENT, "warp.count is 2|180 degrees|150", def->warp = &warp; warp.count = 2);
    WRONG(ARGUMENT, "count_polar 5|156 degrees|150", def->warp = &warp; warp.count_polar = 5;
          warp.kind = MSQ_WARP_SPHERICAL);
    RIGHT(def->warp = &warp; warp.count_polar = 6; warp.kind = MSQ_WARP_SPHERICAL);
    RIGHT(def->warp = &warp; warp.inner_radius = 2; warp.outer_radius = 3);
    WRONG(ARGUMENT, "warp.outer_radius is 2.875|inner_radius 2|no whole cell", def->warp = &warp;
          warp.inner_radius = 2; warp.outer_radius = 2.875);
    RIGHT(def->warp = &warp; warp.inner_radius = 16777215);
    WRONG(LIMIT, "warp.inner_radius is 1.67772e+07|the limit is 1.67772e+07 cells",
          def->warp = &warp;
          warp.inner_radius = 16777216);
    WRONG(LIMIT, "radius reaches 4.1|the limit is 4", def->warp = &warp; def->radius.value = 4.125);
    WRONG(UNSUPPORTED, "a period and a warp", def->warp = &warp; def->period = &period);
    WRONG(UNSUPPORTED, "a warp is given, and a library of 2", def->warp = &warp; def->cells = cells;
          def->cell_count = 2);
    if (TRY(msq_structure_lattice(context, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_lattice") { /* libraries of unit cells */
    static msq_unit_cell_def cells[257];
    const double node[3] = {0, 0, 0};
    msq_lattice_def* def = lattice_of(MSQ_UNIT_CELL_BCC);
    msq_structure** structure = (msq_structure**)output(0);
    for (int i = 0; i < 257; ++i) cells[i] = named_cell(MSQ_UNIT_CELL_CUBIC);
    def->cells = cells;
    def->cell_count = 3;
    WRONG(ARGUMENT, "cells is NULL", def->cells = NULL);
    WRONG(ARGUMENT, "cell_count is 0", def->cell_count = 0);
    WRONG(ARGUMENT, "cell_count is 257", def->cell_count = 257);
    RIGHT(def->cell_count = 256);
    WRONG(LIMIT, "8192 struts|4096", def->cell_count = 256;
          for (int i = 0; i < 256; ++i) cells[i].unit_cell = MSQ_UNIT_CELL_RHOMBIC_DODECAHEDRON);
    WRONG(ARGUMENT, "unit cell 2: unit_cell is 9", cells[2].unit_cell = 9);
    WRONG(ARGUMENT, "unit cell 2: node_count is 0", cells[2].unit_cell = MSQ_UNIT_CELL_CUSTOM);
    WRONG(ARGUMENT, "unit cell 1: |struct_size", cells[1].struct_size -= 8);
    /* As if of a later version, whose fields are zero; but elements have one size. */
    WRONG(ARGUMENT, "unit cell 2: struct_size is|that of the first", cells[2].struct_size += 8;
          memset(&cells[3], 0, sizeof cells[3]));
    WRONG(ARGUMENT, "must be NULL", def->nodes = node);
    wrong_number(table, &def->cell_choice.value, "cell_choice is ");
    WRONG(ARGUMENT, "clusters is 65", def->clusters = 65);
    if (TRY(msq_structure_lattice(context, def, structure))) msq_structure_release(*structure);
  }
}

static msq_plate_lattice_def* plates_of(int32_t plate_cell) {
  msq_plate_lattice_def* def = (msq_plate_lattice_def*)definition(0);
  assert_ok(msq_plate_lattice_def_init(def, sizeof *def));
  def->plate_cell = plate_cell;
  def->thickness.value = 0.1;
  return def;
}

static void plate_lattices(void** state) {
  msq_field* fields[3];
  (void)state;
  make_fields(context, fields, 1);
  REFUSALS("msq_structure_plate_lattice") {
    const double factors[12] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    const uint32_t pairs[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    msq_context* in = context;
    msq_plate_lattice_def* def = plates_of(MSQ_PLATE_CELL_FCC);
    msq_structure** structure = (msq_structure**)output(0);
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    wrong_enum(table, &def->plate_cell, "plate_cell", 0, 5);
    wrong_grid(table, &def->grid);
    WRONG(ARGUMENT, "reserved is 1", def->reserved = 1);
    WRONG(ARGUMENT, "struts is not NULL, but radius is 0", def->struts = pairs[0]);
    WRONG(ARGUMENT, "strut_factors is not NULL, but radius is 0", def->strut_factors = factors;
          def->strut_count = 12);
    RIGHT(def->radius.value = 0.1; def->strut_factors = factors; def->strut_count = 12);
    WRONG(ARGUMENT, "strut_count is 2", def->radius.value = 0.1; def->strut_factors = factors;
          def->strut_count = 2);
    WRONG(ARGUMENT, "unit_cell is 9", def->radius.value = 0.1; def->unit_cell = 9);
    WRONG(ARGUMENT, "node_count is 0", def->radius.value = 0.1; def->unit_cell = 0);
    WRONG(ARGUMENT, "face 0, in model units, has|at least 1e-05", def->grid.cell_size[1] = 1e-6;
          def->grid.cell_size[0] = 1e-6; def->thickness.value = 1e-6);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_structure_plate_lattice(in, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_plate_lattice") { /* sizes; cells of unlike sides */
    msq_plate_lattice_def* def = plates_of(MSQ_PLATE_CELL_CUBIC);
    msq_structure** structure = (msq_structure**)output(0);
    def->grid.cell_size[1] = 0.25;
    const double numbers[4] = {0, -0.5, NAN, INFINITY};
    for (int i = 0; i < 4; ++i) WRONG(ARGUMENT, "thickness is ", def->thickness.value = numbers[i]);
    RIGHT(def->thickness.value = 1);
    WRONG(LIMIT, "cell sizes of a lattice differ by 4e+08 times", def->grid.cell_size[2] = 1e8);
    WRONG(LIMIT, "thickness reaches 1.00098|the limit is 1 ", def->thickness.value = 1.0009765625);
    WRONG(ARGUMENT, "thickness|-0.25", def->thickness.field = fields[0]);
    WRONG(ARGUMENT, "thickness|0 everywhere", def->thickness.field = fields[1]);
    WRONG(LIMIT, "thickness|the limit is 1 ", def->thickness.field = fields[2]);
    for (int i = 1; i < 4; ++i) WRONG(ARGUMENT, "radius is ", def->radius.value = numbers[i]);
    WRONG(LIMIT, "radius reaches 1.00098|the limit is 1 ", def->radius.value = 1.0009765625);
    WRONG(ARGUMENT, "radius|0 everywhere", def->radius.field = fields[1]);
    if (TRY(msq_structure_plate_lattice(context, def, structure)))
      msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_plate_lattice") { /* cells of the host */
    static const uint32_t wrong[4][3] = {{0, 4, 1}, {UINT32_MAX, 1, 2}, {2, 1, 2}, {3, 3, 3}};
    static const double outside[] = {-0.125, 1.125, NAN, INFINITY};
    static const char* texts[] = {"-0.125", "1.125", "nan", "inf"};
    static const uint64_t counts[] = {0, 4097, UINT64_MAX};
    double cell_nodes[4][3] = {{0, 0, 0}, {0.25, 0.25, 0.25}, {0.5, 0.5, 0}, {0.9, 0.1, 1}};
    uint32_t faces[2][3] = {{0, 1, 2}, {1, 2, 3}};
    double factors[2] = {1, 1};
    const double refused[] = {0, -1, 0.00099, 1000.5, NAN, INFINITY};
    msq_plate_lattice_def* def = plates_of(MSQ_PLATE_CELL_CUSTOM);
    msq_structure** structure = (msq_structure**)output(0);
    def->nodes = cell_nodes[0];
    def->node_count = 4;
    def->faces = faces[0];
    def->face_count = 2;
    WRONG(ARGUMENT, "nodes is NULL", def->nodes = NULL);
    WRONG(ARGUMENT, "faces is NULL", def->faces = NULL);
    for (int i = 0; i < 3; ++i) {
      WRONG(ARGUMENT, words_of("node_count|%" PRIu64 "|4096", counts[i]),
            def->node_count = counts[i]);
      WRONG(ARGUMENT, words_of("face_count|%" PRIu64 "|4096", counts[i]),
            def->face_count = counts[i]);
    }
    for (int i = 0; i < 4; ++i) {
      WRONG(ARGUMENT,
            words_of("face 1 joins nodes %" PRIu32 ", %" PRIu32 " and %" PRIu32 "|4 nodes",
                     wrong[i][0], wrong[i][1], wrong[i][2]),
            memcpy(faces[1], wrong[i], sizeof wrong[i]));
      for (int axis = 0; axis < 3; ++axis)
        WRONG(ARGUMENT, words_of("node|%s", texts[i]), cell_nodes[2][axis] = outside[i]);
    }
    /* On a line, and nearly so. */
    WRONG(ARGUMENT, "face 0, in model units, has|at least 1e-05",
          memcpy(cell_nodes[2], cell_nodes[0], sizeof cell_nodes[0]));
    WRONG(ARGUMENT, "face 0, in model units, has|at least 1e-05", cell_nodes[2][0] = 0.5;
          cell_nodes[2][1] = 0.5; cell_nodes[2][2] = 0.5000001);
    RIGHT(cell_nodes[2][0] = 0.5; cell_nodes[2][1] = 0.5; cell_nodes[2][2] = 0.5001);
    WRONG(ARGUMENT, "face_count is 1|6", def->plate_cell = MSQ_PLATE_CELL_CUBIC;
          def->face_factors = factors; def->face_count = 1);
    for (int i = 0; i < 6; ++i)
      WRONG(ARGUMENT, "the factor of face 1|from 0.001 to 1000", def->face_factors = factors;
            factors[1] = refused[i]);
    RIGHT(def->face_factors = factors; factors[1] = 40);
    WRONG(LIMIT, "greatest face factor|the limit is 4", def->face_factors = factors;
          factors[1] = 40.0009765625);
    if (TRY(msq_structure_plate_lattice(context, def, structure)))
      msq_structure_release(*structure);
  }
  release_fields(fields);
}

static msq_unit_cell_def* cell_of(int32_t unit_cell) {
  msq_unit_cell_def* cell = (msq_unit_cell_def*)definition(0);
  *cell = named_cell(unit_cell);
  return cell;
}

static void unit_cells(void** state) {
  msq_structure *lattice = make_lattice(context), *foam = make_foam(context, MSQ_FOAM_AUTO);
  msq_structure* warped;
  const double position = 0, size = 1;
  msq_period_def period;
  msq_lattice_def graded = *lattice_of(MSQ_UNIT_CELL_BCC);
  (void)state;
  assert_ok(msq_period_def_init(&period, sizeof period));
  period.positions = &position;
  period.cell_sizes = &size;
  period.count = 1;
  graded.period = &period;
  assert_ok(msq_structure_lattice(context, &graded, &warped));
  REFUSALS("msq_unit_cell_info") {
    static const double cell_nodes[2][3] = {{0, 0.25, 0.5}, {1, 0.25, 0.5}};
    static const uint32_t struts[1][2] = {{0, 1}};
    msq_unit_cell_def* cell = cell_of(MSQ_UNIT_CELL_CUSTOM);
    msq_unit_cell_report* report = (msq_unit_cell_report*)output(0);
    uint32_t* unmatched = (uint32_t*)output(1);
    report->struct_size = sizeof *report;
    cell->nodes = cell_nodes[0];
    cell->node_count = 2;
    cell->struts = struts[0];
    cell->strut_count = 1;
    wrong_sizes(table, cell, sizeof *cell, sizeof *cell);
    WRONG(ARGUMENT, "unmatched is NULL", unmatched = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    WRONG(ARGUMENT, "strut 0", cell->node_count = 1);
    WRONG(ARGUMENT, "unit_cell is 9", cell->unit_cell = 9);
    WRONG(ARGUMENT, "cell is NULL", cell = NULL);
    TRY(msq_unit_cell_info(cell, report, unmatched, 1));
  }
  REFUSALS("msq_unit_cell_geometry") {
    msq_unit_cell_def* cell = cell_of(MSQ_UNIT_CELL_BCC);
    double* cell_nodes = (double*)output(0);
    uint32_t* struts = (uint32_t*)output(1);
    uint64_t nodes_room = 9, struts_room = 8;
    WRONG(ARGUMENT, "nodes is NULL", cell_nodes = NULL);
    WRONG(ARGUMENT, "struts is NULL", struts = NULL);
    WRONG(ARGUMENT, "node_count is 8; the unit cell has 9", nodes_room = 8);
    WRONG(ARGUMENT, "strut_count is 9; the unit cell has 8", struts_room = 9);
    WRONG(ARGUMENT, "unit_cell is -1", cell->unit_cell = -1);
    WRONG(ARGUMENT, "cell is NULL", cell = NULL);
    TRY(msq_unit_cell_geometry(cell, cell_nodes, nodes_room, struts, struts_room));
  }
  REFUSALS("msq_lattice_faces") {
    const msq_structure* structure = lattice;
    double low[3] = {0, 0, 0}, high[3] = {2, 2, 2};
    const double *min = low, *max = high;
    msq_lattice_faces_report* report = (msq_lattice_faces_report*)output(0);
    msq_job* job = NULL;
    report->struct_size = sizeof *report;
    WRONG(ARGUMENT, "lattice is NULL", structure = NULL);
    WRONG(ARGUMENT, "not a lattice", structure = foam);
    WRONG(UNSUPPORTED, "a period or a warp", structure = warped);
    WRONG(ARGUMENT, "min is NULL", min = NULL);
    WRONG(ARGUMENT, "max is NULL", max = NULL);
    WRONG(ARGUMENT, "report is NULL", report = NULL);
    WRONG(ARGUMENT, "min must be less", max = min);
    wrong_vector(table, low, "min is (");
    wrong_vector(table, high, "max is (");
    WRONG(LIMIT, "cells", high[0] = high[1] = high[2] = 1100);
    WRONG(LIMIT, "axis 2", high[2] = 2e7);
    WRONG(LIMIT, "axis 1", high[1] = 1e300);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    TRY(msq_lattice_faces(structure, min, max, report, job));
  }
  msq_structure_release(lattice);
  msq_structure_release(warped);
  msq_structure_release(foam);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lattices),
      cmocka_unit_test(plate_lattices),
      cmocka_unit_test(unit_cells),
  };
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_context_release(context);
  return failed;
}
