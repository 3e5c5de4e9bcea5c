// SPDX-License-Identifier: Apache-2.0
#include "shape/caps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include "base/borrowed.h"
#include "base/pi.h"
#include "base/simd.h"
#include "shape/half_angles.h"
#include "shape/tree_triangle.h"

namespace msq {

namespace {

/// In multiples of its radius: the distance from which a node is evaluated as a whole.
constexpr double usual_opening = 3;

/// Triangles over a loop that run along its edges in the opposite direction. Chords cut off halves
/// of the loop, and so on: with many vertices, most triangles are small and lie along the loop.
void cap_loop(uint32_t begin, uint32_t end, std::vector<Triangle>& triangles) {
  std::vector<std::pair<uint32_t, uint32_t>> arcs{{begin, end - 1}};
  while (!arcs.empty()) {
    const auto [first, last] = arcs.back();
    arcs.pop_back();
    if (last - first < 2) continue;
    const uint32_t middle = first + (last - first) / 2;
    triangles.push_back({last, middle, first});
    arcs.push_back({first, middle});
    arcs.push_back({middle, last});
  }
}

/// Distance from the origin to the segment from a along `along`.
double distance_to_segment(Vec3 a, Vec3 along) {
  const double squared = dot(along, along);
  const double t = squared > 0 ? std::clamp(-dot(a, along) / squared, 0.0, 1.0) : 0;
  return length(a + along * t);
}

}  // namespace

int64_t Caps::View::whole() const {
  return static_cast<int64_t>(std::floor(turns + 0.5));
}

double Caps::View::margin() const {
  return 4 * pi * (0.5 - std::abs(turns - std::floor(turns + 0.5)) - error);
}

Caps::Caps(const TriangleSoup& soup, const Loops& loops, const Box3& bounds, double scale)
    : scale_(scale), low_y_(bounds.min.y) {
  soup_.vertices.reserve(loops.vertices.size());
  for (const uint32_t v : loops.vertices) soup_.vertices.push_back(soup.vertices[v]);
  soup_.triangles.reserve(loops.vertices.size());
  for (size_t i = 0; i < loops.count(); ++i)
    cap_loop(static_cast<uint32_t>(loops.starts[i]), static_cast<uint32_t>(loops.starts[i + 1]),
             soup_.triangles);
  const uint32_t count = static_cast<uint32_t>(soup_.triangles.size());
  std::vector<uint32_t> order(count);
  for (uint32_t i = 0; i < count; ++i) order[i] = i;
  nodes_.reserve(2 * static_cast<size_t>(count));
  build(order, {0, count});
  nodes_.shrink_to_fit();
  std::vector<Triangle> sorted;
  sorted.reserve(count);
  for (const uint32_t i : order) sorted.push_back(soup_.triangles[i]);
  soup_.triangles = std::move(sorted);
  find_neighbours();
  columns_ = TriangleBins(soup_, bounds, bins_for(count, 0.5, 4096), bins_for(count, 0.5, 4096),
                          current_job());
  sheets_ = TriangleBins(soup_, bounds, 1, bins_for(count, 1.0, 16384), current_job());
  tolerance_ =
      0x1p-44 * (4 + scale_ * std::max(max_magnitude(bounds.min), max_magnitude(bounds.max)));
  rounding_ = 0x1p-46 * (64 + static_cast<double>(count));
}

double Caps::Node::solid_angle(Vec3 d, double r) const {
  const double inverse = 1 / (r * r);
  const double along = first[0] * d.x * d.x + first[1] * d.y * d.y + first[2] * d.z * d.z +
                       first[3] * d.x * d.y + first[4] * d.x * d.z + first[5] * d.y * d.z;
  const double trace = first[0] + first[1] + first[2];
  return inverse / r * (dot(normal, d) + trace - 3 * along * inverse);
}

void Caps::build(std::vector<uint32_t>& order, Run run) {
  const size_t index = nodes_.size();
  nodes_.push_back(node_of(order, run));
  if (!nodes_[index].is_leaf) {
    // Three times the centre.
    const auto centre = [&](uint32_t i) { return corner(i, 0) + corner(i, 1) + corner(i, 2); };
    Box3 centres{centre(order[run.begin]), centre(order[run.begin])};
    for (uint32_t k = run.begin; k < run.end; ++k) {
      const Vec3 c = centre(order[k]);
      centres = {min(centres.min, c), max(centres.max, c)};
    }
    const Vec3 extent = centres.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const uint32_t middle = run.begin + (run.end - run.begin) / 2;
    std::nth_element(order.begin() + run.begin, order.begin() + middle, order.begin() + run.end,
                     [&](uint32_t i, uint32_t j) {
                       const double a = centre(i)[axis], b = centre(j)[axis];
                       return a < b || (a == b && i < j);
                     });
    build(order, {run.begin, middle});
    build(order, {middle, run.end});
  }
  nodes_[index].next = static_cast<uint32_t>(nodes_.size());
}

void Caps::find_neighbours() {
  std::unordered_map<uint64_t, std::pair<uint32_t, uint32_t>> edges;  // triangle and edge
  edges.reserve(2 * soup_.triangles.size());
  neighbours_.assign(soup_.triangles.size(), {no_triangle, no_triangle, no_triangle});
  for (uint32_t t = 0; t < soup_.triangles.size(); ++t)
    for (uint32_t i = 0; i < 3; ++i) {
      const uint64_t a = soup_.triangles[t][i], b = soup_.triangles[t][(i + 1) % 3];
      const auto [at, is_first] = edges.try_emplace(std::min(a, b) << 32 | std::max(a, b), t, i);
      if (is_first) continue;
      const auto [other, edge] = at->second;
      neighbours_[t][i] = other;
      neighbours_[other][edge] = t;
    }
}

Caps::Node Caps::node_of(const std::vector<uint32_t>& order, Run run) const {
  Node node{};
  node.triangle = run.begin;
  node.is_leaf = run.end - run.begin == 1;
  const auto for_triangles = [&](auto&& use) {
    for (uint32_t k = run.begin; k < run.end; ++k) {
      const Vec3 a = corner(order[k], 0), b = corner(order[k], 1), c = corner(order[k], 2);
      use(a, b, c, cross(b - a, c - a) * 0.5);
    }
  };
  const Vec3 start = corner(order[run.begin], 0);
  Box3 box{start, start};
  Vec3 weighted;
  for_triangles([&](Vec3 a, Vec3 b, Vec3 c, Vec3 normal) {
    box = {min(box.min, min(a, min(b, c))), max(box.max, max(a, max(b, c)))};
    const double area = length(normal);
    node.area += area * (1 + 0x1p-40);
    weighted = weighted + (a + b + c - start * 3.0) * (area / 3);
    node.normal = node.normal + normal;
  });
  node.centre = node.area > 0 ? start + weighted * (1 / node.area) : (box.min + box.max) * 0.5;
  for_triangles([&](Vec3 a, Vec3 b, Vec3 c, Vec3 normal) {
    const Vec3 u = a - node.centre, v = b - node.centre, w = c - node.centre, sum = u + v + w;
    for (const Vec3 corner : {u, v, w})
      node.radius = std::max(node.radius, length(corner) * (1 + 0x1p-40));
    node.second_moment +=
        length(normal) * (dot(u, u) + dot(v, v) + dot(w, w) + dot(sum, sum)) / 12 * (1 + 0x1p-40);
    const Vec3 middle = sum * (1.0 / 3);
    const double first[6] = {middle.x * normal.x,
                             middle.y * normal.y,
                             middle.z * normal.z,
                             middle.x * normal.y + middle.y * normal.x,
                             middle.x * normal.z + middle.z * normal.x,
                             middle.y * normal.z + middle.z * normal.y};
    for (int i = 0; i < 6; ++i) node.first[i] += first[i];
  });
  return node;
}

template <class Far, class Near>
void Caps::for_each_part(Vec3 p, double opening, double room, double radius, Far&& far,
                         Near&& near) const {
  for (uint32_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    const Vec3 d = node.centre - p;
    const double squared = dot(d, d), r = std::sqrt(squared);
    const bool is_far = r > opening * node.radius + room && r > 64 * tolerance_;
    if (is_far) {
      if (!far(node, d, r, (r - node.radius - radius) * (1 - 0x1p-40))) return;
    } else if (node.is_leaf) {
      if (!near(node.triangle)) return;
    }
    i = is_far || node.is_leaf ? node.next : i + 1;
  }
}

struct Caps::Sum {
  HalfAngles near;
  double far = 0;  // solid angle
  double error = 0;

