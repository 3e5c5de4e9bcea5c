/* SPDX-License-Identifier: Apache-2.0
 * What rays, cameras and pictures refuse. */
#include "cameras.h"
#include "wrong_values.h"

static msq_context* context;
static msq_model *plain, *everywhere; /* a box; a lattice without bounds */

enum { few = 4 };

static void rays(void** state) {
  (void)state;
  REFUSALS("msq_ray_cast") {
    double origins[few][3], directions[few][3], limits[few] = {0, 0, 0, 0};
    const msq_model* model = plain;
    msq_rays_def* rays = (msq_rays_def*)definition(0);
    msq_query_def* query = any_query(1);
    msq_ray_hit* hits = (msq_ray_hit*)output(0);
    uint64_t count = few;
    msq_job* job = NULL;
    for (int i = 0; i < few; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        origins[i][axis] = axis == 0 ? -1 : 0.5 * i;
        directions[i][axis] = axis == 0;
      }
    assert_ok(msq_rays_def_init(rays, sizeof *rays));
    rays->count = few;
    rays->origins = origins;
    rays->directions = directions;
    wrong_sizes(table, rays, sizeof *rays, sizeof *rays);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "hits is NULL", hits = NULL);
    WRONG(ARGUMENT, "hit_count is 3; there are 4 rays", count = few - 1);
    WRONG(ARGUMENT, "hit_count is 5; there are 4 rays", count = few + 1);
    RIGHT(rays->count = count = 0; hits = NULL);
    wrong_vector(table, origins[2], "origin of ray 2");
    wrong_vector(table, directions[1], "direction of ray 1");
    for (int which = 0; which < 3; ++which)
      WRONG(ARGUMENT, "t_min of ray 3", limits[3] = not_finite(which); rays->t_min = limits);
    WRONG(ARGUMENT, "direction of ray 3 is (0, 0, 0)", directions[3][0] = 0);
    WRONG(ARGUMENT, "t_max of ray 0", limits[0] = NAN; rays->t_max = limits);
    WRONG(ARGUMENT, "origins is NULL", rays->origins = NULL);
    WRONG(ARGUMENT, "directions is NULL", rays->directions = NULL);
    WRONG(ARGUMENT, "coordinate_type is 9", rays->coordinate_type = 9);
    WRONG(ARGUMENT, "coordinate_type is 0", rays->coordinate_type = 0);
    WRONG(ARGUMENT, "the stride of origins is 8", rays->origin_stride = 8);
    WRONG(ARGUMENT, "the stride of directions is 8", rays->direction_stride = 8);
    WRONG(ARGUMENT, "t_max of ray 0", model = everywhere);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    wrong_query(table, query);
    WRONG(ARGUMENT, "rays is NULL", rays = NULL);
    RIGHT(query = NULL);
    WRONG(ARGUMENT, "hits begins 0 bytes after origins|96 bytes", hits = (msq_ray_hit*)origins);
    WRONG(ARGUMENT, "hits begins|overlap", hits = (msq_ray_hit*)((unsigned char*)directions + 8));
    WRONG(ARGUMENT, "hits begins|overlap", rays->t_min = limits; hits = (msq_ray_hit*)limits);
    WRONG(ARGUMENT, "hits begins|overlap", rays->t_max = limits; hits = (msq_ray_hit*)limits);
    TRY(msq_ray_cast(model, rays, query, hits, count, job));
  }
  REFUSALS("msq_ray_cast") { /* without bounds each ray needs an end */
    const double origins[6] = {0.5, 0.1, 0.3, 2.2, 0.4, 0.3};
    const double directions[6] = {1, 2, 3, 0, -0.5, 0};
    double t_max[2] = {10, 10};
    msq_ray_hit* hits = (msq_ray_hit*)output(0);
    msq_rays_def rays;
    assert_ok(msq_rays_def_init(&rays, sizeof rays));
    rays.count = 2;
    rays.origins = origins;
    rays.directions = directions;
    rays.t_max = t_max;
    WRONG(ARGUMENT, "t_max of ray 0", rays.t_max = NULL);
    WRONG(ARGUMENT, "t_max of ray 1", t_max[1] = INFINITY);
    WRONG(LIMIT, "ray 1", t_max[1] = 1e8);
    TRY(msq_ray_cast(everywhere, &rays, NULL, hits, 2, NULL));
  }
}

