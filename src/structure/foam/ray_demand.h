// SPDX-License-Identifier: Apache-2.0
// Whether a foam's rays are worth the edges of the cells that they cross.
//
// The edges about a ray cost as much as 20 to 30 marches, and serve all rays that come near. So
// rays that begin in bricks of cells of their own march, until marches have cost what the edges of
// all bricks that the rays may cross do. Both ways find the same bits.
#pragma once

#include <atomic>
#include <cstdint>

namespace msq {

class RayDemand {
 public:
  /// Whether it was said once.
  bool has_paid() const { return has_edges_.load(std::memory_order_relaxed); }

  /// For a batch of rays that begin in so many bricks, and cross some of `about` bricks, which hold
  /// `most` at best.
  bool pays(uint64_t rays, uint64_t beginnings, double about, double most) {
    if (rays >= rays_a_brick * beginnings) {
      has_edges_.store(true, std::memory_order_relaxed);
      return true;
    }
    if (has_paid()) return true;
    const uint64_t marched = marched_.fetch_add(rays, std::memory_order_relaxed) + rays;
    if (about > most || static_cast<double>(marched) < marches_a_brick * about) return false;
    has_edges_.store(true, std::memory_order_relaxed);
    return true;
  }

 private:
  static constexpr uint64_t rays_a_brick = 8;
  static constexpr double marches_a_brick = 4;

  std::atomic<uint64_t> marched_{0};
  std::atomic<bool> has_edges_{false};
};

}  // namespace msq
