// SPDX-License-Identifier: Apache-2.0
// The distance from a point to the nearest cell of an image whose samples are wanted: branch and
// bound over the image's pyramid, the nearest octant first.
#pragma once

#include <cmath>
#include <limits>

#include "shape/image.h"

namespace msq {

template <class Wanted>
class NearestCell {
 public:
  /// `g`: in model units along the image's axes, from its first sample.
  NearestCell(const Image& image, Vec3 g, Wanted& wanted) : image_(image), g_(g), wanted_(wanted) {}

  /// Infinite where no cell is wanted.
  double distance() {
    const auto& levels = image_.bounds().levels();
    const uint64_t root[3] = {0, 0, 0};
    search(levels.size() - 1, root);
    return std::sqrt(best_);
  }

 private:
  /// Squared, to the cells [low, high) along each axis.
  double distance_squared(const uint64_t (&low)[3], const uint64_t (&high)[3]) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double spacing = image_.frame().spacing[axis];
      const double gap = std::max({static_cast<double>(low[axis]) * spacing - g_[axis],
                                   g_[axis] - static_cast<double>(high[axis]) * spacing, 0.0});
      sum += gap * gap;
    }
    return sum;
  }

  void search(size_t level, const uint64_t (&block)[3]) {
    const ImageBounds::Level& blocks = image_.bounds().levels()[level];
    const unsigned bits = ImageBounds::leaf_bits + static_cast<unsigned>(level);
    uint64_t low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = block[axis] << bits;
      high[axis] = std::min((block[axis] + 1) << bits, image_.cells(axis));
    }
    if (!(distance_squared(low, high) < best_)) return;
    if (!wanted_(blocks.at(block[0], block[1], block[2]))) return;
    if (level == 0) return search_cells(low, high);
    const ImageBounds::Level& finer = image_.bounds().levels()[level - 1];
    unsigned nearest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double middle =
          static_cast<double>((2 * block[axis] + 1) << (bits - 1)) * image_.frame().spacing[axis];
      if (g_[axis] > middle) nearest |= 1u << axis;
    }
    for (const unsigned flip : {0u, 1u, 2u, 4u, 3u, 5u, 6u, 7u}) {
      uint64_t child[3];
      bool exists = true;
      for (int axis = 0; axis < 3; ++axis) {
        child[axis] = 2 * block[axis] + ((nearest ^ flip) >> axis & 1);
        exists = exists && child[axis] < finer.size[axis];
      }
      if (exists) search(level - 1, child);
    }
  }

  void search_cells(const uint64_t (&low)[3], const uint64_t (&high)[3]) {
    for (uint64_t k = low[2]; k < high[2]; ++k)
      for (uint64_t j = low[1]; j < high[1]; ++j)
        for (uint64_t i = low[0]; i < high[0]; ++i) {
          const double squared = distance_squared({i, j, k}, {i + 1, j + 1, k + 1});
          if (squared < best_ && wanted_(image_.samples_of({{i, j, k}, {i, j, k}})))
            best_ = squared;
        }
  }

  const Image& image_;
  const Vec3 g_;
  Wanted& wanted_;
  double best_ = std::numeric_limits<double>::infinity();
};

template <class Wanted>
double nearest_cell(const Image& image, Vec3 g, Wanted&& wanted) {
  return NearestCell<std::remove_reference_t<Wanted>>(image, g, wanted).distance();
}

}  // namespace msq
