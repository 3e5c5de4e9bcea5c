// SPDX-License-Identifier: Apache-2.0
// Meshes made in tests.
#pragma once

#include <map>
#include <utility>

#include "base/pi.h"
#include "base/triangle_soup.h"

namespace msq::test {

using msq::pi;

/// Adds a mesh's triangles to another, moved.
inline void append(TriangleSoup& soup, const TriangleSoup& more, Vec3 by = {}) {
  const uint32_t first = static_cast<uint32_t>(soup.vertices.size());
  for (Vec3 v : more.vertices) soup.vertices.push_back(v + by);
  for (const Triangle& t : more.triangles)
    soup.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

inline TriangleSoup inside_out(TriangleSoup soup) {
  for (Triangle& t : soup.triangles) std::swap(t[1], t[2]);
  return soup;
}

inline TriangleSoup box_mesh(Vec3 low, Vec3 high) {
  TriangleSoup soup;
  for (int i = 0; i < 8; ++i)
    soup.vertices.push_back(
        {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  soup.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return soup;
}

/// An icosahedron whose triangles are split in four, `levels` times, and pushed out to the sphere.
inline TriangleSoup icosphere(double radius, int levels) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  TriangleSoup soup;
  soup.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  soup.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [found, is_new] = middles.emplace(std::minmax(a, b), soup.vertices.size());
      if (is_new) soup.vertices.push_back((soup.vertices[a] + soup.vertices[b]) * 0.5);
      return found->second;
    };
    std::vector<Triangle> split;
    for (const auto& [a, b, c] : soup.triangles) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}})
        split.push_back(t);
    }
    soup.triangles = std::move(split);
  }
  for (Vec3& v : soup.vertices) v = v * (radius / length(v));
  return soup;
}

/// A ring about the z axis.
inline TriangleSoup torus_mesh(double ring, double tube, uint32_t around, uint32_t across) {
  TriangleSoup soup;
  for (uint32_t i = 0; i < around; ++i)
    for (uint32_t j = 0; j < across; ++j) {
      const double u = 2 * pi * i / around, v = 2 * pi * j / across;
      const double r = ring + tube * std::cos(v);
      soup.vertices.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
    }
  for (uint32_t i = 0; i < around; ++i)
    for (uint32_t j = 0; j < across; ++j) {
      const uint32_t i1 = (i + 1) % around, j1 = (j + 1) % across;
      const uint32_t a = i * across + j, b = i1 * across + j, c = i1 * across + j1,
                     d = i * across + j1;
      soup.triangles.push_back({a, b, c});
      soup.triangles.push_back({a, c, d});
    }
  return soup;
}

/// Turned about two axes: along no axis and no diagonal.
inline Rotation turned_twice() {
  const double a = 0.37, b = 0.21;
  Rotation r;
  r.m = {std::cos(a),
         -std::sin(a),
         0,
         std::sin(a) * std::cos(b),
         std::cos(a) * std::cos(b),
         -std::sin(b),
         std::sin(a) * std::sin(b),
         std::cos(a) * std::sin(b),
         std::cos(b)};
  return r;
}

}  // namespace msq::test
