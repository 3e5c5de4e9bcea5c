/* SPDX-License-Identifier: Apache-2.0
 * msq_structure_boolean. */
#include "layers.h"
#include "struts.h"

enum { member_count = 3 };

/* A lattice, a gyroid with other cells that are turned, and a foam. */
static void make_members(msq_context* context, msq_structure* members[member_count]) {
  static const double turned[9] = {0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1};
  msq_functional_def def;
  members[0] = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.2);
  assert_ok(msq_functional_def_init(&def, sizeof def));
  set_cell(&def.grid, 1.7);
  memcpy(def.grid.rotation, turned, sizeof turned);
  def.grid.origin[1] = 0.4;
  def.level.value = 0.3;
  assert_ok(msq_structure_functional(context, &def, &members[1]));
  members[2] = make_foam_with(context, 0.15, 0);
}

static msq_structure* boolean_of(int32_t operation, msq_structure* const* members, uint64_t count) {
  msq_structure* made;
  assert_ok(msq_structure_boolean(operation, (const msq_structure* const*)members, count, &made));
  return made;
}

/* Keeps the structure. */
static msq_model* model_with(msq_context* context, msq_structure* structure) {
  msq_structure_retain(structure);
  return make_model(context, make_box(context), structure, NULL);
}

static int wanted(int32_t operation, const int in[member_count]) {
  return operation == MSQ_BOOLEAN_UNION          ? in[0] || in[1] || in[2]
         : operation == MSQ_BOOLEAN_INTERSECTION ? in[0] && in[1] && in[2]
                                                 : in[0] && !in[1] && !in[2];
}

/* As far as the box allows. */
static double wanted_distance(int32_t operation, const double of[member_count]) {
  return operation == MSQ_BOOLEAN_UNION          ? fmin(of[0], fmin(of[1], of[2]))
         : operation == MSQ_BOOLEAN_INTERSECTION ? fmax(of[0], fmax(of[1], of[2]))
                                                 : fmax(of[0], fmax(-of[1], -of[2]));
}

static void memberships_are_put_together(void** state) {
  msq_context* context = make_context();
  msq_structure *members[member_count], *made[3];
  msq_model *of_members[member_count], *models[3];
  uint64_t random = 3;
  size_t held[3] = {0};
  (void)state;
  make_members(context, members);
  for (int i = 0; i < 3; ++i) {
    made[i] = boolean_of(i + 1, members, member_count);
    models[i] = model_with(context, made[i]);
    of_members[i] = model_with(context, members[i]);
    msq_structure_release(made[i]);
  }
  for (int i = 0; i < 3; ++i) msq_structure_release(members[i]);
  for (size_t n = 0; n < 5000; ++n) {
    double p[3], of[member_count], distance;
    int in[member_count];
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = n % 2 ? random_between(&random, 1, 3) : floor(random_between(&random, 8, 24)) / 8;
    for (int i = 0; i < member_count; ++i) {
      in[i] = is_inside(of_members[i], p[0], p[1], p[2]);
      assert_ok(msq_point_distance(of_members[i], p, NULL, &of[i]));
    }
    for (int i = 0; i < 3; ++i) {
      const int is_wanted = wanted(i + 1, in);
      assert_int_equal(is_inside(models[i], p[0], p[1], p[2]), is_wanted);
      held[i] += (size_t)is_wanted;
      assert_ok(msq_point_distance(models[i], p, NULL, &distance));
      assert_true(is_wanted ? distance <= 0 : distance > 0);
      assert_near(distance, wanted_distance(i + 1, of), 1e-300);
    }
  }
  for (int i = 0; i < 3; ++i) {
    assert_in_range(held[i], 20, 4980);
    msq_model_release(models[i]);
    msq_model_release(of_members[i]);
  }
  msq_context_release(context);
}

