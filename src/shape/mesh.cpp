// SPDX-License-Identifier: Apache-2.0
#include "shape/mesh.h"

#include <cstdlib>

#include "base/status.h"
#include "shape/mesh_diagnosis.h"
#include "shape/self_intersections.h"

namespace msq {

namespace {

/// A point of the plane z = const.
struct PlanePoint {
  double x, y;
};

/// Where an edge crosses the plane; low.z <= z < high.z.
inline PlanePoint cross_edge(const Vec3& low, const Vec3& high, double z) {
  const double t = (z - low.z) / (high.z - low.z);
  // Within the edge's y, so that rounding does not carry it out of the triangle's bins.
  const double y =
      std::clamp(low.y + t * (high.y - low.y), std::min(low.y, high.y), std::max(low.y, high.y));
  return {low.x + t * (high.x - low.x), y};
}

/// The segment in which a plane cuts a triangle, from the edge that runs up to the one that runs
/// down.
struct Segment {
  PlanePoint up, down;
};

inline bool cut_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double z, Segment& segment) {
  const bool below_a = a.z <= z, below_b = b.z <= z, below_c = c.z <= z;
  if (below_a == below_b && below_b == below_c) return false;
  const auto edge = [&](const Vec3& p, const Vec3& q, bool below_p, bool below_q) {
    if (below_p == below_q) return;
    if (below_p)
      segment.up = cross_edge(p, q, z);
    else
      segment.down = cross_edge(q, p, z);
  };
  edge(a, b, below_a, below_b);
  edge(b, c, below_b, below_c);
  edge(c, a, below_c, below_a);
  return true;
}

/// Where the row y crosses a segment that it separates, low.y <= y < high.y.
inline double cross_segment(const PlanePoint& low, const PlanePoint& high, double y) {
  const double t = (y - low.y) / (high.y - low.y);
  return low.x + t * (high.x - low.x);
}

/// Sign of a crossing: what the winding number loses on passing it along +x. For outward normals
/// the surface is left (+1) where the segment's upward end has the larger y.
inline int crossing_sign(const Segment& s) {
  return s.up.y > s.down.y ? 1 : -1;
}

struct Crossing {
  double x;
  uint32_t row;
  int32_t sign;
};

uint32_t bins_for(uint64_t triangles, double power, uint32_t most) {
  return static_cast<uint32_t>(
      std::clamp(std::pow(static_cast<double>(triangles), power), 1.0, static_cast<double>(most)));
}

uint64_t bytes_of(const TriangleSoup& soup) {
  return soup.vertices.capacity() * sizeof(Vec3) + soup.triangles.capacity() * sizeof(Triangle);
}

}  // namespace

Mesh::Mesh(TriangleSoup soup, WindingRule rule, std::shared_ptr<MemoryBudget> budget)
    : rule_(rule), budget_(std::move(budget)) {
  check_soup(soup);
  // While it is built: the soup, its weld map and the sorted copies of the diagnosis.
  const uint64_t scratch = soup.vertices.size() * 48 + soup.triangles.size() * 48;
  Reservation building(budget_, bytes_of(soup) + scratch, "building a mesh");
  const uint64_t dropped = weld(soup);
  if (soup.triangles.empty())
    fail(Status::mesh, "all %llu triangles of the mesh are degenerate",
         static_cast<unsigned long long>(dropped));
  facts_ = diagnose(soup);
  facts_.degenerate_triangles += dropped;
  soup_ = std::move(soup);
  const uint64_t count = soup_.triangles.size();
  columns_ =
      TriangleBins(soup_, facts_.bounds, bins_for(count, 0.5, 4096), bins_for(count, 0.5, 4096));
  sheets_ = TriangleBins(soup_, facts_.bounds, 1, bins_for(count, 1.0, 16384));
  building = {};
  reservation_ =
      Reservation(budget_, bytes_of(soup_) + columns_.bytes() + sheets_.bytes(), "a mesh");
}

const MeshBoundary& Mesh::boundary() const {
  return boundary_.get(
      [this] { return std::make_unique<MeshBoundary>(soup_, facts_, rule_, budget_); });
}

