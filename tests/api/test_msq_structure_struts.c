/* SPDX-License-Identifier: Apache-2.0
 * msq_structure_struts. What struts must be like: tests/contract/test_struts.cpp. */
#include "struts.h"

/* What a callback saw. */
typedef struct taken {
  msq_strut first[8];
  uint64_t count, calls;
  double length;
  uint64_t ids;
  int32_t stop_with;
} taken;

static int32_t take(void* user, const msq_strut* struts, uint64_t count) {
  taken* all = (taken*)user;
  if (count < 1 || count > 4096) return -100;
  for (uint64_t i = 0; i < count; ++i) {
    double squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double way = struts[i].b[axis] - struts[i].a[axis];
      squared += way * way;
    }
    all->length += sqrt(squared);
    all->ids += struts[i].id[0] ^ struts[i].id[1];
    if (all->count < 8) all->first[all->count] = struts[i];
    ++all->count;
  }
  ++all->calls;
  return all->stop_with;
}

static taken struts_of(msq_context* context, const msq_structure* structure,
                       const msq_struts_def* def) {
  taken all;
  memset(&all, 0, sizeof all);
  assert_ok(msq_structure_struts(context, structure, def, take, &all, NULL));
  return all;
}

static void lattices_have_struts(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 1, 0.125);
  msq_struts_def def = struts_def(0, 4);
  taken owned = struts_of(context, lattice, &def), near;
  (void)state;
  assert_int_equal(sizeof(msq_strut), 128);
  assert_int_equal(owned.count, 3 * 64);
  assert_true(owned.length == 3 * 64);
  for (int i = 0; i < 8; ++i) {
    const msq_strut* s = &owned.first[i];
    assert_true(s->radii[0] == 0.125 && s->radii[1] == 0.125);
    assert_int_equal(s->caps[0] + s->caps[1] + s->cut[0] + s->cut[1], 0);
    assert_true(s->node_a[0] != s->node_b[0] || s->node_a[1] != s->node_b[1]);
    for (int axis = 0; axis < 3; ++axis) assert_true(s->cell[axis] >= 0 && s->cell[axis] < 4);
  }
  /* Struts in the upper faces come near the box, and those that end there: (5^2 + 4 * 5^2 ...). */
  def.selection = MSQ_STRUTS_NEAR;
  near = struts_of(context, lattice, &def);
  assert_int_equal(near.count, 3 * 6 * 25);
  /* A box that is a point. */
  def = struts_def(0.5, 0.5);
  assert_int_equal(struts_of(context, lattice, &def).count, 0);
  def.selection = MSQ_STRUTS_NEAR;
  assert_int_equal(struts_of(context, lattice, &def).count, 0);
  def.min[0] = def.max[0] = 0;
  def.min[1] = def.max[1] = 0.1;
  assert_int_equal(struts_of(context, lattice, &def).count, 1);
  msq_structure_release(lattice);
  msq_context_release(context);
}

static void beams_are_struts(void** state) {
  msq_context* context = make_context();
  msq_structure* truss = make_truss(context);
  const msq_struts_def def = struts_def(-1, 3);
  const taken all = struts_of(context, truss, &def);
  int seen = 0;
  (void)state;
  assert_int_equal(all.count, 3);
  for (int i = 0; i < 3; ++i) {
    const msq_strut* s = &all.first[i];
    assert_true(s->id[0] < 3 && s->id[1] == 0);
    seen |= 1 << s->id[0];
    if (s->id[0] == 1) {
      assert_true(s->radii[0] == 0.5 && s->radii[1] == 0.125);
      assert_int_equal(s->caps[0], MSQ_CAP_HEMISPHERE);
      assert_int_equal(s->caps[1], MSQ_CAP_SPHERE);
    }
    if (s->id[0] == 2) {
      assert_true(s->radii[0] == 0.75);
      assert_memory_equal(s->a, s->b, sizeof s->a);
      assert_memory_equal(s->node_a, s->node_b, sizeof s->node_a);
    }
  }
  assert_int_equal(seen, 7);
  msq_structure_release(truss);
  msq_context_release(context);
}

