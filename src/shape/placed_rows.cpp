// SPDX-License-Identifier: Apache-2.0
#include "shape/placed_rows.h"

#include <cmath>
#include <limits>

#include "base/infinity.h"
#include "shape/crossed_rows.h"

namespace msq {

namespace {

/// A convex polygon in a plane z = const: the part of a triangle between two such planes, seen
/// along z.
struct Polygon {
  static constexpr size_t most = 6;
  PlanePoint points[most];
  size_t count = 0;

  void add(double x, double y) { points[count++] = {x, y}; }
};

Polygon part_between(const Vec3 (&corners)[3], double low, double high) {
  Polygon part;
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % 3];
    if (a.z >= low && a.z <= high) part.add(a.x, a.y);
    const double first = a.z < b.z ? low : high, second = a.z < b.z ? high : low;
    for (const double z : {first, second}) {
      if (!(std::min(a.z, b.z) < z && z < std::max(a.z, b.z))) continue;
      const double t = (z - a.z) / (b.z - a.z);
      part.add(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
    }
  }
  return part;
}

}  // namespace

/// Samples near triangles, batch by batch.
class PlacedRows::Near {
 public:
  Near(const RowBlock& block, const Shape& definition, const Box3& bounds)
      : block_(block),
        grid_(*block.grid),
        definition_(definition),
        first_(grid_.first_x_from(bounds.min.x)),
        end_(grid_.first_x_from<true>(bounds.max.x)),
        to_index_(1 / grid_.spacing.x) {}

  /// Those of row j of layer k from x = low to high.
  void add(uint64_t j, uint64_t k, double low, double high) {
    // Indices are below 2^31, so their rounding here is below 2^-18.
    constexpr double slack = 0x1p-18;
    const double from = (low - grid_.origin.x) * to_index_,
                 to = (high - grid_.origin.x) * to_index_;
    if (std::ceil(from - slack) > to + slack) return;
    const uint64_t begin = std::max(first_, grid_.first_x_from(low));
    const uint64_t end = std::min(end_, grid_.first_x_from<true>(high));
    for (uint64_t i = begin; i < end; ++i) {
      points_.push_back(grid_.at(i, j, k));
      places_.push_back({block_.row(j, k), i});
      if (points_.size() == batch) settle();
    }
  }

  /// Sets or clears the bits of those that were added.
  void settle() {
    if (points_.empty()) return;
    check_cancelled();
    inside_.resize(points_.size());
    definition_.find_inside(points_.data(), points_.size(), inside_.data());
    for (size_t n = 0; n < points_.size(); ++n) {
      uint64_t& word = places_[n].row[places_[n].i / bits_per_word];
      const uint64_t bit = uint64_t{1} << places_[n].i % bits_per_word;
      word = inside_[n] ? word | bit : word & ~bit;
    }
    points_.clear();
    places_.clear();
  }

 private:
  static constexpr size_t batch = 1024;
  struct Place {
    uint64_t* row;
    uint64_t i;
  };

  const RowBlock& block_;
  const SampleGrid& grid_;
  const Shape& definition_;
  const uint64_t first_, end_;
  const double to_index_;
  std::vector<Vec3> points_;
  std::vector<Place> places_;
  std::vector<uint8_t> inside_;
};

const PlacedRows* PlacedRows::find(const Lazy<PlacedRows>& rows, const Shape& shape,
                                   const Job* job) {
  // So a layer lies in two neighbouring bins at most.
  constexpr double part = 0x1p-20;
  const MeshMap map = shape.mesh_map();
  const Vec3 size = map.bounds.extent();
  if (!map.mesh || !map.mesh->facts().closed || !(map.error <= part * min_component(size)))
    return nullptr;
  return &rows.get([&] { return std::make_unique<const PlacedRows>(map, job); });
}

bool PlacedRows::fill(const Lazy<PlacedRows>& rows, const Shape& shape, const RowBlock& block) {
  const PlacedRows* const found = find(rows, shape, current_job());
  if (found) found->fill(block, shape);
  return found;
}

// Twice the error leaves room for the rounding of what is found with it.
PlacedRows::PlacedRows(const MeshMap& map, const Job* job)
    : mesh_(*map.mesh),
      is_mirrored_(map.is_mirrored),
      bounds_(map.bounds),
      error_(2 * (map.error +
                  crossing_error(max_magnitude(map.bounds.min) + max_magnitude(map.bounds.max)))) {
  const uint64_t vertices = mesh_.vertices().size(), triangles = mesh_.triangles().size();
  constexpr uint64_t bins_of_triangle = 40;
  reservation_ = Reservation(
      mesh_.budget(), vertices * sizeof(Vec3) + triangles * (sizeof(Triangle) + bins_of_triangle),
      "the triangles of a placed mesh");
  soup_.vertices.reserve(vertices);
  CancelPoll poll(job);
  for (const Vec3& v : mesh_.vertices()) {
    poll();
    soup_.vertices.push_back(map.place(v));
  }
  soup_.triangles = mesh_.triangles();
  sheets_ = TriangleBins(soup_, bounds_, 1, bins_for(triangles, 1.0, 16384), job);
}

