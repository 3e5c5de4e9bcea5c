// SPDX-License-Identifier: Apache-2.0
// Layers turned and mirrored, as the panels of printers are mounted.
#pragma once

#include <cstdint>

#include "base/parallel.h"

namespace msq {

/// Pixel (i, j) of the result is pixel (u, v) of the plan: mirrored indices first, (i, j) to
/// (width - 1 - i, height - 1 - j) of the result as far as said, then exchanged if transposed.
struct Orientation {
  bool mirror_x = false, mirror_y = false, transpose = false;

  bool is_plain() const { return !mirror_x && !mirror_y && !transpose; }
};

/// Rows [begin, end) of the plan, `rows`. Calls for bands of rows, the first of which begins at 0,
/// write a whole layer. `pixel_bytes`: 0, 1 or 4, 0 being bits with the leftmost pixel in the high
/// bit. `width`, `height`: of the plan. Rows of both are layer_stride() apart; bytes past the width
/// of the result become 0.
void orient_rows(const Orientation& orientation, unsigned pixel_bytes, const uint8_t* rows,
                 uint64_t begin, uint64_t end, uint64_t width, uint64_t height, uint8_t* out,
                 const Executor& executor);

}  // namespace msq
