/* SPDX-License-Identifier: Apache-2.0
 * msq_render: depth, normals and colours of scenes simple enough to know them beforehand. */
#include "cameras.h"
#include "materials.h"

/* ---- scenes ------------------------------------------------------------------------------ */

static msq_model* make_ball(msq_context* context) {
  const double centre[3] = {0, 0, 0};
  msq_shape* ball;
  assert_ok(msq_shape_from_sphere(context, centre, 1, &ball));
  return make_model(context, ball, NULL, NULL);
}

/* A mesh of boxes. */
static msq_model* make_boxes(msq_context* context, const double (*corners)[6], int count) {
  double vertices[4][8][3];
  uint32_t triangles[4][12][3];
  for (int b = 0; b < count; ++b)
    for (int i = 0; i < 8; ++i)
      for (int axis = 0; axis < 3; ++axis)
        vertices[b][i][axis] = corners[b][axis + (i >> axis & 1 ? 3 : 0)];
  for (int b = 0; b < count; ++b)
    for (int t = 0; t < 12; ++t)
      for (int i = 0; i < 3; ++i) triangles[b][t][i] = cube_triangles()[t][i] + 8 * (uint32_t)b;
  const msq_mesh_def def = mesh_def((const double(*)[3])vertices[0], 8 * (uint64_t)count,
                                    (const uint32_t(*)[3])triangles[0], 12 * (uint64_t)count);
  return make_model(context, make_mesh(context, &def), NULL, NULL);
}

/* Down along z from a height of 10, x to the right and y upwards, 4 x 4 units. */
static msq_camera from_above(double x, double y) {
  msq_camera camera = camera_at(MSQ_CAMERA_ORTHOGRAPHIC, x, y, 10);
  camera.target[0] = x;
  camera.target[1] = y;
  camera.up[1] = 1;
  camera.up[2] = 0;
  camera.height = 4;
  return camera;
}

static int srgb_of(double linear) {
  const double value = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
  return (int)floor(255 * value + 0.5);
}

static void assert_rgba(const picture* got, uint32_t i, uint32_t j, int r, int g, int b, int a) {
  const uint8_t* rgba = got->frame.rgba + 4 * ((size_t)j * got->width + i);
  if (rgba[0] != r || rgba[1] != g || rgba[2] != b || rgba[3] != a)
    fail_msg("pixel (%u, %u) is %u, %u, %u, %u, not %d, %d, %d, %d", i, j, rgba[0], rgba[1],
             rgba[2], rgba[3], r, g, b, a);
}

/* ---- geometry ---------------------------------------------------------------------------- */

enum { side = 33 };

/* The ball's depth and normal in closed form, in both projections. */
static void shows_a_ball_where_it_is(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_ball(context);
  const msq_render_def def = render_def(side, side);
  (void)state;
  for (int32_t projection = 0; projection < 2; ++projection) {
    msq_camera camera = camera_at(projection, 0, 0, 5);
    camera.up[1] = 1;
    camera.up[2] = 0;
    camera.height = 2.5;
    camera.field_of_view = 30;
    const double pixel = (projection ? 2 * tan(15 * acos(-1) / 180) : camera.height) / side;
    picture got = rendered(model, &camera, &def);
    int hits = 0;
    for (uint32_t j = 0; j < side; ++j)
      for (uint32_t i = 0; i < side; ++i) {
        const double a = (i + 0.5 - side / 2.0) * pixel, b = (side / 2.0 - j - 0.5) * pixel;
        const double d = 1 + a * a + b * b, s = projection ? 25 - 24 * d : 1 - a * a - b * b;
        const float depth = got.frame.depth[j * side + i];
        if (fabs(s) < 1e-9) continue;
        assert_true((s > 0) == isfinite(depth));
        assert_int_equal(got.frame.scale[j * side + i], s > 0 ? 0 : -1);
        const float* normal = got.frame.normal + 3 * (j * side + i);
        if (s < 0) {
          assert_true(depth > 0 && normal[0] == 0 && normal[1] == 0 && normal[2] == 0);
          continue;
        }
        ++hits;
        const double t = projection ? (5 - sqrt(s)) / d : 5 - sqrt(s);
        assert_near((double)depth, t, 1e-6);
        assert_near((double)normal[0], projection ? a * t : a, 1e-6);
        assert_near((double)normal[1], projection ? b * t : b, 1e-6);
        assert_near((double)normal[2], 5 - t, 1e-6);
      }
    assert_true(hits > 300);
    free_picture(&got);
  }
  msq_model_release(model);
  msq_context_release(context);
}

