/* SPDX-License-Identifier: Apache-2.0
 * msq_foam_def_init, msq_structure_foam. */
#include "definitions.h"

enum { side = 14, samples = side * side * side };
/* of msq_foam_def before it had a density */
enum { first_size = offsetof(msq_foam_def, density) };

static msq_foam_def foam_def(void) {
  msq_foam_def def;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.radius.value = 0.15;
  return def;
}

DEFINE_CREATE(structure, structure_foam, foam_def)

static void defaults_are_those_of_the_header(void** state) {
  msq_foam_def def;
  (void)state;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  assert_int_equal(def.method, MSQ_FOAM_AUTO);
  assert_default_grid(&def.grid);
  assert_null(def.radius.field);
  assert_true(def.jitter == 1);
  assert_int_equal(def.seed, 0);
  assert_null(def.density.field);
  assert_true(def.density.value == 1);
  assert_null(def.wall_thickness.field);
  assert_true(def.wall_thickness.value == 0);
  assert_null(def.vent_radius.field);
  assert_true(def.vent_radius.value == 0);
  for (int axis = 0; axis < 3; ++axis) assert_true(def.stretch[axis] == 1);
  assert_true(def.weight == 0);
  assert_null(def.period);
  assert_null(def.warp);
}

/* Samples of a foam in the box, as a grid. */
static void sample_foam_at(const msq_foam_def* def, double high, uint64_t n, uint8_t* inside) {
  const msq_points_def points = grid_points(0.05, high, n);
  msq_context* context = make_context();
  msq_structure* foam;
  assert_ok(msq_structure_foam(context, def, &foam));
  msq_model* model = make_model(context, make_box(context), foam, NULL);
  assert_ok(msq_set_membership(model, &points, NULL, inside, n * n * n, NULL));
  msq_model_release(model);
  msq_context_release(context);
}

static void sample_foam(const msq_foam_def* def, uint8_t inside[samples]) {
  sample_foam_at(def, 3.95, side, inside);
}

static void weight_picks_another_foam(void** state) {
  uint8_t plain[samples], other[samples];
  msq_foam_def def = foam_def();
  (void)state;
  sample_foam(&def, plain);
  for (int with_walls = 0; with_walls < 2; ++with_walls) {
    if (with_walls) {
      def.wall_thickness.value = 0.1;
      def.radius.value = def.weight = 0;
      sample_foam(&def, plain);
    }
    size_t differ = 0, more = 0;
    def.weight = 0.5;
    sample_foam(&def, other);
    for (size_t i = 0; i < samples; ++i) differ += plain[i] != other[i];
    assert_true(differ > samples / 50);
    def.weight = 1;
    sample_foam(&def, other);
    for (size_t i = 0; i < samples; ++i) more += plain[i] != other[i];
    assert_true(more > differ);
  }
}

/* Cells of one size are those of the grid. Where cells are a quarter as long, there are more struts
 * across the axis. */
static void period_moves_the_seeds(void** state) {
  uint8_t plain[samples], other[samples];
  const double positions[2] = {1.5, 2.5}, even[2] = {1, 1}, sizes[2] = {1, 0.25};
  msq_period_def period;
  (void)state;
  assert_ok(msq_period_def_init(&period, sizeof period));
  period.positions = positions;
  period.count = 2;
  for (int with_walls = 0; with_walls < 2; ++with_walls) {
    msq_foam_def def = foam_def();
    if (with_walls) def.wall_thickness.value = 0.1;
    def.radius.value = with_walls ? 0 : 0.1;
    sample_foam(&def, plain);
    def.period = &period;
    def.grid.cell_size[2] = 3; /* not used */
    for (period.axis = 0; period.axis < 3; ++period.axis) {
      size_t differ = 0, low[2] = {0, 0}, high[2] = {0, 0};
      for (int axis = 0; axis < 3; ++axis) def.grid.cell_size[axis] = axis == period.axis ? 3 : 1;
      period.cell_sizes = even;
      sample_foam(&def, other);
      for (size_t i = 0; i < samples; ++i) differ += plain[i] != other[i];
      assert_in_range(differ, 0, 2);
      period.cell_sizes = sizes;
      sample_foam(&def, other);
      for (size_t i = 0; i < samples; ++i) {
        const size_t at[3] = {i % side, i / side % side, i / side / side};
        size_t* const half = at[period.axis] < side / 2 ? low : high;
        half[0] += plain[i];
        half[1] += other[i];
      }
      assert_true(2 * low[1] < 3 * low[0] && 2 * low[0] < 3 * low[1]);
      assert_true((double)high[1] > 1.3 * (double)high[0]);
    }
  }
}

