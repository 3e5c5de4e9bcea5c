// SPDX-License-Identifier: Apache-2.0
// The minimum and maximum sample of the parts of an image, in a pyramid.
//
// A cell lies between eight neighbouring samples. Leaves are blocks of 4x4x4 cells, including
// samples on their faces, and 2x2x2 blocks make one of the next level. Bounds are stored in single
// precision, rounded outwards: 8 bytes for 64 samples.
#pragma once

#include <cstdint>
#include <vector>

#include "base/interval.h"
#include "base/job.h"

namespace msq {

/// Cells low to high, both included, along each axis.
struct VoxelRange {
  uint64_t low[3], high[3];
};

class ImageBounds {
 public:
  static constexpr unsigned leaf_bits = 2;  ///< of the cells along a leaf

  struct Level {
    uint64_t size[3];  ///< blocks along each axis
    struct Bound {
      float low, high;
    };
    std::vector<Bound> bounds;

    Interval at(uint64_t x, uint64_t y, uint64_t z) const {
      const Bound& b = bounds[(z * size[1] + y) * size[0] + x];
      return {b.low, b.high};
    }
  };

  ImageBounds() = default;
  /// Takes size[0] * size[1] * size[2] contiguous samples, x fastest. Throws Error(cancelled) if
  /// the job, which may be null, is cancelled.
  template <class T>
  ImageBounds(const T* values, const uint64_t (&size)[3], const Job* job);

  /// Encloses the samples of the cells; may examine a part up to twice as wide.
  Interval over(const VoxelRange& cells) const;
  /// Finest first; the last has one block.
  const std::vector<Level>& levels() const { return levels_; }

  uint64_t bytes() const;
  static uint64_t bytes_for(const uint64_t (&size)[3]);

 private:
  void add_levels();

  std::vector<Level> levels_;
};

}  // namespace msq
