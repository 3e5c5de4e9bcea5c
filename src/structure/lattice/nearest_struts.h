// SPDX-License-Identifier: Apache-2.0
// The distance from any point to a lattice's struts.
//
// The unit cell is divided into boxes. With c the centre of a box, h half its diagonal and d the
// distance from c to the nearest strut, no point of the box is farther than d + h from that strut,
// nor nearer than |c - s| - h to a strut s; so only struts within d + 2 h of c can be the nearest
// to one of its points. These are listed for each box; boxes take them from lists of boxes twice
// their size.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "structure/lattice/unit_cell.h"
#include "strut/segment.h"

namespace msq {

class NearestStruts {
 public:
  NearestStruts(const std::vector<PeriodicStrut>& struts, Vec3 cell_size);

  /// Of a point of the cell, from its corner, in model units. At most reach().
  double distance(Vec3 q) const;
  /// Farther struts are not looked for, so that flat cells do not list more of their like than can
  /// be searched: 8 times the smallest cell size.
  double reach() const { return reach_; }

 private:
  static constexpr int parts = 8;  // boxes along each axis

  void divide(std::array<int, 3> first, int side, const std::vector<uint32_t>& from);

  Vec3 box_size_;
  double reach_;
  std::vector<Segment> struts_;  // of the tiling
  struct List {
    uint32_t begin = 0, end = 0;
  };
  std::vector<List> lists_;
  std::vector<uint32_t> entries_;
};

}  // namespace msq
