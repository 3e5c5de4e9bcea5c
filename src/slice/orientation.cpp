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

/// What is to be turned: rows of the plan, and where they go.
struct Turn {
  Orientation how;
  const uint8_t* rows;
  uint64_t stride, begin, end, width, height;
  uint8_t* out;
  uint64_t out_stride;

  const uint8_t* row(uint64_t v) const { return rows + (v - begin) * stride; }
};

void copy_rows(const Turn& turn, uint64_t first, uint64_t last) {
  for (uint64_t v = first; v < last; ++v)
    std::memcpy(turn.out + (turn.how.mirror_y ? turn.height - 1 - v : v) * turn.out_stride,
                turn.row(v), turn.out_stride);
}

template <class Pixels>
void mirror_rows(const Turn& turn, uint64_t first, uint64_t last) {
  for (uint64_t v = first; v < last; ++v) {
    uint8_t* row = turn.out + (turn.how.mirror_y ? turn.height - 1 - v : v) * turn.out_stride;
    std::memset(row, 0, turn.out_stride);
    for (uint64_t u = 0; u < turn.width; ++u)
      Pixels::set(row, turn.width - 1 - u, Pixels::get(turn.row(v), u));
  }
}

/// Rows [first, last) of the result, the columns that rows of the plan become.
template <class Pixels>
void transpose_rows(const Turn& turn, uint64_t first, uint64_t last) {
  if (turn.begin == 0)
    std::memset(turn.out + first * turn.out_stride, 0, (last - first) * turn.out_stride);
  // Columns of the result outside, so that reads of the plan stay in one of its rows.
  for (uint64_t v = turn.begin; v < turn.end; ++v) {
    const uint64_t i = turn.how.mirror_x ? turn.height - 1 - v : v;
    for (uint64_t j = first; j < last; ++j) {
      const uint64_t u = turn.how.mirror_y ? turn.width - 1 - j : j;
      Pixels::set(turn.out + j * turn.out_stride, i, Pixels::get(turn.row(v), u));
    }
  }
}

template <class Pixels>
void orient(const Turn& turn, const Executor& executor) {
  const bool is_transposed = turn.how.transpose;
  const uint64_t first = is_transposed ? 0 : turn.begin;
  const uint64_t last = is_transposed ? turn.width : turn.end;
  executor.for_each((last - first + strip_rows - 1) / strip_rows, [&](uint64_t strip) {
    const uint64_t begin = first + strip * strip_rows, end = std::min(last, begin + strip_rows);
    if (is_transposed) return transpose_rows<Pixels>(turn, begin, end);
    if (turn.how.mirror_x) return mirror_rows<Pixels>(turn, begin, end);
    copy_rows(turn, begin, end);
  });
}

}  // namespace

void orient_rows(const Orientation& orientation, unsigned pixel_bytes, const uint8_t* rows,
                 uint64_t begin, uint64_t end, uint64_t width, uint64_t height, uint8_t* out,
                 const Executor& executor) {
  Turn turn{orientation, rows, layer_stride(pixel_bytes, width), begin, end, width, height, out, 0};
  turn.out_stride = layer_stride(pixel_bytes, orientation.transpose ? height : width);
  const auto run = pixel_bytes == 0   ? orient<BitPixels>
                   : pixel_bytes == 1 ? orient<ValuePixels<uint8_t>>
                                      : orient<ValuePixels<uint32_t>>;
  run(turn, executor);
}

}  // namespace msq
