// SPDX-License-Identifier: Apache-2.0
#include "png_stream.h"

#include <png.h>
#include <zlib.h>

#include <cstdlib>
#include <cstring>

namespace msq_io {

namespace {

struct Sink {
  std::vector<uint8_t>* stream;
  bool is_out_of_memory;
};

// In place of libpng's own functions, which print.
void on_error(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}
void on_warning(png_structp, png_const_charp) {}

bool append(std::vector<uint8_t>& stream, const uint8_t* bytes, size_t size) noexcept {
  try {
    stream.insert(stream.end(), bytes, bytes + size);
    return true;
  } catch (...) {
    return false;
  }
}

/// For libpng, whose errors do not tell what is wrong.
png_voidp take_memory(png_structp png, png_alloc_size_t size) {
  void* const block = std::malloc(size);
  if (!block) static_cast<Sink*>(png_get_mem_ptr(png))->is_out_of_memory = true;
  return block;
}
void give_memory(png_structp, png_voidp block) {
  std::free(block);
}

// No exception passes through libpng.
void on_bytes(png_structp png, png_bytep bytes, size_t size) {
  auto* sink = static_cast<Sink*>(png_get_io_ptr(png));
  if (!append(*sink->stream, bytes, size)) {
    sink->is_out_of_memory = true;
    png_error(png, "out of memory");
  }
}
void on_flush(png_structp) {}

/// Without objects that longjmp would skip. Returns whether it succeeded.
bool write_image(png_structp png, png_infop info, const PngRows* image, const uint8_t* rows,
                 int level, bool is_layer) {
  if (setjmp(png_jmpbuf(png))) return false;
  // Sizes are checked by the callers.
  png_set_user_limits(png, 0x7fffffff, 0x7fffffff);
  const int colour = image->channels == 1   ? PNG_COLOR_TYPE_GRAY
                     : image->channels == 3 ? PNG_COLOR_TYPE_RGB
                                            : PNG_COLOR_TYPE_RGB_ALPHA;
  png_set_IHDR(png, info, image->width, image->height, static_cast<int>(image->depth), colour,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, level);
  if (is_layer) {
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    // At the first level the search for longer matches costs more than it saves.
    png_set_compression_strategy(png, level == 1 ? Z_RLE : Z_DEFAULT_STRATEGY);
  }
  png_write_info(png, info);
  const uint64_t row = image->row_bytes();
  for (uint64_t y = 0; y < image->height; ++y) png_write_row(png, rows + y * row + 1);
  png_write_end(png, info);
  return true;
}

void put_be32(uint8_t* to, uint32_t value) {
  for (int i = 0; i < 4; ++i) to[i] = static_cast<uint8_t>(value >> (24 - 8 * i));
}

void append_chunk(std::vector<uint8_t>& stream, const char* name, const uint8_t* bytes,
                  size_t size) {
  const size_t start = stream.size();
  stream.resize(start + size + 12);
  uint8_t* to = stream.data() + start;
  put_be32(to, static_cast<uint32_t>(size));
  std::memcpy(to + 4, name, 4);
  if (size > 0) std::memcpy(to + 8, bytes, size);
  put_be32(to + 8 + size, static_cast<uint32_t>(crc32_z(0, to + 4, size + 4)));
}

}  // namespace

size_t begin_png(const PngRows& image, std::vector<uint8_t>& stream) {
  static constexpr uint8_t signature[8] = {137, 80, 78, 71, 13, 10, 26, 10};
  stream.assign(signature, signature + sizeof signature);
  const int colour = image.channels == 1 ? 0 : image.channels == 3 ? 2 : 6;
  uint8_t header[13] = {};
  put_be32(header, image.width);
  put_be32(header + 4, image.height);
  header[8] = static_cast<uint8_t>(image.depth);
  header[9] = static_cast<uint8_t>(colour);
  append_chunk(stream, "IHDR", header, sizeof header);
  static constexpr uint8_t pixels[8] = {0, 0, 0, 0, 'I', 'D', 'A', 'T'};
  stream.insert(stream.end(), pixels, pixels + sizeof pixels);
  return stream.size() - sizeof pixels;
}

void end_png(size_t chunk, uint32_t (*crc)(uint32_t, const unsigned char*, uint64_t),
             std::vector<uint8_t>& stream) {
  const size_t size = stream.size() - chunk - 8;
  if (size > 0x7fffffff)
    fail(MSQ_E_LIMIT, "a picture of %zu compressed bytes; the limit is 2147483647", size);
  put_be32(stream.data() + chunk, static_cast<uint32_t>(size));
  uint8_t sum[4];
  put_be32(sum, crc(0, stream.data() + chunk + 4, size + 4));
  stream.insert(stream.end(), sum, sum + sizeof sum);
  append_chunk(stream, "IEND", nullptr, 0);
}

void encode_by_libpng(const PngRows& image, const std::vector<uint8_t>& rows, int level,
                      bool is_layer, std::vector<uint8_t>& stream) {
  stream.clear();
  Sink sink{&stream, false};
  png_structp png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning,
                                              &sink, take_memory, give_memory);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  bool is_written = false;
  if (info) {
    png_set_write_fn(png, &sink, on_bytes, on_flush);
    is_written = write_image(png, info, &image, rows.data(), level, is_layer);
  }
  png_destroy_write_struct(&png, &info);
  if (!info && !is_written && stream.empty()) throw std::bad_alloc();
  if (!is_written && sink.is_out_of_memory) throw std::bad_alloc();
  if (!is_written)
    fail(MSQ_E_INTERNAL, "libpng does not write %u x %u pixels", image.width, image.height);
}

void encode_png(const PngRows& image, const std::vector<uint8_t>& rows, int level,
                std::vector<uint8_t>& stream) {
  if (level == 0 && encode_fast(image, rows, stream)) return;
  encode_by_libpng(image, rows, level ? level : 1, true, stream);
}

void copy_rows(const PngRows& image, const uint8_t* pixels, uint64_t stride,
               std::vector<uint8_t>& rows) {
  const uint64_t row = image.row_bytes();
  if (image.width > 0x7fffffff || image.height > 0x7fffffff || image.bytes() > 0x7fffffff)
    fail(MSQ_E_LIMIT, "a picture of %u x %u pixels has %s bytes; the limit is 2147483647",
         image.width, image.height,
         // As a double: it may be more than 64 bits hold.
         text_of(static_cast<double>(row) * image.height, 15).c_str());
  rows.resize(image.bytes());
  for (uint64_t y = 0; y < image.height; ++y) {
    uint8_t* to = rows.data() + y * row;
    *to = 0;
    std::memcpy(to + 1, pixels + y * stride, row - 1);
  }
}

PngRows take_pixels(const msq_output& output, bool takes_bits, Packet& packet) {
  const bool is_bits = output.output == MSQ_LAYER_BITS;
  if (!(is_bits && takes_bits) && output.output != MSQ_LAYER_BYTES &&
      output.output != MSQ_LAYER_GREY)
    fail(MSQ_E_ARGUMENT, "the output of the layers is %d; it must be %s", output.output,
         takes_bits ? "MSQ_LAYER_BITS (1), BYTES (2) or GREY (3)"
                    : "MSQ_LAYER_BYTES (2) or GREY (3)");
  const PngRows image{packet.width, packet.height, is_bits ? 1u : 8u, 1};
  copy_rows(image, output.data, output.stride, packet.input);
  packet.bytes = packet.input.size();
  return image;
}

}  // namespace msq_io