  double turns() const {
    return static_cast<double>(near.turns()) + near.rest() / (2 * pi) + far / (4 * pi);
  }

  /// Adds a node; d is the vector from the point, r the distance.
  void add(const Node& node, Vec3 d, double r) {
    const double gap = (r - node.radius) * (1 - 0x1p-40), gap_squared = gap * gap;
    far += node.solid_angle(d, r);
    error += 3 / (4 * pi) * node.second_moment / (gap_squared * gap_squared);
  }
};

void Caps::look_at(uint32_t triangle, Vec3 p, Sum& sum) const {
  const Vec3 a = corner(triangle, 0) - p, b = corner(triangle, 1) - p, c = corner(triangle, 2) - p;
  const double of_a = length(a), of_b = length(b), of_c = length(c), product = of_a * of_b * of_c;
  const double re = product + dot(a, b) * of_c + dot(a, c) * of_b + dot(b, c) * of_a;
  const double im = dot(a, cross(b, c));
  sum.near.add(re, im);

  // Over the product, 4 times the cosines of half the angles between corners: small near an edge.
  const double size = std::abs(re) + std::abs(im);
  sum.error += size > 0x1p-4 * product ? 0x1p-42 : 0x1p-46 * product / size;
  if (!(size * std::min({of_a, of_b, of_c}) > 32 * tolerance_ * product)) sum.error = 1;
  // The angle jumps from -2 pi to 2 pi within the triangle.
  if (re < 0 && (std::abs(im) <= 2 * tolerance_ * length(cross(b - a, c - a)) ||
                 std::abs(im) <= 0x1p-46 * product))
    sum.error = 1;
}

Caps::View Caps::view(Vec3 point, double opening) const {
  const Vec3 p = point * scale_;
  Sum sum;
  for_each_part(
      p, opening, 0, 0,
      [&](const Node& node, Vec3 d, double r, double) {
        sum.add(node, d, r);
        return true;
      },
      [&](uint32_t triangle) {
        look_at(triangle, p, sum);
        return true;
      });
  return {sum.turns(), sum.error + rounding_};
}

// Consider all points p' within b of p, and a node at the distance r from p. With gap = r - rho -
// b, the second-order term in p' - p is at most 3 A b^2 / gap^4. The first moment adds to the
// gradient at most 6 / gap^4 times the integral of |y - c|, hence 6 sqrt(A M) / gap^4.
void Caps::FarView::add(const Node& node, Vec3 d, double r, double gap, double radius) {
  const double inverse = 1 / (r * r), of_cube = inverse / r, gap_squared = gap * gap;
  turns += node.solid_angle(d, r) * (1 / (4 * pi));
  gradient = gradient +
             (d * (3 * inverse * dot(node.normal, d)) - node.normal) * (of_cube * (1 / (4 * pi)));
  const double of_ball = radius * std::sqrt(node.area);
  const double size = std::sqrt(node.second_moment) + of_ball;
  const double factor = 3 / (4 * pi) / (gap_squared * gap_squared);
  error += factor * (size * size);
  error_of_ball += factor * (of_ball * of_ball);
}

void Caps::gather(Vec3 centre, double radius, Nearby& near) const {
  const Vec3 p = centre * scale_;
  radius *= scale_;
  near.centre = p;
  near.nodes.clear();
  near.triangles.clear();
  near.far = {};
  for_each_part(
      p, usual_opening, radius, radius,
      [&](const Node& node, Vec3 d, double r, double gap) {
        // Where the ball is small, what it adds to the error is small beside the node's own.
        if (4 * radius < node.radius || r > 8 * (node.radius + radius))
          near.far.add(node, d, r, gap, radius);
        else
          near.nodes.push_back(static_cast<uint32_t>(&node - nodes_.data()));
        return true;
      },
      [&](uint32_t triangle) {
        near.triangles.push_back({corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)});
        return true;
      });
}

