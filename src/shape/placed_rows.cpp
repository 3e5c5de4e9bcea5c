// SPDX-License-Identifier: Apache-2.0
#include "shape/placed_rows.h"

#include <cmath>

#include "base/infinity.h"
#include "base/memory.h"
#include "shape/asked_samples.h"
#include "shape/crossed_rows.h"
#include "shape/mesh.h"
#include "shape/row_boxes.h"

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

/// Asks the samples that are near triangles.
class NearSamples {
 public:
  /// error: twice that of placed_rows.h, which leaves room for the rounding of what is found here.
  NearSamples(const RowBlock& block, const Shape& shape, double error)
      : grid_(*block.grid),
        error_(error),
        first_x_(grid_.first_x_from(shape.bounds().min.x)),
        end_x_(grid_.first_x_from<true>(shape.bounds().max.x)),
        first_y_(std::max(block.y0, grid_.first_y_from(shape.bounds().min.y))),
        end_y_(
            std::max(first_y_, std::min(block.y1, grid_.first_y_from<true>(shape.bounds().max.y)))),
        to_index_(1 / grid_.spacing.x),
        asked_(block, shape) {}

  void begin_layer(uint64_t k) {
    k_ = k;
    z_ = grid_.z(k);
  }

  /// Of the layer.
  void add(const Vec3 (&corners)[3]) {
    const double a = corners[0].z - z_, b = corners[1].z - z_, c = corners[2].z - z_;
    if (std::min({a, b, c}) > error_ || std::max({a, b, c}) < -error_) return;
    if (std::min({std::abs(a), std::abs(b), std::abs(c)}) <= error_)
      add_polygon(part_between(corners, z_ - error_, z_ + error_));
    else if ((a < 0) == (b < 0))
      add_segment(corners[2], corners[0], corners[1]);
    else if ((b < 0) == (c < 0))
      add_segment(corners[0], corners[1], corners[2]);
    else
      add_segment(corners[1], corners[2], corners[0]);
  }

  void end_layer() { asked_.ask(); }

 private:
  struct Rows {
    uint64_t begin, end;
  };
  Rows rows(double low, double high) const {
    return {std::clamp(grid_.first_y_from(low), first_y_, end_y_),
            std::clamp(grid_.first_y_from<true>(high), first_y_, end_y_)};
  }

  /// Of a triangle with one corner alone on its side of the plane. Its points near the layer are
  /// those of its segment in the plane, moved by no more than the edges do on their way through the
  /// planes z - error and z + error.
  void add_segment(const Vec3& lone, const Vec3& b, const Vec3& c) {
    const Vec3 to_b = b - lone, to_c = c - lone;
    const double s = (z_ - lone.z) / to_b.z, t = (z_ - lone.z) / to_c.z;
    const PlanePoint p{lone.x + s * to_b.x, lone.y + s * to_b.y},
        q{lone.x + t * to_c.x, lone.y + t * to_c.y};
    const double wide_x =
        error_ * (1 + std::max(std::abs(to_b.x / to_b.z), std::abs(to_c.x / to_c.z)));
    const double wide_y =
        error_ * (1 + std::max(std::abs(to_b.y / to_b.z), std::abs(to_c.y / to_c.z)));
    const PlanePoint &low = p.y <= q.y ? p : q, &high = p.y <= q.y ? q : p;
    const double slope = high.y > low.y ? (high.x - low.x) / (high.y - low.y) : 0;
    const Rows near = rows(low.y - wide_y, high.y + wide_y);
    for (uint64_t j = near.begin; j < near.end; ++j) {
      const double y = grid_.y(j);
      const double from = std::clamp(y - wide_y, low.y, high.y) - low.y,
                   to = std::clamp(y + wide_y, low.y, high.y) - low.y;
      const double x0 = low.x + slope * from;
      // The last part reaches its end, whatever the slope is.
      const double x1 = y + wide_y >= high.y ? high.x : low.x + slope * to;
      add_row(j, std::min(x0, x1) - wide_x, std::max(x0, x1) + wide_x);
    }
  }

  void add_polygon(const Polygon& part) {
    double low = infinity, high = -infinity;
    for (size_t i = 0; i < part.count; ++i) {
      low = std::min(low, part.points[i].y);
      high = std::max(high, part.points[i].y);
    }
    const Rows near = rows(low - error_, high + error_);
    for (uint64_t j = near.begin; j < near.end; ++j) {
      const double from = grid_.y(j) - 2 * error_, to = grid_.y(j) + 2 * error_;
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
      if (left <= right) add_row(j, left - 2 * error_, right + 2 * error_);
    }
  }

