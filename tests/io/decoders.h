/* SPDX-License-Identifier: Apache-2.0
 * Programs of others that read PNG. */
#ifndef IO_DECODERS_H
#define IO_DECODERS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct decoded {
  uint32_t width, height, depth, channels;
  uint8_t* pixels; /* 8 bits per channel, of 1-bit images 0 or 255; to be freed */
} decoded;

typedef struct decoder {
  const char* name;
  int (*decode)(const uint8_t* bytes, size_t size, decoded* image); /* 0: success */
} decoder;

/* libpng, and libspng and lodepng where they are found. */
extern const decoder decoders[];
extern const size_t decoder_count;

#ifdef __cplusplus
}
#endif

#endif
