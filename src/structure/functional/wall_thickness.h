// SPDX-License-Identifier: Apache-2.0
// The thickness of a sheet's walls, in the units of the model, as a function of its level.
//
// The mean thickness at a level is the volume of the walls over the area of their middle surface,
// where the function is 0, both within a cell. For walls of constant thickness t around a minimal
// surface of area A and Euler characteristic X, that volume is t A + pi X t^3 / 6 (Steiner's
// formula; Hyde et al., "The Language of Shape", 1997, chapter 4, "parallel surfaces"). So for thin
// walls it is t. Volume over area is also meaningful for surfaces that are not minimal, and for
// thick walls.
#pragma once

#include "expression/tape.h"
#include "field/curve.h"

namespace msq {

class WallThickness {
 public:
  /// Throws Error(argument) if the function is 0 nowhere in the cell.
  WallThickness(const Tape& function, Vec3 cell_size);

  /// Area of the surface within a cell.
  double area() const { return area_; }
  /// The thickness at which the walls fill the whole cell.
  double most() const { return most_; }
  /// By level, the fraction of the cell where the function's magnitude is at most that.
  const Curve& volume_fractions() const { return fractions_; }
  /// The level by thickness, from 0 to most().
  const Curve& levels() const { return levels_; }

 private:
  double area_ = 0, most_ = 0;
  Curve fractions_{{{0, 0}}}, levels_{{{0, 0}}};
};

}  // namespace msq
