/* SPDX-License-Identifier: Apache-2.0
 * Small objects and checks that the tests of the C interface share. */
#ifndef FIXTURES_H
#define FIXTURES_H

#include <math.h>

#include "msq_test.h"

/* ---- checks ------------------------------------------------------------------------------ */

/* The last failure's message contains this number. */
static inline void assert_message_has_number(uint64_t number) {
  char text[32];
  snprintf(text, sizeof text, "%llu", (unsigned long long)number);
  assert_message_has(text);
}

/* The call fails with this status, and its message contains the text. */
#define assert_refused(call, status, text) \
  do {                                     \
    assert_status(call, status);           \
    assert_message_has(text);              \
  } while (0)

/* An address that no handle has. */
static inline void* untouched(void) {
  static char nothing;
  return &nothing;
}

/* The call, which has &made for its output handle, is refused and leaves it alone. */
#define assert_makes_nothing(type, call, status, text) \
  do {                                                 \
    type* made = (type*)untouched();                   \
    assert_refused(call, status, text);                \
    assert_ptr_equal(made, untouched());               \
  } while (0)

static inline void assert_near(double got, double wanted, double tolerance) {
  if (fabs(got - wanted) <= tolerance) return;
  fail_msg("%.17g is not within %g of %.17g", got, tolerance, wanted);
}

static inline void assert_filled(const void* data, size_t bytes, uint8_t value) {
  const uint8_t* at = (const uint8_t*)data;
  for (size_t i = 0; i < bytes; ++i)
    if (at[i] != value) fail_msg("byte %zu is %u, not %u", i, (unsigned)at[i], (unsigned)value);
}

/* What no coordinate may be. */
static inline double not_finite(int which) {
  return which == 0 ? NAN : which == 1 ? INFINITY : -INFINITY;
}

/* Uniform in [low, high). */
static inline double random_between(uint64_t* state, double low, double high) {
  uint64_t x = *state += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  x ^= x >> 31;
  return low + (high - low) * ((double)(x >> 11) * 0x1p-53);
}

/* ---- contexts -------------------------------------------------------------------------------- */

/* With so many threads on any machine. 0: one per core. */
static inline msq_context* make_context_of(uint32_t threads, uint64_t cache_bytes,
                                           uint64_t memory_limit) {
  msq_context_def def;
  msq_context* context;
  assert_ok(msq_context_def_init(&def, sizeof def));
  def.threads = threads;
  def.beyond_cores = 1;
  def.cache_bytes = cache_bytes;
  def.memory_limit = memory_limit;
  assert_ok(msq_context_create(&def, &context));
  return context;
}

static inline msq_context* make_context(void) {
  return make_context_of(2, (uint64_t)1 << 30, 0);
}

static inline msq_memory_report memory_of(const msq_context* context) {
  msq_memory_report report = {0};
  report.struct_size = sizeof report;
  assert_ok(msq_context_memory(context, &report));
  return report;
}

static inline msq_cache_report cache_of(const msq_context* context) {
  msq_cache_report report = {0};
  report.struct_size = sizeof report;
  assert_ok(msq_cache_stats(context, &report));
  return report;
}

static inline double progress_of(const msq_job* job) {
  double fraction = -1;
  assert_ok(msq_job_progress(job, &fraction));
  return fraction;
}

/* ---- shapes ------------------------------------------------------------------------------------
 */

static inline msq_shape* make_box_of(msq_context* context, double low, double high) {
  const double min[3] = {low, low, low}, max[3] = {high, high, high};
  msq_shape* shape;
  assert_ok(msq_shape_from_box(context, min, max, &shape));
  return shape;
}

/* From 0 to 4 in each axis. */
static inline msq_shape* make_box(msq_context* context) {
  return make_box_of(context, 0, 4);
}

/* Corner i is at bit 0, 1, 2 of i in x, y, z. */
static inline void cube_corners(double low, double high, double corners[8][3]) {
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis) corners[i][axis] = (i >> axis & 1) ? high : low;
}

