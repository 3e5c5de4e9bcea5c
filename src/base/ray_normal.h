// SPDX-License-Identifier: Apache-2.0
// The normal of a solid of which nothing but membership is known.
#pragma once

#include <array>
#include <cmath>

#include "base/ray.h"

namespace msq {

/// Unit vectors on a spiral from pole to pole, evenly spread: Swinbank and Purser, "Fibonacci
/// grids", 2006.
inline const std::array<Vec3, 48>& directions_all_around() {
  static const std::array<Vec3, 48> directions = [] {
    constexpr double golden_angle = 2.39996322972865332;
    std::array<Vec3, 48> made;
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
/// ray enters; the direction back along the ray where they say nothing.
template <class Inside>
Vec3 normal_by_membership(Inside&& inside, const Ray& ray, double t, double distance) {
  const Vec3 p = ray.at(t);
  Vec3 sum;
  for (const Vec3& away : directions_all_around())
    if (!inside(p + away * distance)) sum = sum + away;
  const double size = length(sum);
  // Against the ray, as it enters.
  return size > 0.5 && dot(sum, ray.direction) < 0 ? sum * (1 / size) : ray.direction * -1.0;
}

}  // namespace msq