/* From above, of a picture 4 by 4. */
static void set_camera(msq_camera* camera, int32_t projection) {
  *camera = camera_at(projection, 1, 2, 10);
  camera->target[0] = 1;
  camera->target[1] = 2;
  camera->target[2] = 4;
  camera->up[1] = 3; /* of any length, and not normal to the view */
  camera->up[2] = -2;
  camera->height = 6;
  camera->field_of_view = 90;
}

static void wrong_camera(refusals* table, msq_camera* camera) {
  wrong_sizes(table, camera, sizeof *camera, sizeof *camera);
  WRONG(ARGUMENT, "projection is -1", camera->projection = -1);
  WRONG(ARGUMENT, "projection is 2", camera->projection = 2);
  wrong_vector(table, camera->eye, "eye is");
  wrong_vector(table, camera->target, "target is");
  wrong_vector(table, camera->up, "up is");
  WRONG(ARGUMENT, "clip_near is -1", camera->clip_near = -1);
  WRONG(ARGUMENT, "clip_near is nan", camera->clip_near = NAN);
  WRONG(ARGUMENT, "clip_near is inf", camera->clip_near = INFINITY);
  WRONG(ARGUMENT, "clip_far is 0", camera->clip_far = 0);
  WRONG(ARGUMENT, "clip_far is nan", camera->clip_far = NAN);
  WRONG(ARGUMENT, "clip_far is 3", camera->clip_near = camera->clip_far = 3);
  WRONG(ARGUMENT, "target - eye is (0, 0, 0)",
        memcpy(camera->target, camera->eye, sizeof camera->eye));
  WRONG(ARGUMENT, "along the view", camera->up[1] = 1e-9);
  WRONG(ARGUMENT, "up is (0, 0, 0)", camera->up[1] = camera->up[2] = 0);
}

static void cameras(void** state) {
  (void)state;
  for (int32_t projection = 0; projection < 2; ++projection) REFUSALS("msq_camera_ray") {
      msq_camera* camera = (msq_camera*)definition(0);
      uint32_t width = 4, height = 4;
      double at[2] = {1, 1}, *position = at;
      double *origin = (double*)output(0), *direction = (double*)output(1);
      set_camera(camera, projection);
      WRONG(ARGUMENT, "width is 0", width = 0);
      WRONG(ARGUMENT, "height is 20000; it must be from 1 to 16384", height = 20000);
      WRONG(ARGUMENT, "position is NULL", position = NULL);
      wrong_number(table, &at[0], "position[0] is ");
      wrong_number(table, &at[1], "position[1] is ");
      WRONG(ARGUMENT, "origin is NULL", origin = NULL);
      WRONG(ARGUMENT, "direction is NULL", direction = NULL);
      wrong_camera(table, camera);
      if (projection == MSQ_CAMERA_ORTHOGRAPHIC) {
        WRONG(ARGUMENT, "height is 0", camera->height = 0);
        WRONG(ARGUMENT, "height is -2", camera->height = -2);
        WRONG(ARGUMENT, "height is inf", camera->height = INFINITY);
        WRONG(ARGUMENT, "not finite", camera->height = 1e308;
              camera->eye[0] = camera->target[0] = 1.7e308);
        RIGHT(camera->field_of_view = -1);
      } else {
        WRONG(ARGUMENT, "field_of_view is 0", camera->field_of_view = 0);
        WRONG(ARGUMENT, "field_of_view is 180", camera->field_of_view = 180);
        WRONG(ARGUMENT, "field_of_view is nan", camera->field_of_view = NAN);
        RIGHT(camera->height = -1);
      }
      WRONG(ARGUMENT, "camera is NULL", camera = NULL);
      TRY(msq_camera_ray(camera, width, height, position, origin, direction));
    }
  REFUSALS("msq_camera_fit") {
    const msq_model* model = plain;
    double along[3] = {1, 2, 3}, above[3] = {0, 0, 1};
    const double *direction = along, *up = above;
    uint32_t width = 9, height = 9;
    msq_camera* camera = (msq_camera*)output(0);
    *camera = camera_at(MSQ_CAMERA_ORTHOGRAPHIC, 7, 8, 9);
    WRONG(ARGUMENT, "projection is 2", camera->projection = 2);
    wrong_sizes(table, camera, sizeof *camera, sizeof *camera);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "direction is NULL", direction = NULL);
    RIGHT(up = NULL);
    WRONG(ARGUMENT, "direction is (0, 0, 0)", memset(along, 0, sizeof along));
    WRONG(ARGUMENT, "up is (0, 0, 0)", memset(above, 0, sizeof above));
    WRONG(ARGUMENT, "along the view", above[0] = -2; above[1] = -4; above[2] = -6);
    wrong_vector(table, along, "direction");
    wrong_vector(table, above, "up");
    WRONG(ARGUMENT, "width is 0; it must be from 1 to 16384", width = 0);
    WRONG(ARGUMENT, "height is 16385", height = 16385);
    WRONG(ARGUMENT, "bounds", model = everywhere);
    WRONG(ARGUMENT, "camera is NULL", camera = NULL);
    TRY(msq_camera_fit(model, direction, up, width, height, camera));
  }
}

