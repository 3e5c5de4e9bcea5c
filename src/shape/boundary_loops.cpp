// SPDX-License-Identifier: Apache-2.0
#include "shape/boundary_loops.h"

#include <algorithm>
#include <limits>

#include "shape/half_angles.h"
#include "shape/triangle_rows.h"

namespace msq {

namespace {

/// The vector from a point to a vertex, and its direction as a pair of a real and a complex number.
struct Corner {
  Vec3 way;
  double u, y, z;
};

Corner corner(Vec3 vertex, Vec3 p, double scale) {
  // For equal coordinates -0: the vertex is the lower one.
  const Vec3 way{(vertex.x - p.x) * scale, -((p.y - vertex.y) * scale),
                 -((p.z - vertex.z) * scale)};
  const double across = way.y * way.y + way.z * way.z;
  const double size = std::sqrt(way.x * way.x + across);
  if (way.x <= 0) return {way, size - way.x, way.y, way.z};
  // Times |a| + a_x, because |a| - a_x would lose digits.
  const double factor = size + way.x;
  if (across > 0x1p-300) return {way, across, way.y * factor, way.z * factor};
  const double high = std::max(std::abs(way.y), std::abs(way.z));
  if (high == 0) return {way, 0, -factor, -0.0};  // lower in z, and more so in y
  const double y = way.y / high, z = way.z / high;
  return {way, high * (y * y + z * z), y * factor, z * factor};
}

/// Adds half the solid angle of the strip from an edge to the sum. It is from 0 to pi if the row of
/// p is on one side of the edge, and from -pi to 0 on the other. If the edge is beyond p, the row
/// rule decides the side. Rounding, of that rule or here, may move the angle past pi.
void add_strip(const Corner& a, const Corner& b, Vec3 from, Vec3 to, Vec3 p, HalfAngles& sum) {
  const double re = a.u * b.u + (a.y * b.y + a.z * b.z);
  const double im = a.y * b.z - a.z * b.y;
  sum.add(re, im);
  const bool is_up = from.z <= to.z;
  const Vec3 &low = is_up ? from : to, &high = is_up ? to : from;
  if (!(low.z <= p.z && p.z < high.z)) return;
  const PlanePoint crossing = cross_edge(low, high, p.z);
  if (!(crossing.x > p.x)) return;
  const bool is_negative = is_up == (crossing.y <= p.y);
  if (std::signbit(im) != is_negative) sum.add_turns(is_negative ? -1 : 1);
}

/// Distance from the origin to the segment between two points.
double distance_to_segment(Vec3 a, Vec3 along, double length_squared) {
  const double t = std::clamp(-dot(a, along) / length_squared, 0.0, 1.0);
  return length(a + along * t);
}

}  // namespace

template <class Visit>
void BoundaryLoops::for_each_edge(size_t loop, Vec3 p, Visit&& visit) const {
  const Vec3* const begin = vertices_.data() + starts_[loop];
  const Vec3* const end = vertices_.data() + starts_[loop + 1];
  const Corner first = corner(*begin, p, scale_);
  Corner last = first;
  for (const Vec3* v = begin + 1; v != end; ++v) {
    const Corner next = corner(*v, p, scale_);
    visit(v[-1], *v, last, next);
    last = next;
  }
  visit(end[-1], *begin, last, first);
}

BoundaryLoops::BoundaryLoops(const TriangleSoup& soup, const Loops& loops, double scale)
    : scale_(scale), starts_(loops.starts) {
  vertices_.reserve(loops.vertices.size());
  for (const uint32_t v : loops.vertices) vertices_.push_back(soup.vertices[v]);
  loops_.reserve(loops.count());
  for (size_t i = 0; i < loops.count(); ++i) {
    const uint64_t begin = starts_[i], end = starts_[i + 1];
    Loop loop{{}, 0, 0};
    const auto vertex = [&](uint64_t n) { return vertices_[n] * scale; };
    Box3 box{vertex(begin), vertex(begin)};
    for (uint64_t n = begin; n < end; ++n) box = {min(box.min, vertex(n)), max(box.max, vertex(n))};
    loop.centre = (box.min + box.max) * 0.5;
    for (uint64_t n = begin; n < end; ++n) {
      const Vec3 a = vertex(n) - loop.centre;
      const Vec3 b = vertex(n + 1 == end ? begin : n + 1) - loop.centre;
      loop.radius = std::max(loop.radius, length(a) * (1 + 0x1p-40));
      loop.area += 0.5 * length(cross(a, b)) * (1 + 0x1p-40);
    }
    loops_.push_back(loop);
  }
}

int64_t BoundaryLoops::turns(Vec3 p) const {
  HalfAngles sum;
  for (size_t i = 0; i < loops_.size(); ++i)
    for_each_edge(i, p, [&](Vec3 from, Vec3 to, const Corner& a, const Corner& b) {
      add_strip(a, b, from, to, p, sum);
    });
  return sum.turns();
}

BoundaryLoops::Level BoundaryLoops::level(Vec3 p) const {
  constexpr double far = std::numeric_limits<double>::infinity();
  Level level{0, 0, 0, far, 0, far, 0};
  HalfAngles sum;
  for (size_t i = 0; i < loops_.size(); ++i) {
    for_each_edge(i, p, [&](Vec3 from, Vec3 to, const Corner& a, const Corner& b) {
      add_strip(a, b, from, to, p, sum);
      const Vec3 along = (to - from) * scale_;
      const double squared = dot(along, along), size = std::sqrt(squared);
      const double rounding = 0x1p-48 * (max_magnitude(a.way) + size);
      const double d = std::max(0.0, distance_to_segment(a.way, along, squared) - rounding);
      level.nearest = std::min(level.nearest, d);
      level.slope += std::min(size / (d * d), 2 / d);
      // 2^13 times the error here: enough for points up to 1023/1024 of d away.
      level.error += 0x1p-36 * (1 + size / d);
    });
    const Loop& loop = loops_[i];
    const double to_ball = std::max(0.0, length(loop.centre - p * scale_) - loop.radius);
    level.nearest_loop = std::min(level.nearest_loop, to_ball);
    level.view += loop.area / (to_ball * to_ball);
  }
  level.turns = sum.turns();
  level.rest = sum.rest();
  return level;
}

// The gradient of 4 pi w is the integral of r x dl / |r|^3 over the loops (Biot and Savart), and
// its derivative at most that of 2 |dl| / |r|^3: 2 L / d^3, nor more than 4 / d^2, that of the
// whole line. Points within d / 4 are no nearer than 3 d / 4. The product |a| |b| + a b loses
// digits where p is near the edge: as (L / d)^2 in units of 2^-52.
BoundaryLoops::Course BoundaryLoops::course(Vec3 p, Vec3 direction, double rounding) const {
  Course course{0, 0, 0, std::numeric_limits<double>::infinity(), 0, 0, 0};
  HalfAngles sum;
  for (size_t i = 0; i < loops_.size(); ++i)
    for_each_edge(i, p, [&](Vec3 from, Vec3 to, const Corner& a, const Corner& b) {
      add_strip(a, b, from, to, p, sum);
      const Vec3 along = (to - from) * scale_;
      const double squared = dot(along, along), size = std::sqrt(squared);
      const double of_a = length(a.way), of_b = length(b.way);
      const double d = std::max(0.0, distance_to_segment(a.way, along, squared) -
                                         0x1p-48 * (max_magnitude(a.way) + size));
      course.nearest = std::min(course.nearest, d);
      const double inverse = 1 / d, part = size * inverse;
      const double slope = std::min(part, 2.0) * inverse;
      course.bend += 2 * std::min(part * inverse, 2 * inverse) * inverse;
      // 2^3 times what is lost, and what the ray's points are off.
      course.error += 0x1p-46 * (1 + part) + 2 * rounding * slope;
      course.slack += 0x1p-46 * (1 + part * part) * slope;
      const double product = of_a * of_b;
      const double over = product * (product + dot(a.way, b.way));
      if (over > 0)
        course.along += dot(cross(a.way, along), direction) * ((of_a + of_b) / over);
      else
        course.slack += slope;
    });
  course.turns = sum.turns();
  course.rest = sum.rest();
  // The bound grows by (4/3)^3.
  course.bend *= 64.0 / 27 * (1 + 0x1p-40);
  return course;
}

void BoundaryLoops::expand(const Ball* balls, size_t count, double rounding,
                           Expansion* made) const {
  expand_loops({vertices_.data(), starts_.data(), loops_.size(), scale_, rounding}, balls, count,
               made);
}

Vec3 BoundaryLoops::gradient(Vec3 p) const {
  Vec3 sum;
  for (size_t i = 0; i < loops_.size(); ++i)
    for_each_edge(i, p, [&](Vec3, Vec3, const Corner& from, const Corner& to) {
      const Vec3 a = from.way, b = to.way;
      const double of_a = length(a), of_b = length(b), product = of_a * of_b;
      const double over = product * (product + dot(a, b));
      if (over > 0) sum = sum + cross(a, b) * ((of_a + of_b) / over);
    });
  return sum;
}

}  // namespace msq
