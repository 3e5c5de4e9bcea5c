/* SPDX-License-Identifier: Apache-2.0
 * MSQ_WARP_SAMPLED: functional structures and lattices against an evaluation of the map, and of all
 * struts of all cells, by other means: 10^5 points each with MSQ_TEST_SCALE=10. */
#include "maps.h"

static msq_points_def array_of(const double* points, uint64_t count) {
  msq_points_def def;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinates = points;
  def.count = count;
  return def;
}

/* In a box that is larger than that of the samples. */
static double* random_points(size_t count) {
  double* const points = (double*)malloc(count * 3 * sizeof(double));
  uint64_t state = 23;
  assert_non_null(points);
  for (size_t i = 0; i < count; ++i) {
    points[3 * i] = random_between(&state, -2.9, 2.0);
    points[3 * i + 1] = random_between(&state, -1.6, 2.4);
    points[3 * i + 2] = random_between(&state, -1.6, 1.6);
  }
  return points;
}

static const double turn = 6.283185307179586;

static void functions_are_evaluated_through_the_map(void** state) {
  msq_context* context = make_context();
  const size_t count = test_count(10000);
  double* const points = random_points(count);
  uint8_t* const inside = (uint8_t*)malloc(count);
  double* const distances = (double*)malloc(count * sizeof(double));
  msq_field* fields[3];
  const msq_warp_def warp = sampled_warp(context, fields);
  msq_functional_def def;
  msq_structure* structure;
  size_t held = 0, held_in_box = 0;
  (void)state;
  assert_true(inside && distances);
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.level.value = 0.2;
  def.warp = &warp;
  def.grid.origin[0] = 77; /* not used */
  assert_ok(msq_structure_functional(context, &def, &structure));
  for (int axis = 0; axis < 3; ++axis) msq_field_release(fields[axis]);
  msq_model* model = make_model(context, make_box_of(context, -3, 3), structure, NULL);
  const msq_points_def set = array_of(points, count);
  assert_ok(msq_set_membership(model, &set, NULL, inside, count, NULL));
  assert_ok(msq_set_distance(model, &set, NULL, distances, count, NULL));
  for (size_t i = 0; i < count; ++i) {
    double g[3], u[3];
    map_position(points + 3 * i, g);
    map_at(g, u);
    for (int axis = 0; axis < 3; ++axis) u[axis] *= turn;
    const double onset = sin(u[0]) * cos(u[1]) + sin(u[1]) * cos(u[2]) + sin(u[2]) * cos(u[0]);
    const double within = map_within(g);
    held += inside[i];
    held_in_box += within > 0;
    if (fabs(within) < 1e-12 || (within > 0 && fabs(onset - 0.2) < 1e-12)) continue;
    if (inside[i] != (within > 0 && onset <= 0.2))
      fail_msg("(%g, %g, %g) has %g, %g within, but inside is %d", points[3 * i], points[3 * i + 1],
               points[3 * i + 2], onset, within, inside[i]);
    assert_true(inside[i] ? distances[i] <= 0 : distances[i] > 0);
    /* The gradient of the gyroid is at most 2 in angles: the map stretches by at most 2.6. */
    if (within > 0.1) assert_true(fabs(distances[i]) >= fabs(onset - 0.2) / (turn * 2 * 4) - 1e-9);
    if (within < 0) assert_true(distances[i] >= -within - 1e-9);
  }
  assert_in_range(held, held_in_box / 3, held_in_box * 3 / 4);
  free(points);
  free(inside);
  free(distances);
  msq_model_release(model);
  msq_context_release(context);
}

/* ---- Lattices */

static const double nodes[6][3] = {{0, 0.25, 0.75}, {1, 0.5, 0.125},   {0.3, 0, 1},
                                   {0.7, 1, 0},     {0.6, 0.45, 0.55}, {1, 1, 0.4}};
static const uint32_t struts[5][2] = {{0, 1}, {2, 3}, {4, 0}, {4, 3}, {5, 4}};
static const double factors[5] = {1, 0.5, 1.75, 1.25, 0.75};
static const double radius = 0.04;

typedef struct capsule {
  double a[3], b[3], radius;
} capsule;

