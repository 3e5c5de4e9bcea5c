/* SPDX-License-Identifier: Apache-2.0
 * An image that the tests of voxels and of grid fields share. */
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

#endif
