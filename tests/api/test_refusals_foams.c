/* SPDX-License-Identifier: Apache-2.0
 * What msq_structure_foam refuses. */
#include <math.h>

#include "wrong_values.h"

static msq_context* context;

static msq_foam_def* foam_of(void) {
  msq_foam_def* def = (msq_foam_def*)definition(0);
  assert_ok(msq_foam_def_init(def, sizeof *def));
  def->radius.value = 0.15;
  return def;
}

/* A field of 2 x 2 x 2 samples, spacing apart, that grows along an axis by that much per length. */
static msq_field* coordinate_of(int axis, double spacing, double slope) {
  double values[8];
  msq_grid_field_def def;
  msq_field* field;
  for (int i = 0; i < 8; ++i) values[i] = (i >> axis & 1) * spacing * slope;
  assert_ok(msq_grid_field_def_init(&def, sizeof def));
  def.image.values = values;
  def.image.value_type = MSQ_FLOAT64;
  for (int i = 0; i < 3; ++i) {
    def.image.size[i] = 2;
    def.image.grid.cell_size[i] = spacing;
  }
  assert_ok(msq_field_grid(context, &def, &field));
  return field;
}

/* A coordinate of a map that winds round a hole again and again, 8 voxels a turn. */
static msq_field* winding(int axis) {
  enum { turns = 4096, along = 8 * turns + 1 };
  static double values[2 * along * 2];
  msq_grid_field_def def;
  msq_field* field;
  for (int i = 0; i < 2 * along * 2; ++i) {
    const double angle = 0.78539816339744830962 * (i / 2 % along), radius = i % 2 ? 60 : 50;
    values[i] = axis == 0 ? radius * cos(angle) : axis == 1 ? radius * sin(angle) : i / (2 * along);
  }
  assert_ok(msq_grid_field_def_init(&def, sizeof def));
  def.image.values = values;
  def.image.value_type = MSQ_FLOAT64;
  def.image.size[0] = def.image.size[2] = 2;
  def.image.size[1] = along;
  def.image.grid.cell_size[0] = def.image.grid.cell_size[2] = 1;
  def.image.grid.cell_size[1] = 4;
  assert_ok(msq_field_grid(context, &def, &field));
  return field;
}

static void sampled_foams(void** state) {
  /* 8^3 cells of size 1; those that are 16 and 17 times as long along y; 300^3 cells. */
  msq_field *even[3], *flat[2], *many[3], *wound[3];
  (void)state;
  for (int axis = 0; axis < 3; ++axis) {
    even[axis] = coordinate_of(axis, 8, 1);
    many[axis] = coordinate_of(axis, 300, 1);
    wound[axis] = winding(axis);
  }
  flat[0] = coordinate_of(1, 8, 1.0 / 16);
  flat[1] = coordinate_of(1, 8, 1.0 / 17);
  REFUSALS("msq_structure_foam") {
    msq_warp_def* warp = (msq_warp_def*)definition(1);
    msq_foam_def* def = foam_of();
    msq_structure** structure = (msq_structure**)output(0);
    assert_ok(msq_warp_def_init(warp, sizeof *warp));
    warp->kind = MSQ_WARP_SAMPLED;
    warp->u = even[0];
    warp->v = even[1];
    warp->w = even[2];
    def->grid.cell_size[0] = 100; /* not used */
    def->warp = warp;
    WRONG(ARGUMENT, "warp.v", warp->v = NULL);
    WRONG(ARGUMENT, "one grid", warp->v = many[1]);
    WRONG(ARGUMENT, "folds", warp->v = even[0]);
    RIGHT(warp->v = flat[0]);
    WRONG(LIMIT, "at least 1 wide and up to 17 long|16 times", warp->v = flat[1]);
    WRONG(LIMIT, "301 x 301 x 301 cells|16777216", warp->u = many[0]; warp->v = many[1];
          warp->w = many[2]);
    WRONG(LIMIT, "nearly the same coordinates|134217728 looks", warp->u = wound[0];
          warp->v = wound[1]; warp->w = wound[2]; def->radius.value = 0.01);
    WRONG(LIMIT, "radius|1.01|the limit is 1", def->radius.value = 1.01);
    WRONG(LIMIT, "wall_thickness reaches 1.01|the limit is 1", def->wall_thickness.value = 1.01);
    WRONG(UNSUPPORTED, "a warp|method", def->method = MSQ_FOAM_POINT);
    WRONG(UNSUPPORTED, "a warp|stretch (1, 2, 1)", def->stretch[1] = 2);
    WRONG(UNSUPPORTED, "a warp|weight 0.125", def->weight = 0.125);
    WRONG(UNSUPPORTED, "a warp|density reaches 2", def->density.value = 2);
    if (TRY(msq_structure_foam(context, def, structure))) msq_structure_release(*structure);
  }
  release_fields(even);
  release_fields(many);
  release_fields(wound);
  msq_field_release(flat[0]);
  msq_field_release(flat[1]);
}