/* However far away the eye is. */
static void loses_no_accuracy_from_afar(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_ball(context);
  const msq_render_def def = render_def(side, side);
  picture got[2];
  (void)state;
  for (int far = 0; far < 2; ++far) {
    msq_camera camera = camera_at(MSQ_CAMERA_ORTHOGRAPHIC, 0, 0, far ? 1e9 : 5);
    camera.up[1] = 1;
    camera.height = 2.5;
    got[far] = rendered(model, &camera, &def);
  }
  for (size_t n = 0; n < 3 * (size_t)side * side; ++n)
    assert_near((double)got[1].frame.normal[n], (double)got[0].frame.normal[n], 1e-6);
  free_picture(&got[0]);
  free_picture(&got[1]);
  msq_model_release(model);
  msq_context_release(context);
}

/* ---- colours ----------------------------------------------------------------------------- */

static const double three_colours[3][3] = {{1, 0.5, 0}, {0.25, 0.125, 1}, {0, 1, 0.0625}};

/* A box of material 1 with struts of material 2 and a skin of material 3, from above. */
static void colours_by_what_is_hit(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_material_model(context, 1, 1, 1);
  const msq_camera camera = from_above(2, 2);
  msq_render_def def = render_def(8, 8);
  (void)state;
  def.ambient = 1;
  def.colours = three_colours[0];
  def.colour_count = 3;
  for (int32_t by = MSQ_COLOUR_PLAIN; by <= MSQ_COLOUR_NORMAL; ++by) {
    def.colour_by = by;
    picture got = rendered(model, &camera, &def);
    for (uint32_t j = 0; j < 8; ++j)
      for (uint32_t i = 0; i < 8; ++i) {
        const size_t at = 8 * j + i;
        assert_int_equal(got.frame.scale[at], 0);
        assert_int_equal(got.frame.material[at], 3);
        const double upwards[3] = {0.5, 0.5, 1};
        const double* c = by == MSQ_COLOUR_NORMAL ? upwards : three_colours[0];
        assert_rgba(&got, i, j, srgb_of(c[0]), srgb_of(c[1]), srgb_of(c[2]), 255);
      }
    free_picture(&got);
  }
  /* Below the skin: struts of scale 1 and material 2. */
  msq_camera within = camera;
  within.clip_near = 6.26;
  for (int32_t by = MSQ_COLOUR_SCALE; by <= MSQ_COLOUR_MATERIAL; ++by) {
    def.colour_by = by;
    picture got = rendered(model, &within, &def);
    int struts = 0;
    for (uint32_t j = 1; j < 7; ++j)
      for (uint32_t i = 1; i < 7; ++i) {
        const size_t at = 8 * j + i;
        if (got.frame.material[at] != 2) continue;
        ++struts;
        assert_int_equal(got.frame.scale[at], 1);
        const double* c = three_colours[by == MSQ_COLOUR_SCALE ? 1 : 2];
        assert_rgba(&got, i, j, srgb_of(c[0]), srgb_of(c[1]), srgb_of(c[2]), 255);
      }
    assert_true(struts > 8);
    free_picture(&got);
  }
  msq_model_release(model);
  msq_context_release(context);
}

