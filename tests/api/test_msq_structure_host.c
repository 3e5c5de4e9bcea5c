/* SPDX-License-Identifier: Apache-2.0
 * msq_host_structure_def_init, msq_structure_host. */
#include "hosts.h"

/* A host that has lattices of its own: BCC, by points or by cells. */
typedef struct bcc_host {
  host_log log;
  msq_neighbourhood grid;
  double radius;
  uint64_t built, freed, asked_by_point, asked_by_cell;
  uint64_t bytes;      /* that cells say they have */
  msq_context* clears; /* whose cache is cleared by evaluate_cell */
  msq_model* lets_go;  /* released by the first callback */
  int box_answer;      /* other than 0: what box answers */
} bcc_host;

enum { struts_of_cell = 27 * 8 };
typedef struct bcc_cell {
  int32_t cell[3];
  double struts[struts_of_cell][2][3]; /* from the cell's corner */
} bcc_cell;

static void fill_cell(const bcc_host* host, bcc_cell* cell) {
  for (int s = 0; s < struts_of_cell; ++s)
    for (int axis = 0; axis < 3; ++axis) {
      const int shift = s / (axis == 0 ? 8 : axis == 1 ? 24 : 72) % 3 - 1;
      const double size = host->grid.cell_size[axis];
      cell->struts[s][0][axis] = (shift + 0.5) * size;
      cell->struts[s][1][axis] = (shift + (s >> axis & 1)) * size;
    }
}

static double distance_to(const bcc_cell* cell, const double* q) {
  double least = INFINITY;
  for (int s = 0; s < struts_of_cell; ++s) {
    double along = 0, squared = 0, distance = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = cell->struts[s][0][axis], ab = cell->struts[s][1][axis] - a;
      along += (q[axis] - a) * ab;
      squared += ab * ab;
    }
    const double t = fmin(1, fmax(0, along / squared));
    for (int axis = 0; axis < 3; ++axis) {
      const double a = cell->struts[s][0][axis], ab = cell->struts[s][1][axis] - a;
      const double d = q[axis] - a - t * ab;
      distance += d * d;
    }
    least = fmin(least, distance);
  }
  return sqrt(least);
}

/* Whether cells and positions say where the points are. */
static void check_points(bcc_host* host, const msq_host_points* points) {
  const msq_neighbourhood* grid = &host->grid;
  if (points->struct_size != sizeof *points) host->log.wrong = "struct_size";
  for (uint64_t i = 0; i < points->count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      double at = grid->origin[axis];
      for (int k = 0; k < 3; ++k) {
        const double q = points->positions[3 * i + k];
        if (!(q >= 0 && q <= grid->cell_size[k])) host->log.wrong = "position";
        at += grid->rotation[3 * axis + k] * (points->cells[3 * i + k] * grid->cell_size[k] + q);
      }
      if (fabs(at - points->points[3 * i + axis]) > 1e-9) host->log.wrong = "point";
    }
  if (host->lets_go) {
    msq_model* model = host->lets_go;
    host->lets_go = NULL;
    msq_model_release(model);
  }
}

static int32_t inside_points(void* user, const msq_host_points* points, uint8_t* inside) {
  bcc_host* host = (bcc_host*)user;
  const int32_t code = note_call(&host->log, points->count);
  static bcc_cell cell;
  if (code) return code;
  host->asked_by_point += points->count;
  check_points(host, points);
  fill_cell(host, &cell);
  for (uint64_t i = 0; i < points->count; ++i)
    if (distance_to(&cell, points->positions + 3 * i) <= host->radius)
      inside[i] = (uint8_t)(1 + i % 255);
  return 0;
}

static int32_t build_cell(void* user, const int32_t index[3], void** data, uint64_t* bytes) {
  bcc_host* host = (bcc_host*)user;
  const int32_t code = note_call(&host->log, 1);
  bcc_cell* cell;
  if (code) return code;
  cell = (bcc_cell*)malloc(sizeof *cell);
  if (!cell) return -1;
  fill_cell(host, cell);
  memcpy(cell->cell, index, sizeof cell->cell);
  ++host->built;
  *data = cell;
  *bytes = host->bytes;
  return 0;
}

