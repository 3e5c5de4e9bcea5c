// SPDX-License-Identifier: Apache-2.0
// PNG streams in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline.h"

namespace msq_io {

/// Rows of an image as PNG has them before compression: each begins with the byte of its filter, 0.
struct PngRows {
  uint32_t width, height;
  /// 1 or 8.
  uint32_t depth;
  /// 1, 3 or 4.
  uint32_t channels;

  /// Bytes of a row with its filter.
  uint64_t row_bytes() const { return (uint64_t{width} * depth * channels + 7) / 8 + 1; }
  uint64_t bytes() const { return row_bytes() * height; }
};

/// Compresses rows to a stream with the level of msq_io_png_def.
void encode_png(const PngRows& image, const std::vector<uint8_t>& rows, int level,
                std::vector<uint8_t>& stream);

/// By libpng, with a level of zlib. is_layer: layers are mostly runs; other pictures get filters.
void encode_by_libpng(const PngRows& image, const std::vector<uint8_t>& rows, int level,
                      bool is_layer, std::vector<uint8_t>& stream);

/// By ISA-L. Returns false in a build without it.
bool encode_fast(const PngRows& image, const std::vector<uint8_t>& rows,
                 std::vector<uint8_t>& stream);

/// Begins the file that a zlib stream is appended to: signature and header, and the chunk of
/// pixels, whose place it returns.
size_t begin_png(const PngRows& image, std::vector<uint8_t>& stream);
/// Ends the chunk and the file. crc: as crc32_gzip_refl of ISA-L.
void end_png(size_t chunk, uint32_t (*crc)(uint32_t, const unsigned char*, uint64_t),
             std::vector<uint8_t>& stream);

/// Copies pixels to rows. Fails with LIMIT if that are 2^31 bytes or more.
void copy_rows(const PngRows& image, const uint8_t* pixels, uint64_t stride,
               std::vector<uint8_t>& rows);

/// Copies an output of pixels to the input of the packet. Fails if it is of another kind.
PngRows take_pixels(const msq_output& output, bool takes_bits, Packet& packet);

}  // namespace msq_io
