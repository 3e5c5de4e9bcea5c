/* SPDX-License-Identifier: Apache-2.0
 * msq_fill_lines of plates, waves, warped functions, foams with holes, stretched and weighted
 * foams, and of structures made of others. */
#include "fills.h"

static const double size = 4;

static msq_structure* make_walls(msq_context* context, double vent_radius, double stretch,
                                 double weight) {
  msq_foam_def def;
  msq_structure* made;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.wall_thickness.value = 0.1 * size;
  def.vent_radius.value = vent_radius;
  def.stretch[2] = stretch;
  def.weight = weight;
  set_cell(&def.grid, size);
  assert_ok(msq_structure_foam(context, &def, &made));
  return made;
}

static msq_structure* plain_foam(msq_context* context) {
  return make_walls(context, 0, 1, 0);
}
static msq_structure* foam_with_holes(msq_context* context) {
  return make_walls(context, 0.2 * size, 1, 0);
}
static msq_structure* stretched_foam(msq_context* context) {
  return make_walls(context, 0, 2, 0);
}
static msq_structure* weighted_foam(msq_context* context) {
  return make_walls(context, 0, 1, 0.8 * size);
}

static msq_structure* make_plates(msq_context* context, int32_t plate_cell, double radius) {
  msq_plate_lattice_def def;
  msq_structure* made;
  assert_ok(msq_plate_lattice_def_init(&def, sizeof def));
  def.plate_cell = plate_cell;
  def.thickness.value = 0.1;
  def.radius.value = radius;
  set_cell(&def.grid, size);
  assert_ok(msq_structure_plate_lattice(context, &def, &made));
  return made;
}
static msq_structure* octet_plates(msq_context* context) {
  return make_plates(context, MSQ_PLATE_CELL_CUBIC_OCTET, 0);
}
static msq_structure* kelvin_plates_and_struts(msq_context* context) {
  return make_plates(context, MSQ_PLATE_CELL_KELVIN, 0.3);
}

static msq_structure* waves(msq_context* context) {
  msq_waves_def def;
  msq_structure* made;
  assert_ok(msq_waves_def_init(&def, sizeof def));
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.count = 40;
  def.level.value = 0.2;
  set_cell(&def.grid, size);
  assert_ok(msq_structure_waves(context, &def, &made));
  return made;
}

static msq_structure* gyroid_around_an_axis(msq_context* context) {
  msq_functional_def def;
  msq_warp_def warp;
  msq_structure* made;
  assert_ok(msq_warp_def_init(&warp, sizeof warp));
  warp.count = 20;
  warp.inner_radius = 3;
  warp.outer_radius = 19;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value = 0.2;
  def.grid.origin[0] = def.grid.origin[1] = 20;
  def.warp = &warp;
  set_cell(&def.grid, size);
  assert_ok(msq_structure_functional(context, &def, &made));
  return made;
}

static msq_structure* joined(msq_context* context, int32_t operation, msq_structure* a,
                             msq_structure* b) {
  const msq_structure* both[2];
  msq_structure* made;
  (void)context;
  both[0] = a;
  both[1] = b;
  assert_ok(msq_structure_boolean(operation, both, 2, &made));
  msq_structure_release(a);
  msq_structure_release(b);
  return made;
}
static msq_structure* foam_and_plates(msq_context* context) {
  return joined(context, MSQ_BOOLEAN_UNION, plain_foam(context), octet_plates(context));
}
static msq_structure* foam_without_struts(msq_context* context) {
  return joined(context, MSQ_BOOLEAN_DIFFERENCE, plain_foam(context),
                make_lattice_of(context, MSQ_UNIT_CELL_BCC, size, 0.2 * size));
}

typedef msq_structure* (*make_fn)(msq_context* context);

static const struct {
  const char* name;
  make_fn make;
} known[] = {{"foam", plain_foam},
             {"foam with holes", foam_with_holes},
             {"stretched foam", stretched_foam},
             {"weighted foam", weighted_foam},
             {"plates", octet_plates},
             {"plates and struts", kelvin_plates_and_struts},
             {"waves", waves},
             {"gyroid around an axis", gyroid_around_an_axis},
             {"foam and plates", foam_and_plates},
             {"foam without struts", foam_without_struts}};
enum { kinds = sizeof known / sizeof *known };

