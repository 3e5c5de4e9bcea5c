// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/seeds/cell_seeds.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "base/simd.h"
#include "structure/foam/seeds/cell_seeds.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

double squared_distances(const double* x, const double* y, const double* z, size_t count, Vec3 q,
                         double* out) {
  const hn::ScalableTag<double> d;
  const auto qx = hn::Set(d, q.x), qy = hn::Set(d, q.y), qz = hn::Set(d, q.z);
  auto least = hn::Set(d, 1e300);
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto dx = hn::Sub(hn::LoadU(d, x + i), qx), dy = hn::Sub(hn::LoadU(d, y + i), qy),
               dz = hn::Sub(hn::LoadU(d, z + i), qz);
    const auto d2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
    hn::StoreU(d2, d, out + i);
    least = hn::Min(least, d2);
  }
  return hn::GetLane(hn::MinOfLanes(d, least));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(squared_distances);

void CellSeeds::move_to(const FoamSeeds& seeds, CellIndex cell) {
  if (seeds_ && *seeds_ == seeds && cell_ == cell) return;
  seeds_ = seeds;
  cell_ = cell;
  known_ = 0;
}

double CellSeeds::Block::reach(Vec3 q, Vec3 scale) const {
  double reach = 1e300;
  for (int axis = 0; axis < 3; ++axis)
    reach = std::min(reach, half[axis] * scale[axis] + std::min(q[axis], scale[axis] - q[axis]));
  return reach;
}

const CellSeeds::Block& CellSeeds::block(size_t step) {
  while (known_ <= step) {
    if (blocks_.size() == known_) blocks_.emplace_back();
    Block& block = blocks_[known_];
    const Vec3 scale = seeds_->scale();
    block.count = 1;
    for (int axis = 0; axis < 3; ++axis) {
      block.half[axis] = static_cast<int>(std::ceil(static_cast<double>(known_ + 1) / scale[axis]));
      block.count *= static_cast<size_t>(2 * block.half[axis] + 1);
    }
    for (std::vector<double>* v : {&block.x, &block.y, &block.z}) {
      v->resize(block.count + max_simd_doubles);
      std::fill(v->begin() + static_cast<ptrdiff_t>(block.count), v->end(), 1e100);
    }
    size_t i = 0;
    for (int dz = -block.half[2]; dz <= block.half[2]; ++dz)
      for (int dy = -block.half[1]; dy <= block.half[1]; ++dy) {
        const uint64_t key = seeds_->row_key(cell_, dy, dz);
        for (int dx = -block.half[0]; dx <= block.half[0]; ++dx, ++i) {
          const Vec3 s = seeds_->in_row(key, cell_, dx, dy, dz);
          block.x[i] = s.x;
          block.y[i] = s.y;
          block.z[i] = s.z;
        }
      }
    ++known_;
  }
  return blocks_[step];
}

double CellSeeds::find_distances(const Block& block, Vec3 q) {
  distance_squared_.resize(block.count + max_simd_doubles);
  return HWY_DYNAMIC_DISPATCH(squared_distances)(block.x.data(), block.y.data(), block.z.data(),
                                                 block.count, q, distance_squared_.data());
}

const CellSeeds::Block& CellSeeds::find_near(Vec3 q, double radius, std::vector<uint32_t>& found) {
  const Block* block;
  double needed;
  for (size_t step = 0;; ++step) {
    block = &this->block(step);
    needed = std::sqrt(find_distances(*block, q)) + 2 * radius + near_slack;
    if (!(needed > block->reach(q, seeds_->scale()))) break;  // also if q is NaN
  }
  // Without a branch on the distance: it would be unpredictable.
  found.resize(block->count + 1);
  size_t count = 0;
  for (size_t i = 0; i < block->count; ++i) {
    found[count] = static_cast<uint32_t>(i);
    count += distance_squared_[i] <= needed * needed;
  }
  found.resize(count);
  return *block;
}

}  // namespace msq
#endif  // HWY_ONCE
