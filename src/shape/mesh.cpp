// SPDX-License-Identifier: Apache-2.0
#include "shape/mesh.h"

#include <cstdlib>

#include "base/borrowed.h"
#include "base/hash_input.h"
#include "base/status.h"
#include "shape/mesh_diagnosis.h"
#include "shape/self_intersections.h"
#include "shape/triangle_rows.h"

namespace msq {

namespace {

/// Memory for the rows of a layer.
struct LayerWorkspace {
  std::vector<RowCrossing> crossings, sorted;
  std::vector<uint32_t> row_ends;

  size_t bytes() const {
    return (crossings.capacity() + sorted.capacity()) * sizeof(RowCrossing) +
           row_ends.capacity() * sizeof(uint32_t);
  }
};

uint64_t bytes_of(const TriangleSoup& soup) {
  return soup.vertices.capacity() * sizeof(Vec3) + soup.triangles.capacity() * sizeof(Triangle);
}

}  // namespace

Mesh::Mesh(TriangleSoup soup, WindingRule rule, std::shared_ptr<MemoryBudget> budget,
           const JobPart& part)
    : rule_(rule), budget_(std::move(budget)) {
  check_soup(soup, part.job);
  // Memory during construction: the soup, its weld map and the sorted copies of the diagnosis.
  const uint64_t scratch = soup.vertices.size() * 48 + soup.triangles.size() * 48;
  Reservation building(budget_, bytes_of(soup) + scratch, "building a mesh");
  const uint64_t dropped = weld(soup, part.job);
  if (soup.triangles.empty())
    fail(Status::mesh, "all %llu triangles of the mesh are degenerate",
         static_cast<unsigned long long>(dropped));
  part.set_progress(0.3);
  facts_ = diagnose(soup, part.job);
  facts_.degenerate_triangles += dropped;
  soup_ = std::move(soup);
  part.set_progress(0.8);
  const uint64_t count = soup_.triangles.size();
  columns_ = TriangleBins(soup_, facts_.bounds, bins_for(count, 0.5, 4096),
                          bins_for(count, 0.5, 4096), part.job);
  sheets_ = TriangleBins(soup_, facts_.bounds, 1, bins_for(count, 1.0, 16384), part.job);
  uint64_t bytes = bytes_of(soup_) + columns_.bytes() + sheets_.bytes();
  building = {};
  if (rule_ == WindingRule::automatic && !facts_.closed) {
    const uint64_t edges =
        std::min(3 * count, facts_.open_edges + facts_.non_manifold_edges + facts_.flipped_edges);
    building = Reservation(budget_, bytes + OpenMesh::bytes_to_build(count, edges),
                           "building an open mesh");
    open_ = std::make_unique<OpenMesh>(soup_, facts_.bounds);
    facts_.volume += open_->volume_of_holes();
    bytes += open_->bytes();
    building = {};
  }
  reservation_ = Reservation(budget_, bytes, "a mesh");
}

const MeshBoundary& Mesh::boundary(const Job* job) const {
  return boundary_.get(
      [&] { return std::make_unique<MeshBoundary>(soup_, facts_, rule_, budget_, job); });
}

const DecidedCells& Mesh::cells(const Job* job) const {
  return cells_.get([&] {
    return std::make_unique<DecidedCells>(
        soup_, facts_.bounds, [this](Vec3 p) { return inside(p); }, budget_, job);
  });
}

bool Mesh::inside(Vec3 p) const {
  if (!facts_.bounds.contains(p)) return false;
  RowWinding winding = count_crossings(soup_, columns_.at(p.y, p.z), p);
  if (open_) {
    const int64_t correction = open_->correction(p);
    winding.beyond += correction;
    winding.from += correction;
  }
  return solid(winding.beyond) || solid(winding.from);
}

uint64_t Mesh::self_intersections(const Job* job) const {
  return count_self_intersections(*this, job);
}

void Mesh::fill_rows(const RowBlock& block) const {
  if (open_) return fill_open_rows(block);
  for (uint64_t k = block.z0; k < block.z1; ++k) fill_layer(block, k);
}

void Mesh::fill_layer(const RowBlock& block, uint64_t k) const {
  const SampleGrid& grid = *block.grid;
  const Box3& box = facts_.bounds;
  const double z = grid.z(k);
  if (z < box.min.z || z > box.max.z) return;

  const Borrowed<LayerWorkspace> workspace;
  auto& [crossings, sorted, row_ends] = *workspace;
  crossings.clear();
  add_crossings(soup_, sheets_.at(box.min.y, z), block, k, crossings);
  sort_by_row(crossings, block.rows(), row_ends, sorted);

  const uint64_t first = grid.first_x_from(box.min.x);
  const uint64_t end = grid.first_x_from<true>(box.max.x);
  for (uint64_t r = 0; r < block.rows(); ++r) {
    const double y = grid.y(block.y0 + r);
    if (y < box.min.y || y > box.max.y) continue;
    RowCrossing* const row_begin = sorted.data() + (r ? row_ends[r - 1] : 0);
    RowCrossing* const row_end = sorted.data() + row_ends[r];
    if (row_begin == row_end) continue;
    std::sort(row_begin, row_end,
              [](const RowCrossing& a, const RowCrossing& b) { return a.x < b.x; });
    fill_between(row_begin, row_end, grid, first, end, block.row(block.y0 + r, k),
                 [this](int64_t winding) { return solid(winding); });
  }
}

void Mesh::describe(HashInput& input) const {
  input.kind("shape: mesh");
  // Of closed meshes `automatic` is `nonzero`.
  const bool is_nonzero = rule_ == WindingRule::automatic && facts_.closed;
  input.integer(static_cast<uint64_t>(is_nonzero ? WindingRule::nonzero : rule_));
  input.points(soup_.vertices);
  static_assert(sizeof(Triangle) == 3 * sizeof(uint32_t));
  input.list(soup_.triangles[0].data(), 3 * soup_.triangles.size());
}

}  // namespace msq
