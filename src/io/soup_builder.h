// SPDX-License-Identifier: Apache-2.0
// Gathers the triangles of a file, within the limits of its options and until its job is cancelled.
#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "base/job.h"
#include "base/triangle_soup.h"
#include "io/transform.h"

namespace msq {

class SoupBuilder {
 public:
  /// `bytes`: size of the file, for the progress of the job's part.
  explicit SoupBuilder(uint64_t max_triangles, const JobPart& part = {}, uint64_t bytes = 0)
      : max_triangles_(max_triangles), part_(part), bytes_(bytes) {}

  uint64_t max_triangles() const { return max_triangles_; }
  const Job* job() const { return part_.job; }

  /// Readers call this often, for example for each word or vertex, with the remaining bytes of the
  /// file. Throws Error(cancelled) if the job is cancelled.
  void report(uint64_t bytes_left) {
    if ((++reports_ & 1023) == 0) report_now(bytes_left);
  }
  void report_now(uint64_t bytes_left) const;

  /// So far.
  uint64_t vertices() const { return soup_.vertices.size(); }
  uint64_t triangles() const { return soup_.triangles.size(); }
  /// Throws Error(limit) if `more` triangles would exceed the limit.
  void expect_triangles(uint64_t more) const;
  /// The same for vertices; 32-bit indices limit them to 2^32 - 1.
  void expect_vertices(uint64_t more) const;

  void reserve_vertices(uint64_t count) { soup_.vertices.reserve(count); }
  void add_vertex(Vec3 position) { soup_.vertices.push_back(position); }
  /// Adds a triangle with three vertices of its own.
  void add_triangle(const Vec3 (&corners)[3]);
  /// Faces of one or two vertices are dropped. Throws Error(mesh) on an index out of range.
  void add_polygon(std::span<const int64_t> indices);
  /// Adds a whole mesh; reverses its triangles if the transform mirrors it.
  void add_instance(const TriangleSoup& mesh, const Transform& transform);

  /// Everything gathered, unchanged.
  TriangleSoup take() { return std::move(soup_); }
  /// Everything gathered, scaled. Throws Error(mesh) if there are no triangles or vertices that are
  /// not finite.
  TriangleSoup finish(double scale);

 private:
  uint64_t max_triangles_;
  JobPart part_;
  uint64_t bytes_, reports_ = 0;
  uint64_t faces_ = 0;
  TriangleSoup soup_;
  std::vector<uint32_t> polygon_;
};

/// Drops the vertices that no triangle uses. Indices must be in range.
void drop_unused_vertices(TriangleSoup& mesh);

}  // namespace msq
