// SPDX-License-Identifier: Apache-2.0
#include "shape/triangle_tree.h"

#include <algorithm>
#include <limits>

#include "base/job.h"
#include "strut/segment.h"

namespace msq {

namespace {

constexpr uint32_t leaf_triangles = 8;
/// For balanced trees of up to 2^32 triangles, with a reserve.
constexpr size_t max_depth = 64;

double longest_squared(const TreeTriangle& t) {
  const Vec3 w = t.v - t.u;
  return std::max({dot(t.u, t.u), dot(t.v, t.v), dot(w, w)});
}

/// Whether a triangle is so flat that its normal is meaningless: its height is below 2^-24 of its
/// longest edge.
bool is_sliver(double normal_squared, double longest_squared) {
  return normal_squared <= 0x1p-48 * longest_squared * longest_squared;
}

double longest_edge(const TreeTriangle& t) {
  return std::sqrt(longest_squared(t));
}

double edge_distance_squared(const TreeTriangle& t, Vec3 p, bool u, bool v, bool w) {
  double least = std::numeric_limits<double>::infinity();
  if (u) least = std::min(least, Segment(t.a, t.a + t.u).distance_squared(p));
  if (v) least = std::min(least, Segment(t.a, t.a + t.v).distance_squared(p));
  if (w) least = std::min(least, Segment(t.a + t.u, t.a + t.v).distance_squared(p));
  return least;
}

/// Squared distance to the nearest point of the triangle, except for rounding: the foot of the
/// perpendicular if it lies within, otherwise a point on one of the edges that the foot lies
/// beyond. If the triangle's plane is farther than sqrt(best), any number above best.
double distance_squared(const TreeTriangle& t, Vec3 p, double best) {
  const Vec3 normal = cross(t.u, t.v);
  const double normal_squared = dot(normal, normal);
  if (is_sliver(normal_squared, longest_squared(t)))
    return edge_distance_squared(t, p, true, true, true);
  const Vec3 w = p - t.a;
  const double above = dot(w, normal);
  if (above * above > best * normal_squared * (1 + 0x1p-20))
    return std::numeric_limits<double>::infinity();
  const double inverse = 1 / normal_squared;
  const double of_u = dot(cross(w, t.v), normal) * inverse;
  const double of_v = dot(cross(t.u, w), normal) * inverse;
  const bool beyond_u = of_v < 0, beyond_v = of_u<0, beyond_w = of_u + of_v> 1;
  if (beyond_u || beyond_v || beyond_w)
    return edge_distance_squared(t, p, beyond_u, beyond_v, beyond_w);
  const Vec3 d = w - t.u * of_u - t.v * of_v;
  return dot(d, d);
}

/// The point of the triangle at that distance.
Vec3 foot(const TreeTriangle& t, Vec3 p) {
  const Vec3 normal = cross(t.u, t.v), w = p - t.a;
  const double normal_squared = dot(normal, normal);
  if (!is_sliver(normal_squared, longest_squared(t))) {
    const double inverse = 1 / normal_squared;
    const double of_u = dot(cross(w, t.v), normal) * inverse;
    const double of_v = dot(cross(t.u, w), normal) * inverse;
    if (of_u >= 0 && of_v >= 0 && of_u + of_v <= 1) return t.a + t.u * of_u + t.v * of_v;
  }
  Vec3 nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& s :
       {Segment(t.a, t.a + t.u), Segment(t.a, t.a + t.v), Segment(t.a + t.u, t.a + t.v)}) {
    const double along = std::clamp(dot(p - s.a, s.ab) * s.inverse_length_squared, 0.0, 1.0);
    const Vec3 on = s.a + s.ab * along, away = p - on;
    if (dot(away, away) >= least) continue;
    least = dot(away, away);
    nearest = on;
  }
  return nearest;
}

/// Bound of the positive error of the distance above. Of a sliver only edges are tested; all its
/// points are within its height of an edge. Otherwise the foot's coordinates in u and v are within
/// 12 units of 2^-53 of |w| |u| |v| / |normal| over |u| and |v|, and the distance to the plane
/// within as many. Up to the longest edge L from the triangle, |w| is at most 2 L: that makes 2^-46
/// L^3 / |normal|. Farther away, an error of the foot is of second order and stays below 2^-47 of
/// the distance, and that of the plane is below the 2^-20 by which the plane must be too far.
double excess_of(const TreeTriangle& t) {
  const Vec3 normal = cross(t.u, t.v);
  const double squared = longest_squared(t), longest = std::sqrt(squared);
  const double area = length(normal);
  if (is_sliver(area * area, squared)) return 0x1p-22 * longest;
  return 0x1p-46 * longest * squared / area;
}

}  // namespace

uint64_t TriangleTree::bytes_to_build(uint64_t triangles) {
  // The triangles in input order and leaf by leaf, their order, and leaves of four or more.
  return triangles * (2 * sizeof(TreeTriangle) + sizeof(uint32_t) + sizeof(Node) / 4) +
         sizeof(Node);
}

