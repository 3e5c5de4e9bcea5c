// SPDX-License-Identifier: Apache-2.0
#include "shape/mesh_diagnosis.h"

#include <cstring>
#include <functional>
#include <vector>

#include "base/polled_sort.h"
#include "base/random.h"
#include "base/status.h"

namespace msq {

namespace {

uint64_t hash_of(const Vec3& v) {
  uint64_t bits[3];
  std::memcpy(bits, &v, sizeof bits);
  return splitmix_finalise(bits[0] ^ splitmix_finalise(bits[1] ^ splitmix_finalise(bits[2])));
}

/// Finite vertices, each once, by open addressing: one block of memory, so that a cancelled call
/// frees it at once.
class VertexTable {
 public:
  explicit VertexTable(CancelPoll& poll) : poll_(poll), slots_(1024, none) {}

  /// The number of the vertex; adds it if there is none with its coordinates.
  uint32_t number(const Vec3& p) {
    uint32_t& slot = slot_of(p);
    if (slot != none) return slot;
    const uint32_t added = slot = static_cast<uint32_t>(vertices_.size());
    vertices_.push_back(p);
    if (vertices_.size() > slots_.size() / 2) grow();
    return added;
  }
  std::vector<Vec3> take() { return std::move(vertices_); }

 private:
  static constexpr uint32_t none = UINT32_MAX;

  /// The slot of an equal vertex, or an empty one.
  uint32_t& slot_of(const Vec3& p) {
    const size_t mask = slots_.size() - 1;
    for (size_t at = hash_of(p) & mask;; at = (at + 1) & mask)
      if (slots_[at] == none || vertices_[slots_[at]] == p) return slots_[at];
  }
  void grow() {
    slots_.assign(2 * slots_.size(), none);
    for (uint32_t i = 0; i < vertices_.size(); ++i) {
      poll_();
      slot_of(vertices_[i]) = i;
    }
  }

