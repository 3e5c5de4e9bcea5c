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

#include "expression/tape.h"
#include "field/curve.h"

namespace msq {

class WallThickness {
 public:
  /// Throws Error(argument) where the function is 0 nowhere in the cell.
  WallThickness(const Tape& function, Vec3 cell_size);

  /// Of the surface within a cell.
  double area() const { return area_; }
  /// The thickness of the walls that fill all of the cell.
  double most() const { return most_; }
  /// By level, the part of the cell where the function's magnitude is at most that.
  const Curve& volume_fractions() const { return fractions_; }
  /// By thickness, from 0 to most(), the level.
  const Curve& levels() const { return levels_; }

 private:
  double area_ = 0, most_ = 0;
  Curve fractions_{{{0, 0}}}, levels_{{{0, 0}}};
};

}  // namespace msq
