/* SPDX-License-Identifier: Apache-2.0
 * msq_lattice_def_init, msq_structure_lattice, msq_structure_retain, msq_structure_release. */
#include "definitions.h"

/* Bytes of the definition when it was published. */
/* A cell with nothing in common with the named ones. */
static const double custom_nodes[4][3] = {
    {0, 0, 0}, {0.25, 0.25, 0.25}, {0.5, 0.5, 0}, {0.9, 0.1, 1}};
static const uint32_t custom_struts[3][2] = {{0, 1}, {1, 2}, {2, 3}};

static msq_lattice_def lattice_def(int32_t unit_cell, double radius) {
  msq_lattice_def def;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = unit_cell;
  def.radius.value = radius;
  if (unit_cell == MSQ_UNIT_CELL_CUSTOM) {
    def.nodes = custom_nodes[0];
    def.node_count = 4;
    def.struts = custom_struts[0];
    def.strut_count = 3;
  }
  return def;
}

DEFINE_CREATE(structure, structure_lattice, lattice_def)

static void defaults_are_those_of_the_header(void** state) {
  msq_lattice_def def;
  (void)state;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  assert_int_equal(def.unit_cell, MSQ_UNIT_CELL_BCC);
  assert_default_grid(&def.grid);
  assert_null(def.radius.field);
  assert_null(def.nodes);
  assert_null(def.struts);
  assert_null(def.strut_factors);
  assert_null(def.cells);
  assert_int_equal(def.cell_count, 0);
  assert_int_equal(def.clusters, 0);
}

/* ---- the solid, against distances to all struts of the cells around */

typedef struct oracle {
  double nodes[16][3];
  int struts[64][2];
  int strut_count;
} oracle;

static double distance_between(const double a[3], const double b[3]) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
              (a[2] - b[2]) * (a[2] - b[2]));
}

/* Struts between nodes at this distance in the unit cube. */
static void connect(oracle* cell, int node_count, double distance) {
  cell->strut_count = 0;
  for (int i = 0; i < node_count; ++i)
    for (int j = i + 1; j < node_count; ++j)
      if (fabs(distance_between(cell->nodes[i], cell->nodes[j]) - distance) < 1e-9) {
        cell->struts[cell->strut_count][0] = i;
        cell->struts[cell->strut_count++][1] = j;
      }
}

static oracle oracle_of(int32_t unit_cell) {
  oracle cell;
  memset(&cell, 0, sizeof cell);
  if (unit_cell == MSQ_UNIT_CELL_CUSTOM) {
    memcpy(cell.nodes, custom_nodes, sizeof custom_nodes);
    for (int i = 0; i < 3; ++i)
      for (int end = 0; end < 2; ++end) cell.struts[i][end] = (int)custom_struts[i][end];
    cell.strut_count = 3;
    return cell;
  }
  cube_corners(0, 1, cell.nodes);
  if (unit_cell == MSQ_UNIT_CELL_CUBIC) {
    connect(&cell, 8, 1);
  } else if (unit_cell == MSQ_UNIT_CELL_BCC) {
    for (int axis = 0; axis < 3; ++axis) cell.nodes[8][axis] = 0.5;
    connect(&cell, 9, sqrt(0.75));
  } else {
    for (int face = 0; face < 6; ++face)
      for (int axis = 0; axis < 3; ++axis)
        cell.nodes[8 + face][axis] = axis == face / 2 ? face % 2 : 0.5;
    connect(&cell, 14, sqrt(0.5));
  }
  return cell;
}

static double distance_to_strut(const double p[3], const double a[3], const double b[3]) {
  double along = 0, squared = 0, nearest[3];
  for (int axis = 0; axis < 3; ++axis) {
    along += (p[axis] - a[axis]) * (b[axis] - a[axis]);
    squared += (b[axis] - a[axis]) * (b[axis] - a[axis]);
  }
  along = fmin(1, fmax(0, along / squared));
  for (int axis = 0; axis < 3; ++axis) nearest[axis] = a[axis] + along * (b[axis] - a[axis]);
  return distance_between(p, nearest);
}

