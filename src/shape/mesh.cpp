// SPDX-License-Identifier: Apache-2.0
#include "shape/mesh.h"

#include <cstdlib>

#include "base/hash_input.h"
#include "base/status.h"
#include "shape/crossed_rows.h"
#include "shape/mesh_diagnosis.h"
#include "shape/self_intersections.h"

namespace msq {

namespace {

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
  for (uint64_t k = block.z0; k < block.z1; ++k)
    fill_crossed_rows(soup_, sheets_, facts_.bounds, block, k,
                      [this](int64_t winding) { return solid(winding); });
}

MeshMap Mesh::mesh_map() const {
  const double magnitude = max_magnitude(bounds().min) + max_magnitude(bounds().max);
  return {this, nullptr, false, bounds(), crossing_error(magnitude)};
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
