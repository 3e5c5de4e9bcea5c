// SPDX-License-Identifier: Apache-2.0
// An order of points in which neighbours lie close together: along Morton's curve, the bits of
// their coordinates interleaved.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace msq {

class PointOrder {
 public:
  static constexpr uint64_t bytes_of_point = 2 * sizeof(uint64_t);

  /// The numbers of the points in that order, valid until the next call. Any finite points; at most
  /// 2^32.
  std::span<const uint64_t> sort(std::span<const Vec3> points);

 private:
  std::vector<uint64_t> keyed_, sorted_;
};

}  // namespace msq
