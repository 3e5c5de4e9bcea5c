// SPDX-License-Identifier: Apache-2.0
#include "shape/mesh_boundary.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "shape/open_edges.h"

namespace msq {

namespace {

bool has_strips(const ShapeFacts& facts, WindingRule rule) {
  return !facts.closed && rule != WindingRule::automatic;
}

/// The edges at which the winding number of a ray changes, for the rule.
std::vector<OpenEdge> edges_that_bound(const TriangleSoup& soup, WindingRule rule, const Job* job) {
  std::vector<OpenEdge> edges = open_edges(soup, job);
  if (rule == WindingRule::even_odd)
    std::erase_if(edges, [](const OpenEdge& e) { return e.count % 2 == 0; });
  return edges;
}

uint64_t bytes_to_build(const TriangleSoup& soup, const ShapeFacts& facts, WindingRule rule) {
  const uint64_t count = soup.triangles.size();
  if (!has_strips(facts, rule)) return TriangleTree::bytes_to_build(count);
  // Each open or unbalanced edge adds two triangles; a mesh has at most three such edges per
  // triangle.
  const uint64_t edges =
      std::min(3 * count, facts.open_edges + facts.non_manifold_edges + facts.flipped_edges);
  return 3 * count * sizeof(OpenEdge) + edges * sizeof(OpenEdge) +
         TriangleTree::bytes_to_build(count + 2 * edges + 2);
}

std::vector<TreeTriangle> boundary_triangles(const TriangleSoup& soup, const ShapeFacts& facts,
                                             WindingRule rule, double scale, const Job* job) {
  CancelPoll poll(job);
  std::vector<OpenEdge> open;
  const bool with_strips = has_strips(facts, rule);
  if (with_strips) open = edges_that_bound(soup, rule, job);
  std::vector<TreeTriangle> triangles;
  triangles.reserve(soup.triangles.size() + (with_strips ? 2 * open.size() + 2 : 0));
  const auto vertex = [&](uint32_t i) { return soup.vertices[i] * scale; };
  for (const Triangle& t : soup.triangles) {
    poll();
    triangles.emplace_back(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  }
  if (!with_strips) return triangles;
  const Vec3 low = facts.bounds.min * scale, high = facts.bounds.max * scale;
  const auto add = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    triangles.emplace_back(a, b, c);
    triangles.emplace_back(a, c, d);
  };
  for (const OpenEdge& e : open) {
    const Vec3 a = vertex(std::min(e.from, e.to)), b = vertex(std::max(e.from, e.to));
    add(a, b, {low.x, b.y, b.z}, {low.x, a.y, a.z});
  }
  add(low, {low.x, high.y, low.z}, {low.x, high.y, high.z}, {low.x, low.y, high.z});
  return triangles;
}

}  // namespace

MeshBoundary::MeshBoundary(const TriangleSoup& soup, const ShapeFacts& facts, WindingRule rule,
                           const std::shared_ptr<MemoryBudget>& budget, const Job* job)
    : scale_(std::ldexp(
          1.0, std::clamp(-std::ilogb(max_component(facts.bounds.extent())), -1000, 1000))),
      reservation_(budget, bytes_to_build(soup, facts, rule), "the distances of a mesh"),
      tree_(boundary_triangles(soup, facts, rule, scale_, job), job) {
  const double magnitude =
      scale_ * std::max(max_magnitude(facts.bounds.min), max_magnitude(facts.bounds.max));
  // inside() and the tree lose a few units of 2^-53 of the coordinates.
  slack_ = tree_.excess() + 0x1p-46 * magnitude;
  // Distances in the box, whose largest extent is below 2, are below 4. This bounds the reduction
  // by distance_bound() and the error of the tree.
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

double MeshBoundary::distance_bound(Vec3 p) const {
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
