// SPDX-License-Identifier: Apache-2.0
// Images for tests.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "shape/image.h"

namespace msq::test {

template <class T>
inline constexpr Image::Type image_type = Image::Type::float64;
template <>
inline constexpr Image::Type image_type<float> = Image::Type::float32;
template <>
inline constexpr Image::Type image_type<uint8_t> = Image::Type::uint8;
template <>
inline constexpr Image::Type image_type<int16_t> = Image::Type::int16;
template <>
inline constexpr Image::Type image_type<uint16_t> = Image::Type::uint16;

struct ImageSize {
  uint64_t x, y, z;
};

template <class T>
Image make_image(const std::vector<T>& values, ImageSize size, const ImageFrame& frame) {
  const Image::Source source{values.data(),
                             image_type<T>,
                             {size.x, size.y, size.z},
                             size.x * sizeof(T),
                             size.x * size.y * sizeof(T)};
  return Image(source, frame, std::make_shared<MemoryBudget>(uint64_t{0}));
}

/// The values of a function of the voxel's indices.
template <class T>
std::vector<T> sampled(ImageSize size, const std::function<double(Vec3)>& function) {
  std::vector<T> values;
  values.reserve(size.x * size.y * size.z);
  for (uint64_t k = 0; k < size.z; ++k)
    for (uint64_t j = 0; j < size.y; ++j)
      for (uint64_t i = 0; i < size.x; ++i)
        values.push_back(static_cast<T>(function({double(i), double(j), double(k)})));
  return values;
}

/// About two axes.
inline Rotation skew_rotation() {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-1.1), t = std::sin(-1.1);
  return {{c, -s * d, s * t, s, c * d, -c * t, 0, t, d}};
}

}  // namespace msq::test