static int32_t evaluate_cell(void* user, const void* data, const msq_host_points* points,
                             uint8_t* inside) {
  bcc_host* host = (bcc_host*)user;
  const bcc_cell* cell = (const bcc_cell*)data;
  const int32_t code = note_call(&host->log, points->count);
  if (code) return code;
  if (host->clears && msq_cache_clear(host->clears) != MSQ_OK) host->log.wrong = "clear";
  host->asked_by_cell += points->count;
  check_points(host, points);
  for (uint64_t i = 0; i < points->count; ++i) {
    if (memcmp(cell->cell, points->cells + 3 * i, sizeof cell->cell) != 0) host->log.wrong = "cell";
    inside[i] = distance_to(cell, points->positions + 3 * i) <= host->radius;
  }
  return 0;
}

static void free_cell(void* user, void* data) {
  bcc_host* host = (bcc_host*)user;
  if (!pthread_equal(pthread_self(), host->log.thread)) host->log.wrong = "thread of free_cell";
  if (host->log.released) host->log.wrong = "free_cell after the release";
  ++host->freed;
  free(data);
}

static int32_t bound_distance(void* user, const msq_host_points* points, double* distances) {
  bcc_host* host = (bcc_host*)user;
  static bcc_cell cell;
  const int32_t code = note_call(&host->log, points->count);
  if (code) return code;
  fill_cell(host, &cell);
  for (uint64_t i = 0; i < points->count; ++i)
    distances[i] =
        host->log.bad ? NAN : 0.99 * (distance_to(&cell, points->positions + 3 * i) - host->radius);
  return 0;
}

/* About the middle, in the cells of a grid that is not turned. */
static int32_t answer_box(void* user, const double min[3], const double max[3], int32_t* answer) {
  bcc_host* host = (bcc_host*)user;
  static bcc_cell cell;
  const int32_t code = note_call(&host->log, 1);
  double half = 0, q[3];
  if (code) return code;
  fill_cell(host, &cell);
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = (min[axis] + max[axis]) / 2 - host->grid.origin[axis];
    if (!(min[axis] <= max[axis])) host->log.wrong = "box";
    half += (max[axis] - min[axis]) * (max[axis] - min[axis]) / 4;
    q[axis] = middle - floor(middle / host->grid.cell_size[axis]) * host->grid.cell_size[axis];
  }
  half = sqrt(half) * 1.000001;
  const double onset = distance_to(&cell, q);
  if (onset > host->radius + half) *answer = MSQ_BOX_OUTSIDE;
  if (onset < host->radius - half) *answer = MSQ_BOX_INSIDE;
  if (host->box_answer) *answer = host->box_answer;
  return 0;
}

