// SPDX-License-Identifier: Apache-2.0
// The normal of a solid of which nothing but membership is known.
#pragma once

#include "base/ray.h"

namespace msq {

/// The mean direction of the points outside, among points all around at `distance` from where the
/// ray enters; the direction back along the ray where they say nothing.
template <class Inside>
Vec3 normal_by_membership(Inside&& inside, const Ray& ray, double t, double distance) {
  // On a spiral from pole to pole, evenly spread: Swinbank and Purser, "Fibonacci grids", 2006.
  constexpr int count = 48;
  constexpr double golden_angle = 2.39996322972865332;
  const Vec3 p = ray.at(t);
  Vec3 sum;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, across = std::sqrt(1 - z * z);
    const Vec3 away{across * std::cos(golden_angle * i), across * std::sin(golden_angle * i), z};
    if (!inside(p + away * distance)) sum = sum + away;
  }
  const double size = length(sum);
  // Against the ray, as it enters.
  return size > 0.5 && dot(sum, ray.direction) < 0 ? sum * (1 / size) : ray.direction * -1.0;
}

}  // namespace msq
