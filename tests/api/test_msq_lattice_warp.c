/* SPDX-License-Identifier: Apache-2.0
 * msq_lattice_def.period and msq_lattice_def.warp: the solid against a search through all struts of
 * a region, which are placed by the C library's functions. 1.5 x 10^4 points for each of six
 * lattices; with MSQ_TEST_SCALE=10, 1.5 x 10^5. */
#include "periods.h"

static const double nodes[6][3] = {{0, 0.25, 0.75}, {1, 0.5, 0.125},   {0.3, 0, 1},
                                   {0.7, 1, 0},     {0.6, 0.45, 0.55}, {1, 1, 0.4}};
static const uint32_t struts[5][2] = {{0, 1}, {2, 3}, {4, 0}, {4, 3}, {5, 4}};
static const double mixed_factors[5] = {1, 0.5, 1.75, 1.25, 0.75},
                    equal_factors[5] = {1, 1, 1, 1, 1};
static const double* factors = mixed_factors;
static const double radius = 0.06;

typedef struct placed_strut {
  double a[3], ab[3], squared, reach;
} placed_strut;

enum { max_struts = 100000 };
static placed_strut placed[max_struts];
static size_t placed_count;

/* Where the integral from 0 is u. */
static double position(double u) {
  double low = -100, high = 100;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    if (integral(middle) - integral(0) < u)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

typedef void (*place_fn)(const double u[3], double g[3]);

static int graded_axis;
static void place_graded(const double u[3], double g[3]) {
  for (int axis = 0; axis < 3; ++axis)
    g[axis] = axis == graded_axis ? position(u[axis]) : 0.8 * u[axis];
}
/* 11 cells around, 0.3 wide from a radius of 1.2, 0.7 long. */
static void place_around_axis(const double u[3], double g[3]) {
  const double r = 1.2 + 0.3 * u[0], angle = turn * u[1] / 11;
  g[0] = r * cos(angle);
  g[1] = r * sin(angle);
  g[2] = 0.7 * u[2];
}
/* The same, turned by 0.6 cells from cell to cell along the axis, and by -0.3 outwards. */
static void place_twisted(const double u[3], double g[3]) {
  const double around[3] = {u[0], u[1] + 0.3 * u[0] - 0.6 * u[2], u[2]};
  place_around_axis(around, g);
}
/* 9 cells around, 5 from pole to pole, 0.5 wide from the centre on. */
static void place_around_point(const double u[3], double g[3]) {
  const double r = 0.5 * u[0], angle = turn * u[1] / 9, latitude = turn / 2 * (u[2] / 5 - 0.5);
  g[0] = r * cos(latitude) * cos(angle);
  g[1] = r * cos(latitude) * sin(angle);
  g[2] = r * sin(latitude);
}

static void place_cells(place_fn place, const int first[3], const int last[3]) {
  int i[3];
  placed_count = 0;
  for (i[2] = first[2]; i[2] <= last[2]; ++i[2])
    for (i[1] = first[1]; i[1] <= last[1]; ++i[1])
      for (i[0] = first[0]; i[0] <= last[0]; ++i[0])
        for (int s = 0; s < 5; ++s) {
          double ends[2][3];
          for (int end = 0; end < 2; ++end) {
            double u[3];
            for (int axis = 0; axis < 3; ++axis) u[axis] = i[axis] + nodes[struts[s][end]][axis];
            place(u, ends[end]);
          }
          assert_true(placed_count < max_struts);
          placed_strut* const strut = &placed[placed_count++];
          strut->squared = 0;
          for (int axis = 0; axis < 3; ++axis) {
            strut->a[axis] = ends[0][axis];
            strut->ab[axis] = ends[1][axis] - ends[0][axis];
            strut->squared += strut->ab[axis] * strut->ab[axis];
          }
          strut->reach = factors[s] * radius;
        }
}

/* The distance to the surface of the nearest capsule, negative inside. */
static double gap_of(const double g[3]) {
  double gap = 1e9;
  for (size_t n = 0; n < placed_count; ++n) {
    const placed_strut* const s = &placed[n];
    double w[3], along = 0, squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      w[axis] = g[axis] - s->a[axis];
      along += w[axis] * s->ab[axis];
    }
    along = s->squared > 0 ? along / s->squared : 0;
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    for (int axis = 0; axis < 3; ++axis) {
      const double away = w[axis] - along * s->ab[axis];
      squared += away * away;
    }
    const double least = gap + s->reach;
    if (least < 0 || squared >= least * least) continue;
    gap = sqrt(squared) - s->reach;
  }
  return gap;
}