/* Edges of a box through the middle of pixels cover half of their samples, corners a quarter. */
static void samples_cover_pixels_evenly(void** state) {
  const double box[1][6] = {{-1.25, -1.25, 0, 1.25, 1.25, 1}};
  msq_context* context = make_context();
  msq_model* model = make_boxes(context, box, 1);
  msq_render_def def = render_def(8, 8);
  const msq_camera camera = from_above(0, 0); /* pixels of 0.5 */
  const double white[3] = {1, 1, 1};
  (void)state;
  def.ambient = 1;
  def.colours = white;
  def.colour_count = 1;
  for (uint32_t samples = 2; samples <= 16; samples *= 2) {
    def.samples = samples;
    def.background[3] = 0;
    picture got = rendered(model, &camera, &def);
    assert_rgba(&got, 0, 0, 0, 0, 0, 0);
    assert_rgba(&got, 1, 3, 255, 255, 255, 128);
    assert_rgba(&got, 6, 4, 255, 255, 255, 128);
    assert_rgba(&got, 3, 1, 255, 255, 255, 128);
    assert_rgba(&got, 4, 6, 255, 255, 255, 128);
    assert_rgba(&got, 1, 1, 255, 255, 255, 64);
    assert_rgba(&got, 6, 6, 255, 255, 255, 64);
    assert_rgba(&got, 2, 5, 255, 255, 255, 255);
    free_picture(&got);
    /* Light adds up, not bytes. */
    def.background[3] = 1;
    got = rendered(model, &camera, &def);
    assert_rgba(&got, 0, 0, 0, 0, 0, 255);
    assert_rgba(&got, 1, 3, srgb_of(0.5), srgb_of(0.5), srgb_of(0.5), 255);
    assert_rgba(&got, 1, 6, srgb_of(0.25), srgb_of(0.25), srgb_of(0.25), 255);
    free_picture(&got);
  }
  def.samples = 1;
  const double green[4] = {0, 0.75, 0, 0.5};
  memcpy(def.background, green, sizeof green);
  picture got = rendered(model, &camera, &def);
  assert_rgba(&got, 0, 0, 0, srgb_of(0.75), 0, 128);
  free_picture(&got);
  msq_model_release(model);
  msq_context_release(context);
}

/* ---- light ------------------------------------------------------------------------------- */

/* A floor with its top at z = 1 and a block over it, at z 2 to 3. */
static const double floor_and_block[2][6] = {{0, 0, 0, 4, 4, 1}, {1.5, 1.5, 2, 2.5, 2.5, 3}};

enum { pixels = 40 }; /* of 0.1 */

/* White, the light at 45 degrees from the right. */
static msq_render_def lit_def(void) {
  static const double white[3] = {1, 1, 1};
  msq_render_def def = render_def(pixels, pixels);
  def.colours = white;
  def.colour_count = 1;
  def.light[0] = 2;
  def.light[1] = 0;
  def.light[2] = 2;
  def.ambient = 0.25;
  return def;
}

static void assert_grey(const picture* got, uint32_t i, uint32_t j, double linear) {
  const int byte = srgb_of(linear);
  assert_rgba(got, i, j, byte, byte, byte, 255);
}

