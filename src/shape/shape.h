// SPDX-License-Identifier: Apache-2.0
// The interface of coarse shapes (scale 0). inside() is the definition; fill_rows() must agree with
// it bit for bit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/described.h"
#include "base/job.h"
#include "base/ray.h"
#include "base/ref.h"
#include "base/sample_grid.h"
#include "base/vec.h"
#include "shape/mesh_map.h"

namespace msq {

/// What is known of a shape; the counts are those of meshes. Meanings: msq_shape_report in msq.h.
struct ShapeFacts {
  bool is_mesh = false;
  bool is_bounded = true;
  Box3 bounds;
  double volume = 0, area = 0;
  uint64_t vertices = 0, triangles = 0;
  uint64_t degenerate_triangles = 0, duplicate_triangles = 0;
  uint64_t open_edges = 0, non_manifold_edges = 0, flipped_edges = 0;
  bool closed = true;
};

class BoundarySearch;

class Shape : public Described {
 public:
  /// No point outside this box is inside the shape.
  const Box3& bounds() const { return facts_.bounds; }
  /// If not, the box is infinite.
  bool is_bounded() const { return facts_.is_bounded; }
  const ShapeFacts& facts() const { return facts_; }

  /// Membership of a finite point; the boundary is inside.
  virtual bool inside(Vec3 p) const = 0;
  /// inside[i] becomes inside(points[i]), 0 or 1.
  virtual void find_inside(const Vec3* points, size_t count, uint8_t* inside) const {
    for (size_t i = 0; i < count; ++i) inside[i] = this->inside(points[i]);
  }
  /// Whether any thread may ask it, several at once; otherwise only the thread that made the host's
  /// call.
  virtual bool is_concurrent() const { return true; }

  /// Signed distance of a finite point: at most 0 where inside(p), positive elsewhere, finite, and
  /// never larger in magnitude than the distance from p to the boundary of the solid.
  double distance(Vec3 p) const;
  /// Whether that of two points differs by no more than the way between them, except for 2^-21 of
  /// the diagonal of bounds() and 2^-41 of the points' coordinates and distances.
  virtual bool has_steady_distance() const { return true; }
  /// Whether distance() of points on that side is exact, except for rounding: within depth_error()
  /// in bounds(), and beyond them within as much more as distances are longer.
  virtual bool is_exact_outside() const { return false; }
  virtual bool is_exact_inside() const { return false; }
  /// How many shapes made of other shapes are within each other.
  virtual unsigned nesting() const { return 0; }
  /// How many shapes it is made of, counted with repetition.
  virtual uint64_t terms() const { return 1; }
  /// Builds what distance() needs, if anything; otherwise its first call does, or throws what this
  /// throws. Throws Error(cancelled) where the job, which may be null, is cancelled.
  virtual void prepare_distance(const Job*) const {}
  /// The same for what fill_rows() needs.
  virtual void prepare_rows(const Job*) const {}