/* Layers of bits are the bits of the members' layers, put together. */
static void rows_are_put_together(void** state) {
  msq_context* context = make_context();
  msq_structure* members[member_count];
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 150, 90, 0.3);
  layer_stack of_members[member_count];
  (void)state;
  make_members(context, members);
  for (int i = 0; i < member_count; ++i) {
    msq_model* model = model_with(context, members[i]);
    msq_slicer* slicer = make_slicer(model, &def);
    of_members[i] = run_all(slicer, MSQ_LAYER_BITS);
    msq_slicer_release(slicer);
    msq_model_release(model);
  }
  for (int32_t operation = MSQ_BOOLEAN_UNION; operation <= MSQ_BOOLEAN_DIFFERENCE; ++operation) {
    msq_structure* made = boolean_of(operation, members, member_count);
    msq_model* model = model_with(context, made);
    msq_slicer* slicer = make_slicer(model, &def);
    layer_stack all = run_all(slicer, MSQ_LAYER_BITS);
    const uint64_t bytes = all.taken * all.plan.layer_bytes;
    assert_true(bytes == of_members[0].taken * of_members[0].plan.layer_bytes && bytes > 1000);
    for (uint64_t i = 0; i < bytes; ++i) {
      const unsigned a = of_members[0].data[i], b = of_members[1].data[i];
      const unsigned c = of_members[2].data[i];
      const unsigned bits = operation == MSQ_BOOLEAN_UNION          ? a | b | c
                            : operation == MSQ_BOOLEAN_INTERSECTION ? a & b & c
                                                                    : a & ~b & ~c;
      assert_int_equal(all.data[i], bits);
    }
    free_stack(&all);
    msq_slicer_release(slicer);
    msq_model_release(model);
    msq_structure_release(made);
  }
  for (int i = 0; i < member_count; ++i) {
    free_stack(&of_members[i]);
    msq_structure_release(members[i]);
  }
  msq_context_release(context);
}

static void one_structure_is_itself(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice(context);
  msq_model* of_lattice = model_with(context, lattice);
  (void)state;
  for (int32_t operation = 1; operation <= 3; ++operation) {
    msq_structure* made = boolean_of(operation, &lattice, 1);
    msq_model* model = model_with(context, made);
    double length, of_it;
    assert_ok(msq_model_scale_length(model, 1, &length));
    assert_ok(msq_model_scale_length(of_lattice, 1, &of_it));
    assert_true(length == of_it);
    uint64_t random = 1;
    for (int n = 0; n < 500; ++n) {
      const double p[3] = {random_between(&random, 0, 4), random_between(&random, 0, 4), 1.25};
      double a, b;
      assert_ok(msq_point_distance(model, p, NULL, &a));
      assert_ok(msq_point_distance(of_lattice, p, NULL, &b));
      assert_true(a == b);
    }
    msq_model_release(model);
    msq_structure_release(made);
  }
  msq_model_release(of_lattice);
  msq_structure_release(lattice);
  msq_context_release(context);
}

/* A scale of a model, with another scale within it and a skin: the length is the largest. */
static void a_scale_may_be_a_boolean(void** state) {
  msq_context* context = make_context();
  msq_structure* members[member_count];
  (void)state;
  make_members(context, members);
  msq_structure* made = boolean_of(MSQ_BOOLEAN_UNION, members, 2);
  msq_structure* fine = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 0.25, 0.08);
  msq_structure_retain(made);
  msq_model* model = make_model(context, make_box(context), made, fine);
  msq_model* alone = model_with(context, made);
  double length;
  assert_ok(msq_model_scale_length(model, 1, &length));
  assert_true(length == 1.7);
  uint64_t random = 5;
  size_t held = 0;
  for (int n = 0; n < 2000; ++n) {
    const double p[3] = {random_between(&random, 0, 4), random_between(&random, 0, 4),
                         random_between(&random, 0, 4)};
    msq_query_def coarse;
    assert_ok(msq_query_def_init(&coarse, sizeof coarse));
    coarse.length_scale = 1;
    const int in = is_inside(model, p[0], p[1], p[2]),
              in_coarse = is_inside(alone, p[0], p[1], p[2]);
    int32_t resolved;
    assert_ok(msq_point_membership(model, p, &coarse, &resolved));
    assert_int_equal(resolved, in_coarse);
    assert_true(!in || in_coarse);
    held += (size_t)in;
  }
  assert_in_range(held, 10, 1990);
  msq_model_release(alone);
  msq_model_release(model);
  msq_structure_release(made);
  for (int i = 0; i < member_count; ++i) msq_structure_release(members[i]);
  msq_context_release(context);
}

