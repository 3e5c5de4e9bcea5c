// SPDX-License-Identifier: Apache-2.0
// r-interval preprocessing: the unit cell in n^3 clusters, each with an enclosure of the onset.
// Clusters whose enclosure leaves no doubt are answered as blocks; for the others the tape may be
// shorter than the whole. Source: paper, section "Preprocessing for Repeating Structures"; where it
// samples the corners of clusters, which proves nothing, these are enclosures by interval
// arithmetic.
#pragma once

#include <cstdint>
#include <vector>

#include "expression/enclosure.h"

namespace msq {

class Clusters {
 public:
  struct Cluster {
    Enclosure onset;
    uint16_t tape;  ///< number of the tape to evaluate here
  };

  /// `levels`: the levels that will be asked about. With side 1 nothing is known.
  Clusters(const Tape& tape, int side, Interval levels);

  int side() const { return grids_[0].side; }
  /// The finest grid of clusters with at most so many along an axis of the cell; null if there is
  /// none worth looking at.
  class Grid;
  const Grid* at_most(double side) const;

  /// The first is the whole tape.
  const std::vector<Tape>& tapes() const { return tapes_; }

  class Grid {
   public:
    /// The number of the cluster along an axis that an angle lies in.
    int number(double angle) const {
      const double i = angle * (side / two_pi);
      return i < side ? static_cast<int>(i) : side - 1;
    }
    const Cluster& at(int x, int y, int z) const {
      return clusters[static_cast<size_t>((z * side + y) * side + x)];
    }

    int side;
    std::vector<Cluster> clusters;
  };

 private:
  /// Clusters of twice the size.
  static Grid coarser(const Grid& fine);

  std::vector<Grid> grids_;  // from the finest on
  std::vector<Tape> tapes_;
};

}  // namespace msq
