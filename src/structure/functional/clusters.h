// SPDX-License-Identifier: Apache-2.0
// r-interval preprocessing: the unit cell in n^3 clusters, each with an enclosure of the onset.
// Clusters whose enclosure leaves no doubt are answered as blocks; for the others the tape may be
// shorter than the whole. Source: paper, section "Preprocessing for Repeating Structures"; where it
// samples the corners of clusters, which proves nothing, these are enclosures by interval
// arithmetic.
#pragma once

#include <cstdint>
#include <vector>

#include "structure/functional/enclosure.h"

namespace msq {

class Clusters {
 public:
  struct Cluster {
    Enclosure onset;
    uint16_t tape;  ///< number of the tape to evaluate here
  };

  /// `levels`: the levels that will be asked about.
  Clusters(const Tape& tape, int side, Interval levels);

  int side() const { return side_; }
  /// The number of the cluster along an axis that an angle lies in.
  int number(double angle) const {
    const double i = angle * (side_ / two_pi);
    return i < side_ ? static_cast<int>(i) : side_ - 1;
  }
  const Cluster& at(int x, int y, int z) const {
    return clusters_[static_cast<size_t>((z * side_ + y) * side_ + x)];
  }
  /// The first is the whole tape.
  const std::vector<Tape>& tapes() const { return tapes_; }

 private:
  int side_;
  std::vector<Cluster> clusters_;
  std::vector<Tape> tapes_;
};

}  // namespace msq