static void struts_are_cut_to_a_shape(void** state) {
  const double centre[3] = {0, 0, 0};
  msq_context* context = make_context();
  msq_structure* truss = make_truss(context);
  msq_shape *ball, *space;
  msq_struts_def def = struts_def(-1, 3);
  taken all;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, centre, 1, &ball));
  def.shape = ball;
  all = struts_of(context, truss, &def);
  assert_int_equal(all.count, 2); /* half a beam and the ball */
  for (int i = 0; i < 2; ++i) {
    const msq_strut* s = &all.first[i];
    if (s->id[0] == 2) continue;
    assert_int_equal(s->id[0], 0);
    assert_int_equal(s->cut[0], 0);
    assert_int_equal(s->cut[1], 1);
    assert_near(s->b[0], 1, 1e-9);
    assert_true(s->b[0] <= 1);
    assert_true(s->radii[1] == 0.25);
  }
  assert_ok(msq_shape_all_space(context, &space));
  def.shape = space;
  assert_int_equal(struts_of(context, truss, &def).count, 3);
  msq_shape_release(space);
  msq_shape_release(ball);
  msq_structure_release(truss);
  msq_context_release(context);
}

static void foams_have_struts(void** state) {
  msq_context* context = make_context();
  msq_context* single = make_context_of(1, 0, 0);
  msq_structure* foam = make_foam_with(context, 0.1, 0);
  msq_structure* walled = make_foam_with(context, 0.1, 0.02);
  const msq_struts_def def = struts_def(0, 9);
  const taken all = struts_of(context, foam, &def);
  const taken again = struts_of(single, foam, &def), with_walls = struts_of(context, walled, &def);
  (void)state;
  /* A Poisson process has 13.54 edges per seed, a jittered grid about as many. */
  assert_near((double)all.count / 729, 13.5, 0.3);
  assert_int_equal(all.count, again.count);
  assert_int_equal(all.ids, again.ids);
  assert_memory_equal(all.first, again.first, sizeof all.first);
  assert_int_equal(all.ids, with_walls.ids);
  msq_structure_release(walled);
  msq_structure_release(foam);
  msq_context_release(single);
  msq_context_release(context);
}

/* A union has the struts of its members, one member after the other, with ids of its own. Cut ends
 * have the radius of the member's field. */
static void unions_have_the_struts_of_all(void** state) {
  const double from[3] = {0, 0, 0}, to[3] = {4, 0, 0}, low[3] = {0.3, 0.3, 0.3},
               high[3] = {3.4, 3.4, 3.4};
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 1, 0.125);
  msq_struts_def def = struts_def(0, 4);
  msq_lattice_def graded_def;
  msq_structure *graded, *both;
  msq_field* radius;
  msq_shape* box;
  msq_strut_graph* graph;
  msq_strut_graph_report report = {.struct_size = sizeof report};
  (void)state;
  assert_ok(msq_field_gradient(context, from, 0.1, to, 0.3, &radius));
  assert_ok(msq_lattice_def_init(&graded_def, sizeof graded_def));
  graded_def.unit_cell = MSQ_UNIT_CELL_BCC;
  graded_def.radius.field = radius;
  assert_ok(msq_structure_lattice(context, &graded_def, &graded));
  const msq_structure* const members[3] = {lattice, graded, lattice};
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, members, 3, &both));
  const taken first = struts_of(context, lattice, &def), second = struts_of(context, graded, &def);
  const taken all = struts_of(context, both, &def);
  assert_int_equal(all.count, 2 * first.count + second.count);
  assert_float_equal(all.length, 2 * first.length + second.length, 1e-9);
  for (int i = 0; i < 8; ++i) {
    msq_strut s = all.first[i];
    assert_memory_not_equal(s.id, first.first[i].id, sizeof s.id);
    memcpy(s.id, first.first[i].id, 6 * sizeof *s.id);
    assert_memory_equal(&s, &first.first[i], sizeof s);
  }
  /* The same lattice twice: no strut and no node is that of another member. */
  assert_ok(msq_structure_strut_graph(context, both, &def, &graph, NULL));
  assert_ok(msq_strut_graph_info(graph, &report));
  assert_int_equal(report.strut_count, all.count);
  uint64_t nodes = 0;
  for (int m = 0; m < 3; ++m) {
    msq_strut_graph* own;
    msq_strut_graph_report of_own = {.struct_size = sizeof of_own};
    assert_ok(msq_structure_strut_graph(context, members[m], &def, &own, NULL));
    assert_ok(msq_strut_graph_info(own, &of_own));
    nodes += of_own.node_count;
    msq_strut_graph_release(own);
  }
  assert_int_equal(report.node_count, nodes);
  msq_strut_graph_release(graph);
  assert_ok(msq_shape_from_box(context, low, high, &box));
  def.shape = box;
  assert_ok(msq_structure_strut_graph(context, both, &def, &graph, NULL));
  assert_ok(msq_strut_graph_info(graph, &report));
  uint64_t cut[2] = {0, 0};
  for (uint64_t i = 0; i < report.strut_count; ++i)
    for (int end = 0; end < 2; ++end) {
      const double x = report.nodes[3 * report.struts[2 * i + (uint64_t)end]];
      const double r = report.radii[2 * i + (uint64_t)end];
      const int is_graded = r != 0.125;
      if (is_graded) assert_float_equal(r, 0.1 + 0.05 * x, 1e-12);
      cut[is_graded] += report.cuts[2 * i + (uint64_t)end];
    }
  assert_true(cut[0] > 10 && cut[1] > 10);
  msq_strut_graph_release(graph);
  msq_shape_release(box);
  msq_structure_release(both);
  msq_structure_release(graded);
  msq_field_release(radius);
  msq_structure_release(lattice);
  msq_context_release(context);
}

