// SPDX-License-Identifier: Apache-2.0
// Gathers the triangles of a file, within the limits of its options.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "base/triangle_soup.h"
#include "io/placement.h"

namespace msq {

class SoupBuilder {
 public:
  explicit SoupBuilder(uint64_t max_triangles) : max_triangles_(max_triangles) {}

  uint64_t max_triangles() const { return max_triangles_; }
  /// Throws Error(limit) if `more` triangles would pass the limit.
  void expect_triangles(uint64_t more) const;
  /// The same for vertices, which 32-bit indices limit to 2^32 - 1.
  void expect_vertices(uint64_t more) const;

  void reserve_vertices(uint64_t count) { soup_.vertices.reserve(count); }
  void add_vertex(Vec3 position) { soup_.vertices.push_back(position); }
  /// Faces of one or two vertices are dropped. Throws Error(mesh) on an index out of range.
  void add_polygon(std::span<const int64_t> indices);
  /// Adds a whole mesh, turned outside out where the placement mirrors it.
  void add_instance(const TriangleSoup& mesh, const Placement& placement);

  /// Everything gathered, as it is.
  TriangleSoup take() { return std::move(soup_); }
  /// Everything gathered, scaled. Throws Error(mesh) if there are no triangles or vertices that are
  /// not finite.
  TriangleSoup finish(double scale);

 private:
  uint64_t max_triangles_;
  uint64_t faces_ = 0;
  TriangleSoup soup_;
  std::vector<uint32_t> polygon_;
};

/// Drops the vertices that no triangle uses. Indices must be in range.
void drop_unused_vertices(TriangleSoup& mesh);

}  // namespace msq
