// SPDX-License-Identifier: Apache-2.0
// Cells whose size varies along one axis of a grid: a monotone map w from the coordinate s along
// that axis, in model units from the grid's origin, to the number u of cells from there.
//
// The frequency f = 1 / size is linear between knots and constant beyond them. So u = w(s) is a
// polynomial of degree 2 on each piece, and its slope is continuous. With knots (s_i, h_i),
//   f_i = 1 / h_i,  d = s_{i+1} - s_i,  c_i = (f_{i+1} - f_i) / (2 d),
//   U_{i+1} = U_i + d (f_i + c_i d),
//   w(s) = U_i + t (f_i + c_i t),  t = s - s_i,  for s_i <= s < s_{i+1},
// each operation rounded once, in this order. Before the first knot and from the last on c is 0.
// U_0 is minus the w(0) that U_0 = 0 yields; so w(0) is 0 up to rounding.
//
// Bounds. On a piece the slope of the exact polynomial is f_i + 2 c_i t, which runs from f_i to
// f_{i+1} up to 2^-50 of them, as no term cancels more than half of another. All f are positive, so
// the map does not fold. With n the largest |U_i|, t and f + c t have relative errors below 2^-51,
// and their product is at most n + |u| in magnitude. So the error of w(s), and a jump at a knot, is
// below 2^-49 (n + |u|).
//
// The inverse of a piece, with d = u - U_i, is t = 2 d / (f + g), g = sqrt(f^2 + 4 c d), g being
// the slope there. The error of f^2 + 4 c d is at most 2^-51 f^2, that of g 2^-52 f^2 / g, so that
// of t 2^-51 t f / g. Times the slope that is an error of at most 2^-50 |d| in u, as t f <= 2 |d|,
// in addition to that of d. So position_of(u) is within 2^-49 (n + |u|) / least frequency of the
// exact place, plus the rounding of the sum s_i + t.
#pragma once

#include <cstddef>
#include <vector>

#include "base/hash_input.h"
#include "base/interval.h"
#include "cell/neighbourhood.h"

namespace msq {

class GradedPeriod {
 public:
  struct Knot {
    double position, cell_size;
  };
  static constexpr size_t max_knots = 4096;
  static constexpr double max_ratio = 1024;     // of cell sizes
  static constexpr double min_distance = 1e-6;  // of knots, in the smaller of their cell sizes
  static constexpr double min_size = 1e-75, max_size = 1e75;

  /// Throws Error(argument) or Error(limit), which name the knot, where the map would fold or the
  /// numbers leave the limits above.
  GradedPeriod(int axis, const std::vector<Knot>& knots);

  /// Of the grid.
  int axis() const { return axis_; }
  /// The grid with this cell size along the axis.
  Neighbourhood resized(Neighbourhood grid, double size) const {
    grid.cell_size[axis_] = size;
    return grid;
  }
  void describe(HashInput& input) const;
  double smallest() const { return 1 / most_; }
  double largest() const { return 1 / least_; }
  /// Of the frequencies.
  double least() const { return least_; }
  double most() const { return most_; }
  size_t knots() const { return pieces_.size() - 1; }
  double position(size_t knot) const { return pieces_[knot + 1].start; }

  /// w(s): the definition.
  double cells(double s) const {
    const Piece& p = pieces_[knots_to(s)];
    const double t = s - p.start;
    return p.cells + t * (p.frequency + p.bend * t);
  }
  /// The coordinate s with w(s) = u, up to rounding: the definition of where nodes are. With
  /// d = u - U_i it is s_i + 2 d / (f_i + sqrt(f_i^2 + 4 c_i d)), each operation rounded once, i
  /// being the last knot with U_i <= u.
  double position_of(double u) const;
  /// Its slope, up to rounding.
  double frequency(double s) const {
    const Piece& p = pieces_[knots_to(s)];
    return p.frequency + 2 * p.bend * (s - p.start);
  }
  /// Bound on the error of cells(s), also relative to a continuous map, where that is u.
  double error(double u) const;

  /// Over an interval: bounds of the slope, and of half the change of the slope per length. So
  /// |w(s + d) - w(s) - frequency(s) d| <= bend d^2 there.
  struct Bounds {
    double least, most, bend;
  };
  Bounds over(Interval s) const;
  /// A distance from s, at most `most`, within which the frequency is at most `limit`. 0 if it is
  /// more at s.
  double distance_to(double s, double limit, double most) const;

 private:
  /// From `start` on; the first piece also before it.
  struct Piece {
    double start, cells, frequency, bend;
  };
  /// Number of knots at or before s, which is the number of the piece.
  size_t knots_to(double s) const;

  int axis_;
  double least_, most_, max_cells_ = 0;
  std::vector<Piece> pieces_;  // before the first knot, between knots, beyond the last
};

}  // namespace msq