TriangleTree::TriangleTree(std::vector<TreeTriangle> triangles, const Job* job) {
  CancelPoll poll(job);
  const uint32_t count = static_cast<uint32_t>(triangles.size());
  std::vector<uint32_t> order(count);
  for (uint32_t i = 0; i < count; ++i) order[i] = i;
  nodes_.reserve(count / 4 + 1);
  build(order, triangles, {0, count}, poll);
  triangles_.reserve(count);
  for (const uint32_t i : order) {
    poll();
    triangles_.push_back(triangles[i]);
    excess_ = std::max(excess_, excess_of(triangles[i]));
  }
  nodes_.shrink_to_fit();
}

inline double TriangleTree::Bound::distance_squared(Vec3 p, double best) const {
  const Vec3 gap = max(max(box.min - p, p - box.max), Vec3{});
  const double of_box = dot(gap, gap);
  if (of_box >= best) return of_box;
  const Vec3 w = p - centre;
  const double along = dot(normal, w);
  const double above = std::max(std::abs(along) - half_height, 0.0);
  const Vec3 across = w - normal * along;
  const double across_squared = dot(across, across);
  double of_cylinder = above * above;
  if (of_cylinder < best && across_squared > radius * radius) {
    const double beyond = std::sqrt(across_squared) - radius;
    of_cylinder += beyond * beyond;
  }
  return std::max(of_box, of_cylinder);
}

TriangleTree::Bound TriangleTree::bound_of(const std::vector<uint32_t>& order,
                                           const std::vector<TreeTriangle>& triangles, Run range,
                                           CancelPoll& poll) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Bound bound{{{far, far, far}, {-far, -far, -far}}, {}, {}, 0, 0};  // of no triangles
  const auto for_corners = [&](auto&& use) {
    for (uint32_t k = range.begin; k < range.end; ++k) {
      poll();
      const TreeTriangle& t = triangles[order[k]];
      for (const Vec3 corner : {t.a, t.a + t.u, t.a + t.v}) use(corner);
    }
  };
  for_corners([&](Vec3 corner) {
    bound.box = {min(bound.box.min, corner), max(bound.box.max, corner)};
  });
  Vec3 sum;
  for (uint32_t k = range.begin; k < range.end; ++k) {
    const TreeTriangle& t = triangles[order[k]];
    sum = sum + cross(t.u, t.v);
  }
  const double area = length(sum);
  if (area > 0) bound.normal = sum * (1 / area);
  const Vec3 middle = (bound.box.min + bound.box.max) * 0.5;
  double low = far, high = -far;
  for_corners([&](Vec3 corner) {
    const double along = dot(bound.normal, corner - middle);
    low = std::min(low, along);
    high = std::max(high, along);
  });
  if (low > high) return bound;
  bound.centre = middle + bound.normal * (0.5 * (low + high));
  for_corners([&](Vec3 corner) {
    const Vec3 w = corner - bound.centre;
    const double along = dot(bound.normal, w);
    bound.half_height = std::max(bound.half_height, std::abs(along));
    bound.radius = std::max(bound.radius, length(w - bound.normal * along));
  });
  return bound;
}

uint32_t TriangleTree::build(std::vector<uint32_t>& order,
                             const std::vector<TreeTriangle>& triangles, Run range,
                             CancelPoll& poll) {
  const uint32_t index = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back();
  // Three times the centre.
  const auto centre = [&](uint32_t i) {
    return triangles[i].a * 3.0 + triangles[i].u + triangles[i].v;
  };
  Box3 centres{centre(order[range.begin]), centre(order[range.begin])};
  for (uint32_t k = range.begin; k < range.end; ++k) {
    poll();
    const Vec3 c = centre(order[k]);
    centres = {min(centres.min, c), max(centres.max, c)};
  }
  const Vec3 extent = centres.extent();
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const uint32_t middle = range.begin + (range.end - range.begin) / 2;
  std::nth_element(order.begin() + range.begin, order.begin() + middle, order.begin() + range.end,
                   [&](uint32_t i, uint32_t j) {
                     poll();
                     const double a = centre(i)[axis], b = centre(j)[axis];
                     return a < b || (a == b && i < j);
                   });
  // No half is empty, which would count as an inner node: a single triangle is in both.
  const Run halves[2] = {{range.begin, std::max(middle, range.begin + 1)}, {middle, range.end}};
  for (int side = 0; side < 2; ++side) {
    const Run half = halves[side];
    const uint32_t size = half.end - half.begin;
    const bool is_leaf = size <= leaf_triangles;
    nodes_[index].bound[side] = bound_of(order, triangles, half, poll);
    const uint32_t child = is_leaf ? half.begin : build(order, triangles, half, poll);
    nodes_[index].child[side] = child;
    nodes_[index].count[side] = is_leaf ? size : 0;
  }
  return index;
}

