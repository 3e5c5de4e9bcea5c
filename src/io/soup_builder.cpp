// SPDX-License-Identifier: Apache-2.0
#include "io/soup_builder.h"

#include <utility>

#include "base/status.h"
#include "io/polygon.h"

namespace msq {
namespace {

using Count = unsigned long long;  // as printf wants it

}  // namespace

void SoupBuilder::report_now(uint64_t bytes_left) const {
  check_cancelled(part_.job);
  if (bytes_) part_.set_progress(1 - static_cast<double>(bytes_left) / static_cast<double>(bytes_));
}

void SoupBuilder::expect_triangles(uint64_t more) const {
  const uint64_t held = soup_.triangles.size();
  if (held > max_triangles_ || more > max_triangles_ - held)
    fail(Status::limit, "the mesh has %llu or more triangles; max_triangles is %llu",
         static_cast<Count>(more > UINT64_MAX - held ? UINT64_MAX : held + more),
         static_cast<Count>(max_triangles_));
}

void SoupBuilder::expect_vertices(uint64_t more) const {
  const uint64_t held = soup_.vertices.size();
  if (more > UINT32_MAX - held)
    fail(Status::limit, "the mesh has %llu more vertices after %llu; the limit is %llu",
         static_cast<Count>(more), static_cast<Count>(held), static_cast<Count>(UINT32_MAX));
}

void SoupBuilder::add_polygon(std::span<const int64_t> indices) {
  polygon_.clear();
  for (const int64_t index : indices) {
    if (index < 0 || static_cast<uint64_t>(index) >= soup_.vertices.size())
      fail(Status::mesh, "face %llu has vertex index %lld; there are %llu vertices",
           static_cast<Count>(faces_), static_cast<long long>(index),
           static_cast<Count>(soup_.vertices.size()));
    polygon_.push_back(static_cast<uint32_t>(index));
  }
  ++faces_;
  if (polygon_.size() < 3) return;
  expect_triangles(polygon_.size() - 2);
  triangulate_polygon(soup_.vertices, polygon_, soup_.triangles, part_.job);
}

void SoupBuilder::add_triangle(const Vec3 (&corners)[3]) {
  expect_triangles(1);
  expect_vertices(3);
  const auto first = static_cast<uint32_t>(soup_.vertices.size());
  soup_.vertices.insert(soup_.vertices.end(), corners, corners + 3);
  soup_.triangles.push_back({first, first + 1, first + 2});
}

void SoupBuilder::add_instance(const TriangleSoup& mesh, const Transform& transform) {
  expect_triangles(mesh.triangles.size());
  expect_vertices(mesh.vertices.size());
  const auto first = static_cast<uint32_t>(soup_.vertices.size());
  CancelPoll poll(part_.job);
  for (const Vec3& vertex : mesh.vertices) {
    poll();
    soup_.vertices.push_back(transform.apply(vertex));
  }
  const bool mirrored = transform.determinant() < 0;
  for (Triangle triangle : mesh.triangles) {
    poll();
    if (mirrored) std::swap(triangle[1], triangle[2]);
    soup_.triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
  }
}

TriangleSoup SoupBuilder::finish(double scale) {
  if (soup_.triangles.empty()) fail(Status::mesh, "the file has no triangles");
  CancelPoll poll(part_.job);
  for (Vec3& vertex : soup_.vertices) {
    poll();
    vertex = vertex * scale;
    if (!is_finite(vertex))
      fail(Status::mesh, "vertex %llu is not finite: %g %g %g",
           static_cast<Count>(&vertex - soup_.vertices.data()), vertex.x, vertex.y, vertex.z);
  }
  return take();
}

void drop_unused_vertices(TriangleSoup& mesh) {
  std::vector<uint32_t> renumbered(mesh.vertices.size(), UINT32_MAX);
  std::vector<Vec3> kept;
  for (Triangle& triangle : mesh.triangles)
    for (uint32_t& index : triangle) {
      if (renumbered[index] == UINT32_MAX) {
        renumbered[index] = static_cast<uint32_t>(kept.size());
        kept.push_back(mesh.vertices[index]);
      }
      index = renumbered[index];
    }
  mesh.vertices = std::move(kept);
}

}  // namespace msq