void PlacedRows::fill(const RowBlock& block, const Shape& definition) const {
  Near near(block, definition, bounds_);
  for (uint64_t k = block.z0; k < block.z1; ++k) {
    check_cancelled();
    const double z = block.grid->z(k);
    if (z < bounds_.min.z || z > bounds_.max.z) continue;
    fill_crossed_rows(soup_, sheets_, bounds_, block, k, [this](int64_t winding) {
      return mesh_.solid(is_mirrored_ ? -winding : winding);
    });
    find_near(block, k, near);
    near.settle();
  }
}

void PlacedRows::find_near(const RowBlock& block, uint64_t k, Near& near) const {
  const SampleGrid& grid = *block.grid;
  const double z = grid.z(k), e = error_;
  const uint64_t first = std::max(block.y0, grid.first_y_from(bounds_.min.y));
  const uint64_t last = std::min(block.y1, grid.first_y_from<true>(bounds_.max.y));
  const auto rows = [&](double low, double high) {
    return std::pair(std::clamp(grid.first_y_from(low), first, std::max(first, last)),
                     std::clamp(grid.first_y_from<true>(high), first, std::max(first, last)));
  };
  // Points of the triangle near the layer are those of its segment in the plane, moved by no more
  // than the edges do on their way through the planes z - e and z + e.
  const auto along_segment = [&](const Vec3& lone, const Vec3& b, const Vec3& c) {
    const Vec3 to_b = b - lone, to_c = c - lone;
    const double s = (z - lone.z) / to_b.z, t = (z - lone.z) / to_c.z;
    const PlanePoint p{lone.x + s * to_b.x, lone.y + s * to_b.y},
        q{lone.x + t * to_c.x, lone.y + t * to_c.y};
    const double wide_x = e * (1 + std::max(std::abs(to_b.x / to_b.z), std::abs(to_c.x / to_c.z)));
    const double wide_y = e * (1 + std::max(std::abs(to_b.y / to_b.z), std::abs(to_c.y / to_c.z)));
    const PlanePoint &low = p.y <= q.y ? p : q, &high = p.y <= q.y ? q : p;
    const double slope = high.y > low.y ? (high.x - low.x) / (high.y - low.y) : 0;
    const auto [j0, j1] = rows(low.y - wide_y, high.y + wide_y);
    for (uint64_t j = j0; j < j1; ++j) {
      const double y = grid.y(j);
      const double from = std::clamp(y - wide_y, low.y, high.y) - low.y,
                   to = std::clamp(y + wide_y, low.y, high.y) - low.y;
      const double x0 = low.x + slope * from;
      // The last part reaches its end, whatever the slope is.
      const double x1 = y + wide_y >= high.y ? high.x : low.x + slope * to;
      near.add(j, k, std::min(x0, x1) - wide_x, std::max(x0, x1) + wide_x);
    }
  };
  const auto in_polygon = [&](const Polygon& part) {
    double low = infinity, high = -infinity;
    for (size_t i = 0; i < part.count; ++i) {
      low = std::min(low, part.points[i].y);
      high = std::max(high, part.points[i].y);
    }
    const auto [j0, j1] = rows(low - e, high + e);
    for (uint64_t j = j0; j < j1; ++j) {
      const double from = grid.y(j) - 2 * e, to = grid.y(j) + 2 * e;
      double left = infinity, right = -infinity;
      for (size_t i = 0; i < part.count; ++i) {
        const PlanePoint &a = part.points[i], &b = part.points[(i + 1) % part.count];
        if (std::max(a.y, b.y) < from || std::min(a.y, b.y) > to) continue;
        for (const double y : {std::clamp(a.y, from, to), std::clamp(b.y, from, to)}) {
          const double x = y == a.y   ? a.x
                           : y == b.y ? b.x
                                      : a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
          left = std::min(left, x);
          right = std::max(right, x);
        }
      }
      if (left <= right) near.add(j, k, left - 2 * e, right + 2 * e);
    }
  };
  const auto visit = [&](const TriangleBins::Range& range) {
    for (const uint32_t i : range) {
      const Triangle& t = soup_.triangles[i];
      const Vec3 corners[3] = {soup_.vertices[t[0]], soup_.vertices[t[1]], soup_.vertices[t[2]]};
      const double a = corners[0].z - z, b = corners[1].z - z, c = corners[2].z - z;
      if (std::min({a, b, c}) > e || std::max({a, b, c}) < -e) continue;
      if (std::min({std::abs(a), std::abs(b), std::abs(c)}) <= e)
        in_polygon(part_between(corners, z - e, z + e));
      else if ((a < 0) == (b < 0))
        along_segment(corners[2], corners[0], corners[1]);
      else if ((b < 0) == (c < 0))
        along_segment(corners[0], corners[1], corners[2]);
      else
        along_segment(corners[1], corners[2], corners[0]);
    }
  };
  const TriangleBins::Range below = sheets_.at(bounds_.min.y, z - e),
                            above = sheets_.at(bounds_.min.y, z + e);
  visit(below);
  if (above.first != below.first) visit(above);
}

}  // namespace msq
