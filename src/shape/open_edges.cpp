// SPDX-License-Identifier: Apache-2.0
#include "shape/open_edges.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "base/polled_sort.h"

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

}  // namespace

std::vector<OpenEdge> open_edges(const TriangleSoup& soup, const Job* job) {
  CancelPoll poll(job);
  std::vector<DirectedEdge> uses;
  uses.reserve(3 * soup.triangles.size());
  for (const Triangle& t : soup.triangles)
    for (int i = 0; i < 3; ++i) {
      poll();
      const uint32_t a = t[i], b = t[(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  polled_sort(uses.begin(), uses.end(), std::less<>(), poll);
  std::vector<OpenEdge> open;
  for (size_t i = 0; i < uses.size();) {
    int64_t net = 0;
    const DirectedEdge first = uses[i];
    for (; i < uses.size() && !(first < uses[i]); ++i) net += uses[i].way;
    if (net > 0) open.push_back({first.low, first.high, static_cast<uint32_t>(net)});
    if (net < 0) open.push_back({first.high, first.low, static_cast<uint32_t>(-net)});
  }
  return open;
}

// A walk along unused edges, which ends where it began. Each time that it returns to a vertex, it
// cuts off the loop since then.
Loops join_edges(const std::vector<OpenEdge>& edges, size_t vertices) {
  std::vector<uint64_t> next(vertices + 1, 0);  // first unused edge from each vertex
  for (const OpenEdge& e : edges) next[e.from + 1] += e.count;
  for (size_t v = 0; v < vertices; ++v) next[v + 1] += next[v];
  const std::vector<uint64_t> ends(next.begin() + 1, next.end());
  std::vector<uint32_t> to(ends.empty() ? 0 : ends.back());
  std::vector<uint64_t> filled(next.begin(), next.end() - 1);
  for (const OpenEdge& e : edges)
    for (uint32_t n = 0; n < e.count; ++n) to[filled[e.from]++] = e.to;

  constexpr uint32_t none = UINT32_MAX;
  std::vector<uint32_t> place(vertices, none);  // on the walk
  std::vector<uint32_t> walk;
  Loops loops;
  loops.vertices.reserve(to.size());
  for (uint32_t start = 0; start < vertices; ++start)
    while (next[start] < ends[start]) {
      place[start] = 0;
      walk.assign(1, start);
      while (next[walk.back()] < ends[walk.back()]) {
        const uint32_t v = to[next[walk.back()]++];
        if (place[v] == none) {
          place[v] = static_cast<uint32_t>(walk.size());
          walk.push_back(v);
          continue;
        }
        loops.vertices.insert(loops.vertices.end(), walk.begin() + place[v], walk.end());
        loops.starts.push_back(loops.vertices.size());
        for (size_t i = place[v] + 1; i < walk.size(); ++i) place[walk[i]] = none;
        walk.resize(place[v] + 1);
      }
      place[start] = none;
    }
  return loops;
}

}  // namespace msq