/* Nothing is beyond the shell. A foam of cells as large as those in it fills as much. */
static void warp_bends_the_cells(void** state) {
  uint8_t plain[samples], warped[samples];
  msq_warp_def warp;
  (void)state;
  assert_ok(msq_warp_def_init(&warp, sizeof warp));
  warp.count = 24;
  warp.inner_radius = 3;
  warp.outer_radius = 4.5;
  for (int with_walls = 0; with_walls < 2; ++with_walls) {
    msq_foam_def def = foam_def();
    size_t in_plain = 0, in_shell = 0;
    if (with_walls) def.wall_thickness.value = 0.1;
    def.radius.value = with_walls ? 0 : 0.1;
    sample_foam(&def, plain);
    def.warp = &warp;
    def.grid.cell_size[1] = 300; /* not used */
    sample_foam(&def, warped);
    for (size_t i = 0; i < samples; ++i) {
      const double step = 3.9 / (side - 1), x = 0.05 + step * (double)(i % side),
                   y = 0.05 + step * (double)(i / side % side), r = sqrt(x * x + y * y);
      if (r < warp.inner_radius || r > warp.outer_radius) {
        assert_int_equal(warped[i], 0);
        continue;
      }
      in_plain += plain[i];
      in_shell += warped[i];
    }
    assert_true(in_shell > 50);
    assert_true((double)in_shell < 1.4 * (double)in_plain &&
                (double)in_plain < 1.4 * (double)in_shell);
  }
}

static void seed_picks_another_foam_and_the_same_again(void** state) {
  uint8_t first[samples], other[samples];
  const uint64_t seeds[] = {1, UINT64_MAX, (uint64_t)1 << 63};
  msq_foam_def def = foam_def();
  (void)state;
  sample_foam(&def, first);
  for (int i = 0; i < 3; ++i) {
    def.seed = seeds[i];
    sample_foam(&def, other);
    assert_memory_not_equal(first, other, samples);
  }
  def.seed = 0;
  sample_foam(&def, other);
  assert_memory_equal(first, other, samples);
}

/* Seeds at the cells' centres: the diagram's edges are the edges of a cubic lattice, half a cell
 * off. */
