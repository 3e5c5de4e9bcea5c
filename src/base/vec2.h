// SPDX-License-Identifier: Apache-2.0
// Points and boxes of a plane in double precision.
#pragma once

#include <algorithm>
#include <cmath>

namespace msq {

struct Vec2 {
  double x = 0, y = 0;

  double operator[](int axis) const { return axis == 0 ? x : y; }
  friend bool operator==(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }
};

inline Vec2 operator+(Vec2 a, Vec2 b) {
  return {a.x + b.x, a.y + b.y};
}
inline Vec2 operator-(Vec2 a, Vec2 b) {
  return {a.x - b.x, a.y - b.y};
}
inline Vec2 operator*(Vec2 a, double s) {
  return {a.x * s, a.y * s};
}
inline double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
/// Positive where b lies to the left of a.
inline double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
inline double length(Vec2 a) {
  return std::sqrt(dot(a, a));
}
/// 0 for 0.
inline Vec2 unit(Vec2 a) {
  const double size = length(a);
  return size > 0 ? a * (1 / size) : Vec2{};
}
/// Turned left by a right angle.
inline Vec2 left_of(Vec2 a) {
  return {-a.y, a.x};
}
/// The way to p from the nearest point of the segment from a to b.
inline Vec2 off_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 from = p - a, way = b - a;
  const double squared = dot(way, way);
  const double t = squared > 0 ? std::clamp(dot(from, way) / squared, 0.0, 1.0) : 0;
  return from - way * t;
}

struct Box2 {
  Vec2 min, max;

  Vec2 extent() const { return max - min; }
  Box2 grown(double by) const { return {min - Vec2{by, by}, max + Vec2{by, by}}; }
  bool contains(Vec2 p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y;
  }
};

}  // namespace msq