/* From a point in model coordinates to the tiling's nearest strut, within `around` cells. */
static double distance_to_lattice(const oracle* cell, const msq_neighbourhood* grid,
                                  const double point[3], int around) {
  double local[3], best = INFINITY;
  int base[3];
  for (int axis = 0; axis < 3; ++axis) { /* the rotation's inverse is its transpose */
    local[axis] = 0;
    for (int other = 0; other < 3; ++other)
      local[axis] += grid->rotation[3 * other + axis] * (point[other] - grid->origin[other]);
    base[axis] = (int)floor(local[axis] / grid->cell_size[axis]);
  }
  const int side = 2 * around + 1;
  for (int c = 0; c < side * side * side; ++c) {
    const int shift[3] = {base[0] + c % side - around, base[1] + c / side % side - around,
                          base[2] + c / side / side - around};
    for (int s = 0; s < cell->strut_count; ++s) {
      double ends[2][3];
      for (int end = 0; end < 2; ++end)
        for (int axis = 0; axis < 3; ++axis)
          ends[end][axis] =
              (cell->nodes[cell->struts[s][end]][axis] + shift[axis]) * grid->cell_size[axis];
      best = fmin(best, distance_to_strut(local, ends[0], ends[1]));
    }
  }
  return best;
}

/* Both point by point and as a set. */
static void check_lattice(const msq_lattice_def* def, int around, uint64_t random) {
  const size_t count = test_count(600);
  const oracle cell = oracle_of(def->unit_cell);
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
    const double distance = distance_to_lattice(&cell, &def->grid, points[i], around);
    assert_int_equal(inside[i], is_inside(model, points[i][0], points[i][1], points[i][2]));
    if (fabs(distance - def->radius.value) < 1e-9) continue;
    assert_int_equal(inside[i], distance < def->radius.value);
    inside_count += inside[i];
  }
  assert_true(count < 100 || (inside_count > 0 && inside_count < count));
  msq_model_release(model);
  msq_context_release(context);
  free(points);
  free(inside);
}

static void unit_cells_are_tiled_capsules(void** state) {
  (void)state;
  for (int32_t cell = MSQ_UNIT_CELL_CUSTOM; cell <= MSQ_UNIT_CELL_OCTET; ++cell) {
    const msq_lattice_def def = lattice_def(cell, 0.12);
    check_lattice(&def, 1, (uint64_t)cell + 1);
  }
}

static void unit_cells_stand_on_any_grid(void** state) {
  (void)state;
  for (int32_t cell = MSQ_UNIT_CELL_CUSTOM; cell <= MSQ_UNIT_CELL_OCTET; ++cell) {
    msq_lattice_def def = lattice_def(cell, 0.12);
    const double rotation[9] = {0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6};
    memcpy(def.grid.rotation, rotation, sizeof rotation);
    def.grid.origin[0] = 0.3;
    def.grid.origin[1] = -7.1;
    def.grid.cell_size[0] = 0.7;
    def.grid.cell_size[1] = 1.3;
    check_lattice(&def, 1, (uint64_t)cell + 11);
  }
}

/* A cell of one strut of no more than a tenth: as a radius above the cell size would fill all of it
 * from its neighbours' neighbours. */
static void struts_reach_over_cell_borders(void** state) {
  const double nodes[2][3] = {{0, 0, 0}, {0.125, 0, 0}};
  const uint32_t struts[1][2] = {{0, 1}};
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_CUSTOM, 3.5);
  msq_context* context = make_context();
  msq_structure* lattice;
  (void)state;
  def.nodes = nodes[0];
  def.node_count = 2;
  def.struts = struts[0];
  def.strut_count = 1;
  def.grid.cell_size[0] = 1;
  def.grid.cell_size[1] = 7.5;
  def.grid.cell_size[2] = 7.5;
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  msq_model* model = make_model(context, make_box_of(context, -10, 10), lattice, NULL);
  assert_int_equal(is_inside(model, 0.05, 3.49, 0), 1);
  assert_int_equal(is_inside(model, 0.05, -3.49, 0), 1);
  assert_int_equal(is_inside(model, 0.05, 3.51, 0), 0);
  assert_int_equal(is_inside(model, 0.05, 3.75, 3.75), 0);
  assert_int_equal(is_inside(model, 0.05, 7.5 - 2.4, 2.4), 1);
  msq_model_release(model);
  msq_context_release(context);
}

