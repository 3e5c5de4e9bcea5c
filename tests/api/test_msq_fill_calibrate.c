/* SPDX-License-Identifier: Apache-2.0
 * msq_fill_calibrate: a stack of layers of the structure with the cell sizes found has the density
 * that was asked for, within 2 %. */
#include "fills.h"

enum { kinds = 10 };

typedef msq_structure* (*make_fn)(msq_context* context, const double cell[3]);

static msq_structure* foam_with(msq_context* context, const double cell[3], double jitter,
                                uint64_t seed) {
  msq_foam_def def;
  msq_structure* made;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.radius.value = 0.05;
  def.jitter = jitter;
  def.seed = seed;
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = cell[axis];
  assert_ok(msq_structure_foam(context, &def, &made));
  return made;
}
static msq_structure* usual_foam(msq_context* context, const double cell[3]) {
  return foam_with(context, cell, 1, 0);
}
static msq_structure* calm_foam(msq_context* context, const double cell[3]) {
  return foam_with(context, cell, 0.3, 11);
}
static msq_structure* function_with(msq_context* context, const double cell[3], int32_t function,
                                    int32_t kind, int is_turned) {
  const double turned[9] = {0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8};
  msq_functional_def def;
  msq_structure* made;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.function = function;
  def.kind = kind;
  if (kind == MSQ_FUNCTIONAL_SHEET) def.thickness.value = 0.05;
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = cell[axis];
  if (is_turned) memcpy(def.grid.rotation, turned, sizeof turned);
  assert_ok(msq_structure_functional(context, &def, &made));
  return made;
}
static msq_structure* gyroid(msq_context* context, const double cell[3]) {
  return function_with(context, cell, MSQ_FUNCTION_GYROID, MSQ_FUNCTIONAL_SHEET, 0);
}
static msq_structure* network(msq_context* context, const double cell[3]) {
  return function_with(context, cell, MSQ_FUNCTION_I_WP, MSQ_FUNCTIONAL_NETWORK, 0);
}
static msq_structure* turned_diamond(msq_context* context, const double cell[3]) {
  return function_with(context, cell, MSQ_FUNCTION_DIAMOND, MSQ_FUNCTIONAL_SHEET, 1);
}

static msq_structure* closed_foam(msq_context* context, const double cell[3], double vent_radius,
                                  double stretch, double weight) {
  msq_foam_def def;
  msq_structure* made;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.wall_thickness.value = 0.05;
  def.vent_radius.value = vent_radius * cell[0];
  def.stretch[2] = stretch;
  def.weight = weight * cell[0];
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = cell[axis];
  assert_ok(msq_structure_foam(context, &def, &made));
  return made;
}
static msq_structure* foam_with_holes(msq_context* context, const double cell[3]) {
  return closed_foam(context, cell, 0.2, 1, 0);
}
static msq_structure* stretched_foam(msq_context* context, const double cell[3]) {
  return closed_foam(context, cell, 0, 2, 0);
}
static msq_structure* weighted_foam(msq_context* context, const double cell[3]) {
  return closed_foam(context, cell, 0, 1, 0.7);
}
static msq_structure* octet_plates(msq_context* context, const double cell[3]) {
  msq_plate_lattice_def def;
  msq_structure* made;
  assert_ok(msq_plate_lattice_def_init(&def, sizeof def));
  def.plate_cell = MSQ_PLATE_CELL_FCC;
  def.thickness.value = 0.05;
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = cell[axis];
  assert_ok(msq_structure_plate_lattice(context, &def, &made));
  return made;
}
static msq_structure* few_waves(msq_context* context, const double cell[3]) {
  msq_waves_def def;
  msq_structure* made;
  assert_ok(msq_waves_def_init(&def, sizeof def));
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.count = 8;
  def.level.value = 0.1;
  for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = cell[axis];
  assert_ok(msq_structure_waves(context, &def, &made));
  return made;
}