static void foam_without_jitter_is_the_cubic_lattice(void** state) {
  uint64_t random = 5;
  msq_foam_def def = foam_def();
  msq_context* context = make_context();
  msq_structure* foam;
  (void)state;
  def.jitter = 0;
  def.radius.value = 0.25;
  assert_ok(msq_structure_foam(context, &def, &foam));
  msq_model* model = make_model(context, make_box(context), foam, NULL);
  for (size_t i = 0; i < test_count(500); ++i) {
    double p[3], squared[3], nearest = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = random_between(&random, 0, 4);
      squared[axis] = (p[axis] - rint(p[axis])) * (p[axis] - rint(p[axis]));
    }
    for (int axis = 0; axis < 3; ++axis)
      nearest = fmin(nearest, sqrt(squared[axis] + squared[(axis + 1) % 3]));
    if (fabs(nearest - 0.25) < 1e-6) continue;
    assert_int_equal(is_inside(model, p[0], p[1], p[2]), nearest < 0.25);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void methods_give_the_same_solid(void** state) {
  const double rotation[9] = {0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6};
  const double jitters[] = {1, 0.5, 0};
  (void)state;
  for (int i = 0; i < 3; ++i) {
    uint8_t wanted[samples], got[samples];
    msq_foam_def def = foam_def();
    def.jitter = jitters[i];
    def.grid.cell_size[0] = 0.8;
    def.grid.cell_size[2] = 1.5;
    memcpy(def.grid.rotation, rotation, sizeof rotation);
    def.method = MSQ_FOAM_METHOD_1;
    sample_foam(&def, wanted);
    def.method = MSQ_FOAM_DIRECT;
    sample_foam(&def, got);
    assert_memory_equal(wanted, got, samples);
    def.method = MSQ_FOAM_AUTO;
    sample_foam(&def, got);
    assert_memory_equal(wanted, got, samples);
#if MSQ_WITH_CGAL
    def.method = MSQ_FOAM_METHOD_2;
    sample_foam(&def, got);
    assert_memory_equal(wanted, got, samples);
#endif
    /* Fewer for the slow one. */
    def.method = MSQ_FOAM_DIRECT;
    sample_foam_at(&def, 1.95, 5, wanted);
    def.method = MSQ_FOAM_POINT;
    sample_foam_at(&def, 1.95, 5, got);
    assert_memory_equal(wanted, got, 5 * 5 * 5);
  }
}

/* Thicker struts hold the thinner ones. */
static void field_thickens_the_struts(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {0, 0, 4};
  uint8_t thin[samples], graded[samples], thick[samples];
  msq_context* context = make_context();
  msq_foam_def def = foam_def();
  msq_field* field;
  size_t thin_count = 0, graded_count = 0, thick_count = 0;
  (void)state;
  def.radius.value = 0.1;
  sample_foam(&def, thin);
  def.radius.value = 0.2;
  sample_foam(&def, thick);
  assert_ok(msq_field_gradient(context, from, 0.1, to, 0.2, &field));
  def.radius.field = field;
  sample_foam(&def, graded);
  msq_field_release(field);
  for (int i = 0; i < samples; ++i) {
    assert_true(thin[i] <= graded[i] && graded[i] <= thick[i]);
    thin_count += thin[i];
    graded_count += graded[i];
    thick_count += thick[i];
  }
  assert_true(0 < thin_count && thin_count < graded_count);
  assert_true(graded_count < thick_count && thick_count < samples);
  msq_context_release(context);
}

/* An older host, whose definition ends before the density, has the foam of density 1; and so have
 * densities below 1, and fields of them. */
static void densities_up_to_1_change_nothing(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {0, 0, 4};
  uint8_t wanted[samples], got[samples];
  msq_context* context = make_context();
  msq_foam_def def = foam_def();
  (void)state;
  sample_foam(&def, wanted);
  def.struct_size = first_size;
  def.density.value = 64; /* behind what the size says */
  sample_foam(&def, got);
  assert_memory_equal(wanted, got, samples);
  def = foam_def();
  for (int method = MSQ_FOAM_AUTO; method <= MSQ_FOAM_POINT; ++method) {
    def.method = method;
    def.density.value = 0.5;
    sample_foam(&def, got);
    assert_memory_equal(wanted, got, samples);
  }
  msq_field* field;
  assert_ok(msq_field_gradient(context, from, 0, to, 1, &field));
  def.density.field = field;
  sample_foam(&def, got);
  assert_memory_equal(wanted, got, samples);
  msq_field_release(field);
  msq_context_release(context);
}

/* Thinner struts in the same share of space: density^(-1/3) of the radius. */
static void density_adds_struts(void** state) {
  uint8_t coarse[samples], fine[samples], direct[samples];
  size_t coarse_count = 0, fine_count = 0;
  msq_foam_def def = foam_def();
  (void)state;
  def.radius.value = 0.08;
  sample_foam(&def, coarse);
  def.density.value = 20;
  sample_foam(&def, fine);
  def.method = MSQ_FOAM_DIRECT;
  sample_foam(&def, direct);
  assert_memory_equal(fine, direct, samples);
  for (int i = 0; i < samples; ++i) {
    coarse_count += coarse[i];
    fine_count += fine[i];
  }
  assert_true(fine_count > 3 * coarse_count);
}

static size_t count_of(const uint8_t inside[samples]) {
  size_t count = 0;
  for (int i = 0; i < samples; ++i) count += inside[i];
  return count;
}

/* Seeds at the cells' centres: walls on the faces of the grid. */
static void walls_without_jitter_are_those_of_the_grid(void** state) {
  uint64_t random = 11;
  msq_foam_def def = foam_def();
  msq_context* context = make_context();
  msq_structure* foam;
  (void)state;
  def.jitter = 0;
  def.radius.value = 0;
  def.wall_thickness.value = 0.25;
  assert_ok(msq_structure_foam(context, &def, &foam));
  msq_model* model = make_model(context, make_box(context), foam, NULL);
  for (size_t i = 0; i < test_count(500); ++i) {
    double p[3], nearest = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = random_between(&random, 0.2, 3.8);
      nearest = fmin(nearest, fabs(p[axis] - rint(p[axis])));
    }
    if (fabs(nearest - 0.125) < 1e-6) continue;
    assert_int_equal(is_inside(model, p[0], p[1], p[2]), nearest < 0.125);
    if (nearest < 0.125) continue;
    double distance;
    assert_ok(msq_point_distance(model, p, NULL, &distance));
    assert_true(fabs(distance - (nearest - 0.125)) < 1e-9);
  }
  msq_model_release(model);
  msq_context_release(context);
}

