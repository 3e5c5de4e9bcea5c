/* SPDX-License-Identifier: Apache-2.0
 * msq_model_def_init, msq_model_create, msq_model_retain, msq_model_release. */
#include "definitions.h"

typedef struct parts {
  msq_context* context;
  msq_shape* shape;
  msq_structure* structure;
} parts;

static parts make_parts(void) {
  parts p;
  p.context = make_context();
  p.shape = make_box(p.context);
  p.structure = make_lattice(p.context);
  return p;
}

static void release_parts(parts* p) {
  msq_structure_release(p->structure);
  msq_shape_release(p->shape);
  msq_context_release(p->context);
}

static msq_model_def model_def(const msq_scale_def* scales, uint32_t count) {
  msq_model_def def;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = count;
  return def;
}

DEFINE_CREATE(model, model_create, model_def)

static void defaults_are_those_of_the_header(void** state) {
  msq_model_def def;
  (void)state;
  assert_ok(msq_model_def_init(&def, sizeof def));
  assert_int_equal(def.scale_count, 0);
  assert_int_equal(def.scale_size, 0);
  assert_null(def.scales);
  assert_int_equal(def.reserved, 0);
}

static void model_is_the_intersection_of_its_scales(void** state) {
  const double points[4][3] = {{0.5, 0.5, 0.5}, {0.5, 0, 0.5}, {4.5, 4.5, 4.5}, {0.95, 0.95, 0.95}};
  const int in_shape[] = {1, 1, 0, 1}, in_both[] = {1, 0, 0, 1};
  msq_context* context = make_context();
  msq_model *box = make_box_model(context), *lattice = make_lattice_model(context);
  (void)state;
  for (int i = 0; i < 4; ++i) {
    const double* p = points[i];
    assert_int_equal(is_inside(box, p[0], p[1], p[2]), in_shape[i]);
    assert_int_equal(is_inside(lattice, p[0], p[1], p[2]), in_both[i]);
  }
  msq_model_release(box);
  msq_model_release(lattice);
  msq_context_release(context);
}

static void model_keeps_its_parts_alive(void** state) {
  parts p = make_parts();
  const msq_scale_def scales[2] = {{.shape = p.shape}, {.structure = p.structure}};
  const msq_model_def def = model_def(scales, 2);
  msq_model* model;
  (void)state;
  assert_ok(msq_model_create(p.context, &def, &model));
  msq_context_release(p.context);
  msq_shape_release(p.shape);
  msq_structure_release(p.structure);
  assert_int_equal(is_inside(model, 0.5, 0.5, 0.5), 1);
  msq_model_retain(model);
  msq_model_release(model);
  assert_int_equal(is_inside(model, 0.5, 0, 0.5), 0);
  msq_model_release(model);
}

static void release_of_null_does_nothing(void** state) {
  (void)state;
  msq_model_release(NULL);
  msq_model_retain(NULL);
}

typedef struct later_scale { /* of a host that is newer than the library */
  msq_scale_def known;
  uint64_t added;
} later_scale;

static void scales_of_a_newer_host_must_be_zero_in_the_rest(void** state) {
  parts p = make_parts();
  later_scale scales[2] = {{{.shape = p.shape}, 0}, {{.structure = p.structure}, 0}};
  msq_model_def def = model_def(&scales[0].known, 2);
  (void)state;
  def.scale_size = sizeof(later_scale);
  assert_ok(create(p.context, &def));
  scales[1].added = (uint64_t)1 << 63;
  assert_refused(create(p.context, &def), MSQ_E_ARGUMENT, "scale 1");
  release_parts(&p);
}

static void scale_size_of_0_is_that_of_version_0_1(void** state) {
  parts p = make_parts();
  const msq_scale_def scales[2] = {{.shape = p.shape}, {.structure = p.structure}};
  msq_model_def def = model_def(scales, 2);
  (void)state;
  def.scale_size = 0;
  assert_ok(create(p.context, &def));
  release_parts(&p);
}

static void scales_of_an_older_host_have_no_skin(void** state) {
  parts p = make_parts();
  const void* scales[4] = {p.shape, NULL, NULL, p.structure};
  msq_model_def def = model_def((const msq_scale_def*)scales, 2);
  (void)state;
  def.scale_size = 2 * sizeof(void*);
  assert_ok(create(p.context, &def));
  release_parts(&p);
}