static const double grid_origin[3] = {0.1, 0.3, -0.2};
static double rotation[9];

static msq_lattice_def lattice_def(void) {
  const double c = cos(0.5), s = sin(0.5), made[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  msq_lattice_def def;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  memcpy(rotation, made, sizeof made);
  memcpy(def.grid.rotation, made, sizeof made);
  memcpy(def.grid.origin, grid_origin, sizeof grid_origin);
  def.unit_cell = MSQ_UNIT_CELL_CUSTOM;
  def.nodes = nodes[0];
  def.node_count = 6;
  def.struts = struts[0];
  def.strut_count = 5;
  def.strut_factors = factors;
  def.radius.value = radius;
  return def;
}

/* All queries in a box of the grid's frame, whose points are as far from the other cells' struts.
 */
static void compare(const msq_lattice_def* def, const double half[3]) {
  msq_context* context = make_context();
  msq_structure* structure;
  msq_shape* ball;
  msq_model* model;
  const double far = 6;
  assert_ok(msq_shape_from_sphere(context, grid_origin, far, &ball));
  assert_ok(msq_structure_lattice(context, def, &structure));
  const msq_scale_def scales[2] = {{.shape = ball}, {.structure = structure}};
  msq_model_def model_def;
  assert_ok(msq_model_def_init(&model_def, sizeof model_def));
  model_def.scales = scales;
  model_def.scale_count = 2;
  assert_ok(msq_model_create(context, &model_def, &model));
  const size_t count = test_count(15000);
  double* const points = malloc(count * 3 * sizeof(double));
  double* const distances = malloc(count * sizeof(double));
  uint8_t* const inside = malloc(count);
  assert_true(points && distances && inside);
  uint64_t state = 17;
  double(*const p)[3] = (double(*)[3])points;
  for (size_t i = 0; i < count; ++i) {
    double g[3];
    for (int axis = 0; axis < 3; ++axis) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      g[axis] = half[axis] * ((double)(state >> 11) * 0x1p-52 - 1);
    }
    for (int axis = 0; axis < 3; ++axis)
      p[i][axis] = grid_origin[axis] + rotation[3 * axis] * g[0] + rotation[3 * axis + 1] * g[1] +
                   rotation[3 * axis + 2] * g[2];
  }
  msq_points_def def_points;
  assert_ok(msq_points_def_init(&def_points, sizeof def_points));
  def_points.kind = MSQ_POINTS_ARRAY;
  def_points.coordinates = points;
  def_points.count = count;
  assert_ok(msq_set_membership(model, &def_points, NULL, inside, count, NULL));
  assert_ok(msq_set_distance(model, &def_points, NULL, distances, count, NULL));
  size_t held = 0;
  for (size_t i = 0; i < count; ++i) {
    double g[3], from_axis[3];
    for (int axis = 0; axis < 3; ++axis) from_axis[axis] = p[i][axis] - grid_origin[axis];
    for (int axis = 0; axis < 3; ++axis)
      g[axis] = rotation[axis] * from_axis[0] + rotation[3 + axis] * from_axis[1] +
                rotation[6 + axis] * from_axis[2];
    const double gap = gap_of(g);
    held += inside[i];
    if (fabs(gap) > 1e-9 && inside[i] != (gap <= 0))
      fail_msg("(%.17g, %.17g, %.17g) in the grid is %g away, but inside is %d", g[0], g[1], g[2],
               gap, inside[i]);
    /* Exact outside, unless the ball's surface is nearer. */
    if (gap > 0 && gap < 1.2 && fabs(distances[i] - gap) > 1e-9)
      fail_msg("(%.17g, %.17g, %.17g) in the grid is %.17g away, but the distance is %.17g", g[0],
               g[1], g[2], gap, distances[i]);
  }
  assert_in_range(held, count / 50, count - count / 50);
  free(points);
  free(distances);
  free(inside);
  msq_model_release(model);
  msq_structure_release(structure);
  msq_shape_release(ball);
  msq_context_release(context);
}

