// SPDX-License-Identifier: Apache-2.0
// How far a point is from the surface of a lattice's struts: the least distance to a strut's axis
// less the strut's radius there, its factor times r.
//
// The unit cell is divided into boxes. Let c be the centre of a box, h half its diagonal and g(s)
// the gap between c and the surface of strut s. No point of the box has a gap to s that differs by
// more than h from that; so where g(t) + 2 h < g(s), s is the nearest to none of them. As g is
// linear in r, this holds for all r of an interval if it holds for both its ends. The struts that
// are left are listed for each box; boxes take them from lists of boxes twice their size. Struts
// that t rules out are looked for only with those t that are nearest to c at either end of the
// interval: so lists may be longer than they need be, and hold every strut that is nearest.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "field/field.h"
#include "structure/lattice/unit_cell.h"
#include "strut/segment.h"

namespace msq {

class NearestStruts {
 public:
  /// `struts`: those of one factor next to each other. `radius`: holds every r that gap() is asked
  /// for.
  NearestStruts(const std::vector<PeriodicStrut>& struts, Vec3 cell_size, Interval radius);

  /// The least gap, negative within a strut, of a point of the cell, from its corner, in model
  /// units. At most reach() less the radius of the thickest strut.
  double gap(Vec3 q, double r) const;
  /// Struts farther than that are not looked for, so that flat cells do not list more of their like
  /// than can be searched: 8 times the smallest cell size.
  double reach() const { return reach_; }

 private:
  static constexpr int parts = 8;  // boxes along each axis

  void divide(std::array<int, 3> first, int side, const std::vector<uint32_t>& from);

  Vec3 box_size_;
  double reach_, most_factor_;
  Interval radius_;
  std::vector<LatticeStrut> struts_;  // of the tiling
  struct List {
    uint32_t begin = 0, end = 0;
  };
  std::vector<List> lists_;
  std::vector<uint32_t> entries_;
};

}  // namespace msq
