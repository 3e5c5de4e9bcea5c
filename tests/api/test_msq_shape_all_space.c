/* SPDX-License-Identifier: Apache-2.0
 * msq_shape_all_space, and what differs in queries of such models. tests/contract/
 * test_all_space.cpp compares the answers for all structures. */
#include "cameras.h"
#include "layers.h"

static msq_context* context;
static msq_model *all, *boxed; /* a BCC lattice of cells of 1; in the second from -500 to 500 */

static msq_shape* make_all_space(void) {
  msq_shape* shape;
  assert_ok(msq_shape_all_space(context, &shape));
  return shape;
}

static int set_up(void** state) {
  (void)state;
  context = make_context();
  all = make_model(context, make_all_space(), make_lattice(context), NULL);
  boxed = make_model(context, make_box_of(context, -500, 500), make_lattice(context), NULL);
  return 0;
}

static int tear_down(void** state) {
  (void)state;
  msq_model_release(boxed);
  msq_model_release(all);
  msq_context_release(context);
  return 0;
}

static void it_has_no_bounds(void** state) {
  double min[3], max[3];
  msq_shape* shape = make_all_space();
  const msq_shape_report info = info_of(shape);
  (void)state;
  assert_ok(msq_model_bounds(all, min, max));
  for (int axis = 0; axis < 3; ++axis) {
    assert_true(min[axis] == -INFINITY && max[axis] == INFINITY);
    assert_true(info.min[axis] == -INFINITY && info.max[axis] == INFINITY);
  }
  assert_true(info.volume == INFINITY && info.area == 0 && !info.is_mesh);
  msq_shape_release(shape);
  assert_refused(msq_shape_all_space(context, NULL), MSQ_E_ARGUMENT, "shape is NULL");
  assert_makes_nothing(msq_shape, msq_shape_all_space(NULL, &made), MSQ_E_ARGUMENT,
                       "context is NULL");
}

static void everything_is_inside_without_structures(void** state) {
  msq_model* model = make_model(context, make_all_space(), NULL, NULL);
  const double point[3] = {1e70, -3, 0}, direction[3] = {0, 0, 2}, t_min = -1, t_max = 4;
  double distance;
  msq_ray_hit hit;
  msq_rays_def rays;
  (void)state;
  assert_int_equal(is_inside(model, 1e70, -3, 0), 1);
  assert_ok(msq_point_distance(model, point, NULL, &distance));
  assert_true(distance < -1e308 && isfinite(distance));
  assert_ok(msq_rays_def_init(&rays, sizeof rays));
  rays.count = 1;
  rays.origins = point;
  rays.directions = direction;
  rays.t_min = &t_min;
  rays.t_max = &t_max;
  assert_ok(msq_ray_cast(model, &rays, NULL, &hit, 1, NULL));
  assert_int_equal(hit.starts_inside, 1);
  assert_int_equal(hit.scale, 0);
  assert_true(hit.t == -1);
  msq_model_release(model);
}