static void graded_cells_have_their_struts(void** state) {
  const double half[3] = {1.2, 1.2, 1.2};
  (void)state;
  for (graded_axis = 0; graded_axis < 3; ++graded_axis) {
    msq_lattice_def def = lattice_def();
    msq_period_def period = period_def();
    period.axis = graded_axis;
    def.period = &period;
    for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = axis == graded_axis ? 50 : 0.8;
    const int first[3] = {-5, -5, -5}, last[3] = {5, 5, 5};
    place_cells(place_graded, first, last);
    compare(&def, half);
  }
}

static void cells_around_an_axis_have_their_struts(void** state) {
  const double half[3] = {1.6, 1.6, 0.8};
  const int first[3] = {0, 0, -3}, last[3] = {5, 10, 3};
  msq_lattice_def def = lattice_def();
  msq_warp_def warp;
  (void)state;
  assert_ok(msq_warp_def_init(&warp, sizeof warp));
  warp.count = 11;
  warp.inner_radius = 1.2;
  def.warp = &warp;
  def.grid.cell_size[0] = 0.3;
  def.grid.cell_size[1] = 50; /* ignored */
  def.grid.cell_size[2] = 0.7;
  for (int is_equal = 0; is_equal < 2; ++is_equal) {
    def.strut_factors = factors = is_equal ? equal_factors : mixed_factors;
    place_cells(place_around_axis, first, last);
    compare(&def, half);
  }
  def.strut_factors = factors = mixed_factors;
  warp.shear_outwards = -0.3;
  warp.shear_along = 0.6;
  place_cells(place_twisted, first, last);
  compare(&def, half);
}

static void cells_around_a_point_have_their_struts(void** state) {
  const double half[3] = {1.3, 1.3, 1.3};
  const int first[3] = {0, 0, 0}, last[3] = {3, 8, 4};
  msq_lattice_def def = lattice_def();
  msq_warp_def warp;
  (void)state;
  assert_ok(msq_warp_def_init(&warp, sizeof warp));
  warp.kind = MSQ_WARP_SPHERICAL;
  warp.count = 9;
  warp.count_polar = 5;
  warp.outer_radius = 2.2; /* four whole cells */
  def.warp = &warp;
  def.grid.cell_size[0] = 0.5;
  def.grid.cell_size[1] = def.grid.cell_size[2] = 50;
  place_cells(place_around_point, first, last);
  compare(&def, half);
}

/* The struts of whole turns: as many as cells, each once, joined in rings of a closed graph. */
enum { max_taken = 128 };
typedef struct taken_struts {
  msq_strut struts[max_taken];
  size_t count;
} taken_struts;

static int32_t take_struts(void* user, const msq_strut* found, uint64_t count) {
  taken_struts* const taken = (taken_struts*)user;
  for (uint64_t i = 0; i < count; ++i) {
    assert_true(taken->count < max_taken);
    taken->struts[taken->count++] = found[i];
  }
  return 0;
}

static void rings_close(void** state) {
  msq_context* context = make_context();
  msq_structure* structure;
  msq_warp_def warp;
  msq_lattice_def def;
  static taken_struts taken;
  (void)state;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  assert_ok(msq_warp_def_init(&warp, sizeof warp));
  def.unit_cell = MSQ_UNIT_CELL_CUBIC;
  def.radius.value = 0.05;
  warp.count = 12;
  warp.inner_radius = 2;
  warp.outer_radius = 4.5; /* two whole cells */
  def.warp = &warp;
  assert_ok(msq_structure_lattice(context, &def, &structure));
  msq_struts_def selection;
  assert_ok(msq_struts_def_init(&selection, sizeof selection));
  for (int axis = 0; axis < 3; ++axis) {
    selection.max[axis] = axis < 2 ? 6 : 0.25; /* no strut along the axis */
    selection.min[axis] = -selection.max[axis];
  }
  taken.count = 0;
  assert_ok(msq_structure_struts(context, structure, &selection, take_struts, &taken, NULL));
  int rings = 0;
  for (size_t i = 0; i < taken.count; ++i) {
    const msq_strut* const s = &taken.struts[i];
    const double r = hypot(s->a[0], s->a[1]), q = hypot(s->b[0], s->b[1]);
    rings += fabs(r - q) < 1e-9;
    assert_true(fabs(r - 2) < 1e-9 || fabs(r - 3) < 1e-9 || fabs(r - 4) < 1e-9);
    int at_a = 0;
    for (size_t j = 0; j < taken.count; ++j) {
      const msq_strut* const t = &taken.struts[j];
      if (j != i) assert_memory_not_equal(s->id, t->id, sizeof s->id);
      if (!memcmp(s->node_a, t->node_a, sizeof s->node_a)) {
        assert_memory_equal(s->a, t->a, sizeof s->a);
        ++at_a;
      }
      if (!memcmp(s->node_a, t->node_b, sizeof s->node_a)) {
        assert_memory_equal(s->a, t->b, sizeof s->a);
        ++at_a;
      }
    }
    assert_int_equal(at_a, fabs(r - 3) < 1e-9 ? 4 : 3);
  }
  assert_int_equal(rings, 36);
  assert_int_equal(taken.count, 60);
  msq_structure_release(structure);
  msq_context_release(context);
}