  CancelPoll& poll_;
  std::vector<uint32_t> slots_;  // a power of two of them, half of them empty
  std::vector<Vec3> vertices_;
};

/// One triangle's use of an edge, from its smaller to its larger vertex or the reverse.
struct EdgeUse {
  uint32_t a, b;
  bool forward;
};

/// Signed volume of the tetrahedron from a point to a triangle.
double tetrahedron(const TriangleSoup& soup, const Triangle& t, Vec3 from) {
  const Vec3 a = soup.vertices[t[0]] - from, b = soup.vertices[t[1]] - from,
             c = soup.vertices[t[2]] - from;
  return dot(a, cross(b, c)) / 6;
}

}  // namespace

void check_soup(const TriangleSoup& soup, const Job* job) {
  if (soup.triangles.empty()) fail(Status::mesh, "the mesh has no triangles");
  if (soup.triangles.size() > UINT32_MAX || soup.vertices.size() > UINT32_MAX)
    fail(Status::limit, "the mesh has %zu triangles and %zu vertices; the limit is %u of each",
         soup.triangles.size(), soup.vertices.size(), UINT32_MAX);
  CancelPoll poll(job);
  for (size_t i = 0; i < soup.triangles.size(); ++i)
    for (uint32_t v : soup.triangles[i]) {
      poll();
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

uint64_t weld(TriangleSoup& soup, const Job* job) {
  CancelPoll poll(job);
  VertexTable table(poll);
  std::vector<uint32_t> merged(soup.vertices.size(), UINT32_MAX);
  size_t kept = 0;
  for (Triangle t : soup.triangles) {
    poll();
    // Vertices of triangles that are dropped count for nothing, not even for the numbers of others.
    const Vec3 &a = soup.vertices[t[0]], &b = soup.vertices[t[1]], &c = soup.vertices[t[2]];
    if (a == b || b == c || c == a) continue;
    for (uint32_t& v : t) {
      if (merged[v] == UINT32_MAX)
        merged[v] = table.number(soup.vertices[v] + Vec3{0, 0, 0});  // -0 + 0 is 0
      v = merged[v];
    }
    soup.triangles[kept++] = t;
  }
  const uint64_t dropped = soup.triangles.size() - kept;
  soup.triangles.resize(kept);
  soup.triangles.shrink_to_fit();
  soup.vertices = table.take();
  soup.vertices.shrink_to_fit();
  return dropped;
}

double volume_of_holes(const TriangleSoup& surface, const TriangleSoup& caps,
                       const std::vector<uint32_t>& vertices, const Box3& bounds) {
  std::vector<uint32_t> piece(surface.vertices.size());
  for (uint32_t v = 0; v < piece.size(); ++v) piece[v] = v;
  const auto find = [&](uint32_t v) {
    while (piece[v] != v) v = piece[v] = piece[piece[v]];
    return v;
  };
  for (const Triangle& t : surface.triangles)
    for (int i = 1; i < 3; ++i) piece[find(t[i])] = find(t[0]);
  const Vec3 centre = (bounds.min + bounds.max) * 0.5;
  std::vector<double> of_surface(piece.size()), of_caps(piece.size()), volume(piece.size());
  const auto area = [](const TriangleSoup& soup, const Triangle& t) {
    const Vec3 a = soup.vertices[t[0]];
    return length(cross(soup.vertices[t[1]] - a, soup.vertices[t[2]] - a));
  };
  for (const Triangle& t : surface.triangles) of_surface[find(t[0])] += area(surface, t);
  for (const Triangle& t : caps.triangles) {
    const uint32_t of = find(vertices[t[0]]);
    of_caps[of] += area(caps, t);
    volume[of] += tetrahedron(caps, t, centre);
  }
  double sum = 0;
  for (size_t v = 0; v < piece.size(); ++v)
    if (of_caps[v] <= 0.75 * of_surface[v]) sum += volume[v];
  return sum;
}

ShapeFacts diagnose(const TriangleSoup& soup, const Job* job) {
  CancelPoll poll(job);
  ShapeFacts facts;
  facts.is_mesh = true;
  facts.vertices = soup.vertices.size();
  facts.triangles = soup.triangles.size();
  facts.bounds = {soup.vertices[soup.triangles[0][0]], soup.vertices[soup.triangles[0][0]]};
  for (const Triangle& t : soup.triangles)
    for (uint32_t v : t) {
      poll();
      facts.bounds.min = min(facts.bounds.min, soup.vertices[v]);
      facts.bounds.max = max(facts.bounds.max, soup.vertices[v]);
    }
  // Volumes of tetrahedra from the box's centre: small numbers even far from the origin.
  const Vec3 centre = (facts.bounds.min + facts.bounds.max) * 0.5;
  for (const Triangle& t : soup.triangles) {
    poll();
    const Vec3 a = soup.vertices[t[0]] - centre, b = soup.vertices[t[1]] - centre,
               c = soup.vertices[t[2]] - centre;
    const Vec3 normal = cross(b - a, c - a);
    facts.volume += dot(a, cross(b, c)) / 6;
    facts.area += length(normal) / 2;
    if (normal == Vec3{}) ++facts.degenerate_triangles;
  }

  std::vector<Triangle> sorted;
  sorted.reserve(soup.triangles.size());
  for (Triangle t : soup.triangles) {
    poll();
    std::sort(t.begin(), t.end());
    sorted.push_back(t);
  }
  polled_sort(sorted.begin(), sorted.end(), std::less<>(), poll);
  for (size_t i = 1; i < sorted.size(); ++i) {
    poll();
    if (sorted[i] == sorted[i - 1]) ++facts.duplicate_triangles;
  }
  sorted = {};

  std::vector<EdgeUse> uses;
  uses.reserve(3 * soup.triangles.size());
  for (const Triangle& t : soup.triangles)
    for (int i = 0; i < 3; ++i) {
      poll();
      const uint32_t a = t[i], b = t[(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  polled_sort(
      uses.begin(), uses.end(),
      [](const EdgeUse& l, const EdgeUse& r) { return l.a != r.a ? l.a < r.a : l.b < r.b; }, poll);
  for (size_t i = 0; i < uses.size();) {
    poll();
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
