// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/ray_demand.h"

#include <algorithm>
#include <vector>

#include "base/borrowed.h"
#include "cell/cell_hash.h"
#include "structure/foam/rays/ray_brick.h"

namespace msq {

namespace {

/// Cost, in marches, of the edges around the start of a ray: 3 bricks at 150 to 170 us each,
/// against 12 us per march. With fields, marches take longer, 30 us and more, and so do edges.
constexpr size_t worth_of_capsules = 45, worth_of_others = 20;
/// Number and size of the bricks that are built for rays that begin in one.
constexpr uint64_t bricks_about = 3, brick_bytes = 21000;

}  // namespace

RayDemand::Place RayDemand::find(CellIndex brick, size_t worth) const {
  const uint64_t hash = hash_of(brick);
  Place place;
  place.count = &counts_->of_bricks[hash % places];
  place.name = static_cast<uint32_t>(hash >> 48) << 16;
  place.worth = static_cast<uint32_t>(static_cast<double>(worth) *
                                      (0.5 + random_fraction(splitmix_finalise(hash))));
  const uint32_t known = place.count->load(std::memory_order_relaxed);
  place.rays = known & 0xffff;
  // If two bricks share a slot, the one that is worth its edges stays, and the other counts as
  // worth them, too.
  if ((known & ~0xffffu) != place.name && place.rays < place.worth) place.rays = 0;
  return place;
}

bool RayDemand::pays(CellIndex brick, size_t worth) const {
  const Place place = find(brick, worth);
  return place.rays >= place.worth;
}

void RayDemand::add(CellIndex brick, size_t rays, size_t worth, size_t most) const {
  const Place place = find(brick, worth);
  if (place.rays >= place.worth) return;
  const auto now = static_cast<uint32_t>(std::min<size_t>(place.rays + rays, 0xffff));
  if (now >= place.worth && rays < place.worth &&
      counts_->worthy.fetch_add(1, std::memory_order_relaxed) >= most) {
    // The cache does not hold more bricks: the count begins anew.
    for (std::atomic<uint32_t>& count : counts_->of_bricks)
      count.store(0, std::memory_order_relaxed);
    counts_->worthy.store(0, std::memory_order_relaxed);
    return;
  }
  place.count->store(place.name | now, std::memory_order_relaxed);
}

bool RayDemand::pays_for(const FoamData& foam, const RaySearch* searches, size_t count) {
  CellCache& cache = foam.context().cache;
  // Few rays are not worth the memory for counts that are not kept.
  if (count < worth_of_others && cache.limit() < sizeof(Counts)) return false;
  const auto demand =
      cache.fetch(foam.ray_demand_id(), {}, [] { return std::make_shared<const RayDemand>(); });
  return static_cast<const RayDemand&>(*demand).pays(foam, searches, count);
}

bool RayDemand::pays(const FoamData& foam, const RaySearch* searches, size_t count) const {
  const size_t worth = foam.has_capsules() ? worth_of_capsules : worth_of_others;
  const size_t most = foam.context().cache.limit() / (bricks_about * brick_bytes);
  // The brick that a ray begins in.
  const auto at = [&](size_t i) {
    const Vec3 p = searches[i].ray.at(searches[i].from);
    const CellIndex cell = foam.neighbourhood().locate(p).cell;
    return CellIndex{RayBrick::brick_of(cell.x), RayBrick::brick_of(cell.y),
                     RayBrick::brick_of(cell.z)};
  };
  // Neighbouring rays follow one another: a few represent most of them.
  if (pays(at(0), worth) && pays(at(count / 2), worth) && pays(at(count - 1), worth)) return true;
  constexpr size_t stride = 16;
  const Borrowed<std::vector<CellIndex>> bricks;
  (*bricks).clear();
  for (size_t begin = 0; begin < count;) {
    const CellIndex brick = at(begin);
    size_t end = begin + 1;
    while (end < count) {
      const size_t next = std::min(end + stride, count);
      if (at(next - 1) == brick)
        end = next;
      else if (at(end) == brick)
        ++end;
      else
        break;
    }
    add(brick, end - begin, worth, most);
    (*bricks).push_back(brick);
    begin = end;
  }
  size_t worthy = 0;
  for (const CellIndex brick : *bricks) worthy += pays(brick, worth);
  return 2 * worthy >= (*bricks).size();
}

}  // namespace msq
