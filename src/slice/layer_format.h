// SPDX-License-Identifier: Apache-2.0
// From the engine's bit rows to the host's.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "base/sample_grid.h"

namespace msq {

enum class LayerFormat : int32_t { bits = 1, bytes = 2 };

/// Bytes from one row to the next, a multiple of 8.
inline uint64_t layer_stride(LayerFormat format, uint64_t width) {
  return format == LayerFormat::bits ? words_for(width) * 8 : (width + 7) / 8 * 8;
}

/// Writes rows of one layer, tightly packed in words, as the host's bytes. Returns the number of
/// samples inside.
uint64_t write_layer(LayerFormat format, const uint64_t* words, uint64_t width, uint64_t height,
                     uint8_t* out);

}  // namespace msq
