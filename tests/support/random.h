// SPDX-License-Identifier: Apache-2.0
// Random numbers for tests: the same on every machine, unlike the distributions of <random>.
#pragma once

#include <random>

#include "base/vec.h"

namespace msq::test {

class Random {
 public:
  explicit Random(uint64_t seed) : engine_(seed) {}

  uint64_t bits() { return engine_(); }
  /// In [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  uint64_t below(uint64_t count) { return engine_() % count; }
  Vec3 in_box(const Box3& box) {
    const double x = between(box.min.x, box.max.x), y = between(box.min.y, box.max.y);
    return {x, y, between(box.min.z, box.max.z)};
  }
  /// Normal with mean 0 and variance about 1, good enough for directions.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += unit();
    return sum;
  }
  /// Of length 1.
  Vec3 direction() {
    for (;;) {
      const Vec3 d = in_box({{-1, -1, -1}, {1, 1, 1}});
      if (const double l = length(d); l > 0.1 && l < 1) return d * (1 / l);
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace msq::test
