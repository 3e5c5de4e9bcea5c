/* SPDX-License-Identifier: Apache-2.0
 * msq_ray_cast of models far from the origin, with their grids: hits are right within the rounding
 * of coordinates, and the same whatever was cast before. By structure: contract/test_far_rays.cpp.
 */
#include "fixtures.h"

enum { kinds = 9, rays = 64, samples = 160 };

/* What is cast at: whether the finest scale is a function, whose bounds round, too. */
typedef struct far_kind {
  const char* name;
  int is_function;
} far_kind;
static const far_kind all_kinds[kinds] = {
    {"a foam", 0},
    {"a foam of graded radius", 0},
    {"a foam of graded density", 0},
    {"a thin foam of unlike sides", 0},
    {"a turned lattice", 0},
    {"a gyroid", 1},
    {"a lattice within a skin", 1},
    {"a foam in a lattice in a mesh", 0},
    {"a ball", 0},
};

static msq_structure* far_foam(msq_context* context, int kind, double cell, const double by[3]) {
  msq_foam_def def;
  msq_field* field = NULL;
  msq_structure* foam;
  double to[3];
  for (int i = 0; i < 3; ++i) to[i] = by[i] + (i == 0 ? 4 : 3);
  assert_ok(msq_foam_def_init(&def, sizeof def));
  memcpy(def.grid.origin, by, sizeof def.grid.origin);
  set_cell(&def.grid, cell);
  def.seed = 5;
  def.radius.value = 0.1 * cell;
  if (kind == 1) {
    assert_ok(msq_field_gradient(context, by, 0.04, to, 0.2, &field));
    def.radius.field = field;
  }
  if (kind == 2) {
    assert_ok(msq_field_gradient(context, by, 1, to, 12, &field));
    def.density.field = field;
    def.radius.value = 0.06;
  }
  if (kind == 3) {
    def.grid.cell_size[2] = 0.3;
    def.radius.value = 0.03;
  }
  assert_ok(msq_structure_foam(context, &def, &foam));
  msq_field_release(field);
  return foam;
}

