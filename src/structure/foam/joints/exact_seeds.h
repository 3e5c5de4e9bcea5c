// SPDX-License-Identifier: Apache-2.0
// What seeds decide exactly: on which side of three seeds a fourth lies, and whether a seed is
// nearer to the point equally far from four others than these are.
//
// A seed is at (cell + position in the cell) times the scale, as real numbers: so it is the same
// seed from whichever cell it is seen. Positions in cells are multiples of 2^-40 (placed_seeds.h,
// graded_seeds.h), so along each axis differences of seeds are integers m 2^-40 times the scale.
// The scale matters only to the squares of lengths, the sums of (m 2^-40 scale)^2. Scales are from
// 1/16 to 1, so they are multiples of 2^-57, and everything but lifts is an integer of a known
// number of bits. Lifts are rounded down to multiples of 2^-194. Double precision decides first,
// where a bound of its rounding lets it (J. R. Shewchuk, "Adaptive Precision Floating-Point
// Arithmetic and Fast Robust Geometric Predicates", 1997).
#pragma once

#include "structure/foam/joints/named_seeds.h"
#include "structure/foam/joints/wide_int.h"

namespace msq {

class ExactSeeds {
 public:
  /// A seed from the corner of a cell, `home`, which is the same for all seeds compared. Seeds of a
  /// ball that is at most as large as an empty one are within 2^6 cells of each other, so their
  /// differences are below 2^47; 2^48 would do.
  struct Seed {
    int64_t m[3];  ///< in 2^-40 of a cell
    double lift;
  };
  static Seed from(CellIndex home, const NamedSeed& seed);

  explicit ExactSeeds(Vec3 scale);

  /// The sign of (b - a) x (c - a) . (d - a): 0 if they are in a plane.
  int side(const Seed& a, const Seed& b, const Seed& c, const Seed& d) const;
  /// Whether the point equally far from a to d, which are not in a plane, by lifted distances, is
  /// nearer to e than to them: 1; as far: 0; or farther: -1.
  int nearer(const Seed& a, const Seed& b, const Seed& c, const Seed& d, const Seed& e) const;
  /// That point, from `a`, in foam units, off by some roundings of its coordinates only. The seeds
  /// are not in a plane.
  Vec3 centre(const Seed& a, const Seed& b, const Seed& c, const Seed& d) const;

  /// b - a in foam units, rounded once.
  Vec3 apart(const Seed& a, const Seed& b) const {
    return Vec3{double(b.m[0] - a.m[0]), double(b.m[1] - a.m[1]), double(b.m[2] - a.m[2])} *
           (scale_ * 0x1p-40);
  }

 private:
  using Square = WideInt<8>;

  int exact_nearer(const Seed& a, const Seed* const (&others)[4]) const;
  /// The squared distance plus the difference of lifts, in 2^-194.
  Square square(const Seed& a, const Seed& b) const;

  Vec3 scale_;
  WideInt<4> scale_squared_[3];  // in 2^-114
};

}  // namespace msq
