// SPDX-License-Identifier: Apache-2.0
// The least and the greatest sample of the parts of an image, in a pyramid.
//
// A cell is what eight neighbouring samples bound; blocks of 4x4x4 cells, samples on their faces
// included, are the leaves, and 2x2x2 blocks make one of the next level. Bounds are kept in single
// precision, rounded outwards: 8 bytes for 64 samples.
#pragma once

#include <cstdint>
#include <vector>

#include "base/interval.h"

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
  /// Of size[0] * size[1] * size[2] samples without gaps, x fastest.
  template <class T>
  ImageBounds(const T* values, const uint64_t (&size)[3]);

  /// Encloses the samples of the cells; at most twice too wide a part of them is looked at.
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
