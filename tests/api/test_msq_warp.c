/* SPDX-License-Identifier: Apache-2.0
 * msq_warp_def_init, and msq_functional_def.warp. */
#include "definitions.h"
#include "periods.h"

DEFINE_CREATE(structure, structure_functional, functional_def)

static msq_warp_def warp_def(int32_t kind) {
  msq_warp_def def;
  assert_ok(msq_warp_def_init(&def, sizeof def));
  def.kind = kind;
  def.count = 9;
  def.count_polar = kind == MSQ_WARP_SPHERICAL ? 4 : 0;
  def.inner_radius = 0.5;
  def.outer_radius = 1.75;
  return def;
}

static msq_functional_def functional_def(const msq_warp_def* warp) {
  msq_functional_def def;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.level.value = 0.25;
  def.warp = warp;
  return def;
}

static void defaults_are_those_of_the_header(void** state) {
  msq_warp_def def;
  (void)state;
  assert_ok(msq_warp_def_init(&def, sizeof def));
  assert_int_equal(def.kind, MSQ_WARP_CYLINDRICAL);
  assert_int_equal(def.count, 0);
  assert_int_equal(def.count_polar, 0);
  assert_true(def.inner_radius == 0 && def.outer_radius == 0);
  assert_true(!def.u && !def.v && !def.w);
  assert_true(def.shear_outwards == 0 && def.shear_along == 0);
}

static msq_status create_with(void* env, void* warp) {
  msq_functional_def def = functional_def((const msq_warp_def*)warp);
  return create(env, &def);
}

static void create_honours_every_struct_size(void** state) {
  msq_context* context = make_context();
  msq_warp_def warp = warp_def(MSQ_WARP_SPHERICAL);
  msq_functional_def def = functional_def(&warp);
  (void)state;
  assert_ok(create(context, &def));
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t refused[3] = {0, offsetof(msq_warp_def, u) - 1, 4097};
    warp.struct_size = refused[i];
    assert_refused(create(context, &def), MSQ_E_ARGUMENT, "struct_size of warp");
  }
  msq_context_release(context);
}