/* Struts and walls together hold what either holds, and nothing else. */
static void struts_and_walls_are_joined(void** state) {
  uint8_t struts[samples], walls[samples], both[samples];
  const double densities[] = {1, 6};
  (void)state;
  for (int k = 0; k < 2; ++k) {
    msq_foam_def def = foam_def();
    def.density.value = densities[k];
    def.radius.value = 0.12;
    sample_foam(&def, struts);
    def.wall_thickness.value = 0.08;
    sample_foam(&def, both);
    def.radius.value = 0;
    sample_foam(&def, walls);
    for (int i = 0; i < samples; ++i) assert_int_equal(both[i], struts[i] | walls[i]);
    assert_true(count_of(both) > count_of(struts) && count_of(both) > count_of(walls));
    assert_true(count_of(both) < samples);
  }
}

static void field_thickens_the_walls(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {0, 0, 4};
  uint8_t thin[samples], graded[samples], thick[samples];
  msq_context* context = make_context();
  msq_foam_def def = foam_def();
  msq_field* field;
  (void)state;
  def.radius.value = 0;
  def.wall_thickness.value = 0.1;
  sample_foam(&def, thin);
  def.wall_thickness.value = 0.4;
  sample_foam(&def, thick);
  assert_ok(msq_field_gradient(context, from, 0.1, to, 0.4, &field));
  def.wall_thickness.field = field;
  sample_foam(&def, graded);
  msq_field_release(field);
  for (int i = 0; i < samples; ++i) assert_true(thin[i] <= graded[i] && graded[i] <= thick[i]);
  assert_true(count_of(thin) < count_of(graded) && count_of(graded) < count_of(thick));
  msq_context_release(context);
}

/* Seeds at the cells' centres: holes are about the lines between them. */
static void vents_open_the_walls(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {4, 0, 0};
  uint8_t closed[samples], open[samples], graded[samples];
  msq_foam_def def = foam_def();
  msq_context* context = make_context();
  msq_structure* foam;
  msq_field* field;
  (void)state;
  def.radius.value = 0;
  def.wall_thickness.value = 0.25;
  sample_foam(&def, closed);
  def.vent_radius.value = 0.25;
  sample_foam(&def, open);
  assert_ok(msq_field_gradient(context, from, 0, to, 0.25, &field));
  def.vent_radius.field = field;
  sample_foam(&def, graded);
  def.vent_radius.field = NULL;
  msq_field_release(field);
  /* A smaller hole may be in a wall that is too small for a larger one. */
  for (int i = 0; i < samples; ++i) assert_true(open[i] <= closed[i] && graded[i] <= closed[i]);
  assert_true(count_of(open) < count_of(closed) && count_of(graded) < count_of(closed));
  assert_memory_not_equal(open, graded, samples);
  def.jitter = 0;
  assert_ok(msq_structure_foam(context, &def, &foam));
  msq_model* model = make_model(context, make_box(context), foam, NULL);
  assert_false(is_inside(model, 2, 1.5, 1.5));
  assert_false(is_inside(model, 2.1, 1.7, 1.5));
  assert_true(is_inside(model, 2, 1.8, 1.5));
  double distance;
  const double middle[3] = {2, 1.5, 1.5};
  assert_ok(msq_point_distance(model, middle, NULL, &distance));
  assert_true(distance > 0.24 && distance <= 0.25);
  msq_model_release(model);
  msq_context_release(context);
}

static void method_2_needs_cgal(void** state) {
  msq_context* context = make_context();
  msq_foam_def def = foam_def();
  (void)state;
  def.method = MSQ_FOAM_METHOD_2;
#if MSQ_WITH_CGAL
  assert_ok(create(context, &def));
#else
  assert_refused(create(context, &def), MSQ_E_UNSUPPORTED, "MSQ_WITH_CGAL");
#endif
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(weight_picks_another_foam),
      cmocka_unit_test(period_moves_the_seeds),
      cmocka_unit_test(warp_bends_the_cells),
      cmocka_unit_test(seed_picks_another_foam_and_the_same_again),
      cmocka_unit_test(foam_without_jitter_is_the_cubic_lattice),
      cmocka_unit_test(methods_give_the_same_solid),
      cmocka_unit_test(field_thickens_the_struts),
      cmocka_unit_test(densities_up_to_1_change_nothing),
      cmocka_unit_test(density_adds_struts),
      cmocka_unit_test(walls_without_jitter_are_those_of_the_grid),
      cmocka_unit_test(struts_and_walls_are_joined),
      cmocka_unit_test(field_thickens_the_walls),
      cmocka_unit_test(vents_open_the_walls),
      cmocka_unit_test(method_2_needs_cgal),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