static void foams(void** state) {
  const double jitters[] = {-0.125, 1.125, NAN, INFINITY};
  const char* texts[] = {"-0.125", "1.125", "nan", "inf"};
  const double numbers[] = {-0.25, NAN, INFINITY, -INFINITY};
  msq_field *fields[3], *dense[3];
  (void)state;
  make_fields(context, fields, 0.5);
  dense[0] = ramp_of(context, -1, 8);
  dense[1] = ramp_of(context, 1, 40000);
  dense[2] = ramp_of(context, 1, 32768);
  REFUSALS("msq_structure_foam") {
    msq_context* in = context;
    msq_foam_def* def = foam_of();
    msq_structure** structure = (msq_structure**)output(0);
    wrong_sizes(table, def, offsetof(msq_foam_def, density), sizeof *def);
    WRONG(ARGUMENT, "context is NULL", in = NULL);
    WRONG(ARGUMENT, "structure is NULL", structure = NULL);
    wrong_enum(table, &def->method, "method", 0, 4);
    for (int i = 0; i < 4; ++i)
      WRONG(ARGUMENT, words_of("jitter|%s|from 0 to 1", texts[i]), def->jitter = jitters[i]);
    RIGHT(def->grid.cell_size[1] = 4);
    WRONG(LIMIT, "4.5|limit is 4", def->grid.cell_size[1] = 4.5);
    wrong_grid(table, &def->grid);
    /* densities */
    for (int i = 0; i < 4; ++i) WRONG(ARGUMENT, "density is ", def->density.value = numbers[i]);
    RIGHT(def->density.value = 32768);
    WRONG(LIMIT, "density reaches 32769|the limit is 32768", def->density.value = 32769);
    WRONG(ARGUMENT, "density", def->density.field = dense[0]);
    WRONG(LIMIT, "density", def->density.field = dense[1]);
    RIGHT(def->density.field = dense[2]);
    WRONG(UNSUPPORTED, "density reaches 2|MSQ_FOAM_DIRECT", def->density.value = 2;
          def->method = MSQ_FOAM_POINT);
    WRONG(UNSUPPORTED, "MSQ_FOAM_DIRECT", def->density.value = 2; def->method = MSQ_FOAM_METHOD_1);
    WRONG(UNSUPPORTED, "", def->density.value = 2; def->method = MSQ_FOAM_METHOD_2);
    RIGHT(def->density.value = 2; def->method = MSQ_FOAM_DIRECT);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    if (TRY(msq_structure_foam(in, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_foam") { /* radii and walls */
    msq_foam_def* def = foam_of();
    msq_structure** structure = (msq_structure**)output(0);
    def->grid.cell_size[2] = 0.5;
    wrong_radius(table, &def->radius, 0.5, fields);
    for (int k = 0; k < 2; ++k) {
      const double radius = k ? 0.1 : 0;
      for (int i = 0; i < 4; ++i)
        WRONG(ARGUMENT, "wall_thickness is ", def->radius.value = radius;
              def->wall_thickness.value = numbers[i]);
      RIGHT(def->radius.value = radius; def->wall_thickness.value = 0.5);
      WRONG(LIMIT, "wall_thickness reaches 0.515625|the limit is 0.5", def->radius.value = radius;
            def->wall_thickness.value = 0.515625);
      WRONG(ARGUMENT, "wall_thickness|-0.25", def->radius.value = radius;
            def->wall_thickness.field = fields[0]);
      WRONG(ARGUMENT, "wall_thickness|0 everywhere", def->radius.value = radius;
            def->wall_thickness.field = fields[1]);
      WRONG(LIMIT, "wall_thickness|the limit is 0.5", def->radius.value = radius;
            def->wall_thickness.field = fields[2]);
    }
    /* Walls do not excuse a wrong radius. */
    WRONG(ARGUMENT, "radius is -0.5", def->radius.value = -0.5; def->wall_thickness.value = 0.1);
    WRONG(UNSUPPORTED, "wall_thickness reaches 0.1|MSQ_FOAM_DIRECT",
          def->wall_thickness.value = 0.1;
          def->method = MSQ_FOAM_POINT);
    WRONG(UNSUPPORTED, "wall_thickness reaches 0.1|MSQ_FOAM_DIRECT",
          def->wall_thickness.value = 0.1;
          def->method = MSQ_FOAM_METHOD_1);
    RIGHT(def->wall_thickness.value = 0.1; def->method = MSQ_FOAM_DIRECT);
    if (TRY(msq_structure_foam(context, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_foam") { /* vents */
    msq_foam_def* def = foam_of();
    msq_structure** structure = (msq_structure**)output(0);
    def->grid.cell_size[2] = 0.5;
    def->wall_thickness.value = 0.1;
    for (int i = 0; i < 4; ++i)
      WRONG(ARGUMENT, "vent_radius is ", def->vent_radius.value = numbers[i]);
    RIGHT(def->vent_radius.value = 0.5);
    WRONG(LIMIT, "vent_radius reaches 0.515625|the limit is 0.5",
          def->vent_radius.value = 0.515625);
    WRONG(ARGUMENT, "vent_radius|-0.25", def->vent_radius.field = fields[0]);
    WRONG(ARGUMENT, "vent_radius|0 everywhere", def->vent_radius.field = fields[1]);
    WRONG(LIMIT, "vent_radius|the limit is 0.5", def->vent_radius.field = fields[2]);
    WRONG(ARGUMENT, "vent_radius reaches 0.125|wall_thickness", def->vent_radius.value = 0.125;
          def->wall_thickness.value = 0);
    if (TRY(msq_structure_foam(context, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_foam") { /* stretched cells */
    msq_foam_def* def = foam_of();
    msq_structure** structure = (msq_structure**)output(0);
    def->grid.cell_size[2] = 0.5;
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < 4; ++i)
        WRONG(ARGUMENT, words_of("stretch[%d] is |above 0", axis), def->stretch[axis] = numbers[i]);
      WRONG(ARGUMENT, words_of("stretch[%d] is 0|above 0", axis), def->stretch[axis] = 0);
      WRONG(LIMIT, words_of("stretch[%d] is 0.06|0.0625 and 16", axis), def->stretch[axis] = 0.06);
      WRONG(LIMIT, words_of("stretch[%d] is 16.5|0.0625 and 16", axis), def->stretch[axis] = 16.5);
    }
    /* Cells measure 1, 1 and 0.5. */
    RIGHT(def->stretch[2] = 8);
    WRONG(LIMIT, "stretch (1, 1, 8.5)|differ by 17 times|the limit is 16", def->stretch[2] = 8.5);
    RIGHT(def->stretch[0] = def->stretch[1] = def->stretch[2] = 16);
    RIGHT(def->stretch[0] = 4; def->stretch[2] = 0.5);
    WRONG(LIMIT, "stretch (16, 1, 0.25)|differ by 32 times", def->stretch[0] = 16;
          def->stretch[2] = 0.25);
    for (int method = 0; method < 5; ++method)
      if (method == MSQ_FOAM_POINT || method == MSQ_FOAM_METHOD_1)
        WRONG(UNSUPPORTED, "stretch is (1, 2, 1)|method|MSQ_FOAM_DIRECT", def->stretch[1] = 2;
              def->method = method);
    WRONG(UNSUPPORTED, "", def->stretch[1] = 2; def->method = MSQ_FOAM_METHOD_2);
    RIGHT(def->stretch[1] = 2; def->method = MSQ_FOAM_DIRECT);
    /* Equal numbers change nothing. */
    RIGHT(def->stretch[0] = def->stretch[1] = def->stretch[2] = 3; def->method = MSQ_FOAM_POINT);
    WRONG(UNSUPPORTED, "stretch is (1, 2, 1)|density reaches 2", def->stretch[1] = 2;
          def->density.value = 2);
    RIGHT(def->stretch[1] = 2; def->density.value = 0.5);
    WRONG(UNSUPPORTED, "stretch is (1, 2, 1)|vent_radius reaches 0.125", def->stretch[1] = 2;
          def->wall_thickness.value = 0.1; def->vent_radius.value = 0.125);
    RIGHT(def->stretch[1] = 2; def->wall_thickness.value = 0.1);
    RIGHT(def->stretch[1] = 2; def->wall_thickness.value = 0.1; def->radius.value = 0);
    if (TRY(msq_structure_foam(context, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_foam") { /* weighted seeds */
    msq_foam_def* def = foam_of();
    msq_structure** structure = (msq_structure**)output(0);
    def->grid.cell_size[2] = 0.5;
    for (int i = 0; i < 4; ++i)
      WRONG(ARGUMENT, "weight is |finite and not negative", def->weight = numbers[i]);
    RIGHT(def->weight = 0.5);
    WRONG(LIMIT, "weight is 0.515625|the limit is 0.5|smallest cell size", def->weight = 0.515625);
    for (int method = 0; method < 5; ++method)
      if (method == MSQ_FOAM_POINT || method == MSQ_FOAM_METHOD_1)
        WRONG(UNSUPPORTED, "weight is 0.25|method|MSQ_FOAM_DIRECT", def->weight = 0.25;
              def->method = method);
    WRONG(UNSUPPORTED, "", def->weight = 0.25; def->method = MSQ_FOAM_METHOD_2);
    RIGHT(def->weight = 0.25; def->method = MSQ_FOAM_DIRECT);
    RIGHT(def->weight = 0; def->method = MSQ_FOAM_POINT);
    WRONG(UNSUPPORTED, "weight is 0.25|stretch (1, 2, 1)", def->weight = 0.25; def->stretch[1] = 2);
    RIGHT(def->weight = 0.25; def->stretch[0] = def->stretch[1] = def->stretch[2] = 2);
    WRONG(UNSUPPORTED, "weight is 0.25|density reaches 2", def->weight = 0.25;
          def->density.value = 2);
    RIGHT(def->weight = 0.25; def->density.value = 0.5);
    WRONG(UNSUPPORTED, "weight is 0.25|vent_radius reaches 0.125", def->weight = 0.25;
          def->wall_thickness.value = 0.1; def->vent_radius.value = 0.125);
    RIGHT(def->weight = 0.25; def->wall_thickness.value = 0.1);
    RIGHT(def->weight = 0.25; def->wall_thickness.value = 0.1; def->radius.value = 0);
    if (TRY(msq_structure_foam(context, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_foam") { /* a period */
    const double positions[2] = {0, 4}, sizes[2] = {1, 0.25}, steep[2] = {1, 0.0625},
                 too_steep[2] = {1, 0.0615}, long_cells[2] = {4, 1}, too_long[2] = {4.5, 1},
                 descending[2] = {4, 0};
    msq_period_def* period = (msq_period_def*)definition(1);
    msq_foam_def* def = foam_of();
    msq_structure** structure = (msq_structure**)output(0);
    assert_ok(msq_period_def_init(period, sizeof *period));
    period->positions = positions;
    period->cell_sizes = sizes;
    period->count = 2;
    def->radius.value = 0.05;
    def->grid.cell_size[2] = 100; /* not used */
    def->period = period;
    WRONG(ARGUMENT, "period.axis is 3", period->axis = 3);
    WRONG(ARGUMENT, "period.count is 0", period->count = 0);
    WRONG(ARGUMENT, "period.positions[1] is 0|fold", period->positions = descending);
    RIGHT(period->cell_sizes = steep);
    WRONG(LIMIT, "period.cell_sizes run from 0.0615 to 1|16 times", period->cell_sizes = too_steep);
    RIGHT(period->cell_sizes = long_cells);
    WRONG(LIMIT, "differ by 4.5 times|the limit is 4", period->cell_sizes = too_long);
    RIGHT(def->radius.value = 0.25);
    WRONG(LIMIT, "radius|0.26|the limit is 0.25", def->radius.value = 0.26);
    WRONG(LIMIT, "wall_thickness reaches 0.26|the limit is 0.25", def->wall_thickness.value = 0.26);
    WRONG(LIMIT, "vent_radius reaches 0.26|the limit is 0.25", def->wall_thickness.value = 0.1;
          def->vent_radius.value = 0.26);
    RIGHT(def->wall_thickness.value = 0.1; def->vent_radius.value = 0.25);
    for (int method = 0; method < 5; ++method)
      if (method == MSQ_FOAM_POINT || method == MSQ_FOAM_METHOD_1)
        WRONG(UNSUPPORTED, "a period|method|MSQ_FOAM_DIRECT", def->method = method);
    WRONG(UNSUPPORTED, "", def->method = MSQ_FOAM_METHOD_2);
    RIGHT(def->method = MSQ_FOAM_DIRECT);
    WRONG(UNSUPPORTED, "a period|stretch (1, 2, 1)", def->stretch[1] = 2);
    RIGHT(def->stretch[0] = def->stretch[1] = def->stretch[2] = 2);
    WRONG(UNSUPPORTED, "a period|weight 0.125", def->weight = 0.125);
    WRONG(UNSUPPORTED, "a period|density reaches 2", def->density.value = 2);
    RIGHT(def->density.value = 0.5);
    if (TRY(msq_structure_foam(context, def, structure))) msq_structure_release(*structure);
  }
  REFUSALS("msq_structure_foam") { /* a warp */
    const double positions[1] = {0}, sizes[1] = {1};
    msq_period_def* period = (msq_period_def*)definition(2);
    msq_warp_def* warp = (msq_warp_def*)definition(1);
    msq_foam_def* def = foam_of();
    msq_structure** structure = (msq_structure**)output(0);
    assert_ok(msq_period_def_init(period, sizeof *period));
    period->positions = positions;
    period->cell_sizes = sizes;
    period->count = 1;
    assert_ok(msq_warp_def_init(warp, sizeof *warp));
    warp->count = 25;
    warp->inner_radius = 2; /* 0.5 wide */
    warp->outer_radius = 6;
    def->radius.value = 0.05;
    def->grid.cell_size[1] = 100; /* not used */
    def->warp = warp;
    WRONG(ARGUMENT, "warp.count is 0", warp->count = 0);
    WRONG(ARGUMENT, "warp.outer_radius is 0|in a foam", warp->outer_radius = 0);
    RIGHT(warp->kind = MSQ_WARP_SPHERICAL; warp->count_polar = 12);
    WRONG(LIMIT, "warp.count is 2|at least 3 and 2", warp->kind = MSQ_WARP_SPHERICAL;
          warp->count_polar = 12; warp->count = 2);
    WRONG(LIMIT, "count_polar 1|at least 3 and 2", warp->kind = MSQ_WARP_SPHERICAL;
          warp->count_polar = 1);
    WRONG(LIMIT, "0.0785398 from south|their sizes run from 0.0785398 to 1.50796",
          warp->kind = MSQ_WARP_SPHERICAL;
          warp->count_polar = 80);
    RIGHT(warp->shear_outwards = 0.5; warp->shear_along = -1);
    WRONG(LIMIT, "shear_along 300|the limit is 32766", warp->shear_along = 300);
    WRONG(UNSUPPORTED, "a period and a warp", def->period = period);
    WRONG(LIMIT, "0 wide at inner_radius|16 times", warp->inner_radius = 0);
    RIGHT(warp->inner_radius = 0.376);
    WRONG(LIMIT, "their sizes run from 0.0929911 to 1.50796|16 times", warp->inner_radius = 0.37);
    WRONG(LIMIT, "their sizes run from 0.502655 to 8.1|16 times", def->grid.cell_size[2] = 8.1);
    WRONG(LIMIT, "their sizes run from 0.0625 to 1.50796", def->grid.cell_size[0] = 0.0625);
    WRONG(LIMIT, "seeds would be in one box of the search|the limit is 32766", warp->count = 1;
          warp->inner_radius = 0.25; warp->outer_radius = 2.5);
    RIGHT(warp->count = 2; warp->inner_radius = 0.5; warp->outer_radius = 2.5);
    WRONG(LIMIT, "radius|0.51|the limit is 0.502", def->radius.value = 0.51);
    WRONG(LIMIT, "wall_thickness reaches 0.51|the limit is 0.502",
          def->wall_thickness.value = 0.51);
    WRONG(LIMIT, "vent_radius reaches 0.51|the limit is 0.502", def->wall_thickness.value = 0.1;
          def->vent_radius.value = 0.51);
    RIGHT(def->wall_thickness.value = 0.1; def->vent_radius.value = 0.5);
    for (int method = 0; method < 5; ++method)
      if (method == MSQ_FOAM_POINT || method == MSQ_FOAM_METHOD_1)
        WRONG(UNSUPPORTED, "a warp|method|MSQ_FOAM_DIRECT", def->method = method);
    WRONG(UNSUPPORTED, "", def->method = MSQ_FOAM_METHOD_2);
    RIGHT(def->method = MSQ_FOAM_DIRECT);
    WRONG(UNSUPPORTED, "a warp|stretch (1, 2, 1)", def->stretch[1] = 2);
    RIGHT(def->stretch[0] = def->stretch[1] = def->stretch[2] = 2);
    WRONG(UNSUPPORTED, "a warp|weight 0.125", def->weight = 0.125);
    WRONG(UNSUPPORTED, "a warp|density reaches 2", def->density.value = 2);
    RIGHT(def->density.value = 0.5);
    if (TRY(msq_structure_foam(context, def, structure))) msq_structure_release(*structure);
  }
  release_fields(fields);
  release_fields(dense);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(foams),
      cmocka_unit_test(sampled_foams),
  };
  context = make_context();
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_context_release(context);
  return failed;
}