/* Newton's method with differences, on the interpolated map, from the place of the smooth one. */
static int invert(const double u[3], double g[3]) {
  g[0] = g[1] = g[2] = 1;
  for (int round = 0; round < 80; ++round) {
    double at[3], m[3][4], moved = 0;
    map_at(g, at);
    const double h = round < 40 ? 1e-3 : 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
      double to[3], there[3];
      memcpy(to, g, sizeof to);
      to[axis] += h;
      map_at(to, there);
      for (int c = 0; c < 3; ++c) m[c][axis] = (there[c] - at[c]) / h;
    }
    for (int c = 0; c < 3; ++c) m[c][3] = u[c] - at[c];
    for (int c = 0; c < 3; ++c) /* elimination; the diagonal leads */
      for (int other = 0; other < 3; ++other) {
        if (other == c) continue;
        const double by = m[other][c] / m[c][c];
        for (int k = c; k < 4; ++k) m[other][k] -= by * m[c][k];
      }
    for (int c = 0; c < 3; ++c) {
      const double step = m[c][3] / m[c][c];
      g[c] += step;
      moved = fmax(moved, fabs(step));
    }
    if (moved < 1e-14) break;
  }
  double at[3];
  map_at(g, at);
  for (int c = 0; c < 3; ++c) assert_near(at[c], u[c], 1e-10);
  return map_within(g) > 0;
}

enum { max_capsules = 8000 };
static capsule capsules[max_capsules];
static size_t capsule_count;

static void place_all(void) {
  int i[3];
  capsule_count = 0;
  for (i[2] = -5; i[2] <= 4; ++i[2])
    for (i[1] = 1; i[1] <= 9; ++i[1])
      for (i[0] = -2; i[0] <= 9; ++i[0])
        for (int s = 0; s < 5; ++s) {
          capsule* const made = &capsules[capsule_count];
          int is_there = 1;
          for (int end = 0; end < 2; ++end) {
            double u[3];
            for (int axis = 0; axis < 3; ++axis) u[axis] = i[axis] + nodes[struts[s][end]][axis];
            is_there = is_there && invert(u, end ? made->b : made->a);
          }
          if (!is_there) continue;
          made->radius = radius * factors[s];
          assert_true(++capsule_count < max_capsules);
        }
}

static double gap_of(const double g[3]) {
  double gap = 1e9;
  for (size_t n = 0; n < capsule_count; ++n) {
    const capsule* const c = &capsules[n];
    double along = 0, squared = 0, ab = 0;
    for (int axis = 0; axis < 3; ++axis) {
      along += (g[axis] - c->a[axis]) * (c->b[axis] - c->a[axis]);
      ab += (c->b[axis] - c->a[axis]) * (c->b[axis] - c->a[axis]);
    }
    along = fmax(0, fmin(1, along / ab));
    for (int axis = 0; axis < 3; ++axis) {
      const double away = g[axis] - c->a[axis] - along * (c->b[axis] - c->a[axis]);
      squared += away * away;
    }
    gap = fmin(gap, sqrt(squared) - c->radius);
  }
  return gap;
}

static msq_lattice_def lattice_def(const msq_warp_def* warp) {
  msq_lattice_def def;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = MSQ_UNIT_CELL_CUSTOM;
  def.nodes = nodes[0];
  def.node_count = 6;
  def.struts = struts[0];
  def.strut_count = 5;
  def.strut_factors = factors;
  def.radius.value = radius;
  def.warp = warp;
  return def;
}

static int32_t count_struts(void* user, const msq_strut* found, uint64_t count) {
  for (uint64_t i = 0; i < count; ++i) {
    size_t n = 0;
    double a[3], b[3];
    map_position(found[i].a, a);
    map_position(found[i].b, b);
    for (; n < capsule_count; ++n) {
      double off = 0;
      for (int axis = 0; axis < 3; ++axis)
        off = fmax(
            off,
            fmin(fmax(fabs(capsules[n].a[axis] - a[axis]), fabs(capsules[n].b[axis] - b[axis])),
                 fmax(fabs(capsules[n].b[axis] - a[axis]), fabs(capsules[n].a[axis] - b[axis]))));
      if (off < 1e-9) break;
    }
    assert_true(n < capsule_count);
  }
  *(uint64_t*)user += count;
  return 0;
}

