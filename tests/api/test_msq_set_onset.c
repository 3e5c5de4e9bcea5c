/* SPDX-License-Identifier: Apache-2.0 */
#include "definitions.h"

enum { count = 4000 };

static msq_context* context;
static double points[count][3], onsets[count], gradients[count][3];

static int set_up(void** state) {
  uint64_t random = 3;
  (void)state;
  context = make_context();
  for (int i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = random_between(&random, -7, 7);
  return 0;
}

static int tear_down(void** state) {
  (void)state;
  msq_context_release(context);
  return 0;
}

static msq_points_def array_points(void) {
  msq_points_def def;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinates = points;
  def.count = count;
  return def;
}

static void ask(const msq_structure* structure, int32_t value) {
  const msq_points_def def = array_points();
  assert_ok(
      msq_set_onset(context, structure, &def, value, onsets, count, gradients[0], 3 * count, NULL));
}

/* The distance to the edges of a cubic grid of cells of 2, and its gradient: 0 along the nearest
 * edge. False near the places where two edges are as near. */
static int cubic_oracle(const double p[3], double* distance, double gradient[3]) {
  double offset[3], least = INFINITY, next = INFINITY;
  int along = 0;
  for (int axis = 0; axis < 3; ++axis) offset[axis] = p[axis] - 2 * round(p[axis] / 2);
  for (int axis = 0; axis < 3; ++axis) {
    const double a = offset[(axis + 1) % 3], b = offset[(axis + 2) % 3], d = sqrt(a * a + b * b);
    if (d < least) {
      next = least;
      least = d;
      along = axis;
    } else if (d < next) {
      next = d;
    }
  }
  *distance = least;
  for (int axis = 0; axis < 3; ++axis) gradient[axis] = axis == along ? 0 : offset[axis] / least;
  if (next - least < 1e-3 || least < 1e-2) return 0;
  for (int axis = 0; axis < 3; ++axis)
    if (fabs(offset[axis]) > 0.999) return 0;
  return 1;
}

static void of_lattices_is_the_distance_to_axes(void** state) {
  msq_structure* cubic = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.2);
  int smooth = 0;
  (void)state;
  ask(cubic, MSQ_ONSET_PLAIN);
  for (int i = 0; i < count; ++i) {
    double distance, gradient[3];
    const int is_smooth = cubic_oracle(points[i], &distance, gradient);
    assert_near(onsets[i], distance, 1e-13);
    for (int axis = 0; is_smooth && axis < 3; ++axis)
      assert_near(gradients[i][axis], gradient[axis], 1e-5);
    smooth += is_smooth;
  }
  assert_true(smooth > count / 2);
  ask(cubic, MSQ_ONSET_SIGNED);
  for (int i = 0; i < count; ++i) {
    double distance, gradient[3];
    cubic_oracle(points[i], &distance, gradient);
    assert_near(onsets[i], distance - 0.2, 1e-13);
  }
  msq_structure_release(cubic);
}

/* A gyroid of period 4 whose level is linear in x. */
static msq_structure* make_graded_gyroid(int32_t kind) {
  const double from[3] = {-10, 0, 0}, to[3] = {10, 0, 0};
  msq_functional_def def;
  msq_structure* gyroid;
  msq_field* level;
  assert_ok(msq_field_gradient(context, from, 0.2, to, 0.6, &level));
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.function = MSQ_FUNCTION_GYROID;
  def.kind = kind;
  set_cell(&def.grid, 4);
  def.level.field = level;
  assert_ok(msq_structure_functional(context, &def, &gyroid));
  msq_field_release(level);
  return gyroid;
}

