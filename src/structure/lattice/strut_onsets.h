// SPDX-License-Identifier: Apache-2.0
// The onset of lattices: the least distance to a strut's axis over that strut's factor.
//
// The unit cell is divided into boxes. With c the centre of a box, h half its diagonal and d(s) the
// distance from c to strut s of factor f(s), the onset by s of any point of the box lies between
// (d(s) - h) / f(s) and (d(s) + h) / f(s); so only struts whose first is at most the least of the
// seconds can decide. These are listed for each box.
#pragma once

#include <cstdint>
#include <vector>

#include "structure/lattice/unit_cell.h"

namespace msq {

class StrutOnsets {
 public:
  /// Onsets up to `most` are found, in model units.
  StrutOnsets(const std::vector<PeriodicStrut>& struts, Vec3 cell_size, double most);

  /// Of a point of the cell, from its corner, in model units; something above `most`, maybe
  /// infinity, where it is more than that.
  double onset(Vec3 q) const;

 private:
  static constexpr int parts = 8;  // boxes along each axis

  Vec3 box_size_;
  std::vector<LatticeStrut> struts_;  // of the tiling
  struct List {
    uint32_t begin = 0, end = 0;
  };
  std::vector<List> lists_;
  std::vector<uint32_t> entries_;
};

}  // namespace msq