/* Cells have numbers up to 2^24; that far the model answers, whichever query asks. */
static void each_query_checks_the_cells(void** state) {
  const double most = 16777216;
  const double good[3] = {most - 1.25, 0.5, -most + 1.25}, bad[3] = {0.5, -most - 1, 0};
  const double two[6] = {0, 0, 0, 0.5, -most - 1, 0};
  msq_points_def points = grid_points(0, 4, 5);
  msq_query_def coarse;
  uint8_t inside[125];
  double distance[125];
  int32_t one = 7;
  (void)state;
  (void)is_inside(all, good[0], good[1], good[2]);
  assert_refused(msq_point_membership(all, bad, NULL, &one), MSQ_E_LIMIT, "1.67772e+07");
  assert_message_has("scale 1");
  assert_refused(msq_point_distance(all, bad, NULL, distance), MSQ_E_LIMIT, "1.67772e+07");
  assert_int_equal(one, 7);
  /* Scales that are not resolved have no limit; coordinates do. */
  assert_ok(msq_query_def_init(&coarse, sizeof coarse));
  coarse.length_scale = 2;
  assert_ok(msq_point_membership(all, bad, &coarse, &one));
  assert_int_equal(one, 1);
  const double beyond[3] = {0, 2e75, 0};
  assert_refused(msq_point_membership(all, beyond, &coarse, &one), MSQ_E_LIMIT, "2e+75");
  assert_message_has("1e+75");

  /* Sets: the first point that is too far, or the whole grid or sample. */
  msq_points_def array;
  assert_ok(msq_points_def_init(&array, sizeof array));
  array.kind = MSQ_POINTS_ARRAY;
  array.coordinates = two;
  array.count = 2;
  memset(inside, 7, sizeof inside);
  assert_refused(msq_set_membership(all, &array, NULL, inside, 2, NULL), MSQ_E_LIMIT, "point 1");
  points.origin[1] = most - 3.5;
  points.window.first[1] = 1;
  for (int axis = 0; axis < 3; ++axis) points.window.count[axis] = axis == 1 ? 2 : 5;
  assert_ok(msq_set_membership(all, &points, NULL, inside, 50, NULL));
  memset(inside, 7, sizeof inside);
  points.window.count[1] = 3;
  assert_ok(msq_set_membership(all, &points, NULL, inside, 75, NULL));
  memset(&points.window, 0, sizeof points.window);
  memset(inside, 7, sizeof inside);
  assert_refused(msq_set_membership(all, &points, NULL, inside, 125, NULL), MSQ_E_LIMIT,
                 "the set of points");
  assert_refused(msq_set_distance(all, &points, NULL, distance, 125, NULL), MSQ_E_LIMIT, "axis 1");
  assert_filled(inside, sizeof inside, 7);

  /* In a box all that far away is outside. */
  const double inside_of_box[3] = {most, 0, 0};
  assert_ok(msq_point_membership(boxed, inside_of_box, NULL, &one));
  assert_int_equal(one, 0);
}

static void statistics_measure_the_sample(void** state) {
  const double lengths[2] = {0, 0.5}, far[1] = {2e7};
  msq_points_def sample;
  msq_segments_def def;
  msq_estimate a[2], b[2];
  (void)state;
  assert_ok(msq_points_def_init(&sample, sizeof sample));
  sample.kind = MSQ_POINTS_STRATIFIED;
  sample.per_cell = 4;
  for (int axis = 0; axis < 3; ++axis) {
    sample.spacing[axis] = 0.25;
    sample.counts[axis] = 8;
  }
  assert_ok(msq_volume_fraction(all, &sample, NULL, MSQ_PHASE_SOLID, a, NULL));
  assert_ok(msq_volume_fraction(boxed, &sample, NULL, MSQ_PHASE_SOLID, b, NULL));
  assert_memory_equal(a, b, sizeof a[0]);
  assert_true(a[0].value > 0.1);
  assert_ok(msq_segments_def_init(&def, sizeof def));
  def.lengths = lengths;
  def.length_count = 2;
  assert_ok(msq_lineal_path(all, &sample, NULL, &def, a, 2, NULL));
  assert_ok(msq_lineal_path(boxed, &sample, NULL, &def, b, 2, NULL));
  assert_memory_equal(a, b, sizeof a);
  assert_ok(msq_two_point_correlation(all, &sample, NULL, &def, a, 2, NULL));
  def.lengths = far;
  def.length_count = 1;
  assert_refused(msq_two_point_correlation(all, &sample, NULL, &def, a, 1, NULL), MSQ_E_LIMIT,
                 "the set of points");
}

static void slicers_need_a_region(void** state) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_BITS, 40, 40, 0.5);
  (void)state;
  assert_makes_nothing(msq_slicer, msq_slicer_create(all, &def, &made), MSQ_E_ARGUMENT, "region");
  def.has_region = 1;
  for (int axis = 0; axis < 3; ++axis) def.region_max[axis] = 4;
  msq_slicer *a = make_slicer(all, &def), *b = make_slicer(boxed, &def);
  layer_stack of_all = run_all(a, MSQ_LAYER_BITS), of_box = run_all(b, MSQ_LAYER_BITS);
  assert_same_layers(&of_all, &of_box);
  free_stack(&of_all);
  free_stack(&of_box);
  msq_slicer_release(a);
  msq_slicer_release(b);
  def.region_min[2] = 16777214;
  def.region_max[2] = 16777218;
  assert_makes_nothing(msq_slicer, msq_slicer_create(all, &def, &made), MSQ_E_LIMIT, "the region");
}