static void of_functions_is_the_function(void** state) {
  const double k = 2 * 3.14159265358979323846 / 4;
  (void)state;
  for (int32_t kind = MSQ_FUNCTIONAL_NETWORK; kind <= MSQ_FUNCTIONAL_SHEET; ++kind) {
    msq_structure* gyroid = make_graded_gyroid(kind);
    for (int32_t value = MSQ_ONSET_PLAIN; value <= MSQ_ONSET_SIGNED; ++value) {
      ask(gyroid, value);
      for (int i = 0; i < count; ++i) {
        const double x = k * points[i][0], y = k * points[i][1], z = k * points[i][2];
        double g = sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);
        double d[3] = {k * (cos(x) * cos(y) - sin(z) * sin(x)),
                       k * (cos(y) * cos(z) - sin(x) * sin(y)),
                       k * (cos(z) * cos(x) - sin(y) * sin(z))};
        if (kind == MSQ_FUNCTIONAL_SHEET && fabs(g) < 1e-3) continue;
        if (kind == MSQ_FUNCTIONAL_SHEET && g < 0) {
          g = -g;
          for (int axis = 0; axis < 3; ++axis) d[axis] = -d[axis];
        }
        if (value == MSQ_ONSET_SIGNED) {
          g -= 0.4 + 0.02 * points[i][0];
          d[0] -= 0.02;
        }
        assert_near(onsets[i], g, 1e-12);
        for (int axis = 0; axis < 3; ++axis) assert_near(gradients[i][axis], d[axis], 1e-7);
      }
    }
    msq_structure_release(gyroid);
  }
}

static void its_sign_is_membership(void** state) {
  msq_structure* all[4] = {make_lattice(context), make_foam(context, MSQ_FOAM_DIRECT),
                           make_graded_gyroid(MSQ_FUNCTIONAL_NETWORK),
                           make_graded_gyroid(MSQ_FUNCTIONAL_SHEET)};
  const msq_points_def def = array_points();
  static uint8_t inside[count];
  (void)state;
  for (int s = 0; s < 4; ++s) {
    msq_shape* space;
    int held = 0;
    ask(all[s], MSQ_ONSET_SIGNED);
    assert_ok(msq_shape_all_space(context, &space));
    msq_model* model = make_model(context, space, all[s], NULL);
    assert_ok(msq_set_membership(model, &def, NULL, inside, count, NULL));
    for (int i = 0; i < count; ++i) {
      held += inside[i];
      if (s >= 2 || fabs(onsets[i]) > 1e-9) assert_int_equal(inside[i], onsets[i] <= 0);
    }
    assert_true(held > count / 100 && held < count);
    msq_model_release(model);
  }
}

/* Of a union of struts: the least of the members' onsets, and the least of their differences from
 * their own radii, whose sign is the union's membership. */