static bcc_host make_host(int is_turned) {
  bcc_host host;
  msq_lattice_def def;
  memset(&host, 0, sizeof host);
  host.log = make_log();
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  host.grid = def.grid;
  host.grid.origin[1] = 0.375;
  host.grid.cell_size[2] = 1.25;
  if (is_turned) {
    const double c = cos(0.5), s = sin(0.5);
    const double rotation[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
    memcpy(host.grid.rotation, rotation, sizeof rotation);
  }
  host.radius = 0.15;
  host.bytes = sizeof(bcc_cell);
  return host;
}

enum { by_points = 1, by_cells = 2, with_box = 4, with_distance = 8 };

static msq_host_structure_def host_def(bcc_host* host, int parts) {
  msq_host_structure_def def;
  assert_ok(msq_host_structure_def_init(&def, sizeof def));
  def.grid = host->grid;
  if (parts & by_points) def.inside = inside_points;
  if (parts & by_cells) {
    def.build_cell = build_cell;
    def.evaluate_cell = evaluate_cell;
    def.free_cell = free_cell;
  }
  if (parts & with_box) def.box = answer_box;
  if (parts & with_distance) def.distance = bound_distance;
  def.user = host;
  def.release = note_release;
  return def;
}

static msq_model* make_host_model(msq_context* context, bcc_host* host, int parts) {
  const msq_host_structure_def def = host_def(host, parts);
  msq_structure* structure;
  assert_ok(msq_structure_host(context, &def, &structure));
  return make_model(context, make_box(context), structure, NULL);
}

static msq_model* make_same_model(msq_context* context, const bcc_host* host) {
  msq_lattice_def def;
  msq_structure* structure;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.grid = host->grid;
  def.radius.value = host->radius;
  assert_ok(msq_structure_lattice(context, &def, &structure));
  return make_model(context, make_box(context), structure, NULL);
}

static void defaults_are_those_of_the_header(void** state) {
  msq_host_structure_def def;
  msq_lattice_def lattice;
  (void)state;
  assert_ok(msq_host_structure_def_init(&def, sizeof def));
  assert_ok(msq_lattice_def_init(&lattice, sizeof lattice));
  assert_memory_equal(&def.grid, &lattice.grid, sizeof def.grid);
  assert_int_equal(def.concurrent, 0);
  assert_true(!def.inside && !def.build_cell && !def.evaluate_cell && !def.free_cell);
  assert_true(!def.box && !def.distance && !def.user && !def.release);
}

static void a_lattice_is_a_lattice(void** state) {
  const int parts[] = {by_points, by_cells, by_points | by_cells, by_points | with_box,
                       by_cells | with_box | with_distance};
  (void)state;
  for (int is_turned = 0; is_turned < 2; ++is_turned)
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i) {
      const int used = is_turned ? parts[i] & ~with_box : parts[i];
      msq_context* context = make_context_of(0, i % 2 ? 0 : (uint64_t)1 << 20, 0);
      bcc_host host = make_host(is_turned);
      msq_model* model = make_host_model(context, &host, used);
      msq_model* same = make_same_model(context, &host);
      const uint64_t inside = assert_same_solid(model, same, 0.013, 3.97);
      assert_in_range(inside, host_samples / 100, host_samples / 2);
      assert_asked_by_caller_alone(model, &host.log);
      assert_right(&host.log);
      if (!(used & by_points)) assert_int_equal(host.asked_by_point, 0);
      assert_int_equal(host.asked_by_cell > 0, (used & by_cells) != 0);
      assert_int_equal(host.built > 0, (used & by_cells) != 0);
      msq_model_release(same);
      msq_context_release(context);
      assert_int_equal(host.log.released, 0);
      msq_model_release(model);
      assert_int_equal(host.log.released, 1);
      assert_int_equal(host.freed, host.built);
      assert_right(&host.log);
    }
}

static void boxes_spare_points(void** state) {
  static uint8_t inside[host_samples];
  msq_points_def grid;
  msq_context* context = make_context();
  bcc_host plain = make_host(0), boxes = make_host(0);
  msq_model* model = make_host_model(context, &plain, by_points);
  msq_model* with_boxes = make_host_model(context, &boxes, by_points | with_box);
  (void)state;
  assert_ok(msq_points_def_init(&grid, sizeof grid)); /* much finer than a strut */
  grid.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = 1.0 / 3;
    grid.spacing[axis] = 0.01;
    grid.counts[axis] = host_side;
  }
  assert_ok(msq_set_membership(model, &grid, NULL, inside, host_samples, NULL));
  assert_ok(msq_set_membership(with_boxes, &grid, NULL, inside, host_samples, NULL));
  assert_int_equal(plain.asked_by_point, host_samples);
  assert_in_range(boxes.asked_by_point, 0, host_samples / 2);
  msq_model_release(model);
  msq_model_release(with_boxes);
  msq_context_release(context);
}

static void single_points_are_asked_without_cells_where_they_can(void** state) {
  msq_context* context = make_context();
  bcc_host both = make_host(0), cells = make_host(0);
  msq_model* of_both = make_host_model(context, &both, by_points | by_cells);
  msq_model* of_cells = make_host_model(context, &cells, by_cells);
  (void)state;
  for (int i = 0; i < 10; ++i) {
    const double x = 0.5 + 0.01 * i;
    assert_int_equal(is_inside(of_both, x, 0.7, 0.6), is_inside(of_cells, x, 0.7, 0.6));
  }
  assert_int_equal(both.built, 0);
  assert_int_equal(both.asked_by_point, 10);
  assert_int_equal(cells.built, 1); /* then from the cache */
  assert_int_equal(cells.asked_by_cell, 10);
  msq_model_release(of_both);
  msq_model_release(of_cells);
  msq_context_release(context);
}

/* ---- the cache */

