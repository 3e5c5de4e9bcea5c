/* SPDX-License-Identifier: Apache-2.0
 * What queries of points and sets refuse. */
#include "materials.h"
#include "wrong_values.h"

static msq_context* context;
static msq_model* plain;       /* a lattice in a box */
static msq_model *rich, *bare; /* materials at all scales; at the lattice alone */
static msq_model* mixed;       /* of both */

static int32_t no_points_inside(void* user, const msq_host_points* points, uint8_t* inside) {
  (void)user;
  memset(inside, 0, points->count);
  return 0;
}

static void points(void** state) {
  (void)state;
  REFUSALS("msq_point_membership") {
    const msq_model* model = plain;
    double at[3] = {1.5, 1.5, 1.5}, *point = at;
    msq_query_def* query = any_query(0);
    int32_t* inside = (int32_t*)output(0);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "point is NULL", point = NULL);
    WRONG(ARGUMENT, "inside is NULL", inside = NULL);
    wrong_point(table, at);
    wrong_query(table, query);
    RIGHT(query = NULL);
    TRY(msq_point_membership(model, point, query, inside));
  }
  REFUSALS("msq_point_distance") {
    const msq_model* model = plain;
    double at[3] = {1.5, 1.5, 1.5}, *point = at;
    msq_query_def* query = any_query(0);
    double* distance = (double*)output(0);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "point is NULL", point = NULL);
    WRONG(ARGUMENT, "distance is NULL", distance = NULL);
    wrong_point(table, at);
    wrong_query(table, query);
    RIGHT(query = NULL);
    TRY(msq_point_distance(model, point, query, distance));
  }
  REFUSALS("msq_point_region") {
    const msq_model* model = plain;
    double at[3] = {1.5, 1.5, 1.5}, *point = at;
    int32_t* region = (int32_t*)output(0);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "point is NULL", point = NULL);
    WRONG(ARGUMENT, "region is NULL", region = NULL);
    wrong_point(table, at);
    TRY(msq_point_region(model, point, region));
  }
  REFUSALS("msq_point_material") {
    const char* names[2] = {"modulus", "density"};
    const msq_model* model = rich;
    double at[3], *point = at;
    msq_query_def* query = any_query(0);
    const char* const* channels = names;
    uint64_t count = 2;
    uint32_t* id = (uint32_t*)output(0);
    double* values = (double*)output(1);
    memcpy(at, material_points[0], sizeof at);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "point is NULL", point = NULL);
    WRONG(ARGUMENT, "channels is NULL", channels = NULL);
    WRONG(ARGUMENT, "channel 1 is NULL", names[1] = NULL);
    WRONG(ARGUMENT, "colour", names[0] = "colour");
    WRONG(ARGUMENT, "257", count = 257);
    WRONG(ARGUMENT, "id is NULL", id = NULL);
    WRONG(ARGUMENT, "values is NULL", values = NULL);
    WRONG(ARGUMENT, "no resolved scale has a material", model = bare; query->length_scale = 2;
          count = 0);
    WRONG(ARGUMENT, "no resolved scale of region 1 has a material", model = mixed;
          query->length_scale = 2; count = 0);
    wrong_point(table, at);
    wrong_query(table, query);
    RIGHT(query = NULL);
    TRY(msq_point_material(model, point, query, channels, count, id, values));
  }
}

static void sets(void** state) {
  (void)state;
  REFUSALS("msq_set_membership") {
    const msq_model* model = plain;
    msq_points_def* points = some_points(0);
    msq_query_def* query = any_query(1);
    uint8_t* inside = (uint8_t*)output(0);
    uint64_t count = some_count;
    msq_job* job = NULL;
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "inside is NULL", inside = NULL);
    WRONG(ARGUMENT, "inside is NULL", set_grid(points); inside = NULL);
    WRONG(ARGUMENT, "inside begins 184 bytes after coordinates|192 bytes|overlap",
          inside = (uint8_t*)of_some_points(points, 184));
    WRONG(ARGUMENT, "inside_count is 7|8", count = 7);
    WRONG(ARGUMENT, "inside_count is 9|8", count = 9);
    WRONG(ARGUMENT, "inside_count is 4|8", set_grid(points); count = 4);
    WRONG(ARGUMENT, "inside_count is 1", points->count = 0; count = 1);
    WRONG(LIMIT, "24|9223372036854775807", points->count = count = UINT64_MAX / 2);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(points->count = count = 0; inside = NULL);
    wrong_points(table, points);
    wrong_query(table, query);
    WRONG(ARGUMENT, "points is NULL", points = NULL);
    RIGHT(query = NULL);
    TRY(msq_set_membership(model, points, query, inside, count, job));
  }
  REFUSALS("msq_set_distance") {
    const msq_model* model = plain;
    msq_points_def* points = some_points(0);
    msq_query_def* query = any_query(1);
    double* distance = (double*)output(0);
    uint64_t count = some_count;
    msq_job* job = NULL;
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "distance is NULL", distance = NULL);
    WRONG(ARGUMENT, "distance is NULL", set_grid(points); distance = NULL);
    WRONG(ARGUMENT, "distance begins 0 bytes after coordinates|192 bytes|overlap",
          distance = (double*)of_some_points(points, 0));
    WRONG(ARGUMENT, "distance_count is 7|8", count = 7);
    WRONG(ARGUMENT, "distance_count is 9|8", count = 9);
    WRONG(ARGUMENT, "distance_count is 4|8", set_grid(points); count = 4);
    WRONG(LIMIT, "24", points->count = count = UINT64_MAX / 2);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(points->count = count = 0; distance = NULL);
    wrong_points(table, points);
    wrong_query(table, query);
    WRONG(ARGUMENT, "points is NULL", points = NULL);
    RIGHT(query = NULL);
    TRY(msq_set_distance(model, points, query, distance, count, job));
  }
  REFUSALS("msq_set_region") {
    const msq_model* model = plain;
    msq_points_def* points = some_points(0);
    int32_t* regions = (int32_t*)output(0);
    uint64_t count = some_count;
    msq_job* job = NULL;
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "regions is NULL", regions = NULL);
    WRONG(ARGUMENT, "region_count is 7", count = 7);
    WRONG(ARGUMENT, "region_count is 9", set_grid(points); count = 9);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(points->count = count = 0; regions = NULL);
    wrong_points(table, points);
    WRONG(ARGUMENT, "points is NULL", points = NULL);
    TRY(msq_set_region(model, points, regions, count, job));
  }
  REFUSALS("msq_set_material") {
    const char* names[2] = {"modulus", "density"};
    const msq_model* model = rich;
    msq_points_def* points = some_points(0);
    msq_query_def* query = any_query(1);
    const char* const* channels = names;
    uint64_t channel_count = 2, id_count = some_count, value_count = 2 * some_count;
    uint32_t* ids = (uint32_t*)output(0);
    double* values = (double*)output(1);
    msq_job* job = NULL;
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "channels is NULL", channels = NULL);
    WRONG(ARGUMENT, "channel 0 is NULL", names[0] = NULL);
    WRONG(ARGUMENT, "colour", names[1] = "colour");
    WRONG(ARGUMENT, "257", channel_count = 257);
    WRONG(ARGUMENT, "ids begins 0 bytes after coordinates",
          ids = (uint32_t*)of_some_points(points, 0));
    WRONG(ARGUMENT, "values begins 64 bytes after coordinates",
          values = (double*)of_some_points(points, 64));
    WRONG(ARGUMENT, "ids is NULL", ids = NULL);
    WRONG(ARGUMENT, "values is NULL", values = NULL);
    WRONG(ARGUMENT, "id_count is 7", id_count = 7; value_count = 14);
    WRONG(ARGUMENT, "value_count is 15", value_count = 15);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    wrong_points(table, points);
    wrong_query(table, query);
    WRONG(ARGUMENT, "points is NULL", points = NULL);
    RIGHT(query = NULL);
    TRY(msq_set_material(model, points, query, channels, channel_count, ids, id_count, values,
                         value_count, job));
  }
}