static void callbacks_stop_the_call(void** state) {
  msq_context* context = make_context();
  msq_structure* lattice = make_lattice(context);
  const msq_struts_def def = struts_def(0, 30);
  msq_job* job;
  taken all;
  (void)state;
  memset(&all, 0, sizeof all);
  all.stop_with = -7;
  assert_refused(msq_structure_struts(context, lattice, &def, take, &all, NULL), MSQ_E_HOST, "-7");
  assert_int_equal(msq_error_host_code(), -7);
  assert_int_equal(all.calls, 1);
  assert_ok(msq_job_create(&job));
  all.stop_with = 0;
  assert_ok(msq_structure_struts(context, lattice, &def, take, &all, job));
  assert_true(progress_of(job) == 1);
  assert_ok(msq_job_cancel(job));
  assert_refused(msq_structure_struts(context, lattice, &def, take, &all, job), MSQ_E_CANCELLED,
                 "cancelled");
  msq_job_release(job);
  msq_structure_release(lattice);
  msq_context_release(context);
}

/* The last references go in a callback. */
static int32_t let_go(void* user, const msq_strut* struts, uint64_t count) {
  void** handles = (void**)user;
  (void)struts;
  (void)count;
  msq_structure_release((msq_structure*)handles[0]);
  msq_shape_release((msq_shape*)handles[1]);
  msq_context_release((msq_context*)handles[2]);
  handles[0] = handles[1] = handles[2] = NULL;
  return 0;
}

static void references_may_go_in_callbacks(void** state) {
  msq_context* context = make_context();
  const double centre[3] = {3, 3, 3};
  msq_struts_def def = struts_def(0, 6);
  msq_shape* ball;
  (void)state;
  assert_ok(msq_shape_from_sphere(context, centre, 3, &ball));
  def.shape = ball;
  {
    void* handles[3] = {make_lattice(context), ball, context};
    assert_ok(
        msq_structure_struts(context, (msq_structure*)handles[0], &def, let_go, handles, NULL));
    assert_null(handles[0]);
  }
}

static int32_t four_or_six(void* user, const double* points, uint64_t count, double* values) {
  (void)user;
  for (uint64_t i = 0; i < count; ++i) values[i] = points[3 * i] > 0 ? 6 : 4;
  return 0;
}

static void count_release(void* user) {
  ++*(int*)user;
}

/* Also while the threads' memory lives on, with another context. */
static void densities_end_with_their_handles(void** state) {
  int released = 0;
  msq_context* other = make_context_of(1, 1 << 20, 0);
  msq_context* context = make_context_of(1, 1 << 20, 0);
  msq_host_field_def density;
  msq_foam_def def;
  msq_field* field;
  msq_structure* foam;
  taken all = {0};
  const msq_struts_def box = struts_def(0, 2);
  (void)state;
  assert_ok(msq_host_field_def_init(&density, sizeof density));
  density.evaluate = four_or_six;
  density.release = count_release;
  density.user = &released;
  density.low = 1;
  density.high = 6;
  assert_ok(msq_field_host(context, &density, &field));
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.radius.value = 0.05;
  def.density.field = field;
  assert_ok(msq_structure_foam(context, &def, &foam));
  assert_ok(msq_structure_struts(context, foam, &box, take, &all, NULL));
  assert_true(all.count > 0);
  msq_structure_release(foam);
  msq_field_release(field);
  msq_context_release(context);
  assert_int_equal(released, 1);
  msq_context_release(other);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lattices_have_struts),
      cmocka_unit_test(beams_are_struts),
      cmocka_unit_test(struts_are_cut_to_a_shape),
      cmocka_unit_test(foams_have_struts),
      cmocka_unit_test(callbacks_stop_the_call),
      cmocka_unit_test(references_may_go_in_callbacks),
      cmocka_unit_test(unions_have_the_struts_of_all),
      cmocka_unit_test(densities_end_with_their_handles),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