/* Counter-clockwise from outside. */
static inline const uint32_t (*cube_triangles(void))[3] {
  static const uint32_t triangles[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                            {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                            {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return triangles;
}

static inline msq_mesh_def mesh_def(const double (*vertices)[3], uint64_t vertex_count,
                                    const uint32_t (*triangles)[3], uint64_t triangle_count) {
  msq_mesh_def def;
  assert_ok(msq_mesh_def_init(&def, sizeof def));
  def.vertices = vertices;
  def.vertex_count = vertex_count;
  def.triangles = triangles ? triangles[0] : NULL;
  def.triangle_count = triangle_count;
  return def;
}

static inline msq_shape* make_mesh(msq_context* context, const msq_mesh_def* def) {
  msq_shape* shape;
  assert_ok(msq_shape_from_mesh(context, def, &shape));
  return shape;
}

/* The box of make_box() as 12 triangles. */
static inline msq_shape* make_cube_mesh(msq_context* context) {
  double corners[8][3];
  cube_corners(0, 4, corners);
  const msq_mesh_def def = mesh_def((const double(*)[3])corners, 8, cube_triangles(), 12);
  return make_mesh(context, &def);
}

static inline msq_shape_report info_of(const msq_shape* shape) {
  msq_shape_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_shape_info(shape, &report));
  return report;
}

/* ---- structures
 * ---------------------------------------------------------------------------------- */

static inline void set_cell(msq_neighbourhood* grid, double size) {
  for (int axis = 0; axis < 3; ++axis) grid->cell_size[axis] = size;
}

/* Unit cells from the origin, not turned. */
static inline void assert_default_grid(const msq_neighbourhood* grid) {
  for (int i = 0; i < 3; ++i) {
    assert_true(grid->origin[i] == 0);
    assert_true(grid->cell_size[i] == 1);
  }
  for (int i = 0; i < 9; ++i) assert_true(grid->rotation[i] == (i % 4 == 0));
}

static inline msq_unit_cell_def named_cell(int32_t unit_cell) {
  msq_unit_cell_def cell;
  assert_ok(msq_unit_cell_def_init(&cell, sizeof cell));
  cell.unit_cell = unit_cell;
  return cell;
}

static inline msq_structure* make_lattice_of(msq_context* context, int32_t unit_cell, double cell,
                                             double radius) {
  msq_lattice_def def;
  msq_structure* structure;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  def.unit_cell = unit_cell;
  set_cell(&def.grid, cell);
  def.radius.value = radius;
  assert_ok(msq_structure_lattice(context, &def, &structure));
  return structure;
}

static inline msq_structure* make_lattice(msq_context* context) {
  return make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.15);
}

static inline msq_structure* make_foam(msq_context* context, int32_t method) {
  msq_foam_def def;
  msq_structure* structure;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.method = method;
  def.radius.value = 0.15;
  assert_ok(msq_structure_foam(context, &def, &structure));
  return structure;
}

/* ---- models
 * -------------------------------------------------------------------------------------- */

/* Takes over one reference of each part; the structures may be NULL. */
static inline msq_model* make_model(msq_context* context, msq_shape* shape, msq_structure* coarse,
                                    msq_structure* fine) {
  msq_scale_def scales[3] = {{.shape = shape}, {.structure = coarse}, {.structure = fine}};
  msq_model_def def;
  msq_model* model;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = fine ? 3 : coarse ? 2 : 1;
  assert_ok(msq_model_create(context, &def, &model));
  msq_shape_release(shape);
  msq_structure_release(coarse);
  msq_structure_release(fine);
  return model;
}

static inline msq_model* make_box_model(msq_context* context) {
  return make_model(context, make_box(context), NULL, NULL);
}

static inline msq_model* make_lattice_model(msq_context* context) {
  return make_model(context, make_box(context), make_lattice(context), NULL);
}

static inline msq_model* make_foam_model(msq_context* context, int32_t method) {
  return make_model(context, make_box(context), make_foam(context, method), NULL);
}

/* A model of the shape alone says whether a point is in it. Takes over one reference of the shape.
 */
static inline msq_model* make_shape_model(msq_context* context, msq_shape* shape) {
  return make_model(context, shape, NULL, NULL);
}

static inline int is_inside(const msq_model* model, double x, double y, double z) {
  const double point[3] = {x, y, z};
  int32_t inside = -1;
  assert_ok(msq_point_membership(model, point, NULL, &inside));
  assert_true(inside == 0 || inside == 1);
  return inside;
}

/* n x n x n points over low to high; their number is n * n * n. */
static inline msq_points_def grid_points(double low, double high, uint64_t n) {
  msq_points_def def;
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_GRID;
  for (int axis = 0; axis < 3; ++axis) {
    def.origin[axis] = low;
    def.spacing[axis] = (high - low) / (double)(n - 1);
    def.counts[axis] = n;
  }
  return def;
}

/* ---- slicers
 * ------------------------------------------------------------------------------------- */

/* width x height pixels over the model's box, layers of this height. */
static inline msq_slicer_def slicer_def(int32_t output, uint32_t width, uint32_t height,
                                        double layer_height) {
  msq_slicer_def def;
  assert_ok(msq_slicer_def_init(&def, sizeof def));
  def.output = output;
  def.resolution[0] = width;
  def.resolution[1] = height;
  def.layer_height = layer_height;
  return def;
}

static inline msq_slicer* make_slicer(const msq_model* model, const msq_slicer_def* def) {
  msq_slicer* slicer;
  assert_ok(msq_slicer_create(model, def, &slicer));
  return slicer;
}

static inline msq_slicer_report plan_of(const msq_slicer* slicer) {
  msq_slicer_report report;
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  assert_ok(msq_slicer_info(slicer, &report));
  return report;
}

#endif
