// SPDX-License-Identifier: Apache-2.0
// The boundary of a surface of triangles: the edges along which triangles run more often in one
// direction than in the other, and the loops of these edges.
#pragma once

#include <cstdint>
#include <vector>

#include "base/job.h"
#include "base/triangle_soup.h"

namespace msq {

/// An edge along which triangles run `count` times more often from `from` to `to` than back.
struct OpenEdge {
  uint32_t from, to;  // vertices
  uint32_t count;     // > 0
};

/// The open edges of a welded soup, by their vertices. Takes 12 bytes per edge of a triangle.
/// Throws Error(cancelled) with the job, which may be null.
std::vector<OpenEdge> open_edges(const TriangleSoup& soup, const Job* job);

/// Closed loops of three vertices or more.
struct Loops {
  std::vector<uint32_t> vertices;      // loop after loop, none twice in a loop
  std::vector<uint64_t> starts = {0};  // loop i is vertices[starts[i]] up to [starts[i + 1]]

  size_t count() const { return starts.size() - 1; }
};

/// Makes loops that run along each edge as often as it counts. As many edges begin at each vertex
/// as end there, since this holds for each triangle. If there are several ways to divide edges into
/// loops, chooses one.
Loops join_edges(const std::vector<OpenEdge>& edges, size_t vertices);

}  // namespace msq