/* Paths are in the solid, in the square and not in its hole; the same bits by another context. */
static void lines_are_in_the_walls(void** state) {
  msq_context *context = make_context(), *other = make_context_of(1, 0, 0);
  (void)state;
  for (int k = 0; k < kinds; ++k) {
    msq_structure *made = known[k].make(context), *again = known[k].make(other);
    msq_shape* space;
    assert_ok(msq_shape_all_space(context, &space));
    msq_model* model = make_model(context, space, made, NULL);
    for (double z = 0.3; z < 9; z += 4.1) {
      const msq_fill_def def = square_def(z);
      msq_fill *fill = make_fill(context, again, &def), *same = make_fill(other, again, &def);
      const msq_fill_report paths = paths_of(fill), others = paths_of(same);
      const int64_t* points = (const int64_t*)paths.points;
      assert_true(paths.path_count > 5 && paths.length > 100);
      assert_int_equal(others.point_count, paths.point_count);
      assert_memory_equal(others.points, points, 16 * paths.point_count);
      for (uint64_t p = 0; p < paths.path_count; ++p)
        for (uint64_t i = paths.path_starts[p] + 1; i < paths.path_starts[p + 1]; ++i) {
          const int64_t *a = points + 2 * i - 2, *b = points + 2 * i;
          const double middle[3] = {5e-7 * (double)(a[0] + b[0]), 5e-7 * (double)(a[1] + b[1]), z};
          int32_t is_inside = 0;
          assert_true(middle[0] >= 0 && middle[1] >= 0 && middle[0] <= 40 && middle[1] <= 40);
          assert_false(middle[0] > 15 && middle[1] > 15 && middle[0] < 25 && middle[1] < 25);
          assert_ok(msq_point_membership(model, middle, NULL, &is_inside));
          if (!is_inside)
            fail_msg("%s: %.9f, %.9f is outside", known[k].name, middle[0], middle[1]);
        }
      msq_fill_release(same);
      msq_fill_release(fill);
    }
    msq_model_release(model);
    msq_structure_release(again);
  }
  msq_context_release(other);
  msq_context_release(context);
}

/* Two polygons side by side have the lines of both together. */
static void lines_go_on_in_the_next_polygon(void** state) {
  msq_context* context = make_context();
  const int64_t whole[4][2] = {{0, 0}, {40000000, 0}, {40000000, 30000000}, {0, 30000000}};
  const int64_t left[4][2] = {{0, 0}, {17000000, 0}, {13000000, 30000000}, {0, 30000000}};
  const int64_t right[4][2] = {
      {17000000, 0}, {40000000, 0}, {40000000, 30000000}, {13000000, 30000000}};
  const msq_ring rings[3] = {{whole, 4}, {left, 4}, {right, 4}};
  (void)state;
  for (int k = 0; k < kinds; ++k) {
    msq_structure* made = known[k].make(context);
    double lengths[3];
    for (int i = 0; i < 3; ++i) {
      msq_fill_def def = square_def(2.3);
      def.rings = &rings[i];
      def.ring_count = 1;
      def.tolerance = 1e-4;
      msq_fill* fill = make_fill(context, made, &def);
      lengths[i] = paths_of(fill).length;
      msq_fill_release(fill);
    }
    assert_near(lengths[1] + lengths[2], lengths[0], 3e-4 * lengths[0]);
    msq_structure_release(made);
  }
  msq_context_release(context);
}

/* Holes and struts take a part of a foam's lines; a union has those of both. */
static void lengths_add_up(void** state) {
  msq_context* context = make_context();
  double lengths[kinds];
  (void)state;
  for (int k = 0; k < kinds; ++k) {
    msq_structure* made = known[k].make(context);
    const msq_fill_def def = square_def(0.3);
    msq_fill* fill = make_fill(context, made, &def);
    lengths[k] = paths_of(fill).length;
    msq_fill_release(fill);
    msq_structure_release(made);
  }
  assert_true(lengths[1] < 0.9 * lengths[0] && lengths[1] > 0.3 * lengths[0]);
  assert_true(lengths[9] < 0.9 * lengths[0] && lengths[9] > 0.3 * lengths[0]);
  assert_near(lengths[8], lengths[0] + lengths[4], 1e-3 * lengths[8]);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lines_are_in_the_walls),
      cmocka_unit_test(lines_go_on_in_the_next_polygon),
      cmocka_unit_test(lengths_add_up),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
