// SPDX-License-Identifier: Apache-2.0
// Decides which of a foam's rays are worth the edges of the cells that they cross.
//
// The edges around a ray cost as much as many marches, and serve all rays that come near. So rays
// march until those that began in the same brick of cells have cost as much as the edges there. The
// total cost is then at most about twice the minimum. Both ways find the same bits.
// Source: Karlin, Manasse, McGeoch and Owicki, "Competitive randomized algorithms for nonuniform
// problems", 1994.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "base/ray.h"
#include "cell/cache.h"
#include "structure/foam/foam_data.h"

namespace msq {

/// Counts of a foam's rays. They are kept in the cell cache and count towards its limit. If they
/// are evicted, or not kept, counting begins anew.
class RayDemand final : public CellData {
 public:
  RayDemand() : counts_(std::make_unique<Counts>()) {}

  /// Whether a batch of a foam's rays is worth its edges: true if most of the bricks where its rays
  /// begin are worth theirs.
  static bool pays_for(const FoamData& foam, const RaySearch* searches, size_t count);

  /// Counts rays that begin in a brick of cells. A brick is worth its edges after about `worth`
  /// rays: some bricks earlier, some later, so that the bricks of a picture do not all become worth
  /// them in the same frame. If rays come few at a time, at most `most` bricks become so; then the
  /// count begins anew.
  void add(CellIndex brick, size_t rays, size_t worth, size_t most) const;
  bool pays(CellIndex brick, size_t worth) const;

  uint64_t bytes() const override { return sizeof *this + sizeof *counts_; }

 private:
  static constexpr size_t places = size_t{1} << 16;
  /// The counts of a brick.
  struct Place {
    std::atomic<uint32_t>* count;
    uint32_t name;   ///< of the brick, in the count
    uint32_t worth;  ///< the number of rays from which edges are worth it
    uint32_t rays;
  };

  struct Counts {
    /// Per brick, unless bricks share a slot: the upper half of a hash, and the number of rays.
    std::array<std::atomic<uint32_t>, places> of_bricks{};
    std::atomic<size_t> worthy{0};
  };

  Place find(CellIndex brick, size_t worth) const;
  bool pays(const FoamData& foam, const RaySearch* searches, size_t count) const;

  const std::unique_ptr<Counts> counts_;
};

}  // namespace msq