static void pictures(void** state) {
  const double colours[6] = {0, 0.5, 1, 1, 1.5, 0}, not_a_number[3] = {0, NAN, 0};
  (void)state;
  REFUSALS("msq_render") {
    const msq_model* model = plain;
    msq_camera* camera = (msq_camera*)definition(0);
    msq_render_def* def = (msq_render_def*)definition(1);
    msq_frame* frame = (msq_frame*)definition(2);
    msq_query_def* query = any_query(3);
    msq_job* job = NULL;
    set_camera(camera, MSQ_CAMERA_ORTHOGRAPHIC);
    *def = render_def(12, 8);
    assert_ok(msq_frame_init(frame, sizeof *frame));
    frame->depth = (float*)output(0);
    frame->rgba = (uint8_t*)output(1);
    frame->material = (uint32_t*)output(2);
    frame->normal = (float*)output(3);
    wrong_sizes(table, def, sizeof *def, sizeof *def);
    wrong_sizes(table, frame, sizeof *frame, sizeof *frame);
    WRONG(ARGUMENT, "model is NULL", model = NULL);
    WRONG(ARGUMENT, "width is 0; it must be from 1 to 16384", def->width = 0);
    WRONG(ARGUMENT, "height is 16385", def->height = 16385);
    WRONG(ARGUMENT, "the tile has 0 pixels along x", def->tile_x = 1);
    WRONG(ARGUMENT, "the tile has 0 pixels along y", def->tile_width = 12);
    WRONG(ARGUMENT, "the tile has 13 pixels along x", def->tile_width = 13; def->tile_height = 1);
    WRONG(ARGUMENT, "8 pixels along x from 5 on; the picture has 12", def->tile_x = 5;
          def->tile_width = 8; def->tile_height = 1);
    WRONG(ARGUMENT, "along y from 4294967295 on; the picture has 8", def->tile_y = UINT32_MAX;
          def->tile_width = 8; def->tile_height = 8);
    WRONG(ARGUMENT, "samples is 0; it must be from 1 to 16", def->samples = 0);
    WRONG(ARGUMENT, "samples is 17", def->samples = 17);
    WRONG(ARGUMENT, "first_step is 0", def->first_step = 0);
    WRONG(ARGUMENT, "first_step is 3; it must be a power of two", def->first_step = 3);
    WRONG(ARGUMENT, "first_step is 128", def->first_step = 128);
    WRONG(ARGUMENT, "colour_by is 4", def->colour_by = 4);
    WRONG(ARGUMENT, "colour_by is -1", def->colour_by = -1);
    WRONG(ARGUMENT, "colour_count is 0", def->colours = colours);
    WRONG(ARGUMENT, "colours is NULL and colour_count is 1", def->colour_count = 1);
    WRONG(ARGUMENT, "colour_count is 65537", def->colours = colours; def->colour_count = 65537);
    WRONG(ARGUMENT, "a part of colours is 1.5", def->colours = colours; def->colour_count = 2);
    WRONG(ARGUMENT, "a part of colours is nan", def->colours = not_a_number; def->colour_count = 1);
    WRONG(ARGUMENT, "a part of background is -0.5", def->background[1] = -0.5);
    WRONG(ARGUMENT, "a part of background is nan", def->background[3] = NAN);
    WRONG(ARGUMENT, "light is (0, 0, 0)", memset(def->light, 0, sizeof def->light));
    WRONG(ARGUMENT, "light is (-0.4, 0.6, inf)", def->light[2] = INFINITY);
    wrong_vector(table, def->light, "light is ");
    WRONG(ARGUMENT, "ambient is 1.25; it must be from 0 to 1", def->ambient = 1.25);
    WRONG(ARGUMENT, "ambient is nan", def->ambient = NAN);
    WRONG(ARGUMENT, "shadows is 2", def->shadows = 2);
    WRONG(ARGUMENT, "occlusion_rays is 257", def->occlusion_rays = 257);
    WRONG(ARGUMENT, "occlusion_distance is -1", def->occlusion_distance = -1);
    WRONG(ARGUMENT, "occlusion_distance is inf", def->occlusion_distance = INFINITY);
    WRONG(ARGUMENT, "row_pixels is 11; the tile has 12", frame->row_pixels = 11);
    WRONG(ARGUMENT, "all arrays of the frame are NULL", frame->depth = NULL; frame->rgba = NULL;
          frame->material = NULL; frame->normal = NULL);
    WRONG(ARGUMENT, "height is 0", camera->height = 0);
    WRONG(CANCELLED, "cancelled", job = cancelled_job());
    wrong_camera(table, camera);
    wrong_query(table, query);
    WRONG(ARGUMENT, "camera is NULL", camera = NULL);
    WRONG(ARGUMENT, "def is NULL", def = NULL);
    WRONG(ARGUMENT, "frame is NULL", frame = NULL);
    RIGHT(query = NULL);
    TRY(msq_render(model, camera, def, query, frame, NULL, NULL, job));
  }
  REFUSALS("msq_render") { /* without bounds all rays need an end */
    msq_camera camera;
    msq_render_def def = render_def(8, 8);
    msq_frame frame;
    set_camera(&camera, MSQ_CAMERA_PERSPECTIVE);
    camera.clip_far = 5;
    def.occlusion_rays = 4;
    def.occlusion_distance = 0.4;
    assert_ok(msq_frame_init(&frame, sizeof frame));
    frame.depth = (float*)output(0);
    WRONG(ARGUMENT, "clip_far is inf", camera.clip_far = INFINITY);
    WRONG(ARGUMENT, "occlusion_distance", def.occlusion_distance = 0);
    WRONG(ARGUMENT, "shadows", def.shadows = 1);
    WRONG(LIMIT, "the picture", camera.clip_far = 1e8);
    TRY(msq_render(everywhere, &camera, &def, NULL, &frame, NULL, NULL, NULL));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rays),
      cmocka_unit_test(cameras),
      cmocka_unit_test(pictures),
  };
  msq_shape* all;
  context = make_context();
  plain = make_box_model(context);
  assert_ok(msq_shape_all_space(context, &all));
  everywhere = make_model(context, all, make_lattice(context), NULL);
  const int failed = cmocka_run_group_tests(tests, NULL, NULL);
  msq_job_release(cancelled_job());
  msq_model_release(everywhere);
  msq_model_release(plain);
  msq_context_release(context);
  return failed;
}
