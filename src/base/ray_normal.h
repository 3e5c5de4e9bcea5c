// SPDX-License-Identifier: Apache-2.0
// The normal of a solid of which nothing but membership is known.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/ray.h"

namespace msq {

/// Unit vectors on a spiral from pole to pole, evenly spread: Swinbank and Purser, "Fibonacci
/// grids", 2006.
using DirectionsAllAround = std::array<Vec3, 48>;
inline const DirectionsAllAround& directions_all_around() {
  static const DirectionsAllAround directions = [] {
    constexpr double golden_angle = 2.39996322972865332;
    DirectionsAllAround made;
    for (size_t i = 0; i < made.size(); ++i) {
      const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(made.size());
      const double across = std::sqrt(1 - z * z), turn = golden_angle * static_cast<double>(i);
      made[i] = {across * std::cos(turn), across * std::sin(turn), z};
    }
    return made;
  }();
  return directions;
}

/// The mean direction of the points outside, among points all around at `distance` from where the
/// ray enters; the direction back along the ray where they say nothing. keep(points, inside, count)
/// sets inside[i], which is 1, to 0 where a point is outside.
template <class Keep>
Vec3 normal_by_membership_of_all(Keep&& keep, const Ray& ray, double t, double distance) {
  const auto& directions = directions_all_around();
  constexpr size_t count = std::tuple_size_v<DirectionsAllAround>;
  const Vec3 p = ray.at(t);
  Vec3 points[count];
  uint8_t inside[count];
  for (size_t i = 0; i < count; ++i) {
    points[i] = p + directions[i] * distance;
    inside[i] = 1;
  }
  keep(points, inside, count);
  Vec3 sum;
  for (size_t i = 0; i < count; ++i)
    if (!inside[i]) sum = sum + directions[i];
  const double size = length(sum);
  // Against the ray, as it enters.
  return size > 0.5 && dot(sum, ray.direction) < 0 ? sum * (1 / size) : ray.direction * -1.0;
}

/// The same, by inside(p).
template <class Inside>
Vec3 normal_by_membership(Inside&& inside, const Ray& ray, double t, double distance) {
  return normal_by_membership_of_all(
      [&](const Vec3* points, uint8_t* kept, size_t count) {
        for (size_t i = 0; i < count; ++i) kept[i] = inside(points[i]);
      },
      ray, t, distance);
}

}  // namespace msq
