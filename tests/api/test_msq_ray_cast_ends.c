/* SPDX-License-Identifier: Apache-2.0
 * msq_ray_cast and msq_render end, whatever rays, functions and cameras they are given, and stop
 * when they are cancelled. Calls that do neither run into the test's time limit. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <time.h>

#include "cameras.h"

enum { many = 1000 };

static double origins[many][3], directions[many][3];
static msq_ray_hit hits[many];

static msq_rays_def rays_of(uint64_t count) {
  msq_rays_def def;
  assert_ok(msq_rays_def_init(&def, sizeof def));
  def.count = count;
  def.origins = origins;
  def.directions = directions;
  return def;
}

static msq_job* make_job(void) {
  msq_job* job;
  assert_ok(msq_job_create(&job));
  return job;
}

/* ---- cancelling --------------------------------------------------------------------------- */

/* Cancels a job after a time, unless it is ended before. */
typedef struct canceller {
  msq_job* job;
  struct timespec at;
  int is_ended;
  pthread_t thread;
  pthread_mutex_t mutex;
  pthread_cond_t ended;
} canceller;

static void* cancel_later(void* user) {
  canceller* it = (canceller*)user;
  int waits = 0;
  pthread_mutex_lock(&it->mutex);
  while (!it->is_ended && waits == 0)
    waits = pthread_cond_timedwait(&it->ended, &it->mutex, &it->at);
  pthread_mutex_unlock(&it->mutex);
  return it->is_ended || msq_job_cancel(it->job) == MSQ_OK ? NULL : user;
}

static void start_cancelling(canceller* it, msq_job* job, long milliseconds) {
  it->job = job;
  it->is_ended = 0;
  clock_gettime(CLOCK_REALTIME, &it->at);
  it->at.tv_nsec += milliseconds * 1000000;
  it->at.tv_sec += it->at.tv_nsec / 1000000000;
  it->at.tv_nsec %= 1000000000;
  assert_int_equal(pthread_mutex_init(&it->mutex, NULL), 0);
  assert_int_equal(pthread_cond_init(&it->ended, NULL), 0);
  assert_int_equal(pthread_create(&it->thread, NULL, cancel_later, it), 0);
}

static void end_cancelling(canceller* it) {
  void* failed;
  pthread_mutex_lock(&it->mutex);
  it->is_ended = 1;
  pthread_cond_signal(&it->ended);
  pthread_mutex_unlock(&it->mutex);
  assert_int_equal(pthread_join(it->thread, &failed), 0);
  assert_null(failed);
  pthread_cond_destroy(&it->ended);
  pthread_mutex_destroy(&it->mutex);
}

/* ---- structures --------------------------------------------------------------------------- */

static msq_structure* make_expression(msq_context* context, const char* text, int32_t kind,
                                      double level) {
  msq_functional_def def;
  msq_structure* structure;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  def.function = MSQ_FUNCTION_EXPRESSION;
  def.expression = text;
  def.kind = kind;
  def.level.value = level;
  def.clusters = 1;
  assert_ok(msq_structure_functional(context, &def, &structure));
  return structure;
}

static int32_t host_outside(void* user, const msq_host_points* points, uint8_t* inside) {
  (void)user;
  memset(inside, 0, points->count);
  return 0;
}

static int32_t host_values(void* user, const double* positions, uint64_t count, double* values) {
  (void)user;
  (void)positions;
  for (uint64_t i = 0; i < count; ++i) values[i] = 1;
  return 0;
}

