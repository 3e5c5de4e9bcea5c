/* SPDX-License-Identifier: Apache-2.0
 * msq_render: pixels are what msq_ray_cast says, whatever the tile, the threads and the passes. */
#include "cameras.h"
#include "materials.h"

enum { width = 75, height = 52 };

/* Struts with a skin and materials, where all arrays have something to say; and a foam, whose rays
 * are followed together. */
enum { models = 2 };
static msq_model* make_rich_model(msq_context* context, int which) {
  return which == 0 ? make_material_model(context, 1, 1, 1)
                    : make_foam_model(context, MSQ_FOAM_DIRECT);
}

static void assert_pixel(const picture* got, size_t at, const msq_ray_hit* hit, uint32_t i,
                         uint32_t j) {
  const msq_frame* frame = &got->frame;
  const int same = frame->depth[at] == (float)hit->t && frame->scale[at] == hit->scale &&
                   frame->material[at] == hit->material &&
                   frame->normal[3 * at] == (float)hit->normal[0] &&
                   frame->normal[3 * at + 1] == (float)hit->normal[1] &&
                   frame->normal[3 * at + 2] == (float)hit->normal[2];
  if (!same)
    fail_msg("pixel (%u, %u) has depth %.9g, scale %d, material %u; its ray %.9g, %d, %u", i, j,
             (double)frame->depth[at], frame->scale[at], frame->material[at], hit->t, hit->scale,
             hit->material);
}

/* Every pixel of a picture against its ray, cast in one array. */
static void check_pixels(const msq_model* model, const msq_camera* camera, uint32_t samples) {
  static double origins[width * height][3], directions[width * height][3];
  static double from[width * height], to[width * height];
  static msq_ray_hit hits[width * height];
  msq_render_def def = render_def(width, height);
  def.samples = samples;
  picture got = rendered(model, camera, &def);
  for (uint32_t j = 0; j < height; ++j)
    for (uint32_t i = 0; i < width; ++i) {
      const double position[2] = {i + 0.5, j + 0.5};
      const size_t at = (size_t)j * width + i;
      assert_ok(msq_camera_ray(camera, width, height, position, origins[at], directions[at]));
      from[at] = camera->clip_near;
      to[at] = camera->clip_far;
    }
  msq_rays_def rays;
  assert_ok(msq_rays_def_init(&rays, sizeof rays));
  rays.count = width * height;
  rays.origins = origins;
  rays.directions = directions;
  rays.t_min = from;
  rays.t_max = to;
  assert_ok(msq_ray_cast(model, &rays, NULL, hits, rays.count, NULL));
  int met = 0, missed = 0;
  for (uint32_t j = 0; j < height; ++j)
    for (uint32_t i = 0; i < width; ++i) {
      const size_t at = (size_t)j * width + i;
      assert_pixel(&got, at, &hits[at], i, j);
      *(hits[at].scale < 0 ? &missed : &met) += 1;
      assert_true((hits[at].scale < 0) == (got.frame.rgba[4 * at + 3] == 0) || samples > 1);
    }
  assert_true(met > 500 && missed > 500);
  free_picture(&got);
}

