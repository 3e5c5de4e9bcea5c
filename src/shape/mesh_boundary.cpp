// SPDX-License-Identifier: Apache-2.0
#include "shape/mesh_boundary.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace msq {

namespace {

/// One triangle's use of an edge.
struct DirectedEdge {
  uint32_t low, high;  // vertices
  int32_t way;         // 1 from low to high, -1 back

  friend bool operator<(const DirectedEdge& a, const DirectedEdge& b) {
    return std::pair(a.low, a.high) < std::pair(b.low, b.high);
  }
};

/// The edges beyond which the winding number of a ray differs, to the rule.
std::vector<DirectedEdge> open_edges(const TriangleSoup& soup, WindingRule rule) {
  std::vector<DirectedEdge> uses;
  uses.reserve(3 * soup.triangles.size());
  for (const Triangle& t : soup.triangles)
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = t[i], b = t[(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  std::sort(uses.begin(), uses.end());
  std::vector<DirectedEdge> open;
  for (size_t i = 0; i < uses.size();) {
    int64_t net = 0;
    const DirectedEdge first = uses[i];
    for (; i < uses.size() && !(first < uses[i]); ++i) net += uses[i].way;
    if (rule == WindingRule::even_odd ? net % 2 != 0 : net != 0) open.push_back(first);
  }
  return open;
}

uint64_t bytes_to_build(const TriangleSoup& soup, const ShapeFacts& facts) {
  const uint64_t count = soup.triangles.size();
  if (facts.closed) return TriangleTree::bytes_to_build(count);
  // Each open or unbalanced edge adds two triangles; no mesh has more than three for each.
  const uint64_t edges =
      std::min(3 * count, facts.open_edges + facts.non_manifold_edges + facts.flipped_edges);
  return 3 * count * sizeof(DirectedEdge) + edges * sizeof(DirectedEdge) +
         TriangleTree::bytes_to_build(count + 2 * edges + 2);
}

std::vector<TreeTriangle> boundary_triangles(const TriangleSoup& soup, const ShapeFacts& facts,
                                             WindingRule rule, double scale) {
  std::vector<DirectedEdge> open;
  if (!facts.closed) open = open_edges(soup, rule);
  std::vector<TreeTriangle> triangles;
  triangles.reserve(soup.triangles.size() + (facts.closed ? 0 : 2 * open.size() + 2));
  const auto vertex = [&](uint32_t i) { return soup.vertices[i] * scale; };
  for (const Triangle& t : soup.triangles)
    triangles.emplace_back(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  if (facts.closed) return triangles;
  const Vec3 low = facts.bounds.min * scale, high = facts.bounds.max * scale;
  const auto add = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    triangles.emplace_back(a, b, c);
    triangles.emplace_back(a, c, d);
  };
  for (const DirectedEdge& e : open) {
    const Vec3 a = vertex(e.low), b = vertex(e.high);
    add(a, b, {low.x, b.y, b.z}, {low.x, a.y, a.z});
  }
  add(low, {low.x, high.y, low.z}, {low.x, high.y, high.z}, {low.x, low.y, high.z});
  return triangles;
}

}  // namespace

MeshBoundary::MeshBoundary(const TriangleSoup& soup, const ShapeFacts& facts, WindingRule rule,
                           const std::shared_ptr<MemoryBudget>& budget)
    : scale_(std::ldexp(
          1.0, std::clamp(-std::ilogb(max_component(facts.bounds.extent())), -1000, 1000))),
      reservation_(budget, bytes_to_build(soup, facts), "the distances of a mesh"),
      tree_(boundary_triangles(soup, facts, rule, scale_)) {
  const double magnitude =
      scale_ * std::max(max_magnitude(facts.bounds.min), max_magnitude(facts.bounds.max));
  // inside() and the tree lose a few units of 2^-53 of the coordinates.
  slack_ = tree_.excess() + 0x1p-46 * magnitude;
  // Distances in the box, whose largest extent is below 2, are below 4: what clearance() takes off
  // them and what the tree may add to or lose of them.
  error_ = 2 * (slack_ + 0x1p-43) / scale_;
  reservation_ = {};
  reservation_ = Reservation(budget, tree_.bytes(), "the distances of a mesh");
}

BoundarySearch::Foot MeshBoundary::nearest(Vec3 p, uint32_t start) const {
  const TriangleTree::Nearest found = tree_.nearest(p * scale_, start);
  const double back = 1 / scale_;
  return {found.distance * back, found.point * back, found.triangle};
}

BoundarySearch::Range MeshBoundary::compare(Vec3 p, double low, double high, uint32_t& part) const {
  return tree_.compare(p * scale_, low * scale_, high * scale_, part);
}

double MeshBoundary::clearance(Vec3 p) const {
  const double distance = tree_.distance(p * scale_);
  const double bound = std::max(0.0, distance * (1 - 0x1p-46) - slack_);
  return std::min(bound / scale_, std::numeric_limits<double>::max());
}

bool MeshBoundary::first_crossing(const Ray& ray, double from, double to, double margin, double& t,
                                  Vec3& normal) const {
  TriangleTree::Crossing crossing;
  if (!tree_.first_crossing({ray.origin * scale_, ray.direction}, from * scale_, to * scale_,
                            margin * scale_, crossing))
    return false;
  t = crossing.t / scale_;
  normal = crossing.normal;
  return true;
}

}  // namespace msq