static void custom_arrays_are_copied(void** state) {
  double nodes[4][3];
  uint32_t struts[3][2];
  msq_context* context = make_context();
  msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_CUSTOM, 0.1);
  msq_structure* lattice;
  (void)state;
  memcpy(nodes, custom_nodes, sizeof nodes);
  memcpy(struts, custom_struts, sizeof struts);
  def.nodes = nodes[0];
  def.struts = struts[0];
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  memset(nodes, 0xff, sizeof nodes);
  memset(struts, 0xff, sizeof struts);
  msq_model* model = make_model(context, make_box(context), lattice, NULL);
  assert_int_equal(is_inside(model, 1.1, 1.1, 1.1), 1);
  assert_int_equal(is_inside(model, 1.6, 1.7, 1.5), 0);
  msq_model_release(model);
  msq_context_release(context);
}

static void structures_are_counted(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice(context);
  (void)state;
  msq_structure_release(NULL);
  msq_structure_retain(NULL);
  msq_structure_retain(lattice);
  msq_model* first = make_model(context, make_box(context), lattice, NULL);
  msq_model* second = make_model(context, make_box(context), lattice, NULL);
  msq_model_release(first);
  assert_int_equal(is_inside(second, 0.5, 0.5, 0.5), 1);
  msq_model_release(second);
  msq_context_release(context);
}

/* ---- what is refused */

static void clusters_change_no_answer(void** state) {
  enum { count = 3000 };
  static double points[3 * count];
  uint8_t inside[count], expected[count];
  const double low[3] = {-1, -1, -1}, high[3] = {2, 2, 2};
  const uint32_t clusters[] = {1, 0, 2, 63, 64};
  msq_context* context;
  msq_shape* cube;
  (void)state;
  for (int i = 0; i < 3 * count; ++i) points[i] = (i * 2654435761u % 65536u) / 65536.0 * 3 - 1;
  assert_ok(msq_context_create(NULL, &context));
  assert_ok(msq_shape_from_box(context, low, high, &cube));
  msq_lattice_def too_many = lattice_def(MSQ_UNIT_CELL_OCTET, 0.1);
  too_many.clusters = 65;
  assert_refused(create(context, &too_many), MSQ_E_ARGUMENT, "clusters is 65");
  assert_message_has("64");
  for (size_t n = 0; n < sizeof clusters / sizeof *clusters; ++n) {
    msq_lattice_def def = lattice_def(MSQ_UNIT_CELL_OCTET, 0.1);
    msq_structure* structure;
    msq_model* model;
    msq_model_def model_def;
    msq_points_def points_def;
    int held = 0;
    def.clusters = clusters[n];
    assert_ok(msq_structure_lattice(context, &def, &structure));
    assert_ok(msq_model_def_init(&model_def, sizeof model_def));
    {
      msq_scale_def scales[2];
      memset(scales, 0, sizeof scales);
      scales[0].shape = cube;
      scales[1].structure = structure;
      model_def.scales = scales;
      model_def.scale_count = 2;
      assert_ok(msq_model_create(context, &model_def, &model));
    }
    assert_ok(msq_points_def_init(&points_def, sizeof points_def));
    points_def.kind = MSQ_POINTS_ARRAY;
    points_def.coordinates = points;
    points_def.count = count;
    assert_ok(msq_set_membership(model, &points_def, NULL, inside, count, NULL));
    for (int i = 0; i < count; ++i) held += inside[i];
    assert_in_range(held, 1, count - 1);
    if (n == 0)
      memcpy(expected, inside, sizeof expected);
    else
      assert_memory_equal(inside, expected, sizeof expected);
    msq_model_release(model);
    msq_structure_release(structure);
  }
  msq_shape_release(cube);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(unit_cells_are_tiled_capsules),
      cmocka_unit_test(unit_cells_stand_on_any_grid),
      cmocka_unit_test(struts_reach_over_cell_borders),
      cmocka_unit_test(custom_arrays_are_copied),
      cmocka_unit_test(clusters_change_no_answer),
      cmocka_unit_test(structures_are_counted),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