/* Structures of unit cells that a ray through the middles of cells passes by. */
enum { kinds = 10 };
static msq_structure* make_thin(msq_context* context, int kind) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 0, 0};
  const msq_unit_cell_def cells[2] = {named_cell(MSQ_UNIT_CELL_CUBIC),
                                      named_cell(MSQ_UNIT_CELL_CUBIC)};
  msq_structure* structure = NULL;
  msq_field* field = NULL;
  if (kind == 0) return make_lattice_of(context, MSQ_UNIT_CELL_CUBIC, 1, 0.01);
  if (kind == 1) return make_expression(context, "sin(x)*cos(y)", MSQ_FUNCTIONAL_NETWORK, -2);
  if (kind == 2) return make_expression(context, "sqrt(-1-x)", MSQ_FUNCTIONAL_NETWORK, 1);
  if (kind == 3)
    return make_expression(context, "sin(1e4*sin(1e4*x))+1.5", MSQ_FUNCTIONAL_SHEET, 0.1);
  assert_ok(msq_field_gradient(context, low, 0.01, high, 0.012, &field));
  if (kind == 4 || kind == 5) {
    msq_lattice_def def;
    assert_ok(msq_lattice_def_init(&def, sizeof def));
    def.unit_cell = MSQ_UNIT_CELL_CUBIC;
    def.radius.field = field;
    if (kind == 5) {
      def.cells = cells;
      def.cell_count = 2;
      def.cell_choice.field = field;
    }
    assert_ok(msq_structure_lattice(context, &def, &structure));
  } else if (kind < 8) {
    msq_foam_def def;
    assert_ok(msq_foam_def_init(&def, sizeof def));
    def.jitter = 0; /* so that edges lie by the corners of cells */
    if (kind == 6)
      def.radius.value = 0.001;
    else
      def.radius.field = field;
    assert_ok(msq_structure_foam(context, &def, &structure));
  } else if (kind == 8) {
    msq_host_structure_def def;
    assert_ok(msq_host_structure_def_init(&def, sizeof def));
    def.inside = host_outside;
    assert_ok(msq_structure_host(context, &def, &structure));
  } else {
    msq_host_function_def def;
    assert_ok(msq_host_function_def_init(&def, sizeof def));
    def.evaluate = host_values;
    def.clusters = 1;
    assert_ok(msq_structure_host_function(context, &def, &structure));
  }
  msq_field_release(field);
  return structure;
}

/* Through ten million cells, a thousand times. */
static void rays_through_all_kinds_stop(void** state) {
  (void)state;
  for (int kind = 0; kind < kinds; ++kind) {
    const double low[3] = {0, 0, 0}, high[3] = {1e7, 4, 4};
    msq_context* context = make_context();
    msq_shape* box;
    canceller other;
    msq_job* job = make_job();
    const msq_rays_def def = rays_of(many);
    assert_ok(msq_shape_from_box(context, low, high, &box));
    msq_model* model = make_model(context, box, make_thin(context, kind), NULL);
    for (int i = 0; i < many; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        origins[i][axis] = axis == 0 ? -1 : 1.5 + 1e-4 * i;
        directions[i][axis] = axis == 0;
      }
    start_cancelling(&other, job, 50);
    const msq_status status = msq_ray_cast(model, &def, NULL, hits, many, job);
    end_cancelling(&other);
    if (status != MSQ_E_CANCELLED)
      fail_msg("kind %d: %s, at t = %g", kind, msq_status_name(status), hits[0].t);
    msq_job_release(job);
    msq_model_release(model);
    msq_context_release(context);
  }
}

/* ---- extreme functions --------------------------------------------------------------------- */

/* No sample before a hit is inside, save in parts that may be lost. */
static void assert_agrees(const msq_model* model, const char* text, uint64_t count) {
  const double part = 4 * 0x1p-36;
  for (uint64_t i = 0; i < count; ++i) {
    const double* o = origins[i];
    const double* d = directions[i];
    for (int n = 0; n < 200; ++n) {
      const double t = (n + 0.5) * 0.02;
      int found = 1;
      if (t > hits[i].t - part) break;
      for (int step = -1; step <= 1; ++step) {
        const double at = t + step * part;
        found = found && is_inside(model, o[0] + at * d[0], o[1] + at * d[1], o[2] + at * d[2]);
      }
      if (found) fail_msg("%s: ray %d is inside at %g, before %g", text, (int)i, t, hits[i].t);
    }
  }
}

/* Thickness rises by 30 cells per cell. */
static void rays_through_steep_walls_end(void** state) {
  const double low[3] = {2, 0, 0}, high[3] = {2 + 0.5 / 30, 0, 0};
  const double zero[3] = {0, 0, 0}, four[3] = {4, 4, 4};
  (void)state;
  for (int density = 1; density <= 8; density += 7) {
    msq_context* context = make_context();
    msq_foam_def def;
    msq_structure* foam;
    msq_shape* box;
    msq_field* field;
    const msq_rays_def rays = rays_of(30);
    assert_ok(msq_field_gradient(context, low, 0.05, high, 0.55, &field));
    assert_ok(msq_foam_def_init(&def, sizeof def));
    def.wall_thickness.field = field;
    def.vent_radius.value = 0.1;
    def.density.value = density;
    assert_ok(msq_structure_foam(context, &def, &foam));
    msq_field_release(field);
    assert_ok(msq_shape_from_box(context, zero, four, &box));
    msq_model* model = make_model(context, box, foam, NULL);
    for (int i = 0; i < 30; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        origins[i][axis] = axis == 0 ? -1 : 0.1 + 0.13 * ((i * (axis + 6)) % 30);
        directions[i][axis] = axis == 0 ? 1 : 0.2 * ((i * axis) % 3 - 1);
      }
    assert_ok(msq_ray_cast(model, &rays, NULL, hits, 30, NULL));
    assert_agrees(model, "steep walls", 30);
    msq_model_release(model);
    msq_context_release(context);
  }
}