/* What a boolean lacks, its members have. */
static void some_questions_are_for_the_members(void** state) {
  msq_context* context = make_context();
  msq_structure* members[member_count];
  const msq_points_def points = grid_points(0, 1, 2);
  double onsets[8] = {7};
  const msq_struts_def box = struts_def(0, 1);
  (void)state;
  make_members(context, members);
  msq_structure* joined = boolean_of(MSQ_BOOLEAN_UNION, members, member_count);
  assert_refused(msq_set_onset(context, joined, &points, MSQ_ONSET_PLAIN, onsets, 8, NULL, 0, NULL),
                 MSQ_E_UNSUPPORTED, "no onset");
  assert_true(onsets[0] == 7);
  assert_makes_nothing(msq_strut_graph,
                       msq_structure_strut_graph(context, joined, &box, &made, NULL),
                       MSQ_E_UNSUPPORTED, "no struts");
  msq_structure_release(joined);
  for (int i = 0; i < member_count; ++i) msq_structure_release(members[i]);
  msq_context_release(context);
}

/* Rays meet what is met first, by that member's normal, and name no cell. */
static void rays_meet_the_nearest_member(void** state) {
  msq_context* context = make_context();
  msq_structure* members[2] = {make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 4, 0.5),
                               make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 4, 0.25)};
  const double origin[3] = {-1, 0.1, 2}, direction[3] = {1, 0, 0}, from[3] = {2, -1, 0.25};
  const double up[3] = {0, 1, 0};
  (void)state;
  for (int32_t operation = 1; operation <= 3; ++operation) {
    msq_structure* made = boolean_of(operation, members, 2);
    msq_model* model = model_with(context, made);
    msq_rays_def rays;
    msq_ray_hit hit[2];
    double origins[2][3], directions[2][3];
    memcpy(origins[0], origin, sizeof origin);
    memcpy(directions[0], direction, sizeof direction);
    memcpy(origins[1], from, sizeof from);
    memcpy(directions[1], up, sizeof up);
    assert_ok(msq_rays_def_init(&rays, sizeof rays));
    rays.origins = origins;
    rays.directions = directions;
    rays.count = 2;
    assert_ok(msq_ray_cast(model, &rays, NULL, hit, 2, NULL));
    /* Through the strut along z at (0, 0), from its middle outwards: the face of the box, or where
     * the inner strut ends. Then upwards through the one along x at (0, 0), beside its axis. */
    const int is_cut = operation == MSQ_BOOLEAN_DIFFERENCE;
    assert_near(hit[0].t, is_cut ? 1 + sqrt(0.25 * 0.25 - 0.1 * 0.1) : 1, 1e-9);
    assert_int_equal(hit[0].scale, is_cut ? 1 : 0);
    if (is_cut) {
      assert_near(hit[0].normal[0], -sqrt(0.25 * 0.25 - 0.1 * 0.1) / 0.25, 1e-9);
      assert_near(hit[0].normal[1], -0.1 / 0.25, 1e-9);
    }
    for (int i = 0; i < 2; ++i)
      for (int axis = 0; axis < 3; ++axis) assert_int_equal(hit[i].cell[axis], 0);
    msq_model_release(model);
    msq_structure_release(made);
  }
  msq_structure_release(members[0]);
  msq_structure_release(members[1]);
  msq_context_release(context);
}

/* The limit on cells holds for every grid within. */
static void all_grids_limit_the_shape(void** state) {
  msq_context* context = make_context();
  msq_structure *members[2], *made;
  const double min[3] = {0, 0, 0}, max[3] = {20000, 1, 1};
  msq_shape* shape;
  msq_scale_def scales[2] = {{0}, {0}};
  msq_model_def def;
  msq_model* model = NULL;
  (void)state;
  members[0] = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 1, 0.1);
  members[1] = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 0.001, 0.0001);
  made = boolean_of(MSQ_BOOLEAN_UNION, members, 2);
  assert_ok(msq_shape_from_box(context, min, max, &shape));
  assert_ok(msq_model_def_init(&def, sizeof def));
  scales[0].shape = shape;
  scales[1].structure = made;
  def.scales = scales;
  def.scale_count = 2;
  def.scale_size = sizeof scales[0];
  assert_refused(msq_model_create(context, &def, &model), MSQ_E_LIMIT, "2e+07 cells of scale 1");
  assert_null(model);
  msq_structure_release(made);
  msq_structure_release(members[0]);
  msq_structure_release(members[1]);
  msq_shape_release(shape);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(memberships_are_put_together),
      cmocka_unit_test(rows_are_put_together),
      cmocka_unit_test(one_structure_is_itself),
      cmocka_unit_test(a_scale_may_be_a_boolean),
      cmocka_unit_test(some_questions_are_for_the_members),
      cmocka_unit_test(rays_meet_the_nearest_member),
      cmocka_unit_test(all_grids_limit_the_shape),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