static void count_struts(int32_t unit_cell, const msq_warp_def* warp, double high,
                         size_t strut_count, size_t node_count) {
  msq_context* context = make_context();
  msq_structure* structure;
  msq_lattice_def def;
  msq_struts_def selection;
  static taken_struts taken;
  uint64_t found[2 * max_taken][2];
  size_t found_count = 0;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = unit_cell;
  def.radius.value = 0.01;
  def.warp = warp;
  assert_ok(msq_structure_lattice(context, &def, &structure));
  assert_ok(msq_struts_def_init(&selection, sizeof selection));
  for (int axis = 0; axis < 3; ++axis) {
    selection.max[axis] = axis < 2 ? 6 : high;
    selection.min[axis] = -selection.max[axis];
  }
  taken.count = 0;
  assert_ok(msq_structure_struts(context, structure, &selection, take_struts, &taken, NULL));
  assert_int_equal(taken.count, strut_count);
  for (size_t i = 0; i < taken.count; ++i) {
    const msq_strut* const s = &taken.struts[i];
    const uint64_t* const ends[2] = {s->node_a, s->node_b};
    assert_memory_not_equal(s->a, s->b, sizeof s->a);
    for (int end = 0; end < 2; ++end) {
      size_t n = 0;
      while (n < found_count && memcmp(found[n], ends[end], sizeof found[n])) ++n;
      if (n == found_count) memcpy(found[found_count++], ends[end], sizeof found[n]);
    }
    for (size_t j = 0; j < i; ++j) {
      const msq_strut* const t = &taken.struts[j];
      assert_false(!memcmp(s->a, t->a, sizeof s->a) && !memcmp(s->b, t->b, sizeof s->b));
      assert_false(!memcmp(s->a, t->b, sizeof s->a) && !memcmp(s->b, t->a, sizeof s->b));
      if (!memcmp(s->node_a, t->node_a, sizeof s->node_a))
        assert_memory_equal(s->a, t->a, sizeof s->a);
      if (!memcmp(s->node_b, t->node_a, sizeof s->node_b))
        assert_memory_equal(s->b, t->a, sizeof s->b);
    }
  }
  assert_int_equal(found_count, node_count);
  msq_structure_release(structure);
  msq_context_release(context);
}

static void nodes_at_poles_and_in_the_middle_are_one(void** state) {
  msq_warp_def round;
  (void)state;
  assert_ok(msq_warp_def_init(&round, sizeof round));
  round.count = 6;
  round.outer_radius = 1;
  count_struts(MSQ_UNIT_CELL_CUBIC, &round, 0.25, 6 + 6, 7); /* without those along the axis */
  count_struts(MSQ_UNIT_CELL_CUBIC, &round, 0.75, 6 + 6 + 2 * 7, 3 * 7);
  round.kind = MSQ_WARP_SPHERICAL;
  round.count_polar = 4;
  count_struts(MSQ_UNIT_CELL_CUBIC, &round, 6, 20 + 3 * 6 + 4 * 6, 20 + 1);
  count_struts(MSQ_UNIT_CELL_BCC, &round, 6, 12 * (1 + 4) + 12 * (1 + 3), 24 + 20 + 1);
  round.inner_radius = 1;
  round.outer_radius = 2;
  count_struts(MSQ_UNIT_CELL_CUBIC, &round, 6, 20 + 2 * (3 * 6 + 4 * 6), 2 * 20);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(graded_cells_have_their_struts),
      cmocka_unit_test(cells_around_an_axis_have_their_struts),
      cmocka_unit_test(cells_around_a_point_have_their_struts),
      cmocka_unit_test(rings_close),
      cmocka_unit_test(nodes_at_poles_and_in_the_middle_are_one),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
