// SPDX-License-Identifier: Apache-2.0
#include "shape/mesh_diagnosis.h"

#include <cstring>
#include <unordered_map>

#include "base/random.h"
#include "base/status.h"

namespace msq {

namespace {

struct BitwiseHash {
  size_t operator()(const Vec3& v) const {
    uint64_t bits[3];
    std::memcpy(bits, &v, sizeof bits);
    return splitmix_finalise(bits[0] ^ splitmix_finalise(bits[1] ^ splitmix_finalise(bits[2])));
  }
};

/// One triangle's use of an edge, from its smaller to its larger vertex or the other way.
struct EdgeUse {
  uint32_t a, b;
  bool forward;
};

}  // namespace

void check_soup(const TriangleSoup& soup) {
  if (soup.triangles.empty()) fail(Status::mesh, "the mesh has no triangles");
  if (soup.triangles.size() > UINT32_MAX || soup.vertices.size() > UINT32_MAX)
    fail(Status::limit, "the mesh has %zu triangles and %zu vertices; the limit is %u of each",
         soup.triangles.size(), soup.vertices.size(), UINT32_MAX);
  for (size_t i = 0; i < soup.triangles.size(); ++i)
    for (uint32_t v : soup.triangles[i]) {
      if (v >= soup.vertices.size())
        fail(Status::mesh, "triangle %zu names vertex %u; there are %zu vertices", i, v,
             soup.vertices.size());
      const Vec3& p = soup.vertices[v];
      if (!is_finite(p) || max_magnitude(p) > 1e100)
        fail(Status::mesh,
             "vertex %u is (%g, %g, %g); coordinates must be finite and at most 1e100", v, p.x, p.y,
             p.z);
    }
}

uint64_t weld(TriangleSoup& soup) {
  std::unordered_map<Vec3, uint32_t, BitwiseHash> index_of;
  index_of.reserve(soup.vertices.size());
  std::vector<Vec3> vertices;
  std::vector<uint32_t> merged(soup.vertices.size(), UINT32_MAX);
  size_t kept = 0;
  for (Triangle t : soup.triangles) {
    for (uint32_t& v : t) {
      if (merged[v] == UINT32_MAX) {
        const Vec3 p = soup.vertices[v] + Vec3{0, 0, 0};  // -0 + 0 is 0
        const auto [found, is_new] = index_of.emplace(p, static_cast<uint32_t>(vertices.size()));
        if (is_new) vertices.push_back(p);
        merged[v] = found->second;
      }
      v = merged[v];
    }
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) soup.triangles[kept++] = t;
  }
  const uint64_t dropped = soup.triangles.size() - kept;
  soup.triangles.resize(kept);
  soup.triangles.shrink_to_fit();
  vertices.shrink_to_fit();
  soup.vertices = std::move(vertices);
  return dropped;
}

ShapeFacts diagnose(const TriangleSoup& soup) {
  ShapeFacts facts;
  facts.is_mesh = true;
  facts.vertices = soup.vertices.size();
  facts.triangles = soup.triangles.size();
  facts.bounds = {soup.vertices[soup.triangles[0][0]], soup.vertices[soup.triangles[0][0]]};
  for (const Triangle& t : soup.triangles)
    for (uint32_t v : t) {
      facts.bounds.min = min(facts.bounds.min, soup.vertices[v]);
      facts.bounds.max = max(facts.bounds.max, soup.vertices[v]);
    }
  // Volumes of tetrahedra from the box's centre: small numbers even far from the origin.
  const Vec3 centre = (facts.bounds.min + facts.bounds.max) * 0.5;
  for (const Triangle& t : soup.triangles) {
    const Vec3 a = soup.vertices[t[0]] - centre, b = soup.vertices[t[1]] - centre,
               c = soup.vertices[t[2]] - centre;
    const Vec3 normal = cross(b - a, c - a);
    facts.volume += dot(a, cross(b, c)) / 6;
    facts.area += length(normal) / 2;
    if (normal == Vec3{}) ++facts.degenerate_triangles;
  }

  std::vector<Triangle> sorted = soup.triangles;
  for (Triangle& t : sorted) std::sort(t.begin(), t.end());
  std::sort(sorted.begin(), sorted.end());
  for (size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] == sorted[i - 1]) ++facts.duplicate_triangles;
  sorted = {};

  std::vector<EdgeUse> uses;
  uses.reserve(3 * soup.triangles.size());
  for (const Triangle& t : soup.triangles)
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = t[i], b = t[(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  std::sort(uses.begin(), uses.end(),
            [](const EdgeUse& l, const EdgeUse& r) { return l.a != r.a ? l.a < r.a : l.b < r.b; });
  for (size_t i = 0; i < uses.size();) {
    size_t end = i;
    int64_t balance = 0;
    for (; end < uses.size() && uses[end].a == uses[i].a && uses[end].b == uses[i].b; ++end)
      balance += uses[end].forward ? 1 : -1;
    const size_t count = end - i;
    if (count == 1) ++facts.open_edges;
    if (count > 2) ++facts.non_manifold_edges;
    if (count == 2 && balance != 0) ++facts.flipped_edges;
    if (balance != 0) facts.closed = false;
    i = end;
  }
  return facts;
}

}  // namespace msq
