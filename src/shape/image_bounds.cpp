// SPDX-License-Identifier: Apache-2.0
#include "shape/image_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace msq {

namespace {

constexpr float float_infinity = std::numeric_limits<float>::infinity();

template <class T>
float rounded_down(T v) {
  const float f = static_cast<float>(v);
  if constexpr (!std::is_same_v<T, double>)
    return f;
  else
    return static_cast<double>(f) > v ? std::nextafter(f, -float_infinity) : f;
}

template <class T>
float rounded_up(T v) {
  const float f = static_cast<float>(v);
  if constexpr (!std::is_same_v<T, double>)
    return f;
  else
    return static_cast<double>(f) < v ? std::nextafter(f, float_infinity) : f;
}

uint64_t leaves(uint64_t samples) {
  const uint64_t cells = std::max<uint64_t>(samples, 2) - 1, side = 1 << ImageBounds::leaf_bits;
  return (cells + side - 1) / side;
}

void widen(ImageBounds::Level::Bound& bound, const ImageBounds::Level::Bound& by) {
  bound.low = std::min(bound.low, by.low);
  bound.high = std::max(bound.high, by.high);
}

}  // namespace

template <class T>
ImageBounds::ImageBounds(const T* values, const uint64_t (&size)[3], const Job* job) {
  constexpr uint64_t side = 1 << leaf_bits;
  Level leaf;
  for (int axis = 0; axis < 3; ++axis) leaf.size[axis] = leaves(size[axis]);
  leaf.bounds.assign(leaf.size[0] * leaf.size[1] * leaf.size[2], {float_infinity, -float_infinity});
  // A sample on the face between two leaves is in both.
  struct Two {
    uint64_t first, last;
  };
  const auto leaves_at = [&](uint64_t i, int axis) {
    return Two{i > 0 ? (i - 1) / side : 0, std::min(i / side, leaf.size[axis] - 1)};
  };
  std::vector<Level::Bound> row(leaf.size[0]);
  for (uint64_t k = 0; k < size[2]; ++k)
    for (uint64_t j = 0; j < size[1]; ++j) {
      check_cancelled(job);
      const T* v = values + (k * size[1] + j) * size[0];
      for (uint64_t b = 0; b < row.size(); ++b) {
        T low = v[b * side], high = low;
        for (uint64_t i = b * side + 1, end = std::min(b * side + side + 1, size[0]); i < end;
             ++i) {
          low = std::min(low, v[i]);
          high = std::max(high, v[i]);
        }
        row[b] = {rounded_down(low), rounded_up(high)};
      }
      const Two y = leaves_at(j, 1), z = leaves_at(k, 2);
      for (uint64_t bz = z.first; bz <= z.last; ++bz)
        for (uint64_t by = y.first; by <= y.last; ++by) {
          Level::Bound* bounds = &leaf.bounds[(bz * leaf.size[1] + by) * leaf.size[0]];
          for (uint64_t b = 0; b < row.size(); ++b) widen(bounds[b], row[b]);
        }
    }
  levels_.push_back(std::move(leaf));
  add_levels();
}

void ImageBounds::add_levels() {
  for (;;) {
    const Level& fine = levels_.back();
    if (fine.bounds.size() == 1) return;
    Level coarse;
    for (int axis = 0; axis < 3; ++axis) coarse.size[axis] = (fine.size[axis] + 1) / 2;
    coarse.bounds.assign(coarse.size[0] * coarse.size[1] * coarse.size[2],
                         {float_infinity, -float_infinity});
    size_t at = 0;
    for (uint64_t z = 0; z < fine.size[2]; ++z)
      for (uint64_t y = 0; y < fine.size[1]; ++y)
        for (uint64_t x = 0; x < fine.size[0]; ++x)
          widen(coarse.bounds[(z / 2 * coarse.size[1] + y / 2) * coarse.size[0] + x / 2],
                fine.bounds[at++]);
    levels_.push_back(std::move(coarse));
  }
}

Interval ImageBounds::over(const VoxelRange& cells) const {
  uint64_t low[3], high[3], most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = cells.low[axis] >> leaf_bits;
    high[axis] = cells.high[axis] >> leaf_bits;
    most = std::max(most, high[axis] - low[axis]);
  }
  size_t level = 0;
  for (; most > 2; ++level) {
    most = 0;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] /= 2;
      high[axis] /= 2;
      most = std::max(most, high[axis] - low[axis]);
    }
  }
  const Level& blocks = levels_[level];
  Interval range = blocks.at(low[0], low[1], low[2]);
  for (uint64_t z = low[2]; z <= high[2]; ++z)
    for (uint64_t y = low[1]; y <= high[1]; ++y)
      for (uint64_t x = low[0]; x <= high[0]; ++x) {
        const Interval block = blocks.at(x, y, z);
        range = {std::min(range.low, block.low), std::max(range.high, block.high)};
      }
  return range;
}

uint64_t ImageBounds::bytes() const {
  uint64_t bytes = 0;
  for (const Level& level : levels_) bytes += level.bounds.capacity() * sizeof(Level::Bound);
  return bytes;
}

uint64_t ImageBounds::bytes_for(const uint64_t (&size)[3]) {
  uint64_t blocks[3], bytes = 0;
  for (int axis = 0; axis < 3; ++axis) blocks[axis] = leaves(size[axis]);
  for (;;) {
    const uint64_t count = blocks[0] * blocks[1] * blocks[2];
    bytes += count * sizeof(Level::Bound);
    if (count == 1) return bytes;
    for (uint64_t& n : blocks) n = (n + 1) / 2;
  }
}

template ImageBounds::ImageBounds(const uint8_t*, const uint64_t (&)[3], const Job*);
template ImageBounds::ImageBounds(const int16_t*, const uint64_t (&)[3], const Job*);
template ImageBounds::ImageBounds(const uint16_t*, const uint64_t (&)[3], const Job*);
template ImageBounds::ImageBounds(const float*, const uint64_t (&)[3], const Job*);
template ImageBounds::ImageBounds(const double*, const uint64_t (&)[3], const Job*);

}  // namespace msq