static void of_unions_is_the_least(void** state) {
  const double from[3] = {-7, 0, 0}, to[3] = {7, 0, 0};
  static double least[2][count], slopes[count][3];
  static uint8_t inside[count], owner[2][count];
  const msq_points_def def = array_points();
  msq_field* radius;
  msq_foam_def foam_def;
  const msq_structure* members[2];
  msq_structure *foam, *both, *more;
  msq_shape* space;
  int of_foam = 0, unlike = 0, held = 0, bends = 0;
  (void)state;
  assert_ok(msq_field_gradient(context, from, 0.05, to, 0.5, &radius));
  assert_ok(msq_foam_def_init(&foam_def, sizeof foam_def));
  foam_def.radius.field = radius;
  for (int axis = 0; axis < 3; ++axis) foam_def.grid.cell_size[axis] = 3;
  assert_ok(msq_structure_foam(context, &foam_def, &foam));
  members[0] = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 2, 0.15);
  members[1] = foam;
  for (int value = 0; value < 2; ++value)
    for (int m = 0; m < 2; ++m) {
      ask(members[m], value);
      for (int i = 0; i < count; ++i)
        if (m == 0 || onsets[i] < least[value][i]) {
          least[value][i] = onsets[i];
          if (value == MSQ_ONSET_PLAIN) memcpy(slopes[i], gradients[i], sizeof slopes[i]);
          owner[value][i] = (uint8_t)m;
        }
    }
  /* The nearest axis need not be that of the nearest surface: radii differ. */
  for (int i = 0; i < count; ++i) {
    of_foam += owner[0][i];
    unlike += owner[0][i] != owner[1][i];
  }
  assert_in_range(of_foam, count / 10, count - count / 10);
  assert_true(unlike > count / 50);
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, members, 2, &both));
  ask(both, MSQ_ONSET_PLAIN);
  assert_memory_equal(onsets, least[0], sizeof onsets);
  for (int i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) bends += fabs(gradients[i][axis] - slopes[i][axis]) > 1e-5;
  assert_true(bends < count / 100); /* ridges, and steps that are not alike */
  members[1] = both;
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, members, 2, &more));
  ask(more, MSQ_ONSET_SIGNED);
  for (int i = 0; i < count; ++i) assert_float_equal(onsets[i], least[1][i], 1e-12);
  assert_ok(msq_shape_all_space(context, &space));
  msq_model* model = make_model(context, space, both, NULL);
  assert_ok(msq_set_membership(model, &def, NULL, inside, count, NULL));
  for (int i = 0; i < count; ++i) {
    held += inside[i];
    if (fabs(onsets[i]) > 1e-8) assert_int_equal(inside[i], onsets[i] <= 0);
  }
  assert_in_range(held, count / 100, count);
  msq_model_release(model);
  msq_structure_release(more);
  msq_structure_release((msq_structure*)members[0]);
  msq_structure_release(foam);
  msq_field_release(radius);
}

/* Takes `structure`. */
static void check_limit(msq_structure* structure, double limit) {
  int beyond = 0;
  ask(structure, MSQ_ONSET_PLAIN);
  for (int i = 0; i < count; ++i) {
    if (onsets[i] == INFINITY)
      ++beyond;
    else
      assert_true(onsets[i] <= limit);
  }
  assert_in_range(beyond, 1, count - 1);
  msq_structure_release(structure);
}

/* The distance to copies, in cells of these sizes, of a strut from a cell's corner to `end`. */
static double from_copies(const double p[3], const double sizes[3], const double end[3]) {
  double least = INFINITY, squared = 0;
  for (int axis = 0; axis < 3; ++axis) squared += end[axis] * end[axis];
  for (int i = -20; i <= 20; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k) {
        const double v[3] = {p[0] - i * sizes[0], p[1] - j * sizes[1], p[2] - k * sizes[2]};
        double s = 0, away = 0;
        for (int axis = 0; axis < 3; ++axis) s += v[axis] * end[axis] / squared;
        s = fmin(1, fmax(0, s));
        for (int axis = 0; axis < 3; ++axis) away += pow(v[axis] - s * end[axis], 2);
        least = fmin(least, sqrt(away));
      }
  return least;
}

/* Of cells that are short along x: points are farther from everything than the limit, which is the
 * smallest cell size for foams. */
