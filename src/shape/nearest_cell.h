// SPDX-License-Identifier: Apache-2.0
// The distance from a point to the nearest wanted cell of an image. Branch and bound over the
// image's pyramid, the nearest octant first.
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

  /// Infinite if no cell is wanted.
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

  /// Up to a leaf's cells along an axis, the nearest first.
  struct Order {
    uint64_t cell[1 << ImageBounds::leaf_bits];
    size_t count = 0;
  };
  Order nearest_first(uint64_t low, uint64_t high, int axis) const {
    Order order;
    const double at = g_[axis] / image_.frame().spacing[axis] - 0.5;
    const auto off = [&](uint64_t cell) { return std::abs(static_cast<double>(cell) - at); };
    for (uint64_t cell = low; cell < high; ++cell) {
      size_t place = order.count++;
      for (; place > 0 && off(cell) < off(order.cell[place - 1]); --place)
        order.cell[place] = order.cell[place - 1];
      order.cell[place] = cell;
    }
    return order;
  }

  void search_cells(const uint64_t (&low)[3], const uint64_t (&high)[3]) {
    const Order x = nearest_first(low[0], high[0], 0), y = nearest_first(low[1], high[1], 1),
                z = nearest_first(low[2], high[2], 2);
    for (size_t c = 0; c < z.count; ++c)
      for (size_t b = 0; b < y.count; ++b)
        for (size_t a = 0; a < x.count; ++a) {
          const uint64_t i = x.cell[a], j = y.cell[b], k = z.cell[c];
          const double squared = distance_squared({i, j, k}, {i + 1, j + 1, k + 1});
          if (!(squared < best_)) break;  // the following cells of the row are not nearer either
          if (wanted_(image_.samples_of({{i, j, k}, {i, j, k}}))) best_ = squared;
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