template <class Found>
void TriangleTree::search(Vec3 p, double best, Found&& found) const {
  struct Waiting {
    uint32_t node;
    double distance_squared;
  };
  Waiting stack[max_depth];
  size_t depth = 0;
  stack[depth++] = {0, 0};
  while (depth > 0) {
    const Waiting next = stack[--depth];
    if (next.distance_squared >= best) continue;
    const Node& node = nodes_[next.node];
    const double bounds[2] = {node.bound[0].distance_squared(p, best),
                              node.bound[1].distance_squared(p, best)};
    const int near = bounds[1] < bounds[0];
    Waiting inner[2];
    int inner_count = 0;
    for (const int side : {near, 1 - near}) {
      if (bounds[side] >= best) continue;
      const uint32_t child = node.child[side], count = node.count[side];
      if (count == 0) {
        inner[inner_count++] = {child, bounds[side]};
        continue;
      }
      for (uint32_t i = child; i < child + count; ++i) {
        const double squared = distance_squared(triangles_[i], p, best);
        if (!(squared < best)) continue;
        best = found(i, squared);
        if (!(best > 0)) return;
      }
    }
    while (inner_count > 0) stack[depth++] = inner[--inner_count];
  }
}

double TriangleTree::distance(Vec3 p) const {
  constexpr double far = std::numeric_limits<double>::infinity();
  double best = far;
  search(p, far, [&](uint32_t, double squared) { return best = squared; });
  return std::sqrt(best);
}

TriangleTree::Nearest TriangleTree::nearest(Vec3 p, uint32_t start) const {
  constexpr double far = std::numeric_limits<double>::infinity();
  double best = distance_squared(triangles_[start], p, far);
  uint32_t triangle = start;
  search(p, best, [&](uint32_t i, double squared) {
    triangle = i;
    return best = squared;
  });
  return {std::sqrt(best), foot(triangles_[triangle], p), triangle};
}

TriangleTree::Range TriangleTree::compare(Vec3 p, double low, double high, uint32_t& start) const {
  const double low_squared = low > 0 ? low * low : 0, high_squared = high > 0 ? high * high : 0;
  Range range = Range::beyond;
  // The limit for the search after a triangle is found at that distance.
  const auto found = [&](uint32_t i, double squared) {
    start = i;
    range = squared < low_squared ? Range::below : Range::between;
    return range == Range::below ? 0 : low_squared;
  };
  double best = high_squared;
  const double squared = distance_squared(triangles_[start], p, best);
  if (squared < best) best = found(start, squared);
  if (best > 0) search(p, best, found);
  return range;
}

bool TriangleTree::first_crossing(const Ray& ray, double from, double to, double margin,
                                  Crossing& crossing) const {
  bool found = false;
  const auto cross_triangle = [&](const TreeTriangle& t) {
    const Vec3 normal = cross(t.u, t.v), away = cross(ray.direction, t.v);
    const double across = dot(away, t.u), size = length(normal);
    // Nearly along the plane, the error of t is margin over the slope.
    if (!(std::abs(across) > 0x1p-40 * size)) return;
    const double inverse = 1 / across;
    const Vec3 w = ray.origin - t.a, q = cross(w, t.u);
    const double of_u = dot(w, away) * inverse, of_v = dot(ray.direction, q) * inverse;
    const double edge = longest_edge(t);
    const double room = margin * edge * std::abs(inverse);  // margin over the triangle's height
    if (of_u < -room || of_v < -room || of_u + of_v > 1 + room) return;
    const double at = dot(t.v, q) * inverse;
    if (at < from || at > to) return;
    found = true;
    to = at;
    crossing = {at, normal};
  };
  struct Waiting {
    uint32_t node;
    double from;
  };
  Waiting stack[max_depth];
  size_t depth = 0;
  stack[depth++] = {0, from};
  while (depth > 0) {
    const Waiting next = stack[--depth];
    if (next.from > to) continue;
    const Node& node = nodes_[next.node];
    double near[2];
    bool meets[2];
    for (int side = 0; side < 2; ++side) {
      double low = from, high = to;
      meets[side] = clip_to_box(ray, node.bound[side].box.grown(margin), low, high);
      near[side] = low;
    }
    const int first = meets[1] && (!meets[0] || near[1] < near[0]);
    Waiting inner[2];
    int inner_count = 0;
    for (const int side : {first, 1 - first}) {
      if (!meets[side] || near[side] > to) continue;
      const uint32_t child = node.child[side], count = node.count[side];
      if (count == 0) {
        inner[inner_count++] = {child, near[side]};
        continue;
      }
      for (uint32_t i = child; i < child + count; ++i) cross_triangle(triangles_[i]);
    }
    while (inner_count > 0) stack[depth++] = inner[--inner_count];
  }
  return found;
}

}  // namespace msq