static void beyond_the_limit_is_infinite(void** state) {
  static const double nodes[3][3] = {{0, 0, 0}, {0.1, 0.1, 0.1}, {0.1, 0, 0}}, factors[1] = {0.5};
  static const uint32_t corners[3] = {0, 1, 2};
  static const double sizes[3] = {0.5, 14, 14}, foam_sizes[3] = {0.5, 2, 2};
  msq_lattice_def lattice;
  msq_plate_lattice_def plates;
  msq_foam_def foam;
  msq_structure* made;
  (void)state;
  assert_ok(msq_lattice_def_init(&lattice, sizeof lattice));
  lattice.unit_cell = MSQ_UNIT_CELL_CUSTOM;
  memcpy(lattice.grid.cell_size, sizes, sizeof sizes);
  lattice.radius.value = 0.1;
  lattice.nodes = nodes[0];
  lattice.node_count = 2;
  lattice.struts = corners;
  lattice.strut_count = 1;
  assert_ok(msq_structure_lattice(context, &lattice, &made));
  check_limit(made, 2);
  for (int i = 0; i < count; ++i) {
    const double end[3] = {nodes[1][0] * sizes[0], nodes[1][1] * sizes[1], nodes[1][2] * sizes[2]};
    const double least = from_copies(points[i], sizes, end);
    if (least < 2 - 1e-9) assert_float_equal(onsets[i], least, 1e-9);
    if (least > 2 + 1e-9) assert_true(onsets[i] == INFINITY);
  }
  lattice.strut_factors = factors;
  assert_ok(msq_structure_lattice(context, &lattice, &made));
  check_limit(made, 4);
  assert_ok(msq_plate_lattice_def_init(&plates, sizeof plates));
  plates.plate_cell = MSQ_PLATE_CELL_CUSTOM;
  plates.grid = lattice.grid;
  plates.thickness.value = 0.1;
  plates.nodes = nodes[0];
  plates.node_count = 3;
  plates.faces = corners;
  plates.face_count = 1;
  assert_ok(msq_structure_plate_lattice(context, &plates, &made));
  check_limit(made, 2);
  for (int has_walls = 0; has_walls < 2; ++has_walls) {
    assert_ok(msq_foam_def_init(&foam, sizeof foam));
    memcpy(foam.grid.cell_size, foam_sizes, sizeof foam_sizes);
    (has_walls ? &foam.wall_thickness : &foam.radius)->value = 0.1;
    assert_ok(msq_structure_foam(context, &foam, &made));
    ask(made, MSQ_ONSET_PLAIN);
    double farthest = 0;
    for (int i = 0; i < count; ++i) farthest = fmax(farthest, onsets[i]);
    assert_true(farthest > 0.5 && farthest < INFINITY); /* foams have none by themselves */
    msq_structure_release(made);
  }
}

static void grids_and_windows_have_the_values_of_their_points(void** state) {
  enum { n = 6 };
  msq_structure* foam = make_foam(context, MSQ_FOAM_DIRECT);
  msq_points_def grid = grid_points(-1, 1, n), one = array_points();
  double whole[n * n * n], part[2 * 3 * 4], slopes[2 * 3 * 4][3];
  (void)state;
  assert_ok(msq_set_onset(context, foam, &grid, MSQ_ONSET_PLAIN, whole, n * n * n, NULL, 0, NULL));
  grid.window.first[0] = 4;
  grid.window.first[2] = 1;
  for (uint64_t axis = 0; axis < 3; ++axis) grid.window.count[axis] = 2 + axis;
  assert_ok(msq_set_onset(context, foam, &grid, MSQ_ONSET_PLAIN, part, 24, slopes[0], 72, NULL));
  for (uint64_t i = 0; i < 24; ++i) {
    double point[3], alone, slope[3], length = 0;
    assert_true(part[i] == whole[4 + i % 2 + n * (i / 2 % 3 + n * (1 + i / 6))]);
    assert_ok(msq_points_generate(&grid, i, 1, point));
    one.coordinates = point;
    one.count = 1;
    assert_ok(msq_set_onset(context, foam, &one, MSQ_ONSET_PLAIN, &alone, 1, slope, 3, NULL));
    assert_true(alone == part[i]);
    assert_memory_equal(slope, slopes[i], sizeof slope);
    for (int axis = 0; axis < 3; ++axis) length += slope[axis] * slope[axis];
    assert_true(length < 1 + 1e-6); /* a distance */
  }
  msq_structure_release(foam);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(of_lattices_is_the_distance_to_axes),
      cmocka_unit_test(of_functions_is_the_function),
      cmocka_unit_test(its_sign_is_membership),
      cmocka_unit_test(of_unions_is_the_least),
      cmocka_unit_test(beyond_the_limit_is_infinite),
      cmocka_unit_test(grids_and_windows_have_the_values_of_their_points),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
