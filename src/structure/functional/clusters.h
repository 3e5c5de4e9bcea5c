// SPDX-License-Identifier: Apache-2.0
// r-interval preprocessing: the unit cell in n^3 clusters, each with an enclosure of the onset.
// Clusters that the enclosure decides are written as blocks; the others may use a shorter tape than
// the whole one. Source: paper, section "Preprocessing for Repeating Structures". The paper samples
// the corners of clusters, which proves nothing; these are enclosures by interval arithmetic.
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

  /// `levels`: the levels that will be queried. With side 1 nothing is decided.
  Clusters(const Tape& tape, int side, Interval levels);

  int side() const { return grids_[0].side; }
  /// The finest grid of clusters with at most that many along an axis of the cell; null if there is
  /// no useful one.
  class Grid;
  const Grid* at_most(double side) const;

  /// The first is the whole tape.
  const std::vector<Tape>& tapes() const { return tapes_; }

  class Grid {
   public:
    /// The number of the cluster, along an axis, that contains an angle.
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

  std::vector<Grid> grids_;  // the finest first
  std::vector<Tape> tapes_;
};

}  // namespace msq
