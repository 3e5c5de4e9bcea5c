/* SPDX-License-Identifier: Apache-2.0
 * Grey layers against a rasteriser that is not ours: FreeType fills the contours of the layer and
 * computes the area that they cover in each pixel. */
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include "layers.h"

enum { width = 128, height = 96, max_points = 32767, samples = 16 };

static uint8_t covered[height][width];

/* The area of each pixel that the contours of a layer cover, 0 to 255. */
static void fill(FT_Library library, const msq_slicer* slicer, uint64_t layer) {
  const msq_slicer_report plan = plan_of(slicer);
  msq_contours_def def;
  msq_contours* contours;
  msq_contours_report rings;
  FT_Outline outline;
  FT_Bitmap bitmap;
  assert_ok(msq_contours_def_init(&def, sizeof def));
  def.tolerance = plan.pitch[0] / 64;
  def.pitch = plan.pitch[0] / 8;
  assert_ok(msq_slicer_contours(slicer, layer, &def, &contours, NULL));
  memset(&rings, 0, sizeof rings);
  rings.struct_size = sizeof rings;
  assert_ok(msq_contours_info(contours, &rings));
  assert_in_range(rings.point_count, 100, max_points);
  assert_in_range(rings.ring_count, 1, max_points);
  const double* const at = (const double*)rings.points;
  assert_int_equal(
      FT_Outline_New(library, (FT_UInt)rings.point_count, (FT_Int)rings.ring_count, &outline), 0);
  /* 26.6 fixed-point numbers in pixels, from the lower left corner. */
  for (uint64_t i = 0; i < rings.point_count; ++i) {
    outline.points[i].x = lround(64 * (at[2 * i] - plan.origin[0]) / plan.pitch[0] + 32);
    outline.points[i].y = lround(64 * (at[2 * i + 1] - plan.origin[1]) / plan.pitch[1] + 32);
    outline.tags[i] = 1; /* on the curve */
  }
  for (uint64_t i = 0; i < rings.ring_count; ++i)
    outline.contours[i] = (short)(rings.starts[i + 1] - 1);
  outline.flags |= FT_OUTLINE_EVEN_ODD_FILL;
  memset(covered, 0, sizeof covered);
  memset(&bitmap, 0, sizeof bitmap);
  bitmap.rows = height;
  bitmap.width = width;
  bitmap.pitch = -(int)width; /* rows upwards, as those of layers */
  bitmap.buffer = covered[0];
  bitmap.num_grays = 256;
  bitmap.pixel_mode = FT_PIXEL_MODE_GRAY;
  assert_int_equal(FT_Outline_Get_Bitmap(library, &outline, &bitmap), 0);
  assert_int_equal(FT_Outline_Done(library, &outline), 0);
  msq_contours_release(contours);
}

/* The samples of a pixel differ from the area by at most half a row and half a column of samples
 * for each edge through the pixel, 1/16 of the pixel together; mostly by far less. Contours are
 * within 1/64 pixel of the boundary, and FreeType's points have 1/64 pixel. */
static void compare(msq_context* context, msq_structure* structure) {
  msq_slicer_def def = slicer_def(MSQ_LAYER_GREY, width, height, 0.7);
  FT_Library library;
  def.grey_samples = samples;
  msq_shape* shape;
  const double center[3] = {1.1, 0.9, 1};
  assert_ok(msq_shape_from_sphere(context, center, 0.83, &shape));
  msq_model* model = make_model(context, shape, structure, NULL);
  msq_slicer* slicer = make_slicer(model, &def);
  const msq_slicer_report plan = plan_of(slicer);
  uint8_t* const grey = (uint8_t*)malloc(plan.layer_bytes);
  assert_non_null(grey);
  assert_int_equal(FT_Init_FreeType(&library), 0);
  for (uint64_t layer = 0; layer < 2; ++layer) {
    double squares = 0, sums[2] = {0, 0};
    int most = 0, between = 0;
    fill(library, slicer, layer);
    assert_ok(msq_slice_layer(slicer, layer, grey, plan.layer_bytes, NULL));
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i) {
        const int ours = grey[(uint64_t)j * plan.stride + (uint64_t)i], theirs = covered[j][i];
        const int apart = abs(ours - theirs);
        most = apart > most ? apart : most;
        between += ours > 0 && ours < 255;
        squares += apart * apart;
        sums[0] += ours;
        sums[1] += theirs;
      }
    print_message("%d grey pixels, %d of 255 apart at most, rms %.2f, sums %.0f and %.0f\n",
                  between, most, sqrt(squares / between), sums[0], sums[1]);
    assert_true(between > 300);
    assert_in_range(most, 0, 255 / samples);
    assert_true(squares < 2.5 * 2.5 * between);
    assert_near(sums[0], sums[1], 2e-3 * sums[1]);
  }
  FT_Done_FreeType(library);
  free(grey);
  msq_slicer_release(slicer);
  msq_model_release(model);
}

static void foams_cover_what_freetype_fills(void** state) {
  (void)state;
  msq_context* context = make_context();
  msq_foam_def def;
  msq_structure* foam;
  assert_ok(msq_foam_def_init(&def, sizeof def));
  set_cell(&def.grid, 0.4);
  def.radius.value = 0.06;
  assert_ok(msq_structure_foam(context, &def, &foam));
  compare(context, foam);
  def.radius.value = 0;
  def.wall_thickness.value = 0.07;
  assert_ok(msq_structure_foam(context, &def, &foam));
  compare(context, foam);
  msq_context_release(context);
}

static void lattices_cover_what_freetype_fills(void** state) {
  (void)state;
  msq_context* context = make_context();
  compare(context, make_lattice_of(context, MSQ_UNIT_CELL_OCTET, 0.6, 0.06));
  msq_context_release(context);
}

static void functions_cover_what_freetype_fills(void** state) {
  (void)state;
  msq_context* context = make_context();
  msq_functional_def def;
  msq_structure* gyroid;
  assert_ok(msq_functional_def_init(&def, sizeof def));
  set_cell(&def.grid, 0.5);
  def.kind = MSQ_FUNCTIONAL_SHEET;
  def.level.value = 0.4;
  assert_ok(msq_structure_functional(context, &def, &gyroid));
  compare(context, gyroid);
  msq_context_release(context);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(foams_cover_what_freetype_fills),
      cmocka_unit_test(lattices_cover_what_freetype_fills),
      cmocka_unit_test(functions_cover_what_freetype_fills),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