/* The contours of both models at a height, which are the same. */
static void assert_same_contours(const msq_contours_def* def, double height) {
  msq_contours *a, *b;
  msq_contours_report of_all = {.struct_size = sizeof of_all}, of_box = of_all;
  assert_ok(msq_layer_contours(all, height, def, &a, NULL));
  assert_ok(msq_layer_contours(boxed, height, def, &b, NULL));
  assert_ok(msq_contours_info(a, &of_all));
  assert_ok(msq_contours_info(b, &of_box));
  assert_true(of_all.ring_count > 0);
  assert_int_equal(of_all.point_count, of_box.point_count);
  assert_memory_equal(of_all.points, of_box.points, of_all.point_count * sizeof(double[2]));
  msq_contours_release(a);
  msq_contours_release(b);
}

static void contours_need_a_window(void** state) {
  const double most = 16777216;
  msq_contours_def def;
  (void)state;
  assert_ok(msq_contours_def_init(&def, sizeof def));
  def.type = MSQ_FLOAT64;
  def.tolerance = 0.05;
  assert_makes_nothing(msq_contours, msq_layer_contours(all, 0.25, &def, &made, NULL),
                       MSQ_E_ARGUMENT, "has_window is 0");
  def.has_window = 1;
  for (int i = 0; i < 2; ++i) def.window_max[i] = 3;
  assert_same_contours(&def, 0.25);
  assert_makes_nothing(msq_contours, msq_layer_contours(all, -most - 1, &def, &made, NULL),
                       MSQ_E_LIMIT, "the window");
  assert_message_has("1.67772e+07");
  def.axis = 1;
  assert_makes_nothing(msq_contours, msq_layer_contours(all, 1e80, &def, &made, NULL), MSQ_E_LIMIT,
                       "1e+75");
  def.window_min[1] = most - 1;
  def.window_max[1] = most + 1;
  assert_makes_nothing(msq_contours, msq_layer_contours(all, 0.25, &def, &made, NULL), MSQ_E_LIMIT,
                       "axis 2");
}

static void rays_need_an_end(void** state) {
  const double origins[6] = {0.5, 0.1, 0.3, 2.2, 0.4, 0.3}, directions[6] = {1, 2, 3, 0, -0.5, 0};
  double t_max[2] = {10, INFINITY};
  msq_ray_hit a[2], b[2];
  msq_rays_def rays;
  (void)state;
  assert_ok(msq_rays_def_init(&rays, sizeof rays));
  rays.count = 2;
  rays.origins = origins;
  rays.directions = directions;
  memset(a, 7, sizeof a);
  assert_refused(msq_ray_cast(all, &rays, NULL, a, 2, NULL), MSQ_E_ARGUMENT, "t_max of ray 0");
  rays.t_max = t_max;
  assert_refused(msq_ray_cast(all, &rays, NULL, a, 2, NULL), MSQ_E_ARGUMENT, "t_max of ray 1");
  t_max[1] = 1e8;
  assert_refused(msq_ray_cast(all, &rays, NULL, a, 2, NULL), MSQ_E_LIMIT, "ray 1");
  assert_filled(a, sizeof a, 7);
  t_max[1] = 10;
  assert_ok(msq_ray_cast(all, &rays, NULL, a, 2, NULL));
  assert_ok(msq_ray_cast(boxed, &rays, NULL, b, 2, NULL));
  for (int i = 0; i < 2; ++i) {
    assert_int_equal(a[i].scale, 1);
    assert_int_equal(b[i].scale, 1);
    assert_near(a[i].t, b[i].t, 1e-9);
    for (int axis = 0; axis < 3; ++axis) assert_near(a[i].normal[axis], b[i].normal[axis], 1e-6);
  }
  /* Along the middle of a channel: to the end, and no further. */
  const double channel[3] = {0.5, 0, -20}, up[3] = {0, 0, 1};
  rays.count = 1;
  rays.origins = channel;
  rays.directions = up;
  t_max[0] = 40;
  assert_ok(msq_ray_cast(all, &rays, NULL, a, 1, NULL));
  assert_int_equal(a[0].scale, -1);
  assert_true(a[0].t == INFINITY);
}