/* From points of the boundary that are inside: a hit within the tolerance is where they begin. */
static void rays_from_a_surface_start_inside(void** state) {
  const double zero[3] = {0, 0, 0}, four[3] = {4, 4, 4};
  (void)state;
  for (int kind = 0; kind < 2; ++kind) {
    msq_context* context = make_context();
    msq_foam_def def;
    msq_structure* structure;
    msq_shape* box;
    int count = 0, starts = 0;
    assert_ok(msq_foam_def_init(&def, sizeof def));
    def.radius.value = 0.1;
    if (kind == 0)
      assert_ok(msq_structure_foam(context, &def, &structure));
    else
      structure = make_lattice_of(context, MSQ_UNIT_CELL_BCC, 1, 0.1);
    assert_ok(msq_shape_from_box(context, zero, four, &box));
    msq_model* model = make_model(context, box, structure, NULL);
    for (int i = 0; i < many; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        origins[i][axis] = axis == 0 ? -1 : 0.1 + 0.0037 * ((i * (axis * 37 + 6)) % many);
        directions[i][axis] = axis == 0 ? 1 : 0.2 * ((i * axis) % 3 - 1);
      }
    const msq_rays_def rays = rays_of(many);
    assert_ok(msq_ray_cast(model, &rays, NULL, hits, many, NULL));
    for (int i = 0; i < many; ++i) {
      const double t = hits[i].t;
      double p[3], d[3];
      if (!(t < 100)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = origins[i][axis] + t * directions[i][axis];
        d[axis] = (i >> axis & 1 ? 1 : -1) * (0.2 + 0.1 * axis);
      }
      if (!is_inside(model, p[0], p[1], p[2])) continue;
      for (int axis = 0; axis < 3; ++axis) {
        origins[count][axis] = p[axis];
        directions[count][axis] = d[axis];
      }
      ++count;
    }
    const msq_rays_def from_there = rays_of((uint64_t)count);
    assert_ok(msq_ray_cast(model, &from_there, NULL, hits, (uint64_t)count, NULL));
    for (int i = 0; i < count; ++i) {
      starts += hits[i].starts_inside;
      if (hits[i].t < 1e-12 && !hits[i].starts_inside)
        fail_msg("kind %d: ray %d begins inside and is hit at %g", kind, i, hits[i].t);
    }
    assert_true(count > many / 4 && starts > count / 4);
    msq_model_release(model);
    msq_context_release(context);
  }
}

