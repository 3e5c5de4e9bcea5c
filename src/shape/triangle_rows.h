// SPDX-License-Identifier: Apache-2.0
// Planes z = const cut triangles in segments, and rows of samples cut these segments. Membership of
// meshes is based on these expressions (mesh.h).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/sample_grid.h"
#include "base/triangle_soup.h"
#include "base/vec.h"

namespace msq {

/// A point of the plane z = const.
struct PlanePoint {
  double x, y;
};

/// Where an edge crosses the plane; low.z <= z < high.z.
inline PlanePoint cross_edge(const Vec3& low, const Vec3& high, double z) {
  const double t = (z - low.z) / (high.z - low.z);
  // Clamped to the edge's y, so that rounding does not move it out of the triangle's bins.
  const double y =
      std::clamp(low.y + t * (high.y - low.y), std::min(low.y, high.y), std::max(low.y, high.y));
  return {low.x + t * (high.x - low.x), y};
}

/// The segment in which a plane cuts a triangle, from the edge that runs up to the one that runs
/// down.
struct PlaneSegment {
  PlanePoint up, down;
};

inline bool cut_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double z,
                         PlaneSegment& segment) {
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

/// Where the row y crosses a segment with ends on both sides of it, low.y <= y < high.y.
inline double cross_segment(const PlanePoint& low, const PlanePoint& high, double y) {
  const double t = (y - low.y) / (high.y - low.y);
  return low.x + t * (high.x - low.x);
}

/// Bound on the error of crossings of rows with triangles whose coordinates are up to this.
inline double crossing_error(double magnitude) {
  return 0x1p-47 * magnitude;
}

/// Sign of a crossing: the decrease of the winding number across it along +x. For outward normals
/// the surface is left (+1) where the segment's upward end has the larger y.
inline int crossing_sign(const PlaneSegment& s) {
  return s.up.y > s.down.y ? 1 : -1;
}

/// Winding numbers of the +x ray; they differ for a point on a crossing.
struct RowWinding {
  int64_t beyond = 0, from = 0;  // just right and just left of the point
};

/// From some triangles, given by their numbers, for a point.
template <class Numbers>
RowWinding count_crossings(const TriangleSoup& soup, const Numbers& triangles, Vec3 p) {
  RowWinding winding;
  for (uint32_t i : triangles) {
    const Triangle& t = soup.triangles[i];
    PlaneSegment s;
    if (!cut_triangle(soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]], p.z, s))
      continue;
    const int sign = crossing_sign(s);
    const PlanePoint &low = sign > 0 ? s.down : s.up, &high = sign > 0 ? s.up : s.down;
    if (!(low.y <= p.y && p.y < high.y)) continue;
    const double x = cross_segment(low, high, p.y);
    if (x > p.x) winding.beyond += sign;
    if (x >= p.x) winding.from += sign;
  }
  return winding;
}

struct RowCrossing {
  double x;
  uint32_t row;  // of the block
  int32_t sign;
};

/// Adds the crossings of the rows of a block, in layer k, with some triangles.
template <class Numbers>
void add_crossings(const TriangleSoup& soup, const Numbers& triangles, const RowBlock& block,
                   uint64_t k, std::vector<RowCrossing>& crossings) {
  const SampleGrid& grid = *block.grid;
  const double z = grid.z(k);
  const auto first_row = [&](double y) {
    return std::clamp(grid.first_y_from(y), block.y0, block.y1);
  };
  for (uint32_t i : triangles) {
    const Triangle& t = soup.triangles[i];
    PlaneSegment s;
    if (!cut_triangle(soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]], z, s))
      continue;
    const int sign = crossing_sign(s);
    const PlanePoint &low = sign > 0 ? s.down : s.up, &high = sign > 0 ? s.up : s.down;
    for (uint64_t j = first_row(low.y), end = first_row(high.y); j < end; ++j)
      crossings.push_back(
          {cross_segment(low, high, grid.y(j)), static_cast<uint32_t>(j - block.y0), sign});
  }
}

/// Counting sort by row: the crossings of row r end at row_ends[r].
inline void sort_by_row(const std::vector<RowCrossing>& crossings, uint64_t rows,
                        std::vector<uint32_t>& row_ends, std::vector<RowCrossing>& sorted) {
  row_ends.assign(rows + 1, 0);
  for (const RowCrossing& c : crossings) ++row_ends[c.row + 1];
  for (size_t r = 1; r < row_ends.size(); ++r) row_ends[r] += row_ends[r - 1];
  sorted.resize(crossings.size());
  for (const RowCrossing& c : crossings) sorted[row_ends[c.row]++] = c;
}

/// Sets the bits of the samples [first, end) of a row for which solid(winding number) is true just
/// left or right of them. The crossings of the row are sorted by x.
template <class Solid>
void fill_between(const RowCrossing* row_begin, const RowCrossing* row_end, const SampleGrid& grid,
                  uint64_t first, uint64_t end, uint64_t* row, Solid&& solid) {
  int64_t winding = 0;
  for (auto c = row_begin; c != row_end; ++c) winding += c->sign;
  bool in = solid(winding);
  uint64_t start = first;  // first sample of the current interval, while inside
  for (auto c = row_begin; c != row_end;) {
    const double x = c->x;
    for (; c != row_end && c->x == x; ++c) winding -= c->sign;
    const bool in_beyond = solid(winding);
    if (in && !in_beyond) {
      const uint64_t stop = std::min(end, grid.first_x_from<true>(x));
      if (start < stop) set_bits(row, start, stop - 1);
    } else if (!in && in_beyond) {
      start = std::max(first, grid.first_x_from(x));
    }
    in = in_beyond;
  }
  if (in && start < end) set_bits(row, start, end - 1);
}

}  // namespace msq
