// SPDX-License-Identifier: Apache-2.0
// The normal of a solid from its membership alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/borrowed.h"
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

/// Points around rays, and whether they are inside.
struct PointsAllAround {
  std::vector<Vec3> points;
  std::vector<uint8_t> inside;
};

/// The unit vector along the sum of the directions that lead out; back along the ray if they give
/// none. A ray that enters comes from outside. If it grazes, the error of the sum may turn it along
/// the ray, and it is turned back across.
inline Vec3 against(Vec3 along, Vec3 sum) {
  const double size = length(sum);
  if (!(size > 0.5)) return along * -1.0;
  const Vec3 normal = sum * (1 / size);
  const double lean = dot(normal, along);
  if (lean < 0) return normal;
  constexpr double max_error = 0.25, across = 0x1p-10;
  if (lean > max_error) return along * -1.0;
  const Vec3 turned = normal - along * (lean + across);
  return turned * (1 / length(turned));
}

/// Computes a normal for each search: the mean direction of the points outside, among points all
/// around at `distance` from the ray's point at t. If they give no direction, or one along the ray,
/// the normal points back along the ray. Searches for which wanted(search) is false are left
/// unchanged. keep(points, inside, count) sets inside[i], which is 1, to 0 if point i is outside.
template <class Keep, class Wanted>
void normals_by_membership(Keep&& keep, RaySearch* searches, size_t count, double distance,
                           Wanted&& wanted) {
  const auto& directions = directions_all_around();
  constexpr size_t around = std::tuple_size_v<DirectionsAllAround>;
  constexpr size_t at_once = 64;  // rays
  const Borrowed<PointsAllAround> borrowed;
  auto& [points, inside] = *borrowed;
  points.resize(std::min(count, at_once) * around);
  inside.resize(points.size());
  RaySearch* queried[at_once];
  size_t size = 0;
  for (size_t i = 0; i < count; ++i) {
    if (wanted(searches[i])) {
      const Vec3 p = searches[i].ray.at(searches[i].t);
      for (size_t k = 0; k < around; ++k) {
        points[size * around + k] = p + directions[k] * distance;
        inside[size * around + k] = 1;
      }
      queried[size++] = &searches[i];
    }
    if (size < (i + 1 < count ? at_once : 1)) continue;
    keep(points.data(), inside.data(), size * around);
    for (size_t n = 0; n < size; ++n) {
      Vec3 sum;
      for (size_t k = 0; k < around; ++k)
        if (!inside[n * around + k]) sum = sum + directions[k];
      const Vec3 along = queried[n]->ray.direction;
      queried[n]->normal = against(along, sum);
    }
    size = 0;
  }
}

/// The same for one ray.
template <class Keep>
Vec3 normal_by_membership_of_all(Keep&& keep, const Ray& ray, double t, double distance) {
  RaySearch search{ray, t, t, true, t};
  normals_by_membership(keep, &search, 1, distance, [](const RaySearch&) { return true; });
  return search.normal;
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