static void stacks_have_the_density(void** state) {
  static const struct {
    const char* name;
    make_fn make;
    double cell[3];
  } known[kinds] = {{"foam", usual_foam, {1, 1, 1}},
                    {"foam of unlike cells, jitter 0.3", calm_foam, {2, 1, 1.5}},
                    {"gyroid", gyroid, {3, 3, 3}},
                    {"I-WP network", network, {2, 1.5, 1}},
                    {"turned diamond", turned_diamond, {2, 2, 2}},
                    {"foam with holes", foam_with_holes, {1, 1, 1}},
                    {"stretched foam", stretched_foam, {1, 1, 1}},
                    {"weighted foam", weighted_foam, {1, 1, 1}},
                    {"octet plates", octet_plates, {1, 1.5, 1}},
                    {"waves", few_waves, {1, 1, 1}}};
  msq_context* context = make_context();
  const double width = 0.2, density = 0.15;
  /* Single layers vary. */
  const int all_layers = test_scale() < 1 ? 10 : 30;
  const double tolerance = test_scale() < 1 ? 0.04 : 0.02;
  (void)state;
  for (int k = 0; k < kinds; ++k) {
    if (test_scale() < 1 && (k == 6 || k == 7)) continue;
    double cell[3] = {-1, -1, -1};
    msq_structure* given = known[k].make(context, known[k].cell);
    assert_ok(msq_fill_calibrate(context, given, width, density, cell, NULL));
    assert_near(cell[1] / cell[0], known[k].cell[1] / known[k].cell[0], 1e-12);
    assert_near(cell[2] / cell[0], known[k].cell[2] / known[k].cell[0], 1e-12);
    msq_structure_release(given);

    msq_structure* made = known[k].make(context, cell);
    /* About 40 x 40 cells, or half as many, at heights through 13 of them. */
    const int layers = test_scale() < 1 && k >= 5 ? all_layers / 2 : all_layers;
    const double length = test_scale() < 1 && k >= 5 ? 60 : 120;
    const int64_t side = (int64_t)(1e6 * length);
    const int64_t corners[4][2] = {{0, 0}, {side, 0}, {side, side}, {0, side}};
    const msq_ring ring = {corners, 4};
    double sum = 0;
    for (int i = 0; i < layers; ++i) {
      msq_fill_def def = square_def((i + 0.5) / layers * 13 * cell[2] + 1000);
      def.rings = &ring;
      def.ring_count = 1;
      msq_fill* fill = make_fill(context, made, &def);
      sum += paths_of(fill).length;
      msq_fill_release(fill);
    }
    const double found = sum * width / (layers * length * length);
    print_message("%s: cell %.4f %.4f %.4f, density %.5f, %+.2f %%\n", known[k].name, cell[0],
                  cell[1], cell[2], found, 100 * (found / density - 1));
    assert_near(found, density, tolerance * density);
    msq_structure_release(made);
  }
  msq_context_release(context);
}

static void turn(double rotation[9], int axis, double angle) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (int i = 0; i < 9; ++i) rotation[i] = i % 4 == 0;
  rotation[3 * u + u] = rotation[3 * v + v] = cos(angle);
  rotation[3 * v + u] = sin(angle);
  rotation[3 * u + v] = -sin(angle);
}

