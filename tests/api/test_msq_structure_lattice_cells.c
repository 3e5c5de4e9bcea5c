/* SPDX-License-Identifier: Apache-2.0
 * msq_structure_lattice: named cells, factors of the radius, libraries of unit cells. */
#include "definitions.h"

enum { max_nodes = 32, max_struts = 48 };

/* A unit cell in arrays of its own. */
typedef struct cell_arrays {
  double nodes[max_nodes][3];
  uint32_t struts[max_struts][2];
  double factors[max_struts];
  uint64_t node_count, strut_count;
} cell_arrays;

static cell_arrays arrays_of(const msq_unit_cell_def* cell) {
  cell_arrays arrays;
  msq_unit_cell_report report;
  report.struct_size = sizeof report;
  assert_ok(msq_unit_cell_info(cell, &report, NULL, 0));
  assert_true(report.node_count <= max_nodes && report.strut_count <= max_struts);
  arrays.node_count = report.node_count;
  arrays.strut_count = report.strut_count;
  assert_ok(msq_unit_cell_geometry(cell, arrays.nodes[0], report.node_count, arrays.struts[0],
                                   report.strut_count));
  for (uint64_t s = 0; s < report.strut_count; ++s)
    arrays.factors[s] = cell->strut_factors ? cell->strut_factors[s] : 1;
  return arrays;
}

static msq_lattice_def lattice_def(double radius) {
  msq_lattice_def def;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.radius.value = radius;
  return def;
}

static double distance_to_strut(const double p[3], const double a[3], const double b[3]) {
  double along = 0, squared = 0, sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    along += (p[axis] - a[axis]) * (b[axis] - a[axis]);
    squared += (b[axis] - a[axis]) * (b[axis] - a[axis]);
  }
  along = fmin(1, fmax(0, along / squared));
  for (int axis = 0; axis < 3; ++axis) {
    const double d = p[axis] - a[axis] - along * (b[axis] - a[axis]);
    sum += d * d;
  }
  return sqrt(sum);
}

/* The radius, a number or a gradient along x, and the choice of the unit cell, which may change
 * along y: what the oracle knows of a lattice. */
typedef struct oracle {
  const cell_arrays* cells;
  int cell_count;
  double choice_from, choice_slope; /* at y */
  double radius_from, radius_slope; /* at x */
} oracle;

/* The least distance to a strut, less its radius there. */
static double gap_of(const oracle* o, const msq_neighbourhood* grid, const double point[3]) {
  double local[3], best = INFINITY;
  int base[3];
  const double radius = o->radius_from + o->radius_slope * point[0];
  for (int axis = 0; axis < 3; ++axis) { /* the rotation's inverse is its transpose */
    local[axis] = 0;
    for (int other = 0; other < 3; ++other)
      local[axis] += grid->rotation[3 * other + axis] * (point[other] - grid->origin[other]);
    base[axis] = (int)floor(local[axis] / grid->cell_size[axis]);
  }
  for (int c = 0; c < 27; ++c) {
    const int shift[3] = {base[0] + c % 3 - 1, base[1] + c / 3 % 3 - 1, base[2] + c / 9 - 1};
    double y = grid->origin[1];
    for (int axis = 0; axis < 3; ++axis)
      y += grid->rotation[3 + axis] * (shift[axis] + 0.5) * grid->cell_size[axis];
    const double choice = floor(o->choice_from + o->choice_slope * y + 0.5);
    const cell_arrays* cell = o->cells + (int)fmin(fmax(choice, 0), o->cell_count - 1);
    for (uint64_t s = 0; s < cell->strut_count; ++s) {
      double ends[2][3];
      for (int end = 0; end < 2; ++end)
        for (int axis = 0; axis < 3; ++axis)
          ends[end][axis] =
              (cell->nodes[cell->struts[s][end]][axis] + shift[axis]) * grid->cell_size[axis];
      best = fmin(best, distance_to_strut(local, ends[0], ends[1]) - cell->factors[s] * radius);
    }
  }
  return best;
}

