// SPDX-License-Identifier: Apache-2.0
// A foam whose cells are stretched along the axes of its grid.
//
// Its diagram is that of its seeds where lengths along grid axis i are divided by stretch[i]: the
// space of the diagram. There it is a foam like any other, whose grid has cells of other sides. The
// diagram is then moved back to model space. That map is linear, so edges stay straight, faces
// plane and cells convex. Radii, thicknesses and distances are those of model space.
//
// In the space of the diagram the largest side of a cell is 1, as in foam units (seeds.h): a
// diagram unit. Along axis i a diagram unit is factor[i] foam units, from 1/4 to max_ratio: a cell
// measures h[i] foam units from 1/4 to 1, and from 1 / max_ratio to 1 diagram units.
#pragma once

#include "structure/foam/seeds/seeds.h"

namespace msq {

class Stretch {
 public:
  /// By how much the sides of a cell may differ in the space of the diagram.
  static constexpr double max_ratio = 16;

  /// Whether the diagram differs from that of model space.
  static bool is_any(Vec3 stretch) { return stretch.x != stretch.y || stretch.y != stretch.z; }
  /// The sides of a cell in the space of the diagram, in model units.
  static Vec3 sides(const Neighbourhood& grid, Vec3 stretch) {
    return {grid.cell_size.x / stretch.x, grid.cell_size.y / stretch.y,
            grid.cell_size.z / stretch.z};
  }

  Stretch(const Neighbourhood& grid, double jitter, uint64_t seed, Vec3 stretch)
      : stretch_(stretch),
        seeds_(seed, jitter, sides(grid, stretch) * (1 / max_component(sides(grid, stretch)))),
        factor_(stretch * (max_component(sides(grid, stretch)) / max_component(grid.cell_size))),
        inverse_{1 / factor_.x, 1 / factor_.y, 1 / factor_.z} {}

  /// The seeds in diagram units, from the corner of a cell.
  const FoamSeeds& seeds() const { return seeds_; }
  /// Foam units in a diagram unit, along each axis.
  Vec3 factor() const { return factor_; }
  double max_factor() const { return max_component(factor_); }
  /// A point, in foam units, in diagram units.
  Vec3 to_diagram(Vec3 q) const { return q * inverse_; }
  /// A radius, in diagram units, of a ball that holds the ball of a radius in foam units.
  double around(double radius) const { return radius / min_component(factor_) * (1 + 1e-12); }
  /// A normal of a plane in the space of the diagram, in foam units.
  Vec3 normal(Vec3 n) const { return n * inverse_; }
  /// The greatest distance of a point from its nearest seed, along each axis, in foam units.
  Vec3 reach() const { return factor_ * (seeds_.empty_radius() * (1 + 1e-9)); }

  void describe(HashInput& input) const { input.point(stretch_); }

 private:
  Vec3 stretch_;
  FoamSeeds seeds_;
  Vec3 factor_, inverse_;
};

}  // namespace msq
