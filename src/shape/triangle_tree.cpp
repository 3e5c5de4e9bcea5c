// SPDX-License-Identifier: Apache-2.0
#include "shape/triangle_tree.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/job.h"

namespace msq {

namespace {

/// The point of the triangle at that distance.
Vec3 foot(const TreeTriangle& t, Vec3 p) {
  const double inverse = t.inverse_normal_squared();
  if (inverse > 0) {
    const Vec3 normal = cross(t.u, t.v), w = p - t.a;
    const double of_u = dot(cross(w, t.v), normal) * inverse;
    const double of_v = dot(cross(t.u, w), normal) * inverse;
    if (of_u >= 0 && of_v >= 0 && of_u + of_v <= 1) return t.a + t.u * of_u + t.v * of_v;
  }
  Vec3 nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& s : {t.edge_u(), t.edge_v(), t.edge_w()}) {
    const double along = std::clamp(dot(p - s.a, s.ab) * s.inverse_length_squared, 0.0, 1.0);
    const Vec3 on = s.a + s.ab * along, away = p - on;
    if (dot(away, away) >= least) continue;
    least = dot(away, away);
    nearest = on;
  }
  return nearest;
}

/// Bound of the positive error of the distance. Of a sliver only edges are tested; all its points
/// are within its height of an edge. Otherwise the foot's coordinates in u and v are within 12
/// units of 2^-53 of |w| |u| |v| / |normal| over |u| and |v|, and the distance to the plane within
/// as many. Up to the longest edge L from the triangle, |w| is at most 2 L: that makes 2^-46 L^3 /
/// |normal|. Farther away, an error of the foot is of second order and stays below 2^-47 of the
/// distance.
double excess_of(const TreeTriangle& t) {
  const double squared = t.longest_squared(), longest = std::sqrt(squared);
  if (!(t.inverse_normal_squared() > 0)) return 0x1p-22 * longest;
  return 0x1p-46 * longest * squared / length(cross(t.u, t.v));
}

struct Bound {
  Box3 box;
  // The cylinder.
  Vec3 centre, normal;
  double half_height, radius;
};

struct Run {
  uint32_t begin, end;

  uint32_t size() const { return end - begin; }
};

uint64_t blocks_of(uint64_t triangles) {
  return triangles / tree_width + (triangles % tree_width != 0);
}

/// Each level has at most one node that is not full.
uint64_t most_nodes(uint64_t triangles) {
  return blocks_of(triangles) / (tree_width - 1) + 12;
}

}  // namespace

/// The triangles in input order, and their order leaf by leaf.
struct TriangleTree::Build {
  TriangleTree& tree;
  const std::vector<TreeTriangle>& triangles;
  std::vector<uint32_t> order;
  CancelPoll& poll;

  Bound bound_of(Run range);
  void halve(Run range, uint32_t parts, uint32_t unit, std::vector<Run>& runs);
  uint32_t build(Run range);
};

Bound TriangleTree::Build::bound_of(Run range) {
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
  bound.centre = middle + bound.normal * (0.5 * (low + high));
  for_corners([&](Vec3 corner) {
    const Vec3 w = corner - bound.centre;
    const double along = dot(bound.normal, w);
    bound.half_height = std::max(bound.half_height, std::abs(along));
    bound.radius = std::max(bound.radius, length(w - bound.normal * along));
  });
  return bound;
}

/// Divides a range into parts of `unit` triangles, of which the last may have fewer.
void TriangleTree::Build::halve(Run range, uint32_t parts, uint32_t unit, std::vector<Run>& runs) {
  if (parts == 1) {
    runs.push_back(range);
    return;
  }
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
  const uint32_t middle = range.begin + parts / 2 * unit;
  std::nth_element(order.begin() + range.begin, order.begin() + middle, order.begin() + range.end,
                   [&](uint32_t i, uint32_t j) {
                     poll();
                     const double a = centre(i)[axis], b = centre(j)[axis];
                     return a < b || (a == b && i < j);
                   });
  halve({range.begin, middle}, parts / 2, unit, runs);
  halve({middle, range.end}, parts - parts / 2, unit, runs);
}