/* Turned about z the lines are as long, and a turn by 0.001 about x or y changes hardly one. */
static void turned_cells_have_the_same_size(void** state) {
  static const struct {
    int axis;
    double angle, tolerance;
  } turns[] = {{2, 1e-4, 3e-3}, {2, 0.01, 3e-3}, {2, 0.1, 3e-3},  {2, 0.3, 3e-3},
               {2, 0.7, 3e-3},  {2, 1.2, 3e-3},  {1, 1e-3, 3e-3}, {0, 1e-3, 3e-3}};
  static const double nodes[4][3] = {{0, 0, 0}, {1, 0, 1}, {0.5, 0.5, 0.2}, {0.1, 0.9, 0.7}};
  static const uint32_t faces[2][3] = {{0, 1, 2}, {1, 2, 3}};
  msq_context* context = make_context();
  (void)state;
  for (int k = 0; k < 4; ++k) {
    double plain[3] = {0};
    for (size_t i = 0; i <= sizeof turns / sizeof *turns; ++i) {
      double rotation[9], cell[3];
      msq_structure* made;
      turn(rotation, i ? turns[i - 1].axis : 2, i ? turns[i - 1].angle : 0);
      if (k < 3) {
        msq_plate_lattice_def def;
        assert_ok(msq_plate_lattice_def_init(&def, sizeof def));
        def.plate_cell = k == 0   ? MSQ_PLATE_CELL_FCC
                         : k == 1 ? MSQ_PLATE_CELL_CUBIC
                                  : MSQ_PLATE_CELL_CUSTOM;
        def.nodes = &nodes[0][0];
        def.node_count = 4;
        def.faces = &faces[0][0];
        def.face_count = 2;
        def.thickness.value = 0.05;
        memcpy(def.grid.rotation, rotation, sizeof rotation);
        assert_ok(msq_structure_plate_lattice(context, &def, &made));
      } else {
        msq_functional_def def;
        assert_ok(msq_functional_def_init(&def, sizeof def));
        def.kind = MSQ_FUNCTIONAL_SHEET;
        def.thickness.value = 0.05;
        memcpy(def.grid.rotation, rotation, sizeof rotation);
        assert_ok(msq_structure_functional(context, &def, &made));
      }
      assert_ok(msq_fill_calibrate(context, made, 0.2, 0.15, i ? cell : plain, NULL));
      msq_structure_release(made);
      if (i && fabs(cell[0] / plain[0] - 1) > turns[i - 1].tolerance)
        fail_msg("structure %d, turn %g about %d: %g, not %g", k, turns[i - 1].angle,
                 turns[i - 1].axis, cell[0], plain[0]);
    }
  }
  msq_context_release(context);
}

/* Planes of cubic plates whose normals are at an angle t to z have lines of length sin(t) /
 * distance per area, on average over all heights. */
static void planes_have_the_lines_of_the_formula(void** state) {
  static const struct {
    double cell[3], angle;
    int axis;
  } rows[] = {{{1, 1, 1}, 0.004, 0},
              {{1, 1, 1}, 0.3, 2},
              {{1, 1, 1}, 0.7, 1},
              {{1, 1, 8.0 / 61}, 0.0121, 0},
              {{1, 1, 16.0 / 61}, 0.0121, 1},
              {{1, 2, 5}, 0.3, 2},
              {{3, 1, 1.7}, 0.9, 0},
              {{1, 1, 0.3}, 0.05, 1}};
  msq_context* context = make_context();
  (void)state;
  for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
    double cell[3], lines = 0;
    msq_plate_lattice_def def;
    msq_structure* made;
    assert_ok(msq_plate_lattice_def_init(&def, sizeof def));
    def.thickness.value = 0.05;
    memcpy(def.grid.cell_size, rows[i].cell, sizeof cell);
    turn(def.grid.rotation, rows[i].axis, rows[i].angle);
    def.grid.origin[2] = 0.35;
    assert_ok(msq_structure_plate_lattice(context, &def, &made));
    assert_ok(msq_fill_calibrate(context, made, 0.2, 0.15, cell, NULL));
    msq_structure_release(made);
    for (int axis = 0; axis < 3; ++axis) {
      const double up = def.grid.rotation[6 + axis];
      lines += sqrt(fmax(0, 1 - up * up)) / rows[i].cell[axis];
    }
    const double error = cell[0] / (rows[i].cell[0] * lines * 0.2 / 0.15) - 1;
    if (fabs(error) > 6e-3) fail_msg("row %zu: %+.2f %%", i, 100 * error);
  }
  msq_context_release(context);
}

/* Only their calibration is refused. */
static void graded_foams_have_lines(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {4, 0, 0};
  msq_context* context = make_context();
  msq_structure* graded;
  msq_field* field;
  msq_foam_def def;
  (void)state;
  assert_ok(msq_field_gradient(context, from, 1, to, 9, &field));
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.radius.value = 0.1;
  def.density.field = field;
  assert_ok(msq_structure_foam(context, &def, &graded));
  const msq_fill_def square = square_def(1);
  msq_fill* fill = make_fill(context, graded, &square);
  assert_true(paths_of(fill).path_count > 100);
  msq_fill_release(fill);
  msq_structure_release(graded);
  msq_field_release(field);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(stacks_have_the_density),
      cmocka_unit_test(turned_cells_have_the_same_size),
      cmocka_unit_test(planes_have_the_lines_of_the_formula),
      cmocka_unit_test(graded_foams_have_lines),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