void Caps::find_views(const Vec3* points, size_t count, const Nearby& near, View* views) const {
  constexpr size_t batch = 64, padded = batch + max_simd_doubles;
  double coordinates[3][padded], re[padded], im[padded], turns[padded], error[padded];
  const CapSums sums{coordinates[0], coordinates[1], coordinates[2], re, im, turns, error};
  for (size_t first = 0; first < count; first += batch) {
    const size_t size = std::min(batch, count - first);
    for (size_t axis = 0; axis < 3; ++axis) {
      for (size_t n = 0; n < size; ++n)
        coordinates[axis][n] = points[first + n][static_cast<int>(axis)] * scale_;
      std::fill_n(coordinates[axis] + size, max_simd_doubles, coordinates[axis][0]);
    }
    sum_caps(near.triangles.data(), near.triangles.size(), tolerance_, size, sums);
    for (size_t n = 0; n < size; ++n) {
      const Vec3 p = points[first + n] * scale_;
      Sum sum;
      sum.near = sums.sum(n);
      sum.error = error[n];
      for (const uint32_t i : near.nodes) {
        const Vec3 d = nodes_[i].centre - p;
        sum.add(nodes_[i], d, length(d));
      }
      views[first + n] = {sum.turns() + near.far.turns + dot(near.far.gradient, p - near.centre),
                          sum.error + near.far.error + rounding_};
    }
  }
}

