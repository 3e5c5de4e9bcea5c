// SPDX-License-Identifier: Apache-2.0
// Cells around an axis or around a point: a map from space to coordinates counted in cells.
//
// With (x, y, z) the position in the grid's frame (Neighbourhood::to_grid()), the coordinates are
//   u = (r - inner radius) / cell size x,
//   v = count / (2 pi) atan2(y, x), plus count where that is negative: 0 <= v < count,
// and, around the z axis, r = sqrt(x^2 + y^2) and w = z / cell size z; around the origin,
// r = sqrt(x^2 + y^2 + z^2) and w = count_polar / pi (atan2(z, sqrt(x^2 + y^2)) + pi / 2), from 0
// at the south pole to count_polar at the north pole. On the positive x axis the directions of u, v
// and w are those of x, y and z. warp-inl.h says in which order they are rounded.
//
// Around an axis the cells may be sheared: shear_outwards u + shear_along w is added to v, and v is
// taken modulo count again. So cells turn around the axis from cell to cell.
//
// Cells are those of whole numbers. v is counted modulo count, so the cells close. Points with r
// below the inner or above the outer radius are outside of the shell that the cells fill.
//
// Slopes. Without a shear the gradients of u, v and w are perpendicular to each other. Their
// lengths are 1 / cell size x; count / (2 pi rho) at a distance rho from the axis; and 1 / cell
// size z, or count_polar / (pi r).
#pragma once

#include <array>

#include "base/interval.h"
#include "base/vec.h"
#include "cell/neighbourhood.h"

namespace msq {

class Warp {
 public:
  enum class Kind : int32_t { cylindrical = 1, spherical = 2 };
  struct Shell {
    uint32_t count = 0, count_polar = 0;  // cells around; from pole to pole, if spherical
    double inner = 0, outer = 0;          // radii; outer 0: no limit
    // Around an axis: cells around per cell outwards, and per cell along the axis.
    double shear_outwards = 0, shear_along = 0;

    bool is_sheared() const { return shear_outwards != 0 || shear_along != 0; }
  };
  static constexpr uint32_t max_count = 65536;
  static constexpr double max_shear = 65536;

  /// Throws Error(argument), which names the value and its limit. Of the grid's cell size, y is not
  /// used, nor is z around a point.
  Warp(Kind kind, const Neighbourhood& grid, const Shell& shell);

  Kind kind() const { return kind_; }
  const Neighbourhood& grid() const { return grid_; }
  const Shell& shell() const { return shell_; }
  /// The outer radius, or infinity.
  double outer() const { return numbers_.outer; }
  /// The same cells without a shear.
  Warp straight() const;
  void describe(HashInput& input) const;

  /// (u, v, w), and the distance r from the axis or the point, without the inner radius.
  struct Place {
    Vec3 cells;
    double radius = 0;
  };
  /// The definition. Each is finite for finite points whose coordinates are below 1e150.
  Place place(Vec3 p) const;
  Vec3 to_cells(Vec3 p) const { return place(p).cells; }
  bool is_in_shell(double radius) const {
    return radius >= numbers_.inner && radius <= numbers_.outer;
  }
  /// The cell, with 0 <= y < count and, if spherical, 0 <= z < count_polar; and the position in it.
  /// The north pole is at the upper end of the last cell.
  Neighbourhood::Located locate(Vec3 cells) const;

  /// A point with these coordinates, up to rounding: errors are below 2^-46 of its distance from
  /// the grid's origin and of that origin. The same bits for v and v + count, if both are exact. u
  /// may be such that r is negative: the point is then on the other side.
  Vec3 from_cells(Vec3 cells) const;

  /// What to_cells() and the radius have in a box, rounding included.
  struct Image {
    /// Contains the cells of each point, up to a multiple of count in y: y may begin below 0 or end
    /// above count. It is at most count long; then all v are in it.
    Box3 cells;
    Interval radius;
    /// A lower bound on the distance from the axis.
    double axis_distance = 0;
  };
  Image image(const Box3& box) const;

  /// Computed distances of a point from the axis, and from the axis or the point that the cells are
  /// around. Their errors are below slack().
  double axis_distance(Vec3 p) const;
  double radius(Vec3 p) const;
  /// Upper bounds on the lengths of the gradients of u, v and w at all points that are at least
  /// that far from the axis, and from the point if spherical. Infinite at a distance of 0. For any
  /// numbers a, b and c the length of a grad u + b grad v + c grad w is at most that of (a, b, c)
  /// times these bounds.
  Vec3 slopes(double axis_distance, double radius) const;

  /// The gradients of u, v and w at a point, in the model's frame, up to rounding. Not finite on
  /// the axis.
  std::array<Vec3, 3> gradients(Vec3 p) const;
  /// Upper bounds on the second derivatives of u, v and w along straight lines, per squared length:
  /// with d the distance from the axis and r that from the axis or the point,
  /// 1 / (r cell size x), count / (2 pi d^2), and 0, or 2 count_polar / (pi d r).
  Vec3 bends(double axis_distance, double radius) const;

  /// A bound on the rounding of places: to_cells(p) are the exact coordinates of a point within
  /// slack(p, distance) of p, and so for all points within that distance of p. That exact point may
  /// be on the other side of the seam v = 0.
  double slack(Vec3 p, double distance) const;

  /// What the definition computes with (warp-inl.h).
  struct Numbers {
    double origin[3], matrix[9];
    double inner, outer, radial, around, along, quarter_turn, count, last;
    double shear_outwards, shear_along;
    bool is_spherical, is_sheared;
  };
  const Numbers& numbers() const { return numbers_; }

 private:
  Kind kind_;
  Neighbourhood grid_;
  Shell shell_;
  Numbers numbers_;
};

}  // namespace msq
