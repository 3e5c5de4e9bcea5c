/* SPDX-License-Identifier: Apache-2.0
 * msq_model_regions, msq_point_region and msq_set_region. */
#include "materials.h"

/* A ball filled with a lattice in a solid box; the box is the later region. */
static msq_model* make_plate(msq_context* context, msq_model* parts[2]) {
  const double center[3] = {2, 2, 4};
  msq_shape* ball;
  msq_model* model;
  assert_ok(msq_shape_from_sphere(context, center, 1.5, &ball));
  parts[0] = make_model(context, ball, make_lattice(context), NULL);
  parts[1] = make_box_model(context);
  assert_ok(msq_model_regions(context, (const msq_model* const*)parts, 2, &model));
  return model;
}

static int region_at(const msq_model* model, double x, double y, double z) {
  const double point[3] = {x, y, z};
  int32_t region = 7;
  assert_ok(msq_point_region(model, point, &region));
  return region;
}

static void first_region_decides(void** state) {
  msq_context* context = make_context();
  msq_model *parts[2], *model = make_plate(context, parts);
  static double points[4096][3];
  static int32_t regions[4096];
  uint64_t random = 1;
  size_t of[3] = {0}, held = 0;
  msq_points_def def;
  msq_job* job;
  double min[3], max[3], length;
  (void)state;
  assert_ok(msq_model_bounds(model, min, max));
  assert_true(max[2] == 5.5 && min[2] == 0);
  assert_ok(msq_model_scale_length(model, 1, &length));
  double of_part;
  assert_ok(msq_model_scale_length(parts[0], 1, &of_part));
  assert_true(length == of_part);
  for (int i = 0; i < 4096; ++i)
    for (int a = 0; a < 3; ++a) points[i][a] = random_between(&random, -0.5, 5.75);
  assert_ok(msq_points_def_init(&def, sizeof def));
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinates = points;
  def.count = 4096;
  assert_ok(msq_job_create(&job));
  assert_ok(msq_set_region(model, &def, regions, 4096, job));
  assert_true(progress_of(job) == 1);
  for (int i = 0; i < 4096; ++i) {
    const double* p = points[i];
    const double d[3] = {p[0] - 2, p[1] - 2, p[2] - 4};
    const int is_in_ball = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= 2.25;
    const int is_in_box = fmax(fmax(p[0], p[1]), p[2]) <= 4 && fmin(fmin(p[0], p[1]), p[2]) >= 0;
    const int wanted = is_in_ball ? 0 : is_in_box ? 1 : -1;
    assert_int_equal(regions[i], wanted);
    assert_int_equal(region_at(model, p[0], p[1], p[2]), wanted);
    const int inside = is_inside(model, p[0], p[1], p[2]);
    assert_int_equal(inside, wanted >= 0 ? is_inside(parts[wanted], p[0], p[1], p[2]) : 0);
    ++of[wanted + 1];
    held += (size_t)inside;
  }
  assert_true(of[0] > 100 && of[1] > 100 && of[2] > 100 && held > 100);
  /* A model that is not made of regions is region 0. */
  assert_int_equal(region_at(parts[1], 1, 1, 1), 0);
  assert_int_equal(region_at(parts[1], 1, 1, 5), -1);
  assert_ok(msq_job_cancel(job));
  assert_refused(msq_set_region(model, &def, regions, 4096, job), MSQ_E_CANCELLED, "cancelled");
  msq_job_release(job);
  msq_model_release(parts[0]); /* the model keeps them */
  msq_model_release(parts[1]);
  assert_int_equal(is_inside(model, 0.5, 0.5, 0.5), 1);
  msq_model_release(model);
  msq_context_release(context);
}

/* A ray from above through the ball into the box below. */
static void rays_name_the_scale_of_the_region(void** state) {
  msq_context* context = make_context();
  msq_model *parts[2], *model = make_plate(context, parts);
  const double origins[2][3] = {{2.3, 2.2, 9}, {0.25, 0.25, 9}};
  const double directions[2][3] = {{0, 0, -1}, {0, 0, -2}};
  msq_rays_def def;
  msq_ray_hit hits[2];
  (void)state;
  assert_ok(msq_rays_def_init(&def, sizeof def));
  def.count = 2;
  def.origins = origins;
  def.directions = directions;
  assert_ok(msq_ray_cast(model, &def, NULL, hits, 2, NULL));
  assert_in_range(hits[0].scale, 0, 1);
  assert_near(hits[1].t, 2.5, 1e-9);
  assert_int_equal(hits[1].scale, 0);
  assert_near(hits[1].normal[2], 1, 1e-12);
  assert_true(hits[0].t > 3.49 && hits[0].t <= 6.5);
  for (int i = 0; i < 2; ++i) msq_model_release(parts[i]);
  msq_model_release(model);
  msq_context_release(context);
}

static void every_region_needs_a_material(void** state) {
  msq_context* context = make_context();
  msq_model* const with = make_material_model(context, 1, 1, 1);
  msq_model* const without = make_box_model(context);
  const msq_model* const both[2] = {with, without};
  const double point[3] = {1, 1, 1};
  msq_model* model;
  uint32_t id = 77;
  (void)state;
  assert_ok(msq_model_regions(context, both, 2, &model));
  assert_refused(msq_point_material(model, point, NULL, NULL, 0, &id, NULL), MSQ_E_ARGUMENT,
                 "material");
  assert_int_equal(id, 77);
  msq_model_release(model);
  assert_ok(msq_model_regions(context, both, 1, &model));
  assert_ok(msq_point_material(model, point, NULL, NULL, 0, &id, NULL));
  msq_model_release(model);
  msq_model_release(with);
  msq_model_release(without);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(first_region_decides),
      cmocka_unit_test(rays_name_the_scale_of_the_region),
      cmocka_unit_test(every_region_needs_a_material),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