/// The gradient of the solid angle: its bound, and the minimum distance to what causes it.
struct Caps::Slope {
  double slope = 0;
  double nearest = std::numeric_limits<double>::infinity();

  void add(double part, double distance) {
    slope += part;
    nearest = std::min(nearest, distance);
  }
  // Within s of the point the gradient is at most slope / (1 - s / nearest)^3.
  double change(double s) const {
    const double part = 1 - s / nearest;
    return slope == 0 ? 0
           : part > 0 ? 0.5 * slope * nearest * (1 / (part * part) - 1)
                      : std::numeric_limits<double>::infinity();
  }
};

/// Triangles near a point. Some together are bounded by their edges, others by their area.
struct Caps::NearCaps {
  struct Part {
    uint32_t triangle;
    double of_area, to_triangle;
    double of_edge[3], to_edge[3];
  };
  std::vector<Part> parts;
  std::vector<uint64_t> is_by_edges;  // a bit for each triangle; all 0 between calls

  bool has(uint32_t triangle) const {
    return triangle != no_triangle && (is_by_edges[triangle / 64] >> (triangle % 64) & 1);
  }
  void take(uint32_t triangle) { is_by_edges[triangle / 64] |= uint64_t{1} << (triangle % 64); }
  void begin(size_t triangles) {
    if (is_by_edges.size() < triangles / 64 + 1) is_by_edges.resize(triangles / 64 + 1);
  }
  void end() {
    for (const Part& part : parts) is_by_edges[part.triangle / 64] = 0;
    parts.clear();
  }
  size_t bytes() const {
    return parts.capacity() * sizeof(Part) + is_by_edges.capacity() * sizeof(uint64_t);
  }
};

bool Caps::look_near(uint32_t triangle, Vec3 p, double clear, NearCaps& near) const {
  const Vec3 corners[3] = {corner(triangle, 0) - p, corner(triangle, 1) - p,
                           corner(triangle, 2) - p};
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double twice_area = length(normal);
  double to_edges = std::numeric_limits<double>::infinity();
  bool is_beside = !(twice_area > 0);
  NearCaps::Part part{};
  part.triangle = triangle;
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 from = corners[i], along = corners[(i + 1) % 3] - from;
    const double edge = length(along);
    const double d = std::max(0.0, distance_to_segment(from, along) * (1 - 0x1p-40) - tolerance_);
    if (neighbours_[triangle][i] == no_triangle && !(d > clear)) return false;
    part.to_edge[i] = d;
    part.of_edge[i] = std::min(edge / (d * d), 2 / d);
    to_edges = std::min(to_edges, d);
    is_beside = is_beside || dot(cross(from, along), normal) < 0;
  }
  const double above = is_beside ? to_edges : std::abs(dot(corners[0], normal)) / twice_area;
  part.to_triangle = std::max(0.0, std::min(to_edges, above * (1 - 0x1p-40) - tolerance_));
  part.of_area = twice_area / (part.to_triangle * part.to_triangle * part.to_triangle);
  near.parts.push_back(part);
  return true;
}

