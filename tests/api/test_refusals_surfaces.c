/* SPDX-License-Identifier: Apache-2.0
 * What preview meshes refuse. */
#include "surfaces.h"
#include "wrong_values.h"

static msq_context* context;
static msq_model *plain, *plain_of_small, *everywhere; /* a lattice in a box; without bounds */

static msq_surface_def* any_surface(void) {
  msq_surface_def* def = (msq_surface_def*)definition(0);
  assert_ok(msq_surface_def_init(def, sizeof *def));
  def->pitch = 0.5;
  return def;
}

static void set_box(msq_surface_def* def) {
  def->has_box = 1;
  for (int axis = 0; axis < 3; ++axis) {
    def->min[axis] = 1;
    def->max[axis] = 2;
  }
}

static void wrong_surface(refusals* table, msq_surface_def* def, const msq_model** model,
                          msq_job** job) {
  wrong_sizes(table, def, sizeof *def, sizeof *def);
  WRONG(ARGUMENT, "model is NULL", *model = NULL);
  wrong_enum(table, &def->has_box, "has_box", 0, 1);
  RIGHT(set_box(def));
  for (int axis = 0; axis < 3; ++axis) {
    WRONG(ARGUMENT, "has_box is 0", def->min[axis] = -1);
    WRONG(ARGUMENT, "has_box is 0", def->max[axis] = 2);
    WRONG(ARGUMENT, words_of("min is 2 and max is 2 along axis %d", axis), set_box(def);
          def->min[axis] = 2);
    for (int which = 0; which < 3; ++which) {
      WRONG(ARGUMENT, "min is (|finite", set_box(def); def->min[axis] = not_finite(which));
      WRONG(ARGUMENT, "max is (|finite", set_box(def); def->max[axis] = not_finite(which));
    }
  }
  WRONG(ARGUMENT, "pitch is 0", def->pitch = 0);
  WRONG(ARGUMENT, "pitch is -1", def->pitch = -1);
  wrong_number(table, &def->pitch, "pitch is ");
  WRONG(ARGUMENT, "length_scale is -2", def->length_scale = -2);
  WRONG(ARGUMENT, "length_scale is nan; it must be 0 or more", def->length_scale = NAN);
  WRONG(ARGUMENT, "reserved is 9", def->reserved = 9);
  RIGHT(def->slab_layers = UINT32_MAX);
  WRONG(LIMIT, "the limit is 2147483392", def->pitch = 1e-9);
  WRONG(LIMIT, "memory_limit", *model = plain_of_small);
  WRONG(ARGUMENT, "all space|box", *model = everywhere);
  WRONG(LIMIT, "box", *model = everywhere; set_box(def); def->max[1] = 1e300; def->pitch = 1e299);
  WRONG(CANCELLED, "cancelled", *job = cancelled_job());
}

static void meshes(void** state) {
  (void)state;
  REFUSALS("msq_surface_mesh") {
    const msq_model* model = plain;
    msq_surface_def* def = any_surface();
    msq_surface_fn fn = take_surface;
    msq_job* job = NULL;
    surface all;
    memset(&all, 0, sizeof all);
    wrong_surface(table, def, &model, &job);
    WRONG(ARGUMENT, "fn is NULL", fn = NULL);
    WRONG(HOST, "returned -5", all.stop_with = -5);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    TRY(msq_surface_mesh(model, def, fn, &all, job));
    free_surface(&all);
  }
  REFUSALS("msq_surface_mesh") { /* too few digits */
    const double min[3] = {1e8, 0, 0}, max[3] = {1e8 + 16, 4, 4};
    msq_surface_def* def = any_surface();
    msq_shape* box;
    surface all;
    memset(&all, 0, sizeof all);
    assert_ok(msq_shape_from_box(context, min, max, &box));
    msq_model* far = make_shape_model(context, box);
    WRONG(ARGUMENT, "a pitch of 0.05 along x|too small at 1e+08", def->pitch = 0.05);
    TRY(msq_surface_mesh(far, def, take_surface, &all, NULL));
    free_surface(&all);
    msq_model_release(far);
  }
}

static void files(void** state) {
  (void)state;
  REFUSALS("msq_surface_file") {
    const msq_model* model = plain;
    msq_surface_def* def = any_surface();
    int32_t format = MSQ_SURFACE_PLY;
    msq_file_fn fn = take_file;
    msq_job* job = NULL;
    file_bytes file;
    memset(&file, 0, sizeof file);
    wrong_surface(table, def, &model, &job);
    wrong_enum(table, &format, "format", MSQ_SURFACE_STL, MSQ_SURFACE_PLY);
    WRONG(ARGUMENT, "fn is NULL", fn = NULL);
    WRONG(HOST, "returned 3", file.stop_with = 3);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    TRY(msq_surface_file(model, def, format, fn, &file, job));
    free(file.bytes);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(meshes),
      cmocka_unit_test(files),
  };
  msq_shape* all;
  msq_context* small = make_context_of(1, 0, 1000);
  context = make_context();
  plain = make_lattice_model(context);
  plain_of_small = make_lattice_model(small);
  assert_ok(msq_shape_all_space(context, &all));
  everywhere = make_model(context, all, make_lattice(context), NULL);
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_model_release(everywhere);
  msq_model_release(plain_of_small);
  msq_model_release(plain);
  msq_context_release(small);
  msq_context_release(context);
  return failed;
}
