// SPDX-License-Identifier: Apache-2.0
// The nearest seed's neighbourhood: the seeds of a cell that can own an edge that reaches a point.
//
// The paper tests only the edges of the seed nearest to p. But a capsule may reach p from an edge
// of another cell. Let d0 be the distance from p to its nearest seed and v a point of an edge with
// |v - p| <= r. The nearest seed is within d0 + r of v, so the edge's three seeds, which are no
// farther from v, are within d0 + 2 r of p.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "structure/foam/paper/halo.h"

namespace msq {

class ReachingSeeds {
 public:
  /// For the seeds about a cell and a point of the cell.
  void find(const std::vector<Vec3>& seeds, Vec3 q, double radius) {
    distance_squared_.resize(seeds.size());
    double nearest = 1e300;
    for (size_t i = 0; i < seeds.size(); ++i) {
      const Vec3 d = seeds[i] - q;
      distance_squared_[i] = dot(d, d);
      nearest = std::min(nearest, distance_squared_[i]);
    }
    const double needed = std::sqrt(nearest) + 2 * radius + halo_slack;
    max_squared_ = needed * needed;
  }

  bool has(uint32_t seed) const { return distance_squared_[seed] <= max_squared_; }
  bool has(const std::array<uint32_t, 3>& seeds) const {
    return has(seeds[0]) && has(seeds[1]) && has(seeds[2]);
  }

 private:
  std::vector<double> distance_squared_;
  double max_squared_ = 0;
};

}  // namespace msq