  /// The samples of row j from x = low to high.
  void add_row(uint64_t j, double low, double high) {
    // Indices are below 2^31, so their rounding here is below 2^-18.
    constexpr double slack = 0x1p-18;
    const double from = (low - grid_.origin.x) * to_index_,
                 to = (high - grid_.origin.x) * to_index_;
    if (std::ceil(from - slack) > to + slack) return;
    asked_.add(std::max(first_x_, grid_.first_x_from(low)),
               std::min(end_x_, grid_.first_x_from<true>(high)), j, k_);
  }

  const SampleGrid& grid_;
  const double error_;
  const uint64_t first_x_, end_x_, first_y_, end_y_;  // of the samples in the shape's bounds
  const double to_index_;
  AskedSamples asked_;
  uint64_t k_ = 0;
  double z_ = 0;
};

}  // namespace

class PlacedRows::Triangles {
 public:
  /// Of a closed mesh that is much larger than the error; otherwise there are none.
  Triangles(const MeshMap& map, const Job* job);

  bool exist() const { return mesh_ != nullptr; }
  void fill(const Shape& shape, const RowBlock& block) const;

 private:
  const Mesh* mesh_ = nullptr;  // the shape keeps it
  bool is_mirrored_ = false;
  Box3 bounds_;
  double error_ = 0;  // twice that of the header's comment
  Reservation reservation_;
  TriangleSoup soup_;
  TriangleBins sheets_;  // bins of z alone
};

PlacedRows::Triangles::Triangles(const MeshMap& map, const Job* job) {
  // So a layer lies in two neighbouring bins at most.
  constexpr double part = 0x1p-20;
  if (!map.mesh || !map.mesh->facts().closed ||
      !(map.error <= part * min_component(map.bounds.extent())))
    return;
  mesh_ = map.mesh;
  is_mirrored_ = map.is_mirrored;
  bounds_ = map.bounds;
  error_ = 2 * (map.error +
                crossing_error(max_magnitude(map.bounds.min) + max_magnitude(map.bounds.max)));
  const uint64_t vertices = mesh_->vertices().size(), triangles = mesh_->triangles().size();
  constexpr uint64_t bins_of_triangle = 40;
  reservation_ = Reservation(
      mesh_->budget(), vertices * sizeof(Vec3) + triangles * (sizeof(Triangle) + bins_of_triangle),
      "the triangles of a placed mesh");
  soup_.vertices.reserve(vertices);
  CancelPoll poll(job);
  for (const Vec3& v : mesh_->vertices()) {
    poll();
    soup_.vertices.push_back(map.place(v));
  }
  soup_.triangles = mesh_->triangles();
  sheets_ = TriangleBins(soup_, bounds_, 1, bins_for(triangles, 1.0, 16384), job);
}

void PlacedRows::Triangles::fill(const Shape& shape, const RowBlock& block) const {
  NearSamples near(block, shape, error_);
  const auto add = [&](const TriangleBins::Range& range) {
    for (const uint32_t i : range) {
      const Triangle& t = soup_.triangles[i];
      near.add({soup_.vertices[t[0]], soup_.vertices[t[1]], soup_.vertices[t[2]]});
    }
  };
  for (uint64_t k = block.z0; k < block.z1; ++k) {
    check_cancelled();
    const double z = block.grid->z(k);
    if (z < bounds_.min.z || z > bounds_.max.z) continue;
    fill_crossed_rows(soup_, sheets_, bounds_, block, k, [this](int64_t winding) {
      return mesh_->solid(is_mirrored_ ? -winding : winding);
    });
    near.begin_layer(k);
    const TriangleBins::Range below = sheets_.at(bounds_.min.y, z - error_),
                              above = sheets_.at(bounds_.min.y, z + error_);
    add(below);
    if (above.first != below.first) add(above);
    near.end_layer();
  }
}

PlacedRows::PlacedRows() = default;
PlacedRows::~PlacedRows() = default;

const PlacedRows::Triangles& PlacedRows::triangles(const Shape& shape, const Job* job) const {
  return triangles_.get([&] { return std::make_unique<const Triangles>(shape.mesh_map(), job); });
}

void PlacedRows::prepare(const Shape& shape, const Job* job) const {
  if (!triangles(shape, job).exist()) shape.prepare_distance(job);
}

void PlacedRows::fill(const Shape& shape, const RowBlock& block) const {
  if (const Triangles& placed = triangles(shape, current_job()); placed.exist())
    placed.fill(shape, block);
  else
    RowBoxes::fill(shape, block);
}

}  // namespace msq