bool Mesh::inside(Vec3 p) const {
  if (!facts_.bounds.contains(p)) return false;
  int64_t beyond = 0, from = 0;  // winding numbers just right and just left of p
  for (uint32_t i : columns_.at(p.y, p.z)) {
    const Triangle& t = soup_.triangles[i];
    Segment s;
    if (!cut_triangle(soup_.vertices[t[0]], soup_.vertices[t[1]], soup_.vertices[t[2]], p.z, s))
      continue;
    const int sign = crossing_sign(s);
    const PlanePoint &low = sign > 0 ? s.down : s.up, &high = sign > 0 ? s.up : s.down;
    if (!(low.y <= p.y && p.y < high.y)) continue;
    const double x = cross_segment(low, high, p.y);
    if (x > p.x) beyond += sign;
    if (x >= p.x) from += sign;
  }
  return solid(beyond) || solid(from);
}

uint64_t Mesh::self_intersections(const Job* job) const {
  return count_self_intersections(*this, job);
}

void Mesh::fill_rows(const RowBlock& block) const {
  for (uint64_t k = block.z0; k < block.z1; ++k) fill_layer(block, k);
}

void Mesh::fill_layer(const RowBlock& block, uint64_t k) const {
  const SampleGrid& grid = *block.grid;
  const Box3& box = facts_.bounds;
  const double z = grid.z(k);
  if (z < box.min.z || z > box.max.z) return;

  thread_local std::vector<Crossing> crossings, sorted;
  thread_local std::vector<uint32_t> row_ends;
  crossings.clear();
  const auto first_row = [&](double y) {
    return std::clamp(first_sample_from(grid.origin.y, grid.spacing.y, grid.ny, y), block.y0,
                      block.y1);
  };
  for (uint32_t i : sheets_.at(box.min.y, z)) {
    const Triangle& t = soup_.triangles[i];
    Segment s;
    if (!cut_triangle(soup_.vertices[t[0]], soup_.vertices[t[1]], soup_.vertices[t[2]], z, s))
      continue;
    const int sign = crossing_sign(s);
    const PlanePoint &low = sign > 0 ? s.down : s.up, &high = sign > 0 ? s.up : s.down;
    for (uint64_t j = first_row(low.y), end = first_row(high.y); j < end; ++j)
      crossings.push_back(
          {cross_segment(low, high, grid.y(j)), static_cast<uint32_t>(j - block.y0), sign});
  }

  // Counting sort by row, then by x within the row.
  row_ends.assign(block.rows() + 1, 0);
  for (const Crossing& c : crossings) ++row_ends[c.row + 1];
  for (size_t r = 1; r < row_ends.size(); ++r) row_ends[r] += row_ends[r - 1];
  sorted.resize(crossings.size());
  for (const Crossing& c : crossings) sorted[row_ends[c.row]++] = c;

  const uint64_t first = first_sample_from(grid.origin.x, grid.spacing.x, grid.nx, box.min.x);
  const uint64_t end = first_sample_from<true>(grid.origin.x, grid.spacing.x, grid.nx, box.max.x);
  for (uint64_t r = 0; r < block.rows(); ++r) {
    const double y = grid.y(block.y0 + r);
    if (y < box.min.y || y > box.max.y) continue;
    const auto row_begin = sorted.begin() + (r ? row_ends[r - 1] : 0);
    const auto row_end = sorted.begin() + row_ends[r];
    if (row_begin == row_end) continue;
    std::sort(row_begin, row_end, [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    uint64_t* row = block.row(block.y0 + r, k);

    int64_t winding = 0;
    for (auto c = row_begin; c != row_end; ++c) winding += c->sign;
    bool in = solid(winding);
    uint64_t start = first;  // first sample of the interval that is open, while in
    for (auto c = row_begin; c != row_end;) {
      const double x = c->x;
      for (; c != row_end && c->x == x; ++c) winding -= c->sign;
      const bool in_beyond = solid(winding);
      if (in && !in_beyond) {
        const uint64_t stop =
            std::min(end, first_sample_from<true>(grid.origin.x, grid.spacing.x, grid.nx, x));
        if (start < stop) set_bits(row, start, stop - 1);
      } else if (!in && in_beyond) {
        start = std::max(first, first_sample_from(grid.origin.x, grid.spacing.x, grid.nx, x));
      }
      in = in_beyond;
    }
    if (in && start < end) set_bits(row, start, end - 1);
  }
}

}  // namespace msq