Caps::Slope Caps::slope_of(NearCaps& near) const {
  // A triangle that joins those by edges takes away the edges that it shares with them.
  for (int times = 0; times < 2; ++times)
    for (const NearCaps::Part& part : near.parts) {
      if (near.has(part.triangle)) continue;
      double gain = part.of_area;
      for (size_t i = 0; i < 3; ++i)
        gain += near.has(neighbours_[part.triangle][i]) ? part.of_edge[i] : -part.of_edge[i];
      if (gain >= 0) near.take(part.triangle);
    }
  Slope slope;
  for (const NearCaps::Part& part : near.parts) {
    if (!near.has(part.triangle)) {
      slope.add(part.of_area, part.to_triangle);
      continue;
    }
    for (size_t i = 0; i < 3; ++i)
      if (!near.has(neighbours_[part.triangle][i])) slope.add(part.of_edge[i], part.to_edge[i]);
  }
  return slope;
}

Caps::Steadiness Caps::look_about(Vec3 p, double radius, double opening, int64_t* whole) const {
  FarView far;
  Sum sum;
  Slope slope;
  const double clear = radius + 64 * tolerance_;
  if (whole) {
    bool meets = false;
    for_each_meeting(p, clear, [&](uint32_t) { return !(meets = true); });
    if (meets) return Steadiness::unsteady;
  }
  const Borrowed<NearCaps> near;
  near->begin(soup_.triangles.size());
  // A smaller ball helps as much, and costs less, where much of the error is due to its size.
  constexpr double max_of_ball = 0.05;
  Steadiness found = Steadiness::steady;
  for_each_part(
      p, opening, 1.5 * radius, radius,
      [&](const Node& node, Vec3 d, double r, double gap) {
        far.add(node, d, r, gap, radius);
        if (!(gap > 64 * tolerance_))
          found = Steadiness::unsteady;
        else if (!(far.error < 0.5))
          found = far.error_of_ball < max_of_ball ? Steadiness::unknown : Steadiness::unsteady;
        return found == Steadiness::steady;
      },
      [&](uint32_t triangle) {
        const bool is_clear = look_near(triangle, p, clear, *near);
        if (is_clear) look_at(triangle, p, sum);
        if (!is_clear) found = Steadiness::unsteady;
        return is_clear;
      });
  if (found == Steadiness::steady) slope = slope_of(*near);
  near->end();
  if (found != Steadiness::steady) return found;
  if (!(slope.nearest > clear)) return Steadiness::unsteady;
  View view{sum.turns() + far.turns, sum.error + far.error + rounding_};
  view.error += radius * length(far.gradient) + slope.change(radius) * (1 / (4 * pi));
  if (whole) *whole = view.whole();
  if (view.margin() > 0) return Steadiness::steady;
  view.error -= far.error - far.error_of_ball;
  const bool may_be = view.margin() > 0 && far.error_of_ball < max_of_ball;
  return may_be ? Steadiness::unknown : Steadiness::unsteady;
}

template <class Visit>
void Caps::for_each_meeting(Vec3 p, double radius, Visit&& visit) const {
  for (uint32_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    const Vec3 d = node.centre - p;
    const double reach = node.radius + radius;
    const bool is_near = dot(d, d) <= reach * reach;
    if (is_near && node.is_leaf) {
      const TreeTriangle triangle(corner(node.triangle, 0), corner(node.triangle, 1),
                                  corner(node.triangle, 2));
      if (triangle.distance_squared(p) <= radius * radius && !visit(node.triangle)) return;
    }
    i = is_near && !node.is_leaf ? i + 1 : node.next;
  }
}

void Caps::find_meeting(const Ball& ball, std::vector<std::array<Vec3, 3>>& found) const {
  const Vec3 p = ball.centre * scale_;
  found.clear();
  for_each_meeting(p, ball.radius * scale_ + 64 * tolerance_, [&](uint32_t triangle) {
    found.push_back({corner(triangle, 0) - p, corner(triangle, 1) - p, corner(triangle, 2) - p});
    return true;
  });
}

bool Caps::is_steady_in(Vec3 centre, double radius, int64_t* whole) const {
  for (const double finer : {1.0, 8.0 / 3}) {
    const Steadiness found =
        look_about(centre * scale_, radius * scale_, finer * usual_opening, whole);
    if (found != Steadiness::unknown) return found == Steadiness::steady;
  }
  return false;
}

uint64_t Caps::bytes() const {
  return soup_.vertices.capacity() * sizeof(Vec3) + soup_.triangles.capacity() * sizeof(Triangle) +
         columns_.bytes() + sheets_.bytes() + nodes_.capacity() * sizeof(Node) +
         neighbours_.capacity() * sizeof neighbours_[0];
}

}  // namespace msq