static void what_makes_no_map_is_refused(void** state) {
  msq_context* context = make_context();
  msq_warp_def def;
  (void)state;
#define REFUSED(of_kind, change, text)                                \
  do {                                                                \
    def = warp_def(MSQ_WARP_##of_kind);                               \
    change;                                                           \
    assert_refused(create_with(context, &def), MSQ_E_ARGUMENT, text); \
  } while (0)
  REFUSED(CYLINDRICAL, def.kind = 0, "warp.kind is 0; it must be from 1 to 3");
  REFUSED(CYLINDRICAL, def.kind = 4, "warp.kind is 4");
  REFUSED(CYLINDRICAL, def.count = 0, "warp.count is 0; it must be from 1 to 65536");
  REFUSED(SPHERICAL, def.count = 65537, "warp.count is 65537");
  REFUSED(SPHERICAL, def.count_polar = 0, "warp.count_polar is 0; it must be from 1 to 65536");
  REFUSED(SPHERICAL, def.count_polar = UINT32_MAX, "warp.count_polar is 4294967295");
  REFUSED(CYLINDRICAL, def.count_polar = 1, "warp.count_polar is 1; around an axis it must be 0");
  REFUSED(SPHERICAL, def.inner_radius = -1, "warp.inner_radius is -1; it must be from 0 to 1e+75");
  REFUSED(SPHERICAL, def.inner_radius = 2e75, "warp.inner_radius is 2e+75");
  REFUSED(CYLINDRICAL, def.outer_radius = 0.5, "above inner_radius, 0.5");
  REFUSED(CYLINDRICAL, def.outer_radius = -1, "warp.outer_radius is -1");
  REFUSED(CYLINDRICAL, def.outer_radius = 2e75, "at most 1e+75");
  REFUSED(CYLINDRICAL, def.shear_outwards = 65537, "warp.shear_outwards is 65537; it must be at");
  REFUSED(CYLINDRICAL, def.shear_along = -1e9, "warp.shear_along is -1e+09; it must be at most");
  REFUSED(SPHERICAL, def.shear_along = 0.5, "warp.shear_along is 0.5; around a point it must be 0");
  REFUSED(SPHERICAL, def.shear_outwards = 1, "warp.shear_outwards is 1; around a point");
  for (int which = 0; which < 3; ++which) {
    REFUSED(CYLINDRICAL, def.shear_along = not_finite(which), "warp.shear_along is ");
    REFUSED(CYLINDRICAL, def.shear_outwards = not_finite(which), "warp.shear_outwards is ");
    REFUSED(CYLINDRICAL, def.inner_radius = not_finite(which), "warp.inner_radius is ");
    REFUSED(SPHERICAL, def.outer_radius = not_finite(which), "warp.outer_radius is ");
  }
#undef REFUSED
  msq_context_release(context);
}

static void what_does_not_go_with_a_warp_is_refused(void** state) {
  msq_context* context = make_context();
  const msq_warp_def warp = warp_def(MSQ_WARP_CYLINDRICAL);
  const double start = 0, size = 1;
  msq_functional_def def = functional_def(&warp);
  msq_period_def period;
  msq_structure* structure;
  double cell_size[3] = {7, 7, 7};
  (void)state;
  assert_ok(msq_period_def_init(&period, sizeof period));
  period.positions = &start;
  period.cell_sizes = &size;
  period.count = 1;
  def.period = &period;
  assert_refused(create(context, &def), MSQ_E_UNSUPPORTED, "both period and warp are given");
  def.period = NULL;
  def.kind = MSQ_FUNCTIONAL_SHEET;
  assert_ok(msq_structure_functional(context, &def, &structure));
  assert_refused(msq_fill_calibrate(context, structure, 0.4, 0.1, cell_size, NULL),
                 MSQ_E_UNSUPPORTED, "");
  assert_true(cell_size[0] == 7 && cell_size[1] == 7 && cell_size[2] == 7);
  msq_calibration_report report = {.struct_size = sizeof report, .parameter = 7};
  assert_refused(
      msq_structure_calibrate(context, structure, NULL, 0.2, NULL, NULL, 0, &report, NULL),
      MSQ_E_ARGUMENT, "give a sample of the part");
  assert_true(report.parameter == 7);
  msq_structure_release(structure);
  def.level.value = 0;
  def.thickness.value = 0.1;
  assert_refused(create(context, &def), MSQ_E_UNSUPPORTED, "the cells are warped");
  msq_context_release(context);
}

/* ---- the solid, against the C library's angles */

enum { samples = turned_side * turned_side * turned_side };

static void cells_lie_around_an_axis_or_a_point(void** state) {
  msq_context* context = make_context();
  static uint8_t inside[samples];
  const double c = cos(0.5), s = sin(0.5);
  const double rotation[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  (void)state;
  for (int32_t kind = MSQ_WARP_CYLINDRICAL; kind <= MSQ_WARP_SPHERICAL; ++kind)
    for (int is_turned = 0; is_turned < 2; ++is_turned) {
      const msq_warp_def warp = warp_def(kind);
      msq_functional_def def = functional_def(&warp);
      def.grid.cell_size[0] = 0.7;
      def.grid.cell_size[1] = 100; /* ignored */
      def.grid.cell_size[2] = kind == MSQ_WARP_CYLINDRICAL ? 0.9 : 100;
      def.grid.origin[1] = 0.3;
      if (is_turned) memcpy(def.grid.rotation, rotation, sizeof rotation);
      msq_structure* structure;
      assert_ok(msq_structure_functional(context, &def, &structure));
      msq_model* model = make_model(context, make_box_of(context, -2, 2), structure, NULL);
      const msq_points_def points = turned_points();
      assert_ok(msq_set_membership(model, &points, NULL, inside, samples, NULL));
      int held = 0;
      for (int i = 0; i < samples; ++i) {
        double g[3], u[3];
        turned_position(&points, i, is_turned ? rotation : NULL, g);
        const double rho = sqrt(g[0] * g[0] + g[1] * g[1]);
        const double r = kind == MSQ_WARP_CYLINDRICAL ? rho : sqrt(rho * rho + g[2] * g[2]);
        u[0] = turn * (r - 0.5) / 0.7;
        u[1] = 9 * atan2(g[1], g[0]);
        u[2] = kind == MSQ_WARP_CYLINDRICAL ? turn * g[2] / 0.9
                                            : turn * 4 * (atan2(g[2], rho) / (turn / 2) + 0.5);
        const double onset = sin(u[0]) * cos(u[1]) + sin(u[1]) * cos(u[2]) + sin(u[2]) * cos(u[0]);
        held += inside[i];
        if (fabs(onset - 0.25) > 1e-12 && fabs(r - 0.5) > 1e-12 && fabs(r - 1.75) > 1e-12)
          assert_int_equal(inside[i], onset <= 0.25 && r >= 0.5 && r <= 1.75);
      }
      assert_in_range(held, samples / 50, samples / 2);
      /* The cell of a hit: on the x axis of the grid, the one that begins there. */
      const double origin[3] = {def.grid.origin[0], def.grid.origin[1], 0.01};
      const double direction[3] = {is_turned ? c : 1, is_turned ? s : 0, 0};
      msq_rays_def ray;
      msq_ray_hit hit;
      assert_ok(msq_rays_def_init(&ray, sizeof ray));
      ray.count = 1;
      ray.origins = origin;
      ray.directions = direction;
      assert_ok(msq_ray_cast(model, &ray, NULL, &hit, 1, NULL));
      const double radius =
          kind == MSQ_WARP_CYLINDRICAL ? hit.t : sqrt(hit.t * hit.t + 0.01 * 0.01);
      assert_true(radius >= 0.5 - 1e-9 && radius <= 1.75);
      assert_int_equal(hit.cell[0], (int)floor((radius - 0.5) / 0.7 + 1e-9));
      assert_true(hit.cell[1] == 0 || hit.cell[1] == 8); /* either side of the seam */
      assert_int_equal(hit.cell[2], kind == MSQ_WARP_CYLINDRICAL ? 0 : 2);
      msq_model_release(model);
    }
  msq_context_release(context);
}

/* Slices along each axis of the grid have the twisted gyroid, too. */
static void sheared_cells_turn_around_the_axis(void** state) {
  msq_context* context = make_context();
  static uint8_t inside[samples];
  (void)state;
  for (int is_turned = 0; is_turned < 2; ++is_turned) {
    const double c = cos(0.5), s = sin(0.5), rotation[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
    msq_warp_def warp = warp_def(MSQ_WARP_CYLINDRICAL);
    warp.shear_outwards = is_turned ? -0.4 : 0;
    warp.shear_along = 1.75;
    msq_functional_def def = functional_def(&warp);
    def.grid.cell_size[0] = 0.7;
    def.grid.cell_size[2] = 0.9;
    def.grid.origin[1] = 0.3;
    if (is_turned) memcpy(def.grid.rotation, rotation, sizeof rotation);
    msq_structure* structure;
    assert_ok(msq_structure_functional(context, &def, &structure));
    msq_model* model = make_model(context, make_box_of(context, -2, 2), structure, NULL);
    const msq_points_def points = turned_points();
    assert_ok(msq_set_membership(model, &points, NULL, inside, samples, NULL));
    int held = 0;
    for (int i = 0; i < samples; ++i) {
      double g[3];
      turned_position(&points, i, is_turned ? rotation : NULL, g);
      const double r = sqrt(g[0] * g[0] + g[1] * g[1]);
      const double x = (r - 0.5) / 0.7, z = g[2] / 0.9,
                   y = 9 * atan2(g[1], g[0]) / turn + warp.shear_outwards * x + 1.75 * z;
      const double onset = sin(turn * x) * cos(turn * y) + sin(turn * y) * cos(turn * z) +
                           sin(turn * z) * cos(turn * x);
      held += inside[i];
      if (fabs(onset - 0.25) > 1e-12 && fabs(r - 0.5) > 1e-12 && fabs(r - 1.75) > 1e-12)
        assert_int_equal(inside[i], onset <= 0.25 && r >= 0.5 && r <= 1.75);
    }
    assert_in_range(held, samples / 50, samples / 2);
    msq_model_release(model);
  }
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(create_honours_every_struct_size),
      cmocka_unit_test(what_makes_no_map_is_refused),
      cmocka_unit_test(what_does_not_go_with_a_warp_is_refused),
      cmocka_unit_test(cells_lie_around_an_axis_or_a_point),
      cmocka_unit_test(sheared_cells_turn_around_the_axis),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
