// SPDX-License-Identifier: Apache-2.0
// The host's points: float or double, any stride.
#pragma once

#include <cstdint>
#include <cstring>

#include "base/simd.h"
#include "base/vec.h"

namespace msq {

struct PointArray {
  const unsigned char* data = nullptr;
  uint64_t count = 0;
  uint64_t stride = 0;  ///< bytes
  bool is_float32 = false;

  Vec3 at(uint64_t i) const {
    const unsigned char* p = data + i * stride;  // may be unaligned
    if (is_float32) {
      float v[3];
      std::memcpy(v, p, sizeof v);
      return {v[0], v[1], v[2]};
    }
    double v[3];
    std::memcpy(v, p, sizeof v);
    return {v[0], v[1], v[2]};
  }
  /// Prefetches a point's bytes, which at() will read soon.
  HWY_INLINE void prefetch(uint64_t i) const {
    const unsigned char* p = data + i * stride;
    hwy::Prefetch(p);
    hwy::Prefetch(p + (is_float32 ? sizeof(float[3]) : sizeof(double[3])) - 1);
  }
};

}  // namespace msq
