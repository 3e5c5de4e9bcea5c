/* SPDX-License-Identifier: Apache-2.0
 *
 * Writes pictures as PNG files with libpng. */
#ifndef MSQ_EXAMPLE_PNG_IMAGE_H
#define MSQ_EXAMPLE_PNG_IMAGE_H

#include <stddef.h>
#include <stdint.h>

typedef enum picture_kind {
  PICTURE_BITS, /* 1 bit a pixel, leftmost pixel in the high bit, 1 is white */
  PICTURE_GREY, /* 1 byte a pixel */
  PICTURE_RGB   /* 3 bytes a pixel */
} picture_kind;

typedef struct picture {
  picture_kind kind;
  uint32_t width, height;
  const uint8_t* data; /* height rows */
  size_t stride;       /* bytes from one row to the next */
  int bottom_up; /* 1: the first row of data is the lowest of the picture, as in msq's layers */
} picture;

/* Writes a picture. Returns 0, or what went wrong as a positive errno value. */
int png_image_save(const char* path, const picture* image);

#endif