static void casts_shadows(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_boxes(context, floor_and_block, 2);
  msq_camera camera = from_above(2, 2);
  msq_render_def def = lit_def();
  const double lit = 0.25 + 0.75 * sqrt(0.5);
  (void)state;
  for (int32_t shadows = 0; shadows < 2; ++shadows) {
    def.shadows = shadows;
    picture got = rendered(model, &camera, &def);
    for (uint32_t j = 0; j < pixels; ++j)
      for (uint32_t i = 0; i < pixels; ++i) {
        /* The block's shadow falls one to two units to the left of it. */
        const int is_dark = shadows && i < 15 && j >= 15 && j < 25;
        assert_grey(&got, i, j, is_dark ? 0.25 : lit);
      }
    free_picture(&got);
  }
  /* What is cut away casts none, be it a part of the block or all of it; and cut faces are lit. */
  camera.clip_near = 7.875;
  picture got = rendered(model, &camera, &def);
  assert_true(got.frame.depth[20 * pixels + 20] == 7.875f);
  assert_true(got.frame.normal[3 * (20 * pixels + 20) + 2] == 1);
  assert_grey(&got, 20, 20, lit);
  assert_grey(&got, 7, 20, 0.25);
  assert_grey(&got, 2, 20, lit); /* before, by the upper part of the block */
  free_picture(&got);
  /* Also where the eye is so far away that what is above the cut has the same depth. */
  camera.eye[2] = 0x1p34;
  camera.clip_near = 0x1p34 - 2.5;
  got = rendered(model, &camera, &def);
  assert_grey(&got, 20, 20, lit);
  assert_grey(&got, 7, 20, 0.25);
  free_picture(&got);
  camera.eye[2] = 10;
  camera.clip_near = 8.5;
  got = rendered(model, &camera, &def);
  for (uint32_t i = 0; i < pixels; ++i) assert_grey(&got, i, 20, lit);
  free_picture(&got);
  msq_model_release(model);
  msq_context_release(context);
}

/* Light from below leaves what faces the camera to the ambient light. */
static void leaves_what_faces_away_in_the_dark(void** state) {
  msq_context* context = make_context();
  msq_model* model = make_boxes(context, floor_and_block, 2);
  const msq_camera camera = from_above(2, 2);
  msq_render_def def = lit_def();
  (void)state;
  def.light[2] = -2;
  def.shadows = 1;
  picture got = rendered(model, &camera, &def);
  for (uint32_t i = 0; i < pixels; ++i) assert_grey(&got, i, 20, 0.25);
  free_picture(&got);
  msq_model_release(model);
  msq_context_release(context);
}

static int grey_at(const picture* got, uint32_t i, uint32_t j) {
  return got->frame.rgba[4 * (j * pixels + i)];
}

static void darkens_what_is_closed_in(void** state) {
  /* A floor, and a wall on it from x = 2 on. */
  const double boxes[2][6] = {{0, 0, 0, 4, 4, 1}, {2, 0, 0.5, 4, 4, 5}};
  msq_context* context = make_context();
  msq_model* model = make_boxes(context, boxes, 2);
  const msq_camera camera = from_above(2, 2);
  msq_render_def def = lit_def();
  (void)state;
  def.ambient = 1;
  def.occlusion_rays = 256;
  def.occlusion_distance = 1;
  picture got = rendered(model, &camera, &def);
  for (uint32_t j = 12; j < 28; ++j) {
    assert_grey(&got, 5, j, 1);  /* farther from the wall than rays reach */
    assert_grey(&got, 30, j, 1); /* on it */
    /* Next to it, half of what is around. */
    assert_in_range(grey_at(&got, 19, j), srgb_of(0.48), srgb_of(0.58));
    assert_true(grey_at(&got, 15, j) > grey_at(&got, 19, j) && grey_at(&got, 15, j) < 255);
  }
  free_picture(&got);
  msq_model_release(model);

  /* Nothing is in front of a ball, and no ray from its surface meets it. */
  model = make_ball(context);
  msq_camera around = from_above(0, 0);
  around.height = 2.2;
  def.ambient = 0.5;
  def.shadows = 1;
  def.occlusion_distance = 0;
  def.occlusion_rays = 16;
  picture closed = rendered(model, &around, &def);
  def.occlusion_rays = 0;
  def.shadows = 0;
  picture open = rendered(model, &around, &def);
  assert_same_picture(&closed, &open);
  free_picture(&open);
  free_picture(&closed);
  msq_model_release(model);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(shows_a_ball_where_it_is),
      cmocka_unit_test(loses_no_accuracy_from_afar),
      cmocka_unit_test(colours_by_what_is_hit),
      cmocka_unit_test(samples_cover_pixels_evenly),
      cmocka_unit_test(casts_shadows),
      cmocka_unit_test(leaves_what_faces_away_in_the_dark),
      cmocka_unit_test(darkens_what_is_closed_in),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