/* Single points, an array and their distances, in a box from -3 to 3. */
static void check_lattice(const msq_lattice_def* def, const oracle* o, uint64_t random) {
  const size_t count = test_count(500);
  double(*points)[3] = (double(*)[3])malloc(count * sizeof *points);
  uint8_t* inside = (uint8_t*)malloc(count);
  msq_context* context = make_context();
  msq_structure* lattice;
  msq_points_def array;
  size_t inside_count = 0;
  assert_ok(msq_structure_lattice(context, def, &lattice));
  msq_model* model = make_model(context, make_box_of(context, -3, 3), lattice, NULL);
  for (size_t i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = random_between(&random, -3, 3);
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.coordinates = points;
  array.count = count;
  assert_ok(msq_set_membership(model, &array, NULL, inside, count, NULL));
  for (size_t i = 0; i < count; ++i) {
    const double gap = gap_of(o, &def->grid, points[i]);
    double distance;
    assert_int_equal(inside[i], is_inside(model, points[i][0], points[i][1], points[i][2]));
    assert_ok(msq_point_distance(model, points[i], NULL, &distance));
    assert_int_equal(distance <= 0, inside[i]);
    if (gap > 0) assert_true(distance <= gap + 1e-9);
    if (gap > 0 && o->radius_slope == 0) assert_near(distance, gap, 1e-9);
    if (fabs(gap) < 1e-9) continue;
    assert_int_equal(inside[i], gap < 0);
    inside_count += inside[i];
  }
  assert_true(count < 100 || (inside_count > 0 && inside_count < count));
  msq_model_release(model);
  msq_context_release(context);
  free(points);
  free(inside);
}

static void turn(msq_neighbourhood* grid) {
  const double rotation[9] = {0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6};
  memcpy(grid->rotation, rotation, sizeof rotation);
  grid->origin[0] = 0.3;
  grid->origin[1] = -0.1;
  grid->cell_size[0] = 0.7;
  grid->cell_size[1] = 1.3;
}

static void named_cells_are_tiled_capsules(void** state) {
  (void)state;
  for (int32_t name = MSQ_UNIT_CELL_FCC; name <= MSQ_UNIT_CELL_REENTRANT; ++name) {
    const msq_unit_cell_def cell = named_cell(name);
    const cell_arrays arrays = arrays_of(&cell);
    const oracle o = {&arrays, 1, 0, 0, 0.06, 0};
    msq_lattice_def def = lattice_def(0.06);
    def.unit_cell = name;
    check_lattice(&def, &o, (uint64_t)name);
    turn(&def.grid); /* struts stay circular where cells are neither cubes nor straight */
    check_lattice(&def, &o, (uint64_t)name + 20);
  }
}

/* Of a named cell, and of one's own. */
static void factors_scale_the_radius_of_struts(void** state) {
  const double nodes[3][3] = {{0, 0, 0}, {0.5, 0.25, 0.5}, {1, 0.5, 1}};
  const uint32_t struts[3][2] = {{0, 1}, {1, 2}, {0, 2}};
  double factors[8] = {2.5, 0.5, 1};
  (void)state;
  msq_unit_cell_def cell = named_cell(MSQ_UNIT_CELL_CUSTOM);
  cell.nodes = nodes[0];
  cell.node_count = 3;
  cell.struts = struts[0];
  cell.strut_count = 3;
  cell.strut_factors = factors;
  for (int which = 0; which < 2; ++which) {
    const cell_arrays arrays = arrays_of(&cell);
    const oracle o = {&arrays, 1, 0, 0, 0.08, 0};
    msq_lattice_def def = lattice_def(0.08);
    def.unit_cell = cell.unit_cell;
    def.nodes = cell.nodes;
    def.node_count = cell.node_count;
    def.struts = cell.struts;
    def.strut_count = cell.strut_count;
    def.strut_factors = factors;
    check_lattice(&def, &o, (uint64_t)which + 31);
    turn(&def.grid);
    check_lattice(&def, &o, (uint64_t)which + 41);
    cell = named_cell(MSQ_UNIT_CELL_BCC);
    cell.strut_count = 8;
    cell.strut_factors = factors;
    for (int s = 0; s < 8; ++s) factors[s] = 0.25 * (s + 1);
  }
}

/* Cells and radius both change from one cell to the next. */
static void a_field_chooses_cells_of_a_library(void** state) {
  const double from[3] = {0, -3, 0}, to[3] = {0, 3, 0}, left[3] = {-3, 0, 0}, right[3] = {3, 0, 0};
  const double factors[3] = {1, 2, 0.5};
  msq_context* context = make_context();
  msq_field *choice, *radius;
  msq_unit_cell_def cells[3] = {named_cell(MSQ_UNIT_CELL_CUBIC), named_cell(MSQ_UNIT_CELL_DIAMOND),
                                named_cell(MSQ_UNIT_CELL_CUSTOM)};
  const double nodes[3][3] = {{0.2, 0, 0.1}, {0.5, 0.9, 1}, {1, 0.5, 0.4}};
  const uint32_t struts[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  cell_arrays arrays[3];
  (void)state;
  cells[2].nodes = nodes[0];
  cells[2].node_count = 3;
  cells[2].struts = struts[0];
  cells[2].strut_count = 3;
  cells[2].strut_factors = factors;
  for (int i = 0; i < 3; ++i) arrays[i] = arrays_of(cells + i);
  assert_ok(msq_field_gradient(context, from, -1, to, 4, &choice));
  assert_ok(msq_field_gradient(context, left, 0.02, right, 0.14, &radius));
  for (int which = 0; which < 4; ++which) {
    oracle o = {arrays, 3, 1.5, 5.0 / 6, 0.08, 0.02};
    msq_lattice_def def = lattice_def(0.08);
    def.cells = cells;
    def.cell_count = 3;
    def.cell_choice.field = choice;
    def.radius.field = radius;
    if (which % 2) {
      def.radius.field = NULL;
      o.radius_slope = 0;
    }
    if (which / 2) turn(&def.grid);
    check_lattice(&def, &o, (uint64_t)which + 51);
  }
  msq_field_release(choice);
  msq_field_release(radius);
  msq_context_release(context);
}

/* The first half up, and none beyond the library. */
static void a_number_chooses_too(void** state) {
  const double numbers[] = {-7, 0.49, 0.5, 1, 1.49, 1.5, 1e300};
  const int wanted[] = {0, 0, 1, 1, 1, 2, 2};
  msq_unit_cell_def cells[3];
  cell_arrays arrays[3];
  (void)state;
  for (int i = 0; i < 3; ++i) {
    cells[i] = named_cell(MSQ_UNIT_CELL_CUBIC + i);
    arrays[i] = arrays_of(cells + i);
  }
  for (int i = 0; i < 7; ++i) {
    const oracle o = {arrays, 3, wanted[i], 0, 0.06, 0};
    msq_lattice_def def = lattice_def(0.06);
    def.cells = cells;
    def.cell_count = 3;
    def.cell_choice.value = numbers[i];
    check_lattice(&def, &o, (uint64_t)i + 61);
  }
}

static void libraries_are_copied(void** state) {
  double factors[8] = {1, 1, 1, 1, 1, 1, 1, 1};
  msq_context* context = make_context();
  msq_unit_cell_def cells[2] = {named_cell(MSQ_UNIT_CELL_BCC), named_cell(MSQ_UNIT_CELL_CUBIC)};
  msq_lattice_def def = lattice_def(0.1);
  msq_structure* lattice;
  (void)state;
  cells[0].strut_factors = factors;
  cells[0].strut_count = 8;
  def.cells = cells;
  def.cell_count = 2;
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  memset(factors, 0xff, sizeof factors);
  memset(cells, 0xff, sizeof cells);
  msq_model* model = make_model(context, make_box(context), lattice, NULL);
  assert_int_equal(is_inside(model, 0.5, 0.5, 0.5), 1);
  assert_int_equal(is_inside(model, 0.5, 0.5, 0), 0);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(named_cells_are_tiled_capsules),
      cmocka_unit_test(factors_scale_the_radius_of_struts),
      cmocka_unit_test(a_field_chooses_cells_of_a_library),
      cmocka_unit_test(a_number_chooses_too),
      cmocka_unit_test(libraries_are_copied),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
