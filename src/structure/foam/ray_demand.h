// SPDX-License-Identifier: Apache-2.0
// Which of a foam's rays are worth the edges of the cells that they cross.
//
// The edges about a ray cost many marches, and serve all rays that come near. So rays march, until
// those that began in the same brick of cells have cost what the edges there do: all together then
// cost about twice the least that they could, at most. Both ways find the same bits.
// Source: Karlin, Manasse, McGeoch and Owicki, "Competitive randomized algorithms for nonuniform
// problems", 1994.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>

#include "base/ray.h"
#include "cell/neighbourhood.h"

namespace msq {

class Foam;

class RayDemand {
 public:
  /// Whether a batch of rays is worth its edges: whether most bricks where its rays begin are.
  bool pays(const Foam& foam, const RaySearch* searches, size_t count);

  /// Counts rays that begin in a brick of cells. It is worth its edges from about `worth` rays on:
  /// some bricks earlier, some later, so that not all of a picture become so in the same frame.
  /// Where rays come few at a time no more than `most` bricks do; then the count begins anew.
  void add(CellIndex brick, size_t rays, size_t worth, size_t most);
  bool pays(CellIndex brick, size_t worth);

 private:
  static constexpr size_t places = size_t{1} << 16;
  /// What is known of a brick.
  struct Place {
    std::atomic<uint32_t>* count;
    uint32_t name;   ///< of the brick, in there
    uint32_t worth;  ///< from so many rays on
    uint32_t rays;
  };

  Place find(CellIndex brick, size_t worth);

  /// Brick by brick, as far as they do not share a place: the upper half of a hash, and rays.
  std::once_flag is_there_;
  std::unique_ptr<std::atomic<uint32_t>[]> counts_;
  std::atomic<size_t> worthy_{0};
};

}  // namespace msq