static void check_rays(int which) {
  msq_context* context = make_context();
  msq_model* model = make_rich_model(context, which);
  for (int32_t projection = 0; projection < 2; ++projection) {
    msq_camera camera = fitted_camera(model, projection, width, height);
    check_pixels(model, &camera, 1);
    camera.clip_near = 7;
    camera.clip_far = projection ? 14 : 9;
    check_pixels(model, &camera, 1);
    check_pixels(model, &camera, 3);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void pixels_are_what_rays_say(void** state) {
  (void)state;
  for (int which = 0; which < models; ++which) check_rays(which);
}

/* A definition with all that may depend on more than the pixel. */
static msq_render_def rich_def(uint32_t samples) {
  msq_render_def def = render_def(width, height);
  def.samples = samples;
  def.colour_by = MSQ_COLOUR_MATERIAL;
  def.shadows = 1;
  def.occlusion_rays = 2;
  def.background[0] = 0.25;
  def.background[3] = 0.5;
  return def;
}

/* Tiles of odd sizes and places, and rows that are wider than they. */
static void check_tiles(int which) {
  const uint32_t tiles[4][4] = {{0, 0, 40, 52}, {40, 0, 35, 17}, {40, 17, 35, 35}, {74, 51, 1, 1}};
  msq_context* context = make_context();
  msq_model* model = make_rich_model(context, which);
  for (uint32_t samples = 1; samples <= 2; ++samples) {
    const msq_camera camera = fitted_camera(model, (int32_t)(samples % 2), width, height);
    const msq_render_def def = rich_def(samples);
    picture whole = rendered(model, &camera, &def), parts = make_picture(width, height);
    for (int t = 0; t < 4; ++t) {
      msq_render_def part = def;
      part.tile_x = tiles[t][0];
      part.tile_y = tiles[t][1];
      part.tile_width = tiles[t][2];
      part.tile_height = tiles[t][3];
      const size_t first = (size_t)tiles[t][1] * width + tiles[t][0];
      msq_frame frame = parts.frame;
      frame.row_pixels = width;
      frame.depth += first;
      frame.normal += 3 * first;
      frame.scale += first;
      frame.material += first;
      frame.rgba += 4 * first;
      assert_ok(msq_render(model, &camera, &part, NULL, &frame, NULL, NULL, NULL));
    }
    assert_same_picture(&whole, &parts);
    free_picture(&parts);
    free_picture(&whole);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void tiles_have_the_pixels_of_the_whole(void** state) {
  (void)state;
  for (int which = 0; which < models; ++which) check_tiles(which);
}

static void check_threads(int which) {
  picture got[2];
  for (uint32_t threads = 1; threads <= 2; ++threads) {
    msq_context* context = make_context_of(threads, 1 << 20, 0);
    msq_model* model = make_rich_model(context, which);
    const msq_camera camera = fitted_camera(model, MSQ_CAMERA_PERSPECTIVE, width, height);
    const msq_render_def def = rich_def(2);
    got[threads - 1] = rendered(model, &camera, &def);
    msq_model_release(model);
    msq_context_release(context);
  }
  assert_same_picture(&got[0], &got[1]);
  free_picture(&got[0]);
  free_picture(&got[1]);
}

static void threads_make_no_difference(void** state) {
  (void)state;
  for (int which = 0; which < models; ++which) check_threads(which);
}

/* ---- passes ------------------------------------------------------------------------------ */

typedef struct watcher {
  const picture* shown;
  picture last; /* the picture as it was after the pass before */
  uint32_t passes, step, samples, ended;
  msq_job* job;
  double progress;
  uint32_t stop_at_step;
  int32_t code;
} watcher;

/* Blocks are of one ray, that of their upper left pixel, and these stay from pass to pass. */
static int32_t watch(void* user, const msq_render_pass* pass) {
  watcher* seen = (watcher*)user;
  const msq_frame* frame = &seen->shown->frame;
  assert_int_equal(pass->struct_size, sizeof *pass);
  assert_int_equal(seen->ended, 0);
  assert_true(seen->passes == 0 || pass->samples > 1 || pass->step * 2 == seen->step);
  for (uint32_t j = 0; j < height; ++j)
    for (uint32_t i = 0; i < width; ++i) {
      const size_t at = (size_t)j * width + i;
      const size_t of = (size_t)(j - j % pass->step) * width + (i - i % pass->step);
      assert_memory_equal(frame->depth + at, frame->depth + of, 4);
      assert_memory_equal(frame->normal + 3 * at, frame->normal + 3 * of, 12);
      assert_memory_equal(frame->rgba + 4 * at, frame->rgba + 4 * of, 4);
      if (seen->passes > 0 && i % seen->step == 0 && j % seen->step == 0 && pass->samples == 1) {
        assert_memory_equal(frame->depth + at, seen->last.frame.depth + at, 4);
        assert_memory_equal(frame->rgba + 4 * at, seen->last.frame.rgba + 4 * at, 4);
      }
    }
  memcpy(seen->last.data, seen->shown->data, seen->shown->bytes);
  ++seen->passes;
  seen->step = pass->step;
  seen->samples = pass->samples;
  seen->ended = (uint32_t)pass->is_last;
  if (seen->job) {
    assert_true(progress_of(seen->job) > seen->progress);
    seen->progress = progress_of(seen->job);
  }
  return pass->step == seen->stop_at_step ? seen->code : 0;
}

static watcher make_watcher(const picture* shown) {
  watcher seen;
  memset(&seen, 0, sizeof seen);
  seen.shown = shown;
  seen.last = make_picture(width, height);
  return seen;
}

static void check_passes(int which) {
  msq_context* context = make_context();
  msq_model* model = make_rich_model(context, which);
  const msq_camera camera = fitted_camera(model, MSQ_CAMERA_ORTHOGRAPHIC, width, height);
  for (uint32_t samples = 1; samples <= 3; samples += 2) {
    msq_render_def def = rich_def(samples);
    picture whole = rendered(model, &camera, &def);
    const uint32_t steps[2] = {1, 64}, passes[2] = {1, 7};
    for (int s = 0; s < 2; ++s) {
      def.first_step = steps[s];
      picture got = make_picture(width, height);
      watcher seen = make_watcher(&got);
      assert_ok(msq_job_create(&seen.job));
      assert_ok(msq_render(model, &camera, &def, NULL, &got.frame, watch, &seen, seen.job));
      assert_int_equal(seen.passes, passes[s] + (samples > 1));
      assert_int_equal(seen.samples, samples);
      assert_int_equal(seen.ended, 1);
      assert_true(progress_of(seen.job) == 1);
      assert_same_picture(&whole, &got);
      msq_job_release(seen.job);
      free_picture(&seen.last);
      free_picture(&got);
    }
    free_picture(&whole);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void passes_end_in_the_same_picture(void** state) {
  (void)state;
  for (int which = 0; which < models; ++which) check_passes(which);
}

/* ---- ends ---------------------------------------------------------------------------------- */

static void stops_where_the_callback_says(void** state) {
  const uint32_t steps[2] = {4, 1}, passes[2] = {3, 5};
  msq_context* context = make_context();
  msq_model* model = make_rich_model(context, 0);
  const msq_camera camera = fitted_camera(model, MSQ_CAMERA_ORTHOGRAPHIC, width, height);
  msq_render_def def = render_def(width, height);
  (void)state;
  def.first_step = 16;
  for (int which = 0; which < 2; ++which) {
    picture got = make_picture(width, height);
    watcher seen = make_watcher(&got);
    seen.stop_at_step = steps[which];
    seen.code = -77;
    assert_ok(msq_job_create(&seen.job));
    assert_refused(msq_render(model, &camera, &def, NULL, &got.frame, watch, &seen, seen.job),
                   MSQ_E_HOST, which ? "-77 after the pass of step 1" : "of step 4");
    assert_int_equal(msq_error_host_code(), -77);
    assert_int_equal(seen.passes, passes[which]);
    assert_true(progress_of(seen.job) < 1);
    msq_job_release(seen.job);
    free_picture(&seen.last);
    free_picture(&got);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static int32_t cancel(void* user, const msq_render_pass* pass) {
  if (pass->step == 2) assert_ok(msq_job_cancel((msq_job*)user));
  assert_true(pass->step >= 2);
  return 0;
}

static void can_be_cancelled(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_rich_model(context, 0);
  const msq_camera camera = fitted_camera(model, MSQ_CAMERA_ORTHOGRAPHIC, width, height);
  msq_render_def def = render_def(width, height);
  msq_job* job;
  (void)state;
  def.first_step = 4;
  assert_ok(msq_job_create(&job));
  picture got = make_picture(width, height);
  assert_status(msq_render(model, &camera, &def, NULL, &got.frame, cancel, job, job),
                MSQ_E_CANCELLED);
  memset(got.data, unwritten, got.bytes);
  assert_status(msq_render(model, &camera, &def, NULL, &got.frame, NULL, NULL, job),
                MSQ_E_CANCELLED);
  assert_filled(got.data, got.bytes, unwritten);
  free_picture(&got);
  msq_job_release(job);
  msq_model_release(model);
  msq_context_release(context);
}

/* The arrays that are asked for are as all of them are, and others are not touched. */
static void writes_what_is_asked_for(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_rich_model(context, 0);
  const msq_camera camera = fitted_camera(model, MSQ_CAMERA_PERSPECTIVE, width, height);
  (void)state;
  for (uint32_t samples = 1; samples <= 2; ++samples) {
    const msq_render_def def = rich_def(samples);
    picture whole = rendered(model, &camera, &def), parts = make_picture(width, height);
    for (int which = 0; which < 5; ++which) {
      msq_frame frame;
      assert_ok(msq_frame_init(&frame, sizeof frame));
      if (which == 0) frame.depth = parts.frame.depth;
      if (which == 1) frame.normal = parts.frame.normal;
      if (which == 2) frame.scale = parts.frame.scale;
      if (which == 3) frame.material = parts.frame.material;
      if (which == 4) frame.rgba = parts.frame.rgba;
      assert_ok(msq_render(model, &camera, &def, NULL, &frame, NULL, NULL, NULL));
    }
    assert_same_picture(&whole, &parts);
    free_picture(&whole);
    free_picture(&parts);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void reaches_the_corner_of_the_largest_picture(void** state) {
  enum { most = 16384 };
  msq_context* context = make_context();
  msq_model* model = make_box_model(context);
  (void)state;
  for (int32_t projection = 0; projection < 2; ++projection) {
    /* Along z: the box fills the picture, in perspective to within its front's edges. */
    const double direction[3] = {0, 0, -1};
    msq_camera camera;
    assert_ok(msq_camera_init(&camera, sizeof camera));
    camera.projection = projection;
    assert_ok(msq_camera_fit(model, direction, NULL, most, most, &camera));
    msq_render_def def = render_def(most, most);
    def.tile_x = most - 3;
    def.tile_y = most - 2;
    def.tile_width = 3;
    def.tile_height = 2;
    picture got = rendered(model, &camera, &def);
    for (uint32_t n = 0; n < 6; ++n) {
      const double position[2] = {most - 3 + n % 3 + 0.5, most - 2 + n / 3 + 0.5};
      double origin[3], way[3];
      msq_rays_def ray;
      msq_ray_hit hit;
      assert_ok(msq_camera_ray(&camera, most, most, position, origin, way));
      assert_ok(msq_rays_def_init(&ray, sizeof ray));
      ray.count = 1;
      ray.origins = origin;
      ray.directions = way;
      assert_ok(msq_ray_cast(model, &ray, NULL, &hit, 1, NULL));
      assert_int_equal(hit.scale, 0);
      assert_true(got.frame.depth[n] == (float)hit.t);
      /* The last pixel's middle is half of a pixel within the corner. */
      assert_near(origin[0] + hit.t * way[0], 4 * position[0] / most, 1e-9);
      assert_near(origin[1] + hit.t * way[1], 4 - 4 * position[1] / most, 1e-9);
    }
    free_picture(&got);
  }
  msq_model_release(model);
  msq_context_release(context);
}

static void resolves_down_to_a_length_scale(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_rich_model(context, 0);
  const msq_camera camera = fitted_camera(model, MSQ_CAMERA_PERSPECTIVE, width, height);
  const msq_render_def def = render_def(width, height);
  msq_query_def coarse;
  (void)state;
  assert_ok(msq_query_def_init(&coarse, sizeof coarse));
  coarse.length_scale = 1.5;
  picture got = make_picture(width, height);
  assert_ok(msq_render(model, &camera, &def, &coarse, &got.frame, NULL, NULL, NULL));
  for (size_t at = 0; at < (size_t)width * height; ++at) {
    assert_true(got.frame.scale[at] == (isinf(got.frame.depth[at]) ? -1 : 0));
    assert_int_equal(got.frame.material[at], isinf(got.frame.depth[at]) ? 0 : 1);
  }
  coarse.length_scale = -1;
  assert_refused(msq_render(model, &camera, &def, &coarse, &got.frame, NULL, NULL, NULL),
                 MSQ_E_ARGUMENT, "length_scale is -1");
  free_picture(&got);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(pixels_are_what_rays_say),
      cmocka_unit_test(tiles_have_the_pixels_of_the_whole),
      cmocka_unit_test(threads_make_no_difference),
      cmocka_unit_test(passes_end_in_the_same_picture),
      cmocka_unit_test(stops_where_the_callback_says),
      cmocka_unit_test(can_be_cancelled),
      cmocka_unit_test(writes_what_is_asked_for),
      cmocka_unit_test(reaches_the_corner_of_the_largest_picture),
      cmocka_unit_test(resolves_down_to_a_length_scale),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
