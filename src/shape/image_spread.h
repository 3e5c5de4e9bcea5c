// SPDX-License-Identifier: Apache-2.0
// The range of some samples of an image, and the differences of neighbours.
#pragma once

#include <cstdint>

#include "base/interval.h"
#include "base/vec.h"

namespace msq {

struct ImageSpread {
  Interval range;
  /// Along each axis the least and the greatest difference of neighbours; 0 for a single sample.
  Box3 slopes;

  Vec3 steepest() const { return max(slopes.max, slopes.min * -1); }
};

/// Of count[0] x count[1] x count[2] samples from `first` on, rows `dy` and layers `dz` apart, x
/// fastest. Differences are taken in double precision.
ImageSpread spread_of(const uint8_t* first, const uint64_t (&count)[3], uint64_t dy, uint64_t dz);
ImageSpread spread_of(const int16_t* first, const uint64_t (&count)[3], uint64_t dy, uint64_t dz);
ImageSpread spread_of(const uint16_t* first, const uint64_t (&count)[3], uint64_t dy, uint64_t dz);
ImageSpread spread_of(const float* first, const uint64_t (&count)[3], uint64_t dy, uint64_t dz);
ImageSpread spread_of(const double* first, const uint64_t (&count)[3], uint64_t dy, uint64_t dz);

}  // namespace msq