uint32_t TriangleTree::Build::build(Run range) {
  const uint32_t index = static_cast<uint32_t>(tree.nodes_.size());
  tree.nodes_.emplace_back();
  uint64_t unit = tree_width;
  while (unit * tree_width < range.size()) unit *= tree_width;
  std::vector<Run> runs;
  halve(range, static_cast<uint32_t>((range.size() + unit - 1) / unit), static_cast<uint32_t>(unit),
        runs);
  BoundNode node{};
  for (const Run run : runs) {
    const Bound bound = bound_of(run);
    const uint32_t i = node.count++;
    for (int axis = 0; axis < 3; ++axis) {
      node.min[axis][i] = bound.box.min[axis];
      node.max[axis][i] = bound.box.max[axis];
      node.centre[axis][i] = bound.centre[axis];
      node.normal[axis][i] = bound.normal[axis];
    }
    node.half_height[i] = bound.half_height;
    node.radius[i] = bound.radius;
    node.child[i] = unit == tree_width ? run.begin / tree_width | BoundNode::block_bit : build(run);
  }
  tree.nodes_[index] = node;
  return index;
}

uint64_t TriangleTree::bytes_to_build(uint64_t triangles) {
  return triangles * (sizeof(TreeTriangle) + sizeof(uint32_t)) +
         blocks_of(triangles) * sizeof(TriangleBlock) + most_nodes(triangles) * sizeof(BoundNode);
}

TriangleTree::TriangleTree(std::vector<TreeTriangle> triangles, const Job* job) {
  CancelPoll poll(job);
  const uint32_t count = static_cast<uint32_t>(triangles.size());
  Build building{*this, triangles, std::vector<uint32_t>(count), poll};
  for (uint32_t i = 0; i < count; ++i) building.order[i] = i;
  nodes_.reserve(most_nodes(count));
  building.build({0, count});
  nodes_.shrink_to_fit();
  blocks_.resize(blocks_of(count));
  double largest = 0;
  for (uint32_t i = 0; i < blocks_.size() * tree_width; ++i) {
    poll();
    const TreeTriangle& t = triangles[building.order[std::min(i, count - 1)]];
    blocks_[i / tree_width].set(i % tree_width, t);
    excess_ = std::max(excess_, excess_of(t));
    largest =
        std::max({largest, max_magnitude(t.a), max_magnitude(t.a + t.u), max_magnitude(t.a + t.v)});
  }
  slack_ = 0x1p-62 * largest * largest;
}

double TriangleTree::distance(Vec3 p) const {
  NearestTriangle nearest;
  find_nearest(view(), p, nearest);
  return std::sqrt(nearest.squared);
}

TriangleTree::Nearest TriangleTree::nearest(Vec3 p, uint32_t start) const {
  NearestTriangle nearest{triangle(start).distance_squared(p), start};
  find_nearest(view(), p, nearest);
  return {std::sqrt(nearest.squared), foot(triangle(nearest.triangle), p), nearest.triangle};
}

TriangleTree::Range TriangleTree::compare(Vec3 p, double low, double high, uint32_t& start) const {
  TriangleBelow found{low > 0 ? low * low : 0, high > 0 ? high * high : 0};
  const double squared = triangle(start).distance_squared(p);
  found.triangle = start;
  found.is_below_high = squared < found.high_squared;
  found.is_below_low = squared < found.low_squared;
  if (!found.is_below_low && (found.is_below_high ? found.low_squared : found.high_squared) > 0)
    find_below(view(), p, found);
  start = found.triangle;
  return found.is_below_low ? Range::below : found.is_below_high ? Range::between : Range::beyond;
}

bool TriangleTree::first_crossing(const Ray& ray, double from, double to, double margin,
                                  Crossing& crossing) const {
  bool found = false;
  uint32_t crossed = 0;
  const auto cross_block = [&](uint32_t block) {
    alignas(64) double t[tree_width];
    for (uint32_t bits = meet_triangles(blocks_[block], ray, from, to, margin, t); bits;
         bits &= bits - 1) {
      const auto n = static_cast<uint32_t>(std::countr_zero(bits));
      const uint32_t i = block * tree_width + n;
      if (t[n] > to || (found && t[n] == to && i > crossed)) continue;
      found = true;
      to = t[n];
      crossed = i;
    }
  };
  Waiting waiting[max_waiting];
  size_t count = 0;
  waiting[count++] = {from, 0};
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (next.bound > to) continue;
    if (next.child & BoundNode::block_bit) {
      cross_block(next.child & ~BoundNode::block_bit);
      continue;
    }
    const BoundNode& node = nodes_[next.child];
    alignas(64) double entry[tree_width];
    const uint32_t bits = meet_boxes(node, ray, from, to, margin, entry);
    count = add_waiting(waiting, count, node, bits, entry);
  }
  if (!found) return false;
  const TreeTriangle met = triangle(crossed);
  crossing = {to, cross(met.u, met.v)};
  return true;
}

}  // namespace msq