static void pictures_need_an_end(void** state) {
  enum { side = 24 };
  static float depth[2][side * side];
  static uint8_t rgba[2][side * side * 4];
  const double direction[3] = {1, 2, -1};
  msq_camera camera;
  msq_render_def def;
  msq_frame frame;
  (void)state;
  assert_ok(msq_camera_init(&camera, sizeof camera));
  const msq_camera before = camera;
  assert_refused(msq_camera_fit(all, direction, NULL, side, side, &camera), MSQ_E_ARGUMENT,
                 "bounds");
  assert_memory_equal(&camera, &before, sizeof camera);
  camera.projection = MSQ_CAMERA_PERSPECTIVE;
  camera.eye[0] = 0.5;
  camera.target[0] = 1.5;
  camera.target[1] = 2;
  camera.target[2] = -1;
  assert_ok(msq_render_def_init(&def, sizeof def));
  def.width = def.height = side;
  def.occlusion_rays = 4;
  assert_ok(msq_frame_init(&frame, sizeof frame));
  frame.depth = depth[0];
  frame.rgba = rgba[0];
  assert_refused(msq_render(all, &camera, &def, NULL, &frame, NULL, NULL, NULL), MSQ_E_ARGUMENT,
                 "clip_far is inf");
  camera.clip_far = 5;
  assert_refused(msq_render(all, &camera, &def, NULL, &frame, NULL, NULL, NULL), MSQ_E_ARGUMENT,
                 "occlusion_distance");
  def.occlusion_distance = 0.4;
  def.shadows = 1;
  assert_refused(msq_render(all, &camera, &def, NULL, &frame, NULL, NULL, NULL), MSQ_E_ARGUMENT,
                 "shadows");
  def.shadows = 0;
  camera.clip_far = 1e8;
  assert_refused(msq_render(all, &camera, &def, NULL, &frame, NULL, NULL, NULL), MSQ_E_LIMIT,
                 "the picture");
  camera.clip_far = 5;
  for (int i = 0; i < 2; ++i) {
    frame.depth = depth[i];
    frame.rgba = rgba[i];
    assert_ok(msq_render(i ? boxed : all, &camera, &def, NULL, &frame, NULL, NULL, NULL));
  }
  assert_memory_equal(depth[0], depth[1], sizeof depth[0]);
  /* Occlusion rays begin a little above the surface, how much by the coordinates at hand. */
  int differ = 0;
  for (size_t i = 0; i < sizeof rgba[0]; ++i) differ += rgba[0][i] != rgba[1][i];
  assert_true(differ < 10);
}

static void it_has_no_surface(void** state) {
  msq_shape* shape = make_all_space();
  msq_structure* lattice = make_lattice(context);
  const msq_scale_def scales[2] = {{.shape = shape},
                                   {.structure = lattice, .skin = {.value = 0.5}}};
  const double curve[4] = {0, 0, 1, 1};
  msq_model_def def;
  msq_shape_distance_field_def field;
  (void)state;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = scales;
  def.scale_count = 2;
  assert_makes_nothing(msq_model, msq_model_create(context, &def, &made), MSQ_E_UNSUPPORTED,
                       "scale 1");
  assert_ok(msq_shape_distance_field_def_init(&field, sizeof field));
  field.shape = shape;
  field.curve = curve;
  field.curve_count = 2;
  for (int i = 0; i < 2; ++i) {
    field.step = i;
    assert_makes_nothing(msq_field, msq_field_shape_distance(context, &field, &made, NULL),
                         MSQ_E_UNSUPPORTED, "all space");
  }
  msq_structure_release(lattice);
  msq_shape_release(shape);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(it_has_no_bounds),
      cmocka_unit_test(everything_is_inside_without_structures),
      cmocka_unit_test(each_query_checks_the_cells),
      cmocka_unit_test(statistics_measure_the_sample),
      cmocka_unit_test(slicers_need_a_region),
      cmocka_unit_test(contours_need_a_window),
      cmocka_unit_test(rays_need_an_end),
      cmocka_unit_test(pictures_need_an_end),
      cmocka_unit_test(it_has_no_surface),
  };
  return cmocka_run_group_tests(tests, set_up, tear_down);
}
