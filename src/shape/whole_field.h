// SPDX-License-Identifier: Apache-2.0
// The solid angle of the caps of an open mesh in a ball, as a quadratic function of the place.
//
// Over 4 pi it is C + S (boundary_loops.h), C the winding number of the +x ray through the caps. It
// is smooth, except that it jumps by 1 at the caps, as C does. So at a point of the ball it is its
// expansion about the centre plus a jump for each cap between the two. Its nearest integer is what
// the winding number of the row rule, through mesh and caps, exceeds that of the mesh by.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "shape/loop_expansions.h"

namespace msq {

class WholeField {
 public:
  using Triangle3 = std::array<Vec3, 3>;

  /// Begins anew. Returns where to list the caps that meet the ball, as vectors from its centre,
  /// scaled.
  std::vector<Triangle3>& start(const Ball& ball, double scale);
  /// `beyond`: C at the centre. The tolerance of positions is scaled. False if too little is known.
  bool set(double beyond, const Expansion& of_loops, double tolerance);

  /// Whether the number is the same everywhere in the ball.
  bool is_constant(int64_t& whole) const;
  /// About the part of the ball in which whole_at() does not know the number.
  double doubtful_part() const;
  /// The number at a point of the ball, if it is known.
  bool whole_at(Vec3 p, int64_t& whole) const;

 private:
  /// A cap, seen from the centre.
  struct Sheet {
    Vec3 normal;         // of length 1
    double height;       // of the plane along it; not 0
    double height_room;  // for rounding of heights
    Vec3 sides[3];   // the segment to a point passes the triangle's plane within it where all their
                     // products with it have the sign of `jump`
    double room[3];  // for rounding of these products, per length of the segment
    int64_t jump;
  };
  bool add_sheet(const Triangle3& cap);
  /// Changes a number by the caps between the centre and a point. False if rounding decides: then
  /// the number is not known.
  bool pass_caps(Vec3 d, int64_t& whole) const;

  Vec3 centre_;
  double scale_ = 1;
  double radius_ = 0, tolerance_ = 0;  // scaled
  double value_ = 0, error_ = 0;       // at the centre
  Expansion terms_{};
  double slope_ = 0, spread_ = 0;  // of the value in the ball, without jumps
  std::vector<Triangle3> caps_;
  std::vector<Sheet> sheets_;
};

}  // namespace msq
