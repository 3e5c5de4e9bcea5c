// SPDX-License-Identifier: Apache-2.0
// Cells by a map that the host samples: three images on one grid give the coordinates of a point,
// counted in cells, by linear interpolation along each axis (shape/image.h). The cells fill the box
// of the samples. Beyond it the coordinates are those of the border.
//
// The map has one orientation: the determinant of its derivatives, a polynomial of degree 2 in each
// variable, has one sign in each voxel. That is proven by its Bernstein coefficients, which enclose
// it. Source: Garloff, "Convergent bounds for the range of multivariate polynomials", 1985.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "base/interval.h"
#include "base/ref.h"
#include "base/vec.h"
#include "cell/neighbourhood.h"
#include "field/grid.h"

namespace msq {

class SampledMap {
 public:
  using Fields = std::array<Ref<const GridField>, 3>;
  /// Coordinates, in magnitude.
  static constexpr double max_coordinate = 1 << 22;

  /// Throws Error(argument) if the fields have different grids, fewer than two samples along an
  /// axis or values above max_coordinate, or if the map folds: the message names the voxel and the
  /// point. Error(cancelled) with the thread's job.
  explicit SampledMap(Fields fields);

  /// The definition.
  struct Place {
    Vec3 cells;
    bool is_in_box;
  };
  Place place(Vec3 p) const { return place_at(to_voxels(p)); }
  Vec3 to_cells(Vec3 p) const { return cells_at(to_voxels(p)); }
  bool is_in_box(Vec3 p) const { return is_in_voxels(to_voxels(p)); }
  /// The same of a position in the frame of the samples, in model units.
  Vec3 cells_of(Vec3 g) const { return cells_at(g * image(0).scale()); }

  /// What the searches for some places cost together, on any threads: a block of voxels or a voxel
  /// counts 1, and 64 where Newton's method tries one. In maps that do not have the same
  /// coordinates many times, a place costs about 200.
  class SearchCost {
   public:
    explicit SearchCost(uint64_t places) : most_(std::max(least_, per_place_ * places)) {}
    /// Throws Error(limit) beyond the bound, and Error(cancelled) with the thread's job.
    void add(uint64_t cost);

   private:
    static constexpr uint64_t least_ = uint64_t{1} << 27, per_place_ = 1024;
    const uint64_t most_;
    std::atomic<uint64_t> sum_{0};
  };
  /// The position in the frame of the samples, in model units, that has these coordinates: in the
  /// first voxel, in the order of search, that has them up to 2^-32 of its size. False if there is
  /// none. Source: Newton's method.
  bool find(Vec3 cells, Vec3& g, SearchCost& cost) const;

  const Image& image(int axis) const { return fields_[static_cast<size_t>(axis)]->image(); }
  const ImageFrame& frame() const { return image(0).frame(); }
  /// Cubes in the frame of the samples, as long as the smallest cells at least are, everywhere and
  /// in every direction.
  Neighbourhood smallest() const;
  /// The cube roots of the mean and of the largest volume of cells.
  double mean_size() const { return mean_size_; }
  double largest_size() const { return largest_size_; }
  /// The length of the longest edge that a cell has in the middle of any voxel.
  double longest_edge() const { return longest_edge_; }
  Interval range(int axis) const { return image(axis).range(); }
  /// Those that the coordinates run over.
  struct Cells {
    CellIndex first;
    uint64_t count[3];
    double all;  // the product of the counts
  };
  Cells cells() const;
  /// The box of the samples, in their frame.
  Box3 box() const;

  /// Encloses the coordinates of the points of a box in model coordinates.
  Box3 image_of(const Box3& box) const;
  /// Whether none, or all, of a box's points are in the box of the samples; neither if in doubt.
  enum class Side { both, outside, inside };
  Side side_of(const Box3& box) const;
  /// The distance from a point to the border of that box, negative outside, with rounding.
  double distance_within(Vec3 p) const;

  /// Encloses the slopes of a coordinate in a box; empty if that has too many samples.
  std::optional<Slopes> slopes_in(int axis, const Box3& box) const {
    return fields_[static_cast<size_t>(axis)]->slopes(box);
  }
  /// Bounds the length of differences of coordinates over distances, everywhere.
  double steepness() const { return steepness_; }
  /// The same for each coordinate.
  Vec3 slopes() const { return slopes_; }
  /// Bounds the rounding of coordinates, besides that of the point (slack()).
  double rounding() const { return rounding_; }
  /// A bound on the displacement by rounding of points within that distance of p.
  double slack(Vec3 p, double distance) const;
  /// The gradients of the coordinates at a point, in the model's frame, up to rounding.
  std::array<Vec3, 3> gradients(Vec3 p) const;

  void describe(HashInput& input) const;

 private:
  struct Voxel {
    uint64_t at[3];
    double samples[3][8];
  };
  Voxel voxel(uint64_t x, uint64_t y, uint64_t z) const;
  Vec3 to_voxels(Vec3 p) const { return image(0).to_voxels(p); }
  Vec3 cells_at(Vec3 voxels) const {
    return {image(0).value(voxels), image(1).value(voxels), image(2).value(voxels)};
  }
  bool is_in_voxels(Vec3 u) const {
    return u.x >= 0 && u.y >= 0 && u.z >= 0 && u.x <= top_.x && u.y <= top_.y && u.z <= top_.z;
  }
  Place place_at(Vec3 voxels) const { return {cells_at(voxels), is_in_voxels(voxels)}; }
  void check_grids() const;
  void examine();
  [[noreturn]] void refuse(const Voxel& voxel, Vec3 fraction, double determinant) const;
  bool find_below(size_t level, const uint64_t (&block)[3], Vec3 cells, Vec3& g,
                  SearchCost& cost) const;

  Fields fields_;
  Vec3 top_;  // the last sample
  double steepness_ = 0, mean_size_ = 0, largest_size_ = 0, longest_edge_ = 0, rounding_ = 0;
  Vec3 slopes_;
};

}  // namespace msq