static void cells_are_kept_within_the_caches_limit(void** state) {
  static uint8_t inside[host_samples];
  const msq_points_def grid = host_grid(0.013, 3.97);
  msq_context* context = make_context_of(1, 8 * sizeof(bcc_cell), 0);
  bcc_host host = make_host(0), large = make_host(0);
  msq_model* model = make_host_model(context, &host, by_cells);
  msq_model* of_large = make_host_model(context, &large, by_cells);
  (void)state;
  large.bytes = UINT64_MAX;
  assert_ok(msq_set_membership(model, &grid, NULL, inside, host_samples, NULL));
  const msq_cache_report report = cache_of(context);
  assert_in_range(report.bytes, 5 * sizeof(bcc_cell), 8 * sizeof(bcc_cell));
  assert_true(report.evictions > 0 && host.freed > 0);
  assert_in_range(host.built - host.freed, 1, 9); /* and the last one dropped */
  assert_ok(msq_set_membership(of_large, &grid, NULL, inside, host_samples, NULL));
  assert_in_range(large.built - large.freed, 0, 1);
  assert_int_equal(cache_of(context).bytes, report.bytes);

  /* Cleared cells wait for the next call. */
  const uint64_t freed = host.freed;
  assert_ok(msq_cache_clear(context));
  assert_int_equal(host.freed, freed);
  is_inside(model, 0.5, 0.5, 0.5);
  assert_int_equal(host.freed, host.built - 1);
  msq_model_release(model);
  assert_int_equal(host.freed, host.built);
  assert_int_equal(cache_of(context).bytes, 0);
  msq_model_release(of_large);
  assert_int_equal(large.freed, large.built);
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

static int32_t build_nothing(void* user, const int32_t cell[3], void** data, uint64_t* bytes) {
  (void)user, (void)cell, (void)data, (void)bytes;
  return 0;
}

static int32_t evaluate_nothing(void* user, const void* data, const msq_host_points* points,
                                uint8_t* inside) {
  (void)user, (void)points, (void)inside;
  return data ? -1 : 0;
}

static void cells_may_be_empty(void** state) {
  msq_context* context = make_context();
  bcc_host host = make_host(0);
  msq_host_structure_def def = host_def(&host, by_cells);
  msq_structure* structure;
  (void)state;
  def.build_cell = build_nothing;
  def.evaluate_cell = evaluate_nothing;
  assert_ok(msq_structure_host(context, &def, &structure));
  msq_model* model = make_model(context, make_box(context), structure, NULL);
  assert_int_equal(is_inside(model, 1, 1, 1), 0);
  msq_model_release(model);
  assert_int_equal(host.freed, 0);
  assert_int_equal(host.log.released, 1);
  msq_context_release(context);
}

/* ---- callbacks that call back, and fail */

static void callbacks_may_clear_the_cache_and_let_go_of_the_model(void** state) {
  static uint8_t inside[host_samples], expected[host_samples];
  const msq_points_def grid = host_grid(0.013, 3.97);
  msq_context* context = make_context();
  bcc_host host = make_host(0);
  msq_model* same = make_same_model(context, &host);
  msq_model* model = make_host_model(context, &host, by_cells);
  (void)state;
  host.clears = context;
  host.lets_go = model;
  assert_ok(msq_set_membership(same, &grid, NULL, expected, host_samples, NULL));
  assert_ok(msq_set_membership(model, &grid, NULL, inside, host_samples, NULL));
  assert_memory_equal(inside, expected, host_samples);
  assert_int_equal(host.log.released, 1);
  assert_int_equal(host.freed, host.built);
  assert_right(&host.log);
  msq_model_release(same);
  msq_context_release(context);
}

static msq_status ask_everything(const msq_model* model) {
  static uint8_t inside[host_samples];
  static double distance[host_samples];
  const msq_points_def grid = host_grid(0.013, 3.97);
  msq_points_def few = grid_points(0.1, 3.9, 5);
  msq_status status = msq_set_membership(model, &grid, NULL, inside, host_samples, NULL);
  if (status == MSQ_OK) status = msq_set_distance(model, &few, NULL, distance, 125, NULL);
  return status;
}

static void callbacks_that_fail_stop_the_call(void** state) {
  const int parts[] = {by_points | with_box, by_cells | with_distance};
  (void)state;
  for (int i = 0; i < 2; ++i) {
    uint64_t calls = 0;
    for (int attempt = 0; attempt < 8; ++attempt) {
      msq_context* context = make_context();
      bcc_host host = make_host(0);
      msq_model* model = make_host_model(context, &host, parts[i]);
      if (attempt) {
        host.log.code = -1000 - attempt;
        host.log.fail_at = 1 + (calls - 1) * (uint64_t)(attempt - 1) / 6;
        assert_refused(ask_everything(model), MSQ_E_HOST, "returned -100");
        assert_int_equal(msq_error_host_code(), -1000 - attempt);
        assert_int_equal(host.log.calls, host.log.fail_at);
      }
      assert_ok(ask_everything(model));
      if (!attempt) calls = host.log.calls;
      assert_right(&host.log);
      msq_model_release(model);
      msq_context_release(context);
      assert_int_equal(host.log.released, 1);
      assert_int_equal(host.freed, host.built);
    }
  }
}

static void answers_that_cannot_be_stop_the_call(void** state) {
  msq_context* context = make_context();
  bcc_host host = make_host(0);
  msq_model* model = make_host_model(context, &host, by_points | with_box | with_distance);
  const double point[3] = {1, 1, 1};
  double distance = 77;
  (void)state;
  host.log.bad = 1;
  assert_refused(msq_point_distance(model, point, NULL, &distance), MSQ_E_HOST, "nan");
  assert_int_equal(msq_error_host_code(), 0);
  assert_true(distance == 77);
  host.box_answer = 3;
  assert_refused(ask_everything(model), MSQ_E_HOST, "box answered 3");
  assert_int_equal(msq_error_host_code(), 0);
  msq_model_release(model);
  msq_context_release(context);
}

/* ---- threads */

typedef struct crowd {
  pthread_mutex_t mutex;
  uint64_t built, freed, released;
} crowd;

static int32_t build_in_crowd(void* user, const int32_t cell[3], void** data, uint64_t* bytes) {
  crowd* c = (crowd*)user;
  bcc_host host = make_host(0);
  bcc_cell* made = (bcc_cell*)malloc(sizeof *made);
  (void)cell;
  if (!made) return -1;
  fill_cell(&host, made);
  pthread_mutex_lock(&c->mutex);
  ++c->built;
  pthread_mutex_unlock(&c->mutex);
  *data = made;
  *bytes = sizeof *made;
  return 0;
}

static int32_t evaluate_in_crowd(void* user, const void* data, const msq_host_points* points,
                                 uint8_t* inside) {
  (void)user;
  for (uint64_t i = 0; i < points->count; ++i)
    inside[i] = distance_to((const bcc_cell*)data, points->positions + 3 * i) <= 0.15;
  return 0;
}

static void free_in_crowd(void* user, void* data) {
  crowd* c = (crowd*)user;
  pthread_mutex_lock(&c->mutex);
  ++c->freed;
  pthread_mutex_unlock(&c->mutex);
  free(data);
}

static void release_crowd(void* user) {
  ++((crowd*)user)->released;
}

static void concurrent_structures_give_the_same(void** state) {
  const uint64_t caches[] = {0, 4 * sizeof(bcc_cell), (uint64_t)1 << 20};
  (void)state;
  for (int i = 0; i < 3; ++i) {
    msq_context* context = make_context_of(0, caches[i], 0);
    bcc_host host = make_host(0);
    crowd c;
    memset(&c, 0, sizeof c);
    pthread_mutex_init(&c.mutex, NULL);
    msq_host_structure_def def = host_def(&host, by_cells);
    def.concurrent = 1;
    def.build_cell = build_in_crowd;
    def.evaluate_cell = evaluate_in_crowd;
    def.free_cell = free_in_crowd;
    def.user = &c;
    def.release = release_crowd;
    msq_structure* structure;
    assert_ok(msq_structure_host(context, &def, &structure));
    msq_model* model = make_model(context, make_box(context), structure, NULL);
    msq_model* same = make_same_model(context, &host);
    assert_same_solid(model, same, 0.013, 3.97);
    msq_model_release(same);
    msq_model_release(model);
    assert_int_equal(c.built, c.freed);
    assert_int_equal(c.released, 1);
    msq_context_release(context);
    pthread_mutex_destroy(&c.mutex);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(a_lattice_is_a_lattice),
      cmocka_unit_test(boxes_spare_points),
      cmocka_unit_test(single_points_are_asked_without_cells_where_they_can),
      cmocka_unit_test(cells_are_kept_within_the_caches_limit),
      cmocka_unit_test(cells_may_be_empty),
      cmocka_unit_test(callbacks_may_clear_the_cache_and_let_go_of_the_model),
      cmocka_unit_test(callbacks_that_fail_stop_the_call),
      cmocka_unit_test(answers_that_cannot_be_stop_the_call),
      cmocka_unit_test(concurrent_structures_give_the_same),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
