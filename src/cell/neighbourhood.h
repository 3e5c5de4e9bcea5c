// SPDX-License-Identifier: Apache-2.0
// The neighbourhood grid of a structure, and the canonical map from a point to (cell, position in
// the cell). Every path uses locate(), so all start from the same bits.
// Source: paper, section "Multiscale Shape-Material Modeling API".
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/hash_input.h"
#include "base/vec.h"

namespace msq {

struct CellIndex {
  int32_t x = 0, y = 0, z = 0;

  friend bool operator==(CellIndex a, CellIndex b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

/// Bound on the magnitude of cell indices. Model checks it once for the coarse shape's box.
constexpr double max_cell_index = 1 << 24;

struct Neighbourhood {
  Vec3 origin;
  Vec3 cell_size{1, 1, 1};
  Rotation rotation;

  void describe(HashInput& input) const {
    input.point(origin);
    input.point(cell_size);
    input.rotation(rotation);
  }

  struct Located {
    CellIndex cell;
    Vec3 fraction;  ///< from the cell's corner, in cell sizes, along the grid's axes; 0 to 1
  };

  /// Grid coordinates of a point: model units along the grid's axes, from the grid's origin.
  Vec3 to_grid(Vec3 p) const { return rotation.apply_inverse(p - origin); }
  Vec3 from_grid(Vec3 g) const { return rotation.apply(g) + origin; }

  Located locate(Vec3 p) const {
    const Vec3 g = to_grid(p);
    Located located;
    locate_axis(g.x, cell_size.x, located.cell.x, located.fraction.x);
    locate_axis(g.y, cell_size.y, located.cell.y, located.fraction.y);
    locate_axis(g.z, cell_size.z, located.cell.z, located.fraction.z);
    return located;
  }

  /// For each axis of the grid, the axis of the samples that is parallel to it. All are -1 if the
  /// grid is turned by other than quarter turns. Quarter turns permute the axes: then each
  /// coordinate in the grid is, to the last bit, a function of one coordinate of the sample, as
  /// products with 0 add nothing.
  std::array<int, 3> sample_axes() const {
    std::array<int, 3> axes{-1, -1, -1};
    for (size_t i = 0; i < 9; ++i) {
      const double m = std::abs(rotation.m[i]);
      if (m == 1)
        axes[i % 3] = static_cast<int>(i / 3);
      else if (m != 0)
        return {-1, -1, -1};
    }
    return axes;
  }

  /// Bounding box in grid coordinates of a box in model coordinates.
  Box3 to_grid(const Box3& box) const {
    const Vec3 centre = (box.min + box.max) * 0.5;
    const Vec3 half = box.extent() * 0.5;
    const Vec3 c = to_grid(centre);
    const auto& m = rotation.m;
    const Vec3 h{std::abs(m[0]) * half.x + std::abs(m[3]) * half.y + std::abs(m[6]) * half.z,
                 std::abs(m[1]) * half.x + std::abs(m[4]) * half.y + std::abs(m[7]) * half.z,
                 std::abs(m[2]) * half.x + std::abs(m[5]) * half.y + std::abs(m[8]) * half.z};
    return {c - h, c + h};
  }

  /// Bounding box in model coordinates of a box in grid coordinates.
  Box3 from_grid(const Box3& box) const {
    const Vec3 centre = from_grid((box.min + box.max) * 0.5);
    const Vec3 half = box.extent() * 0.5;
    const auto& m = rotation.m;
    const Vec3 h{std::abs(m[0]) * half.x + std::abs(m[1]) * half.y + std::abs(m[2]) * half.z,
                 std::abs(m[3]) * half.x + std::abs(m[4]) * half.y + std::abs(m[5]) * half.z,
                 std::abs(m[6]) * half.x + std::abs(m[7]) * half.y + std::abs(m[8]) * half.z};
    // The error of positions is a few units of 2^-53 of the largest magnitude; this is thousands of
    // them.
    const double slack =
        0x1p-40 * (max_magnitude(centre) + max_magnitude(h) + max_magnitude(origin));
    return Box3{centre - h, centre + h}.grown(slack);
  }

 private:
  static void locate_axis(double g, double size, int32_t& cell, double& fraction) {
    const double c = g / size;
    const double floor = std::floor(c);
    cell = static_cast<int32_t>(floor);
    fraction = c - floor;
  }
};

}  // namespace msq