static msq_structure* far_lattice(msq_context* context, int is_turned, const double by[3]) {
  const double c = cos(0.7), s = sin(0.7);
  const double turned[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  msq_lattice_def def;
  msq_structure* lattice;
  assert_ok(msq_lattice_def_init(&def, sizeof def));
  memcpy(def.grid.origin, by, sizeof def.grid.origin);
  def.unit_cell = MSQ_UNIT_CELL_BCC;
  def.radius.value = 0.12;
  if (is_turned) memcpy(def.grid.rotation, turned, sizeof turned);
  assert_ok(msq_structure_lattice(context, &def, &lattice));
  return lattice;
}

static msq_shape* far_shape(msq_context* context, int kind, const double by[3]) {
  msq_shape* shape;
  double corners[8][3], low[3], high[3], middle[3];
  for (int i = 0; i < 3; ++i) {
    low[i] = by[i];
    high[i] = by[i] + 4;
    middle[i] = by[i] + 2;
    for (int n = 0; n < 8; ++n) corners[n][i] = n >> i & 1 ? high[i] : low[i];
  }
  if (kind == 7) {
    const msq_mesh_def def = mesh_def((const double(*)[3])corners, 8, cube_triangles(), 12);
    return make_mesh(context, &def);
  }
  if (kind == 6 || kind == 8)
    assert_ok(msq_shape_from_sphere(context, middle, 2, &shape));
  else
    assert_ok(msq_shape_from_box(context, low, high, &shape));
  return shape;
}

static msq_model* far_model(msq_context* context, int kind, const double by[3]) {
  msq_scale_def scales[3] = {{.shape = far_shape(context, kind, by)}};
  msq_structure *coarse = NULL, *fine = NULL;
  msq_model_def def;
  msq_model* model;
  if (kind < 4) coarse = far_foam(context, kind, 1, by);
  if (kind == 4 || kind == 6 || kind == 7) coarse = far_lattice(context, kind == 4, by);
  if (kind == 5) {
    msq_functional_def gyroid;
    assert_ok(msq_functional_def_init(&gyroid, sizeof gyroid));
    memcpy(gyroid.grid.origin, by, sizeof gyroid.grid.origin);
    assert_ok(msq_structure_functional(context, &gyroid, &coarse));
  }
  if (kind == 7) fine = far_foam(context, 0, 0.25, by);
  scales[1].structure = coarse;
  scales[2].structure = fine;
  if (kind == 6) scales[1].skin.value = 0.2;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = fine ? 3 : coarse ? 2 : 1;
  def.scale_size = sizeof scales[0];
  assert_ok(msq_model_create(context, &def, &model));
  msq_shape_release((msq_shape*)scales[0].shape);
  msq_structure_release(coarse);
  msq_structure_release(fine);
  return model;
}

/* From around the box into it, half of them along an axis. */
static void make_rays(const double by[3], double origins[rays][3], double directions[rays][3]) {
  uint64_t random = 11;
  for (int n = 0; n < rays; ++n) {
    double size = 0;
    for (int i = 0; i < 3; ++i) {
      const double from = random_between(&random, -1, 5), to = random_between(&random, 0.5, 3.5);
      origins[n][i] = by[i] + from;
      directions[n][i] = n % 2 ? to - from : i == n / 2 % 3 ? (n % 4 ? 1 : -1) : 0;
      size += directions[n][i] * directions[n][i];
    }
    for (int i = 0; i < 3; ++i) directions[n][i] /= sqrt(size);
  }
}

static void cast_some(const msq_model* model, const double (*origins)[3],
                      const double (*directions)[3], uint64_t count, msq_ray_hit* hits) {
  msq_rays_def def;
  assert_ok(msq_rays_def_init(&def, sizeof def));
  def.count = count;
  def.origins = origins;
  def.directions = directions;
  assert_ok(msq_ray_cast(model, &def, NULL, hits, count, NULL));
}

typedef struct far_ray {
  const msq_model* model;
  const double *origin, *direction;
  double depth; /* that counts */
} far_ray;

static int is_in(const far_ray* ray, double t, double along, int axis) {
  double p[3];
  for (int i = 0; i < 3; ++i)
    p[i] = ray->origin[i] + t * ray->direction[i] + (i == axis ? along : 0);
  return is_inside(ray->model, p[0], p[1], p[2]);
}

static int is_deep(const far_ray* ray, double t) {
  for (int axis = 0; axis < 3; ++axis)
    if (!is_in(ray, t, ray->depth, axis) || !is_in(ray, t, -ray->depth, axis)) return 0;
  return is_in(ray, t, 0, 0);
}

/* `e`: to what places along the ray are known. */
static void check_hit(const char* name, const far_ray* ray, const msq_ray_hit* hit, double e) {
  const double end = hit->scale < 0 ? 7 : hit->t;
  double seen = -1;
  if (hit->scale >= 0) {
    int is_met = 0, was_in = !hit->starts_inside && end > 2 * e;
    for (int n = 0; n <= 8; ++n) is_met |= is_in(ray, end + e * n / 8, 0, 0);
    for (int n = 0; n <= 64; ++n) was_in = was_in && is_deep(ray, end - e - e * n / 64);
    if (!is_met || was_in) seen = end;
  }
  for (int n = 0; n < samples && seen < 0; ++n) {
    /* All along, and then ever nearer. */
    const double t =
        n < samples / 2 ? end * n / (samples / 2) : end - exp2(-0.4 * (n - samples / 2));
    if (t > e && t < end - 2 * e && is_deep(ray, t) && is_deep(ray, t - e) && is_deep(ray, t + e) &&
        is_deep(ray, t + 0.5 * e))
      seen = t;
  }
  if (seen >= 0)
    fail_msg("%s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g), t %.17g: wrong by %.17g",
             name, ray->origin[0], ray->origin[1], ray->origin[2], ray->direction[0],
             ray->direction[1], ray->direction[2], hit->t, seen);
}

static void hits_are_right_far_away(void** state) {
  static const double distances[] = {0, 1, 1e3, 1e5, 1e7};
  static double origins[rays][3], directions[rays][3];
  static msq_ray_hit hits[rays], again[rays];
  (void)state;
  for (int kind = 0; kind < kinds; ++kind)
    for (size_t d = 0; d < sizeof distances / sizeof distances[0]; ++d) {
      const double away = distances[d], by[3] = {away, -0.9 * away, 0.8 * away};
      const far_kind* k = &all_kinds[kind];
      msq_context *context = make_context(), *other = make_context();
      msq_model *model = far_model(context, kind, by), *alone = far_model(other, kind, by);
      size_t met = 0;
      make_rays(by, origins, directions);
      cast_some(model, (const double(*)[3])origins, (const double(*)[3])directions, rays, hits);
      /* Each alone, where nothing is known of others; then what they are after many. */
      for (int n = 0; n < rays; ++n)
        cast_some(alone, (const double(*)[3])(origins + n), (const double(*)[3])(directions + n), 1,
                  &again[n]);
      assert_memory_equal(again, hits, sizeof hits);
      for (int n = 0; n < 8; ++n)
        cast_some(model, (const double(*)[3])origins, (const double(*)[3])directions, rays, again);
      assert_memory_equal(again, hits, sizeof hits);
      for (int n = 0; n < rays; ++n) {
        const double coordinate = away + 6;
        const double of_scale = hits[n].scale == 0   ? 4 + 2 * coordinate
                                : hits[n].scale == 1 ? 1
                                                     : 0.25;
        const double e = fmax(ldexp(of_scale, -36), ldexp(coordinate, -50));
        const far_ray ray = {model, origins[n], directions[n],
                             away > 0 ? ldexp(coordinate, k->is_function ? -46 : -50) : 0};
        check_hit(k->name, &ray, &hits[n], e);
        met += hits[n].scale >= 0;
      }
      assert_true(met > rays / 2);
      msq_model_release(model);
      msq_model_release(alone);
      msq_context_release(context);
      msq_context_release(other);
    }
}

/* A ray that grazes a strut, 30,000 cells away: cast first, and after others. */
static void a_grazing_ray_does_not_depend_on_others(void** state) {
  const double origin[3] = {30000.255354261306, -27000.25814922998, 23998.808294230606};
  const double direction[3] = {0.28691054769119145, 0.28432504045479096, 0.91479047272800251};
  const double low[3] = {29998, -27002, 23998}, high[3] = {30002, -26998, 24002};
  static double origins[2048][3], directions[2048][3];
  static msq_ray_hit hits[2048];
  msq_context* context = make_context();
  msq_foam_def def;
  msq_structure* foam;
  msq_shape* box;
  msq_ray_hit first, then;
  (void)state;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  def.grid.origin[0] = 30000.37;
  def.grid.origin[1] = -26999.63;
  def.grid.origin[2] = 24000.37;
  def.radius.value = 0.1;
  def.seed = 5;
  assert_ok(msq_structure_foam(context, &def, &foam));
  assert_ok(msq_shape_from_box(context, low, high, &box));
  msq_model* model = make_model(context, box, foam, NULL);
  cast_some(model, &origin, &direction, 1, &first);
  assert_near(first.t, 0.0927971, 1e-6);
  for (int n = 0; n < 2048; ++n)
    for (int i = 0; i < 3; ++i) {
      origins[n][i] = origin[i] + 0.01 * (i == 0 ? n % 32 : i == 1 ? n / 32 : 0);
      directions[n][i] = direction[i];
    }
  for (int n = 0; n < 4; ++n)
    cast_some(model, (const double(*)[3])origins, (const double(*)[3])directions, 2048, hits);
  assert_memory_equal(&hits[0], &first, sizeof first);
  cast_some(model, &origin, &direction, 1, &then);
  assert_memory_equal(&then, &first, sizeof first);
  msq_model_release(model);
  msq_context_release(context);
}

/* The ray goes along x and meets the shape at t = 1, within `tolerance`, head on. */
static void assert_hit_head_on(msq_context* context, msq_shape* shape, const double from[3],
                               double way, double tolerance) {
  const double direction[3] = {way, 0, 0};
  msq_model* model = make_model(context, shape, NULL, NULL);
  msq_ray_hit hit;
  cast_some(model, (const double(*)[3])from, (const double(*)[3])direction, 1, &hit);
  const double* n = hit.normal;
  if (!(fabs(hit.t - 1) <= tolerance && fabs(n[0] + 1) < 1e-9 && fabs(n[1]) < 1e-9 &&
        fabs(n[2]) < 1e-9))
    fail_msg("by %g: t %.17g, normal (%.17g, %.17g, %.17g)", way, hit.t, n[0], n[1], n[2]);
  msq_model_release(model);
}

/* The squares of these lengths vanish. */
static void normals_of_tiny_faces_have_length_one(void** state) {
  (void)state;
  const double width = 1e-80, radius = 3e-161;
  const double before_rod[3] = {-1, 0.25 * width, 0.5 * width};
  const double before_ball[3] = {-2 * radius, 0, 0}, middle[3] = {0, 0, 0};
  msq_context* context = make_context();
  double corners[8][3];
  cube_corners(0, 1, corners);
  for (int i = 0; i < 8; ++i) corners[i][1] *= width, corners[i][2] *= width;
  const msq_mesh_def rod = mesh_def((const double(*)[3])corners, 8, cube_triangles(), 12);
  assert_hit_head_on(context, make_mesh(context, &rod), before_rod, 1, 1e-9);
  msq_shape* ball;
  assert_ok(msq_shape_from_sphere(context, middle, radius, &ball));
  assert_hit_head_on(context, ball, before_ball, radius, 0.5); /* as its squared radius */
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(normals_of_tiny_faces_have_length_one),
      cmocka_unit_test(hits_are_right_far_away),
      cmocka_unit_test(a_grazing_ray_does_not_depend_on_others),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