  /// How deep a point of the shape lies under the boundary, or under the part of it that skins
  /// follow: no less than -distance(p). Default: that.
  virtual double depth(Vec3 p) const { return distance_bound(p); }
  /// The same, where the distance is known.
  virtual double depth(Vec3, double distance) const { return -distance; }
  /// Whether that is, within depth_error() for points in bounds(), the distance to some closed set.
  virtual bool knows_depth() const { return false; }
  virtual double depth_error() const { return std::numeric_limits<double>::infinity(); }
  /// Searches of that set where they are faster than depth(); null where they are not.
  virtual const BoundarySearch* boundary_search() const { return nullptr; }
  /// Sets the bits of the samples of the shape whose depth() is at most this, and of any others
  /// that are not in the shape. False, with nothing done, where asking depth() is as fast.
  virtual bool fill_shallow_rows(double, const RowBlock&) const { return false; }
  /// The first t in [from, to] at which the ray is inside, within ray_tolerance() past it; false if
  /// there is none. Parts shorter than that may be overlooked. Stops early, by Error(cancelled),
  /// with the job, within some milliseconds. Default: marches by the distance.
  virtual bool enter(const Ray& ray, double from, double to, double& t, const Job* job) const;
  /// A t up to which a ray that is inside at `from` stays inside: as far as is known at once, at
  /// most `to`. Default: marches by the distance.
  virtual double leave(const Ray& ray, double from, double to, const Job* job) const;
  /// enter(), and then `end`, what leave() returns from t on; t where that is past `to`.
  virtual bool cross(const Ray& ray, double from, double to, double& t, double& end,
                     const Job* job) const;
  /// Whether rays are best evaluated together, by the functions that take several.
  virtual bool gains_by_rays() const { return false; }
  /// Whether it is the box bounds().
  virtual bool is_box() const { return false; }
  /// As enter() for each search: found and t, where it was.
  virtual void enter_all(RaySearch* searches, size_t count, const Job* job) const;
  /// As leave() for each search: t.
  virtual void leave_all(RaySearch* searches, size_t count, const Job* job) const;
  /// The outward normal, of length 1, where the ray enters at t; the direction back where there is
  /// none. Default: from membership around the point.
  virtual Vec3 normal(const Ray& ray, double t) const;
  /// normal() for each search, at t.
  virtual void find_normals(RaySearch* searches, size_t count) const;
  /// Rays that march go on by no less than this, whatever distance() says. Less only where that is
  /// 0 nowhere but at the boundary.
  virtual double min_ray_step() const { return max_component(bounds().extent()) / 1024; }
  double ray_tolerance() const {
    if (!is_bounded()) return 0;
    return std::max(min_tolerance_,
                    0x1p-36 * (max_component(bounds().extent()) + max_magnitude(bounds().min) +
                               max_magnitude(bounds().max)));
  }

  /// The mesh that it is, and where.
  virtual MeshMap mesh_map() const { return {}; }
  /// Number of pairs of triangles that meet where they should not; none where there are no
  /// triangles.
  virtual uint64_t self_intersections(const Job*) const { return 0; }

  /// Sets the bits of the samples that are inside, in a block of zeros. Default: asks inside() of
  /// every sample in bounds().
  virtual void fill_rows(const RowBlock& block) const;
  /// Whether fill_rows() of the parts of a layer takes no longer than that of the layer: of other
  /// shapes, each part would search for what meets the layer.
  virtual bool fills_rows_apart() const { return false; }
  /// Whether all samples of a block are inside, if that is known at once. False is always valid.
  virtual bool holds_block(const RowBlock&) const { return false; }
  /// How many layers one call of fill_rows() has at best: they share what is found about them.
  virtual uint64_t layers_together() const { return 1; }

 protected:
  /// A lower bound of the distance from a point to the boundary of the solid, on either side of it;
  /// finite, not negative, with the rounding of this function and of inside() subtracted. The point
  /// lies no farther from bounds() than 2^60 times their size.
  virtual double distance_bound(Vec3 p) const = 0;

  /// The first t in [from, to] where membership is `wanted`, by distance_bound() and
  /// min_ray_step().
  bool march(bool wanted, const Ray& ray, double from, double to, double& t, const Job* job) const;
  /// At which membership is evaluated for a normal.
  double normal_distance() const { return 1e-4 * max_component(bounds().extent()); }

  /// Calls visit(y, z, row, first, end) for each row of a block that has samples first to end - 1
  /// in bounds().
  template <class Visit>
  void for_each_row_in_bounds(const RowBlock& block, Visit&& visit) const;

  ShapeFacts facts_;
  double min_tolerance_ = 0;  // of rays
};

template <class Visit>
void Shape::for_each_row_in_bounds(const RowBlock& block, Visit&& visit) const {
  const SampleGrid& grid = *block.grid;
  const Box3& box = bounds();
  const uint64_t first = grid.first_x_from(box.min.x);
  const uint64_t end = grid.first_x_from<true>(box.max.x);
  if (first >= end) return;
  for (uint64_t k = block.z0; k < block.z1; ++k) {
    const double z = grid.z(k);
    if (z < box.min.z || z > box.max.z) continue;
    for (uint64_t j = block.y0; j < block.y1; ++j) {
      const double y = grid.y(j);
      if (y < box.min.y || y > box.max.y) continue;
      visit(y, z, block.row(j, k), first, end);
    }
  }
}

}  // namespace msq
