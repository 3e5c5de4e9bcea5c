/* SPDX-License-Identifier: Apache-2.0 */
#define _POSIX_C_SOURCE 200809L
#include "png_image.h"

#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <zlib.h>

/* In place of libpng's own, which print. */
static void on_error(png_structp png, png_const_charp message) {
  (void)message;
  png_longjmp(png, 1);
}
static void on_warning(png_structp png, png_const_charp message) {
  (void)png;
  (void)message;
}

static void write_rows(png_structp png, png_infop info, const picture* image) {
  const int colour = image->kind == PICTURE_RGB ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY;
  png_set_IHDR(png, info, image->width, image->height, image->kind == PICTURE_BITS ? 1 : 8, colour,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (image->kind == PICTURE_BITS) {
    /* Layers are many and mostly runs: the search for longer matches costs more than it saves. */
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_set_compression_level(png, 1);
    png_set_compression_strategy(png, Z_RLE);
  }
  png_write_info(png, info);
  for (uint32_t y = 0; y < image->height; ++y) {
    const size_t row = image->bottom_up ? image->height - 1 - y : y;
    png_write_row(png, image->data + row * image->stride);
  }
  png_write_end(png, info);
}

/* Keeps setjmp away from the locals of its caller. Returns 0 or an errno value. */
static int write_stream(FILE* file, const picture* image) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, on_error, on_warning);
  if (!png) return ENOMEM;
  png_infop info = png_create_info_struct(png);
  if (!info) {
    png_destroy_write_struct(&png, NULL);
    return ENOMEM;
  }
  errno = 0;
  if (setjmp(png_jmpbuf(png))) {
    const int code = errno ? errno : EIO;
    png_destroy_write_struct(&png, &info);
    return code;
  }
  png_init_io(png, file);
  write_rows(png, info, image);
  png_destroy_write_struct(&png, &info);
  return 0;
}

int png_image_save(const char* path, const picture* image) {
  FILE* file = fopen(path, "wb");
  if (!file) return errno;
  const int code = write_stream(file, image);
  if (fclose(file) != 0 && code == 0) return errno; /* a full disk may show only now */
  return code;
}
