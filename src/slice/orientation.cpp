// SPDX-License-Identifier: Apache-2.0
#include "slice/orientation.h"

#include <algorithm>
#include <cstring>

#include "slice/layer_output.h"

namespace msq {

namespace {

constexpr uint64_t strip_rows = 64;

struct BitPixels {
  static bool get(const uint8_t* row, uint64_t i) { return row[i / 8] >> (7 - i % 8) & 1; }
  static void set(uint8_t* row, uint64_t i, bool value) {
    row[i / 8] = static_cast<uint8_t>(row[i / 8] | unsigned{value} << (7 - i % 8));
  }
};

template <class Value>
struct ValuePixels {
  static Value get(const uint8_t* row, uint64_t i) {
    Value value;
    std::memcpy(&value, row + i * sizeof value, sizeof value);
    return value;
  }
  static void set(uint8_t* row, uint64_t i, Value value) {
    std::memcpy(row + i * sizeof value, &value, sizeof value);
  }
};

template <class Pixels>
void orient(const Orientation& how, const uint8_t* plan, uint64_t plan_stride, uint64_t width,
            uint64_t height, uint8_t* out, uint64_t out_stride, const Executor& executor) {
  const uint64_t out_width = how.transpose ? height : width;
  const uint64_t out_height = how.transpose ? width : height;
  executor.for_each((out_height + strip_rows - 1) / strip_rows, [&](uint64_t strip) {
    const uint64_t first = strip * strip_rows, last = std::min(out_height, first + strip_rows);
    if (!how.transpose && !how.mirror_x) {
      for (uint64_t j = first; j < last; ++j) {
        const uint64_t v = how.mirror_y ? out_height - 1 - j : j;
        std::memcpy(out + j * out_stride, plan + v * plan_stride, out_stride);
      }
      return;
    }
    std::memset(out + first * out_stride, 0, (last - first) * out_stride);
    // Columns of the result outside, so that reads of a transposed plan stay in one of its rows.
    for (uint64_t i = 0; i < out_width; ++i) {
      const uint64_t u = how.mirror_x ? out_width - 1 - i : i;
      for (uint64_t j = first; j < last; ++j) {
        const uint64_t v = how.mirror_y ? out_height - 1 - j : j;
        const auto pixel = how.transpose ? Pixels::get(plan + u * plan_stride, v)
                                         : Pixels::get(plan + v * plan_stride, u);
        Pixels::set(out + j * out_stride, i, pixel);
      }
    }
  });
}

}  // namespace

void orient_layer(const Orientation& orientation, unsigned pixel_bytes, const uint8_t* plan,
                  uint64_t width, uint64_t height, uint8_t* out, const Executor& executor) {
  const uint64_t from = layer_stride(pixel_bytes, width);
  const uint64_t to = layer_stride(pixel_bytes, orientation.transpose ? height : width);
  const auto run = pixel_bytes == 0   ? orient<BitPixels>
                   : pixel_bytes == 1 ? orient<ValuePixels<uint8_t>>
                                      : orient<ValuePixels<uint32_t>>;
  run(orientation, plan, from, width, height, out, to, executor);
}

}  // namespace msq
