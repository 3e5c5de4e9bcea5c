// SPDX-License-Identifier: Apache-2.0
#include "slice/layer_format.h"

namespace msq {

static_assert(std::endian::native == std::endian::little,
              "bit rows are written as bytes in the order of a little-endian word");

namespace {

/// Bits in reverse within each byte: sample 0 moves to the high bit of byte 0.
inline uint64_t reverse_bits_of_bytes(uint64_t v) {
  v = (v >> 1 & 0x5555555555555555) | (v & 0x5555555555555555) << 1;
  v = (v >> 2 & 0x3333333333333333) | (v & 0x3333333333333333) << 2;
  return (v >> 4 & 0x0f0f0f0f0f0f0f0f) | (v & 0x0f0f0f0f0f0f0f0f) << 4;
}

}  // namespace

uint64_t write_layer(LayerFormat format, const uint64_t* words, uint64_t width, uint64_t height,
                     uint8_t* out) {
  const size_t row_words = words_for(width), count = row_words * height;
  uint64_t inside = 0;
  for (size_t i = 0; i < count; ++i) inside += static_cast<uint64_t>(std::popcount(words[i]));
  if (format == LayerFormat::bits) {
    for (size_t i = 0; i < count; ++i) {
      const uint64_t reversed = reverse_bits_of_bytes(words[i]);
      std::memcpy(out + i * sizeof reversed, &reversed, sizeof reversed);
    }
    return inside;
  }
  const uint64_t stride = layer_stride(format, width);
  for (uint64_t j = 0; j < height; ++j) {
    const uint64_t* row = words + j * row_words;
    uint8_t* bytes = out + j * stride;
    for (uint64_t i = 0; i < stride; ++i)  // bits past the width are 0
      bytes[i] = (row[i / bits_per_word] >> (i % bits_per_word) & 1) ? 255 : 0;
  }
  return inside;
}

}  // namespace msq
