// SPDX-License-Identifier: Apache-2.0
// Structures against the edges and faces of a diagram that an oracle found.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "msq_test.h"
#include "random.h"
#include "structure/structure.h"
#include "strut/segment.h"

namespace msq::test {

inline double distance_squared(const Segment& edge, Vec3 p) {
  return edge.distance_squared(p);
}
inline Box3 box_of(const Segment& edge) {
  const Vec3 b = edge.a + edge.ab;
  return {min(edge.a, b), max(edge.a, b)};
}

/// Of a convex polygon.
inline double distance_squared(const std::vector<Vec3>& corners, Vec3 p) {
  const size_t count = corners.size();
  Vec3 normal;
  for (size_t i = 0; i < count; ++i)
    normal = normal + cross(corners[i] - corners[0], corners[(i + 1) % count] - corners[0]);
  bool is_above = dot(normal, normal) > 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < count; ++i) {
    const Vec3 a = corners[i], b = corners[(i + 1) % count];
    is_above = is_above && dot(cross(b - a, p - a), normal) >= 0;
    least = std::min(least, Segment(a, b).distance_squared(p));
  }
  if (!is_above) return least;
  const double along = dot(p - corners[0], normal);
  return along * along / dot(normal, normal);
}

inline Box3 box_of(const std::vector<Vec3>& corners) {
  Box3 box{corners[0], corners[0]};
  for (const Vec3& c : corners) box = {min(box.min, c), max(box.max, c)};
  return box;
}

/// The diagram about the origin of the grid, in model units along its axes.
struct Diagram {
  std::vector<Segment> edges;
  std::vector<std::vector<Vec3>> faces;
};

/// Edges or faces, by boxes of the space that is asked.
template <class Part>
class Parts {
 public:
  Parts(const std::vector<Part>& parts, Vec3 half)
      : parts_(parts),
        reach_(0.5 * max_component(half)),
        half_(half),
        bins_(static_cast<size_t>(side * side * side)) {
    for (uint32_t i = 0; i < parts.size(); ++i) {
      const Box3 box = box_of(parts[i]).grown(reach_);
      int from[3], to[3];
      for (int axis = 0; axis < 3; ++axis) {
        from[axis] = std::max(0, bin(box.min[axis], axis));
        to[axis] = std::min(side - 1, bin(box.max[axis], axis));
      }
      for (int z = from[2]; z <= to[2]; ++z)
        for (int y = from[1]; y <= to[1]; ++y)
          for (int x = from[0]; x <= to[0]; ++x) at(x, y, z).push_back(i);
    }
  }

  double distance(Vec3 p) const {
    double least = std::numeric_limits<double>::infinity();
    const auto bin_of = [&](int axis) { return std::clamp(bin(p[axis], axis), 0, side - 1); };
    for (const uint32_t i :
         bins_[static_cast<size_t>((bin_of(2) * side + bin_of(1)) * side + bin_of(0))])
      least = std::min(least, distance_squared(parts_[i], p));
    if (least > reach_ * reach_)
      for (const Part& part : parts_) least = std::min(least, distance_squared(part, p));
    return std::sqrt(least);
  }

 private:
  static constexpr int side = 8;
  int bin(double x, int axis) const {
    const double place = std::floor((x + half_[axis]) / (2 * half_[axis]) * side);
    return static_cast<int>(std::clamp(place, -1.0, double(side)));
  }
  std::vector<uint32_t>& at(int x, int y, int z) {
    return bins_[static_cast<size_t>((z * side + y) * side + x)];
  }

  const std::vector<Part>& parts_;
  const double reach_;
  const Vec3 half_;
  std::vector<std::vector<uint32_t>> bins_;
};

/// Points, and their distances from the diagram.
struct Asked {
  std::vector<Vec3> points;
  std::vector<double> distances;
  size_t near = 0, held = 0;
};

/// Membership, onset and distance of a structure that holds the points within `reach` of the
/// diagram; an onset is `onsets` distances.
/// near: points that close to the boundary may be on either side of it. name: of the structure.
inline void check_diagram(const char* name, const char* what, const Structure& structure,
                          const Asked& asked, double reach, double onsets, double near) {
  std::vector<uint8_t> alive(asked.points.size(), 1);
  structure.keep_points(asked.points.data(), alive.data(), asked.points.size());
  size_t held = 0, differ = 0, close = 0;
  for (size_t i = 0; i < asked.points.size(); ++i) {
    const Vec3 p = asked.points[i];
    const double wanted = asked.distances[i];
    held += alive[i];
    close += std::abs(wanted - reach) <= near;
    if ((alive[i] != (wanted <= reach) && std::abs(wanted - reach) > near) ||
        (i % 16 == 0 && structure.inside(p) != (alive[i] != 0)))
      if (!differ++)
        print_error("(%.17g, %.17g, %.17g) is %.17g from %s: %d\n", p.x, p.y, p.z, wanted, what,
                    alive[i]);
    if (i % 16) continue;
    const double onset = structure.onset(p);
    if (!(std::abs(onset - onsets * wanted) <= near))
      fail_msg("onset %.17g at (%.17g, %.17g, %.17g), not %.17g", onset, p.x, p.y, p.z,
               onsets * wanted);
    // Inside, it is a bound.
    const double d = structure.distance(p);
    if (wanted > reach ? std::abs(d - (wanted - reach)) > 2 * near : d > 2 * near)
      fail_msg("distance %.17g at (%.17g, %.17g, %.17g), not %.17g", d, p.x, p.y, p.z,
               wanted - reach);
  }
  print_message("%s, %s: %zu points, %zu inside, %zu close, %zu wrong\n", name, what,
                asked.points.size(), held, close, differ);
  assert_int_equal(differ, 0);
  assert_true(held > 0 && held < asked.points.size());
  assert_true(close * 100 < asked.points.size());
}

/// Points of the box from -half to half, along the axes of a grid.
template <class Part>
Asked ask(const std::vector<Part>& of, const Neighbourhood& grid, Vec3 half, double reach,
          size_t count, uint64_t seed) {
  const Parts<Part> parts(of, half);
  Random random(seed);
  Asked asked;
  while (asked.points.size() < count) {
    Vec3 g;
    double distance = 0;
    // Half of them near the boundary.
    for (int tries = asked.points.size() % 2 ? 4 : 1; tries > 0; --tries) {
      g = random.in_box(Box3{half * -1.0, half});
      distance = parts.distance(g);
      if (std::abs(distance - reach) <= 0.3 * reach) break;
    }
    asked.points.push_back(grid.from_grid(g));
    asked.distances.push_back(distance);
  }
  return asked;
}

}  // namespace msq::test
