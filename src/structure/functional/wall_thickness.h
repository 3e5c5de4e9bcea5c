// SPDX-License-Identifier: Apache-2.0
// The thickness of a sheet's walls, in the units of the model, against its level.
//
// The mean thickness at a level is the volume of the walls over the area of their middle surface,
// where the function is 0, both within a cell. Of walls of one thickness t about a minimal surface
// of area A and Euler characteristic X, that volume is t A + pi X t^3 / 6 (Steiner's formula; Hyde
// et al., "The Language of Shape", 1997, chapter 4, "parallel surfaces"), so for thin walls it is
// t; volume over area has a meaning for surfaces that are not minimal, and for thick walls, as
// well.
#pragma once

#include <vector>

#include "expression/tape.h"
#include "field/field.h"

namespace msq {

class WallThickness {
 public:
  /// Throws Error(argument) where the function is 0 nowhere in the cell.
  WallThickness(const Tape& function, Vec3 cell_size);

  /// Of the surface within a cell.
  double area() const { return area_; }
  /// Part of the cell where the function's magnitude is at most the level.
  double volume_fraction(double level) const;
  /// That of the walls that fill all of the cell.
  double most() const { return most_; }
  /// The level of walls from 0 to most() thick, linear between `knots` thicknesses; of a greater
  /// thickness never a lower one, to the last bit.
  double level(double thickness) const;
  double lipschitz() const { return steepest_; }
  /// Whether level() is linear between two thicknesses; if so, its slope.
  bool is_linear(Interval thickness, double& slope) const;

  static constexpr int knots = 512;

 private:
  size_t piece(double thickness) const;

  double area_ = 0, most_ = 0, steepest_ = 0;
  std::vector<double> fractions_;  // at equal steps of the level
  double greatest_level_ = 0;
  std::vector<double> levels_, slopes_;  // at equal steps of the thickness, and from there on
};

/// The level of a thickness that is a field, from 0 to most().
class LevelOfThickness final : public Field {
 public:
  LevelOfThickness(WallThickness walls, Parameter thickness)
      : walls_(std::move(walls)), thickness_(std::move(thickness)) {}

  double at(Vec3 p) const override { return walls_.level(thickness_.at(p)); }
  bool is_linear(const Box3& box, Vec3& gradient) const override;
  Interval range() const override { return levels(thickness_.range()); }
  Interval range(const Box3& box) const override { return levels(thickness_.range(box)); }
  double lipschitz() const override { return walls_.lipschitz() * thickness_.lipschitz(); }

 private:
  Interval levels(Interval thickness) const;

  WallThickness walls_;
  Parameter thickness_;
};

}  // namespace msq