static void onsets(void** state) {
  msq_structure *lattice = make_lattice(context), *host, *joined, *common, *partly;
  msq_host_structure_def def;
  (void)state;
  assert_ok(msq_host_structure_def_init(&def, sizeof def));
  def.inside = no_points_inside;
  assert_ok(msq_structure_host(context, &def, &host));
  const msq_structure *both[2] = {lattice, lattice}, *one[2] = {lattice, host};
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, both, 2, &joined));
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_DIFFERENCE, both, 2, &common));
  assert_ok(msq_structure_boolean(MSQ_BOOLEAN_UNION, one, 2, &partly));
  REFUSALS("msq_set_onset") {
    static double odd[some_count][3];
    msq_context* in = context;
    const msq_structure* structure = lattice;
    msq_points_def* points = some_points(0);
    int32_t value = 0;
    double *onsets = (double*)output(0), *gradients = (double*)output(1);
    uint64_t count = some_count, gradient_count = 3 * some_count;
    msq_job* job = NULL;
    memcpy(odd, points->coordinates, sizeof odd);
    WRONG(ARGUMENT, "context", in = NULL);
    WRONG(ARGUMENT, "structure", structure = NULL);
    wrong_enum(table, &value, "value", 0, 1);
    WRONG(ARGUMENT, "onsets begins 0 bytes after coordinates",
          onsets = (double*)of_some_points(points, 0));
    WRONG(ARGUMENT, "gradients begins 128 bytes before coordinates|192 bytes",
          points->coordinates = (unsigned char*)gradients + 128);
    WRONG(ARGUMENT, "onsets", onsets = NULL);
    WRONG(ARGUMENT, "onset_count is 7", count = 7);
    WRONG(ARGUMENT, "onset_count is 9", count = 9);
    WRONG(ARGUMENT, "gradient_count is 8", gradient_count = 8);
    WRONG(ARGUMENT, "gradient_count is 24", gradients = NULL);
    WRONG(UNSUPPORTED, "onset", structure = host);
    RIGHT(structure = joined);
    WRONG(UNSUPPORTED, "no onset|members all have struts", structure = common);
    WRONG(UNSUPPORTED, "no onset|members all have struts", structure = partly);
    WRONG(LIMIT, "cells of the structure", set_grid(points); points->origin[2] = 16777215.5);
    WRONG(LIMIT, "point 1", odd[1][1] = -2e7; points->coordinates = odd);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    RIGHT(gradients = NULL; gradient_count = 0);
    RIGHT(points->count = count = gradient_count = 0; onsets = gradients = NULL);
    wrong_points(table, points);
    WRONG(ARGUMENT, "points", points = NULL);
    TRY(msq_set_onset(in, structure, points, value, onsets, count, gradients, gradient_count, job));
  }
  msq_structure_release(partly);
  msq_structure_release(common);
  msq_structure_release(joined);
  msq_structure_release(host);
  msq_structure_release(lattice);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(points),
      cmocka_unit_test(sets),
      cmocka_unit_test(onsets),
  };
  context = make_context();
  plain = make_lattice_model(context);
  rich = make_material_model(context, 1, 1, 1);
  bare = make_material_model(context, 0, 1, 0);
  assert_ok(msq_model_regions(context, (const msq_model*[]){rich, bare}, 2, &mixed));
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_model_release(plain);
  msq_model_release(rich);
  msq_model_release(bare);
  msq_model_release(mixed);
  msq_context_release(context);
  return failed;
}
