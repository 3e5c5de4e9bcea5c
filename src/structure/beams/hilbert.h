// SPDX-License-Identifier: Apache-2.0
// Positions along a curve that fills a cube: neighbours on the curve lie close together.
// Source: Skilling, "Programming the Hilbert curve", 2004.
#pragma once

#include <cstdint>

namespace msq {

/// Position along the curve of cell (x, y, z) of a cube with 2^bits cells per side; bits from 1 to
/// 21.
inline uint64_t hilbert_index(uint32_t x, uint32_t y, uint32_t z, unsigned bits) {
  uint32_t c[3] = {x, y, z};
  for (uint32_t q = uint32_t{1} << (bits - 1); q > 1; q >>= 1) {
    const uint32_t below = q - 1;
    for (uint32_t& component : c) {
      // Inverts the first component's lower bits, or exchanges them with this one's.
      const uint32_t is_set = component & q ? ~uint32_t{0} : 0;
      const uint32_t exchanged = (c[0] ^ component) & below & ~is_set;
      c[0] ^= (below & is_set) | exchanged;
      component ^= exchanged;
    }
  }
  c[1] ^= c[0];
  c[2] ^= c[1];
  uint32_t turned = 0;
  for (uint32_t q = uint32_t{1} << (bits - 1); q > 1; q >>= 1)
    if (c[2] & q) turned ^= q - 1;
  uint64_t index = 0;
  for (unsigned bit = bits; bit-- > 0;)
    for (const uint32_t component : c) index = index << 1 | ((component ^ turned) >> bit & 1);
  return index;
}

}  // namespace msq