static void lattices_have_the_struts_between_placed_nodes(void** state) {
  msq_context* context = make_context();
  const size_t count = test_count(10000);
  double* const points = random_points(count);
  uint8_t* const inside = (uint8_t*)malloc(count);
  double* const distances = (double*)malloc(count * sizeof(double));
  msq_field* fields[3];
  const msq_warp_def warp = sampled_warp(context, fields);
  const msq_lattice_def def = lattice_def(&warp);
  msq_structure* structure;
  size_t held = 0;
  (void)state;
  assert_true(inside && distances);
  place_all();
  assert_in_range(capsule_count, 200, max_capsules);
  assert_ok(msq_structure_lattice(context, &def, &structure));
  for (int axis = 0; axis < 3; ++axis) msq_field_release(fields[axis]);
  uint64_t found = 0;
  msq_struts_def selection;
  assert_ok(msq_struts_def_init(&selection, sizeof selection));
  for (int axis = 0; axis < 3; ++axis) selection.min[axis] = -(selection.max[axis] = 9);
  assert_ok(msq_structure_struts(context, structure, &selection, count_struts, &found, NULL));
  assert_int_equal(found, capsule_count);
  msq_model* model = make_model(context, make_box_of(context, -4, 4), structure, NULL);
  const msq_points_def set = array_of(points, count);
  assert_ok(msq_set_membership(model, &set, NULL, inside, count, NULL));
  assert_ok(msq_set_distance(model, &set, NULL, distances, count, NULL));
  for (size_t i = 0; i < count; ++i) {
    double g[3];
    map_position(points + 3 * i, g);
    const double gap = gap_of(g);
    held += inside[i];
    if (fabs(gap) > 1e-9 && inside[i] != (gap <= 0))
      fail_msg("(%.17g, %.17g, %.17g) is %g away, but inside is %d", g[0], g[1], g[2], gap,
               inside[i]);
    if (gap > 0 && gap < 1) assert_near(distances[i], gap, 1e-9);
  }
  assert_in_range(held, count / 100, count / 2);
  free(points);
  free(inside);
  free(distances);
  msq_model_release(model);
  msq_context_release(context);
}

/* ---- Refusals */

static msq_status make_structure(msq_context* context, const msq_warp_def* warp) {
  msq_functional_def def;
  msq_structure* structure = (msq_structure*)untouched();
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.warp = warp;
  const msq_status status = msq_structure_functional(context, &def, &structure);
  if (status == MSQ_OK)
    msq_structure_release(structure);
  else
    assert_ptr_equal(structure, untouched());
  return status;
}

static void what_makes_no_map_is_refused(void** state) {
  msq_context* context = make_context();
  msq_field* fields[3];
  msq_field *other, *ramp;
  const msq_warp_def right = sampled_warp(context, fields);
  const double from[3] = {0, 0, 0}, to[3] = {1, 0, 0};
  msq_warp_def def;
  msq_image image;
  (void)state;
  assert_ok(make_structure(context, &right));
  assert_ok(msq_field_gradient(context, from, 0, to, 1, &ramp));
#define REFUSED(change, text)                                            \
  do {                                                                   \
    def = right;                                                         \
    change;                                                              \
    assert_refused(make_structure(context, &def), MSQ_E_ARGUMENT, text); \
  } while (0)
  REFUSED(def.u = NULL, "warp.u");
  REFUSED(def.v = NULL, "warp.v");
  REFUSED(def.w = ramp, "warp.w is another field than one of samples");
  REFUSED(def.count = 3, "warp.count is 3");
  REFUSED(def.count_polar = 4, "warp.count_polar 4");
  REFUSED(def.inner_radius = 2, "warp.inner_radius is 2");
  REFUSED(def.shear_outwards = 1, "warp.shear_outwards is 1");
  REFUSED(def.shear_along = 3, "warp.shear_along 3; of a sampled map both are 0");
  REFUSED(def.outer_radius = 5, "warp.outer_radius 5");
  REFUSED(def.kind = MSQ_WARP_CYLINDRICAL; def.count = 3, "only a sampled map has them");
  /* In place of v: other grids. */
#define OTHER_GRID(change, text)              \
  do {                                        \
    image = map_image(map_values[1]);         \
    change;                                   \
    other = make_grid_field(context, &image); \
    REFUSED(def.v = other, text);             \
    msq_field_release(other);                 \
  } while (0)
  OTHER_GRID(image.size[2] = map_z - 1, "warp.v has 8 samples along axis 2 and warp.u 9");
  OTHER_GRID(image.grid.origin[1] = 0, "the samples of warp.v are from 0 on");
  OTHER_GRID(image.grid.cell_size[0] = 0.5, "along axis 0");
  OTHER_GRID(memcpy(image.grid.rotation, (double[9]){1, 0, 0, 0, 1, 0, 0, 0, 1}, 72),
             "turned differently");
  static double values[map_samples];
  memcpy(values, map_values[1], sizeof values);
  values[0] = 5e6;
  OTHER_GRID(image.values = values, "warp.v runs from");
  /* A fold of one voxel, and a flat map. */
  memcpy(values, map_values[1], sizeof values);
  values[(5 * map_y + 4) * map_x + 3] += 1.5;
  OTHER_GRID(image.values = values, "folds, or is flat, in voxel (2, 4, 4)");
  OTHER_GRID(image.values = map_values[0], "folds, or is flat, in voxel (0, 0, 0)");
#undef OTHER_GRID
  /* One sample along an axis. */
  image = map_image(map_values[0]);
  image.size[1] = 1;
  other = make_grid_field(context, &image);
  REFUSED(def.u = other, "warp.u has 1 sample along axis 1");
  msq_field_release(other);
#undef REFUSED
  /* A mirrored map is one. */
  for (int i = 0; i < map_samples; ++i) values[i] = -map_values[2][i];
  image = map_image(values);
  other = make_grid_field(context, &image);
  def = right;
  def.w = other;
  assert_ok(make_structure(context, &def));
  msq_field_release(other);
  msq_field_release(ramp);
  for (int axis = 0; axis < 3; ++axis) msq_field_release(fields[axis]);
  msq_context_release(context);
}