/* Between two boxes without their far faces, whose gap is narrower than the rays' tolerance. */
static void rays_in_a_narrow_gap_start_outside(void** state) {
  enum { corners = 8, faces = 5 };
  static const uint32_t sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  const double gap = 3e-11, ends[2][2] = {{0, 1}, {1 + gap, 2}};
  double vertices[2 * corners][3];
  uint32_t triangles[4 * faces][3];
  size_t count = 0;
  msq_mesh_def def;
  msq_shape* shape;
  (void)state;
  for (uint32_t box = 0; box < 2; ++box) {
    for (uint32_t corner = 0; corner < corners; ++corner) {
      vertices[box * corners + corner][0] = ends[box][corner & 1];
      vertices[box * corners + corner][1] = corner >> 1 & 1;
      vertices[box * corners + corner][2] = corner >> 2;
    }
    for (uint32_t side = 0; side < 6; ++side)
      for (uint32_t half = 0; side != box && half < 2; ++half, ++count) {
        triangles[count][0] = box * corners + sides[side][0];
        triangles[count][1] = box * corners + sides[side][1 + half];
        triangles[count][2] = box * corners + sides[side][2 + half];
      }
  }
  assert_int_equal(count, 4 * faces);
  msq_context* context = make_context();
  assert_ok(msq_mesh_def_init(&def, sizeof def));
  def.vertices = vertices[0];
  def.vertex_count = 2 * corners;
  def.triangles = triangles[0];
  def.triangle_count = count;
  assert_ok(msq_shape_from_mesh(context, &def, &shape));
  msq_model* model = make_model(context, shape, NULL, NULL);
  for (int i = 0; i < many; ++i) {
    origins[i][0] = 1 + gap * (0.01 + 0.98 * i / many);
    origins[i][1] = 0.3 + 0.0001 * i;
    origins[i][2] = 0.4;
    directions[i][0] = i % 2 ? 1 : -1;
    directions[i][1] = directions[i][2] = 0;
  }
  const msq_rays_def rays = rays_of(many);
  assert_ok(msq_ray_cast(model, &rays, NULL, hits, many, NULL));
  for (int i = 0; i < many; ++i) {
    assert_false(is_inside(model, origins[i][0], origins[i][1], origins[i][2]));
    if (hits[i].starts_inside || !(hits[i].t > 0 && hits[i].t < 1e-9))
      fail_msg("ray %d in the gap begins outside; starts_inside is %d, t %g", i,
               hits[i].starts_inside, hits[i].t);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void rays_through_huge_values_end(void** state) {
  static const char* const texts[] = {
      "exp(57*x)-2",      "x^200-2",           "1e154*sin(x)",  "1e154*sin(x)-1e153",
      "exp(57*sin(x))-3", "1e200*(x-3)*(y-3)", "1e-200*sin(x)", "exp(57*x)*sin(9*y)"};
  enum { few = 60 };
  (void)state;
  for (size_t n = 0; n < sizeof texts / sizeof texts[0]; ++n)
    for (int32_t kind = MSQ_FUNCTIONAL_NETWORK; kind <= MSQ_FUNCTIONAL_SHEET; ++kind)
      for (int is_far = 0; is_far < 2; ++is_far) {
        const double level = kind == MSQ_FUNCTIONAL_SHEET ? 1e153 : 1e-220;
        uint64_t random = 4;
        msq_context* context = make_context();
        msq_model* model = make_model(context, make_box_of(context, 0, 3),
                                      make_expression(context, texts[n], kind, level), NULL);
        msq_job* job = make_job();
        canceller other;
        const msq_rays_def def = rays_of(few);
        for (int i = 0; i < few; ++i) {
          double size = 0;
          for (int axis = 0; axis < 3; ++axis) {
            origins[i][axis] = random_between(&random, 0, 3);
            directions[i][axis] = is_far ? axis == i % 3 : random_between(&random, -1, 1);
            size += directions[i][axis] * directions[i][axis];
          }
          for (int axis = 0; axis < 3; ++axis) directions[i][axis] /= sqrt(size);
          if (is_far) origins[i][i % 3] = -1e30;
        }
        start_cancelling(&other, job, 5000);
        const msq_status status = msq_ray_cast(model, &def, NULL, hits, few, job);
        end_cancelling(&other);
        if (status != MSQ_E_CANCELLED) {
          assert_status(status, MSQ_OK);
          if (!is_far) assert_agrees(model, texts[n], few);
        }
        msq_job_release(job);
        msq_model_release(model);
        msq_context_release(context);
      }
}

/* ---- extreme rays --------------------------------------------------------------------------- */

/* Lengths of directions are powers of two, so that t is exact. */
static void directions_may_have_any_length(void** state) {
  static const int exponents[] = {-1021, -1000, -600, -300, -30, 0, 30, 300, 600, 1000, 1022};
  enum { few = 50, lengths = sizeof exponents / sizeof exponents[0] };
  msq_context* context = make_context();
  msq_model* model = make_lattice_model(context);
  msq_ray_hit wanted[few];
  const msq_rays_def def = rays_of(few);
  uint64_t random = 8;
  (void)state;
  for (int i = 0; i < few; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      origins[i][axis] = random_between(&random, -1, 5);
      /* of length 1 to 2, in 20 bits */
      directions[i][axis] = ldexp(floor(ldexp(random_between(&random, 0.6, 1.1), 20)), -20);
      if (origins[i][axis] > 2) directions[i][axis] *= -1;
    }
  assert_ok(msq_ray_cast(model, &def, NULL, wanted, few, NULL));
  int met = 0;
  for (int n = 0; n < lengths; ++n) {
    for (int i = 0; i < few; ++i)
      for (int axis = 0; axis < 3; ++axis)
        directions[i][axis] = ldexp(directions[i][axis], exponents[n]);
    assert_ok(msq_ray_cast(model, &def, NULL, hits, few, NULL));
    for (int i = 0; i < few; ++i) {
      assert_int_equal(hits[i].scale, wanted[i].scale);
      met += hits[i].scale >= 0;
      for (int axis = 0; axis < 3; ++axis)
        assert_true(hits[i].normal[axis] == wanted[i].normal[axis]);
      if (hits[i].scale < 0) {
        assert_true(hits[i].t == INFINITY);
        continue;
      }
      assert_true(isfinite(hits[i].t));
      assert_near(ldexp(hits[i].t, exponents[n]), wanted[i].t, 1e-14);
    }
    for (int i = 0; i < few; ++i)
      for (int axis = 0; axis < 3; ++axis)
        directions[i][axis] = ldexp(directions[i][axis], -exponents[n]);
  }
  assert_true(met > 10 * lengths);
  /* t_min and t_max that overflow along the direction. */
  {
    const double huge[2] = {1e300, 1e300}, none[2] = {-1e300, 0};
    msq_rays_def far = rays_of(2);
    for (int axis = 0; axis < 3; ++axis) {
      origins[0][axis] = origins[1][axis] = 2.1;
      directions[0][axis] = axis == 0 ? 1e300 : 0;
      directions[1][axis] = axis == 0 ? -1e-300 : 0;
    }
    far.t_max = huge;
    assert_ok(msq_ray_cast(model, &far, NULL, hits, 2, NULL));
    assert_true(hits[0].scale >= 0 && hits[1].scale >= 0 && isfinite(hits[1].t));
    far.t_min = huge;
    assert_ok(msq_ray_cast(model, &far, NULL, hits, 2, NULL));
    assert_true(hits[0].scale < 0);
    far.t_min = none;
    assert_ok(msq_ray_cast(model, &far, NULL, hits, 2, NULL));
    assert_true(hits[0].scale >= 0);
    /* A t that overflows: infinity means that nothing is hit. */
    origins[0][0] = 1000;
    directions[0][0] = -2.3e-308;
    far = rays_of(1);
    assert_ok(msq_ray_cast(model, &far, NULL, hits, 1, NULL));
    assert_true(hits[0].scale >= 0 && isfinite(hits[0].t));
  }
  msq_model_release(model);
  msq_context_release(context);
}

/* An orthographic camera sees the same from anywhere along its view. */
static void cameras_see_from_anywhere(void** state) {
  static const double away[] = {1e3, 1e6, 1e15, 1e30, 1e35, 1e40, 1e100};
  enum { side = 40 };
  (void)state;
  for (int is_lattice = 0; is_lattice < 2; ++is_lattice) {
    msq_context* context = make_context();
    msq_model* model =
        is_lattice ? make_lattice_model(context) : make_foam_model(context, MSQ_FOAM_DIRECT);
    const msq_render_def def = render_def(side, side);
    msq_camera camera = camera_at(MSQ_CAMERA_ORTHOGRAPHIC, 2, 2, 20);
    camera.target[0] = camera.target[1] = 2;
    camera.target[2] = 0;
    camera.up[0] = camera.up[2] = 0;
    camera.up[1] = 1;
    camera.height = 5;
    picture near = rendered(model, &camera, &def);
    for (size_t n = 0; n < sizeof away / sizeof away[0]; ++n) {
      camera.eye[2] = away[n];
      picture far = rendered(model, &camera, &def);
      int differ = 0, seen = 0;
      for (int i = 0; i < side * side; ++i) {
        differ += near.frame.scale[i] != far.frame.scale[i];
        seen += far.frame.scale[i] >= 0;
        for (int axis = 0; axis < 3; ++axis)
          differ += fabsf(near.frame.normal[3 * i + axis] - far.frame.normal[3 * i + axis]) > 1e-4f;
      }
      if (differ || seen < side) fail_msg("from %g: %d differ, %d seen", away[n], differ, seen);
      free_picture(&far);
      camera.projection = MSQ_CAMERA_PERSPECTIVE;
      far = rendered(model, &camera, &def);
      free_picture(&far);
      camera.projection = MSQ_CAMERA_ORTHOGRAPHIC;
    }
    free_picture(&near);
    msq_model_release(model);
    msq_context_release(context);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rays_through_all_kinds_stop),
      cmocka_unit_test(rays_through_steep_walls_end),
      cmocka_unit_test(rays_from_a_surface_start_inside),
      cmocka_unit_test(rays_in_a_narrow_gap_start_outside),
      cmocka_unit_test(rays_through_huge_values_end),
      cmocka_unit_test(directions_may_have_any_length),
      cmocka_unit_test(cameras_see_from_anywhere),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
