// SPDX-License-Identifier: Apache-2.0
#include "decoders.h"

#include <png.h>

#include <cstdlib>
#include <cstring>
#if MSQ_HAS_SPNG
#include <spng.h>
#endif
#if MSQ_HAS_LODEPNG
#include <lodepng.h>
#endif

namespace {

int by_libpng(const uint8_t* bytes, size_t size, decoded* image) {
  // The depth stands in the header; the simplified interface gives 8 bits.
  image->depth = bytes[24];
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes, size)) return 1;
  image->channels = PNG_IMAGE_SAMPLE_CHANNELS(png.format);
  image->width = png.width;
  image->height = png.height;
  image->pixels = static_cast<uint8_t*>(std::malloc(PNG_IMAGE_SIZE(png)));
  return png_image_finish_read(&png, nullptr, image->pixels, 0, nullptr) ? 0 : 1;
}

#if MSQ_HAS_SPNG
int by_libspng(const uint8_t* bytes, size_t size, decoded* image) {
  spng_ctx* context = spng_ctx_new(0);
  spng_ihdr header{};
  size_t room = 0;
  int code = spng_set_png_buffer(context, bytes, size);
  if (!code) code = spng_set_crc_action(context, SPNG_CRC_ERROR, SPNG_CRC_ERROR);
  if (!code) code = spng_get_ihdr(context, &header);
  const bool is_grey = header.color_type == SPNG_COLOR_TYPE_GRAYSCALE;
  const int format = is_grey                                          ? SPNG_FMT_G8
                     : header.color_type == SPNG_COLOR_TYPE_TRUECOLOR ? SPNG_FMT_RGB8
                                                                      : SPNG_FMT_RGBA8;
  if (!code) code = spng_decoded_image_size(context, format, &room);
  image->width = header.width;
  image->height = header.height;
  image->depth = header.bit_depth;
  image->channels = is_grey ? 1 : format == SPNG_FMT_RGB8 ? 3 : 4;
  if (!code) image->pixels = static_cast<uint8_t*>(std::malloc(room));
  if (!code) code = spng_decode_image(context, image->pixels, room, format, 0);
  spng_ctx_free(context);
  return code;
}
#endif

#if MSQ_HAS_LODEPNG
int by_lodepng(const uint8_t* bytes, size_t size, decoded* image) {
  lodepng::State state;
  unsigned width = 0, height = 0;
  if (lodepng_inspect(&width, &height, &state, bytes, size)) return 1;
  image->depth = state.info_png.color.bitdepth;
  image->channels = lodepng_get_channels(&state.info_png.color);
  state.info_raw.colortype = state.info_png.color.colortype;
  state.info_raw.bitdepth = 8;
  const unsigned code =
      lodepng_decode(&image->pixels, &image->width, &image->height, &state, bytes, size);
  return static_cast<int>(code);
}
#endif

}  // namespace

const decoder decoders[] = {
    {"libpng", by_libpng},
#if MSQ_HAS_SPNG
    {"libspng", by_libspng},
#endif
#if MSQ_HAS_LODEPNG
    {"lodepng", by_lodepng},
#endif
};
const size_t decoder_count = sizeof decoders / sizeof *decoders;