static void what_does_not_go_with_a_map_is_refused(void** state) {
  msq_context* context = make_context();
  msq_field* fields[3];
  const msq_warp_def warp = sampled_warp(context, fields);
  const double start = 0, size = 1;
  msq_structure* structure = (msq_structure*)untouched();
  msq_functional_def functional;
  msq_lattice_def lattice = lattice_def(&warp);
  msq_unit_cell_def cells[2];
  msq_period_def period;
  (void)state;
  assert_ok(msq_period_def_init(&period, sizeof period));
  period.positions = &start;
  period.cell_sizes = &size;
  period.count = 1;
  assert_ok(msq_functional_def_init(&functional, sizeof functional));
  functional.warp = &warp;
  functional.period = &period;
  assert_refused(msq_structure_functional(context, &functional, &structure), MSQ_E_UNSUPPORTED,
                 "both period and warp are given");
  functional.period = NULL;
  functional.kind = MSQ_FUNCTIONAL_SHEET;
  functional.thickness.value = 0.1;
  assert_refused(msq_structure_functional(context, &functional, &structure), MSQ_E_UNSUPPORTED,
                 "the cells are warped");
  lattice.period = &period;
  assert_refused(msq_structure_lattice(context, &lattice, &structure), MSQ_E_UNSUPPORTED,
                 "a period and a warp");
  lattice = lattice_def(&warp);
  lattice.radius.value = 40;
  assert_refused(msq_structure_lattice(context, &lattice, &structure), MSQ_E_LIMIT,
                 "4 times the smallest cell size");
  assert_ok(msq_lattice_def_init(&lattice, sizeof lattice));
  lattice.warp = &warp;
  lattice.radius.value = 0.05;
  cells[0] = named_cell(MSQ_UNIT_CELL_BCC);
  cells[1] = named_cell(MSQ_UNIT_CELL_CUBIC);
  lattice.cells = cells;
  lattice.cell_count = 2;
  assert_refused(msq_structure_lattice(context, &lattice, &structure), MSQ_E_UNSUPPORTED,
                 "a warp is given, and a library of 2");
  assert_ptr_equal(structure, untouched());
  for (int axis = 0; axis < 3; ++axis) msq_field_release(fields[axis]);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(functions_are_evaluated_through_the_map),
      cmocka_unit_test(lattices_have_the_struts_between_placed_nodes),
      cmocka_unit_test(what_makes_no_map_is_refused),
      cmocka_unit_test(what_does_not_go_with_a_map_is_refused),
  };
  sample_map();
  return cmocka_run_group_tests(tests, NULL, NULL);
}