static void skin_is_solid_under_the_surface(void** state) {
  parts p = make_parts();
  const double bottom[3] = {0, 0, 0}, top[3] = {0, 0, 4};
  msq_scale_def scales[2] = {{.shape = p.shape}, {.structure = p.structure}};
  msq_model_def def = model_def(scales, 2);
  msq_model* model;
  msq_field* field;
  (void)state;
  def.scale_size = sizeof scales[0];
  scales[1].skin.value = 0.25;
  assert_ok(msq_model_create(p.context, &def, &model));
  assert_int_equal(is_inside(model, 0.2, 1.5, 2), 1);
  assert_int_equal(is_inside(model, 0.25, 1.5, 2), 1);
  assert_int_equal(is_inside(model, 0.25 + 1e-12, 1.5, 2), 0);
  assert_int_equal(is_inside(model, 2.5, 2.5, 2.5), 1); /* a strut */
  assert_int_equal(is_inside(model, -1e-9, 1.5, 2), 0);
  msq_model_release(model);
  /* From 0 at the bottom to 1 at the top. */
  assert_ok(msq_field_gradient(p.context, bottom, 0, top, 1, &field));
  scales[1].skin.field = field;
  assert_ok(msq_model_create(p.context, &def, &model));
  msq_field_release(field);
  assert_int_equal(is_inside(model, 0, 1.5, 0), 0);
  assert_int_equal(is_inside(model, 0.49, 1.5, 2), 1);
  assert_int_equal(is_inside(model, 0.51, 1.5, 2), 0);
  msq_model_release(model);
  release_parts(&p);
}

static int32_t everywhere(void* user, const double* points, uint64_t count, uint8_t* inside) {
  (void)user;
  (void)points;
  memset(inside, 1, count);
  return 0;
}

/* The distance to the boundary that voxels and hosts know is a bound, and tells no depth. */
static void shapes_without_depths_have_no_skin(void** state) {
  static const double center[3] = {2, 2, 2}, top[3] = {2, 2, 4};
  static const uint8_t values[8] = {0, 1, 1, 1, 1, 1, 1, 1};
  parts p = make_parts();
  msq_shape* shapes[6];
  msq_voxels_def voxels;
  msq_host_shape_def host;
  (void)state;
  shapes[0] = make_box(p.context);
  assert_ok(msq_shape_from_sphere(p.context, center, 1, &shapes[1]));
  assert_ok(msq_shape_from_cylinder(p.context, center, top, 1, &shapes[2]));
  shapes[3] = make_cube_mesh(p.context);
  assert_ok(msq_voxels_def_init(&voxels, sizeof voxels));
  voxels.image.values = values;
  voxels.image.value_type = MSQ_UINT8;
  voxels.threshold = 0.5;
  for (int axis = 0; axis < 3; ++axis) voxels.image.size[axis] = 2;
  assert_ok(msq_shape_from_voxels(p.context, &voxels, &shapes[4]));
  assert_ok(msq_host_shape_def_init(&host, sizeof host));
  host.inside = everywhere;
  for (int axis = 0; axis < 3; ++axis) {
    host.min[axis] = 0;
    host.max[axis] = 4;
  }
  assert_ok(msq_shape_from_host(p.context, &host, &shapes[5]));
  for (int i = 0; i < 6; ++i) {
    msq_scale_def scales[2] = {{.shape = shapes[i]}, {.structure = p.structure}};
    msq_model_def def = model_def(scales, 2);
    assert_ok(create(p.context, &def));
    scales[1].skin.value = 0.25;
    if (i < 4)
      assert_ok(create(p.context, &def));
    else
      assert_refused(create(p.context, &def), MSQ_E_UNSUPPORTED,
                     "scale 1 is to leave a skin in a shape whose depth is not known");
    msq_shape_release(shapes[i]);
  }
  release_parts(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(defaults_are_those_of_the_header),
      cmocka_unit_test(model_is_the_intersection_of_its_scales),
      cmocka_unit_test(model_keeps_its_parts_alive),
      cmocka_unit_test(release_of_null_does_nothing),
      cmocka_unit_test(scales_of_a_newer_host_must_be_zero_in_the_rest),
      cmocka_unit_test(scale_size_of_0_is_that_of_version_0_1),
      cmocka_unit_test(scales_of_an_older_host_have_no_skin),
      cmocka_unit_test(skin_is_solid_under_the_surface),
      cmocka_unit_test(shapes_without_depths_have_no_skin),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
