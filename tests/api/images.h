/* SPDX-License-Identifier: Apache-2.0
 * What msq.h promises of an image, whatever it is for. */
#ifndef IMAGES_H
#define IMAGES_H

#include "fields.h"

enum { image_side = 3 };

/* 3 x 3 x 3 bytes, 9 times the index; 0.5 apart from (1, 0, 0) on. */
static inline msq_image small_image(void) {
  static uint8_t values[27];
  msq_image image;
  msq_grid_field_def def;
  for (int i = 0; i < 27; ++i) values[i] = (uint8_t)(9 * i);
  assert_ok(msq_grid_field_def_init(&def, sizeof def));
  image = def.image;
  image.values = values;
  image.value_type = MSQ_UINT8;
  for (int axis = 0; axis < 3; ++axis) {
    image.size[axis] = image_side;
    image.grid.cell_size[axis] = 0.5;
  }
  image.grid.origin[0] = 1;
  return image;
}

/* Makes something of the image and releases it; what fails makes nothing. */
typedef msq_status (*use_image_fn)(msq_context* context, const msq_image* image);

static inline void assert_image_refused(msq_context* context, use_image_fn use,
                                        const msq_image* image, const char* text) {
  assert_refused(use(context, image), MSQ_E_ARGUMENT, text);
}

/* Every way in which an image can be wrong, for a user that takes min_size values and more along
 * an axis. */
static inline void check_bad_images(use_image_fn use, uint64_t min_size) {
  msq_context* context = make_context();
  const uint64_t held = memory_of(context).bytes;
  const msq_image good = small_image();
  msq_image image = good;
  assert_ok(use(context, &image));

  image.values = NULL;
  assert_image_refused(context, use, &image, "image.values is NULL");
  image = good;
  for (int type = -1; type <= 6; type += 7) {
    image.value_type = type;
    assert_image_refused(context, use, &image, "value_type");
  }
  image.value_type = 0; /* the default */
  assert_image_refused(context, use, &image, "value_type is 0");
  image = good;
  image.reserved = 1;
  assert_image_refused(context, use, &image, "reserved");
  for (int axis = 0; axis < 3; ++axis) {
    image = good;
    image.size[axis] = min_size - 1;
    assert_image_refused(context, use, &image, "image.size");
    image.size[axis] = ((uint64_t)1 << 20) + 1;
    assert_image_refused(context, use, &image, "1048577");
    image = good;
    image.grid.cell_size[axis] = 0;
    assert_image_refused(context, use, &image, "cell_size");
    image.grid.cell_size[axis] = NAN;
    assert_image_refused(context, use, &image, "cell_size");
    image.grid.cell_size[axis] = 9.5e-76;
    assert_image_refused(context, use, &image, "is 9.5e-76; it must be from 1e-75 to 1e75");
    image.grid.cell_size[axis] = 1.5e75;
    assert_image_refused(context, use, &image, "is 1.5e+75; it must be from 1e-75 to 1e75");
    image = good;
    image.grid.origin[axis] = INFINITY;
    assert_image_refused(context, use, &image, "origin");
  }
  image = good;
  image.grid.rotation[1] = 0.5;
  assert_image_refused(context, use, &image, "rotation");
  image = good;
  image.row_stride = 2;
  assert_image_refused(context, use, &image, "image.row_stride is 2");
  image = good;
  image.layer_stride = 8;
  assert_image_refused(context, use, &image, "image.layer_stride is 8");
  image.layer_stride = UINT64_MAX / 2;
  assert_status(use(context, &image), MSQ_E_LIMIT);

  float values[27] = {0};
  image = good;
  image.value_type = MSQ_FLOAT32;
  image.values = values;
  values[26] = 300;
  assert_ok(use(context, &image));
  values[14] = NAN;
  assert_image_refused(context, use, &image, "value (2, 1, 1) of the image");
  double wide[27] = {0};
  image.value_type = MSQ_FLOAT64;
  image.values = wide;
  wide[1] = 2e100;
  assert_image_refused(context, use, &image, "1e+100");
  assert_int_equal(memory_of(context).bytes, held);
  msq_context_release(context);

  /* What passes the memory limit is refused before it is taken. */
  context = make_context_of(1, 0, 20);
  image = good;
  assert_refused(use(context, &image), MSQ_E_LIMIT, "an image of");
  assert_int_equal(memory_of(context).bytes, 0);
  msq_context_release(context);
}

#endif
