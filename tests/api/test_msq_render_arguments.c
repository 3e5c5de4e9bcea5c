/* SPDX-License-Identifier: Apache-2.0
 * msq_render: what it takes and what it refuses, with nothing written. */
#include "cameras.h"

typedef struct scene {
  const msq_model* model;
  msq_camera camera;
  msq_render_def def;
  msq_frame frame;
  picture target;
} scene;

static scene make_scene(const msq_model* model) {
  scene made;
  made.model = model;
  made.camera = fitted_camera(model, MSQ_CAMERA_ORTHOGRAPHIC, 12, 8);
  made.def = render_def(12, 8);
  made.target = make_picture(12, 8);
  made.frame = made.target.frame;
  return made;
}

/* On failure nothing is written. */
static msq_status render_scene(scene* of, const msq_camera* camera, const msq_render_def* def,
                               const msq_frame* frame) {
  memset(of->target.data, unwritten, of->target.bytes);
  const msq_status status = msq_render(of->model, camera, def, NULL, frame, NULL, NULL, NULL);
  if (status != MSQ_OK) assert_filled(of->target.data, of->target.bytes, unwritten);
  return status;
}

static msq_status use_camera(void* env, void* camera) {
  scene* of = (scene*)env;
  return render_scene(of, (const msq_camera*)camera, &of->def, &of->frame);
}
static msq_status use_def(void* env, void* def) {
  scene* of = (scene*)env;
  return render_scene(of, &of->camera, (const msq_render_def*)def, &of->frame);
}
static msq_status use_frame(void* env, void* frame) {
  scene* of = (scene*)env;
  return render_scene(of, &of->camera, &of->def, (const msq_frame*)frame);
}

DEFINE_INIT(render_def)
DEFINE_INIT(frame)

static void honours_every_struct_size(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_box_model(context);
  scene of = make_scene(model);
  (void)state;
  check_def_init(init_render_def, sizeof(msq_render_def));
  check_def_init(init_frame, sizeof(msq_frame));
  check_def_sizes(&of.camera, sizeof of.camera, use_camera, &of);
  check_def_sizes(&of.def, sizeof of.def, use_def, &of);
  check_def_sizes(&of.frame, sizeof of.frame, use_frame, &of);
  free_picture(&of.target);
  msq_model_release(model);
  msq_context_release(context);
}

#define assert_def_refused(change, text)                      \
  do {                                                        \
    msq_render_def def = of.def;                              \
    change;                                                   \
    assert_refused(use_def(&of, &def), MSQ_E_ARGUMENT, text); \
  } while (0)

static void refuses_pictures_that_make_no_sense(void** state) {
  const double colours[6] = {0, 0.5, 1, 1, 1.5, 0}, not_a_number[3] = {0, NAN, 0};
  msq_context* context = make_context();
  msq_model* model = make_box_model(context);
  scene of = make_scene(model);
  (void)state;
  assert_def_refused(def.width = 0, "width is 0; it must be from 1 to 16384");
  assert_def_refused(def.height = 16385, "height is 16385");
  assert_def_refused(def.tile_x = 1, "the tile has 0 pixels along x");
  assert_def_refused(def.tile_width = 12, "the tile has 0 pixels along y");
  assert_def_refused(def.tile_width = 13; def.tile_height = 1, "the tile has 13 pixels along x");
  assert_def_refused(def.tile_x = 5; def.tile_width = 8;
                     def.tile_height = 1, "8 pixels along x from 5 on; the picture has 12");
  assert_def_refused(def.tile_y = UINT32_MAX; def.tile_width = 8;
                     def.tile_height = 8, "along y from 4294967295 on; the picture has 8");
  assert_def_refused(def.samples = 0, "samples is 0; it must be from 1 to 16");
  assert_def_refused(def.samples = 17, "samples is 17");
  assert_def_refused(def.first_step = 0, "first_step is 0");
  assert_def_refused(def.first_step = 3, "first_step is 3; it must be a power of two");
  assert_def_refused(def.first_step = 128, "first_step is 128");
  assert_def_refused(def.colour_by = 4, "colour_by is 4");
  assert_def_refused(def.colours = colours, "colour_count is 0");
  assert_def_refused(def.colour_count = 1, "colours is NULL and colour_count is 1");
  assert_def_refused(def.colours = colours; def.colour_count = 65537, "colour_count is 65537");
  assert_def_refused(def.colours = colours; def.colour_count = 2, "a part of colours is 1.5");
  assert_def_refused(def.colours = not_a_number; def.colour_count = 1, "a part of colours is nan");
  assert_def_refused(def.background[1] = -0.5, "a part of background is -0.5");
  assert_def_refused(def.background[3] = NAN, "a part of background is nan");
  assert_def_refused(memset(def.light, 0, sizeof def.light), "light is (0, 0, 0)");
  assert_def_refused(def.light[2] = INFINITY, "light is (-0.4, 0.6, inf)");
  assert_def_refused(def.ambient = 1.25, "ambient is 1.25; it must be from 0 to 1");
  assert_def_refused(def.ambient = NAN, "ambient is nan");
  assert_def_refused(def.shadows = 2, "shadows is 2");
  assert_def_refused(def.occlusion_rays = 257, "occlusion_rays is 257");
  assert_def_refused(def.occlusion_distance = -1, "occlusion_distance is -1");
  assert_def_refused(def.occlusion_distance = INFINITY, "occlusion_distance is inf");

  msq_frame frame = of.frame;
  frame.row_pixels = 11;
  assert_refused(use_frame(&of, &frame), MSQ_E_ARGUMENT, "row_pixels is 11; the tile has 12");
  assert_ok(msq_frame_init(&frame, sizeof frame));
  assert_refused(use_frame(&of, &frame), MSQ_E_ARGUMENT, "all arrays of the frame are NULL");
  msq_camera camera = of.camera;
  camera.height = 0;
  assert_refused(use_camera(&of, &camera), MSQ_E_ARGUMENT, "height is 0");
  assert_refused(render_scene(&of, NULL, &of.def, &of.frame), MSQ_E_ARGUMENT, "camera is NULL");
  assert_refused(render_scene(&of, &of.camera, NULL, &of.frame), MSQ_E_ARGUMENT, "def is NULL");
  assert_refused(render_scene(&of, &of.camera, &of.def, NULL), MSQ_E_ARGUMENT, "frame is NULL");
  of.model = NULL;
  assert_refused(use_def(&of, &of.def), MSQ_E_ARGUMENT, "model is NULL");
  free_picture(&of.target);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(honours_every_struct_size),
      cmocka_unit_test(refuses_pictures_that_make_no_sense),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
