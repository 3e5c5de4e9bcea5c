// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/seeds/cell_seeds.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "base/simd.h"
#include "structure/foam/seeds/cell_seeds.h"
#include "structure/foam/seeds/seed_bits-inl.h"

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

double lifted_squares(const double* x, const double* y, const double* z, const double* lift,
                      size_t count, Vec3 q, double* out) {
  const hn::ScalableTag<double> d;
  const auto qx = hn::Set(d, q.x), qy = hn::Set(d, q.y), qz = hn::Set(d, q.z);
  auto least = hn::Set(d, 1e300);
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto dx = hn::Sub(hn::LoadU(d, x + i), qx), dy = hn::Sub(hn::LoadU(d, y + i), qy),
               dz = hn::Sub(hn::LoadU(d, z + i), qz);
    const auto d2 = hn::Add(hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz)),
                            hn::LoadU(d, lift + i));
    hn::StoreU(d2, d, out + i);
    least = hn::Min(least, d2);
  }
  return hn::GetLane(hn::MinOfLanes(d, least));
}

// The seeds of cells that differ from a home cell by steps: FoamSeeds::in_row, with the key of each
// one's row. May write up to a vector past `count`.
#if HWY_TARGET == HWY_SCALAR

void seed_positions(const CellSteps& cells, const uint64_t* keys, const FoamSeeds& seeds,
                    CellIndex home, size_t count, double* x, double* y, double* z) {
  for (size_t i = 0; i < count; ++i) {
    const Vec3 step{cells.x[i], cells.y[i], cells.z[i]};
    const Vec3 f = seeds.fractions(
        splitmix_output(keys[i], static_cast<uint32_t>(home.x + static_cast<int>(step.x))));
    const Vec3 s = (step + f) * seeds.scale();
    x[i] = s.x;
    y[i] = s.y;
    z[i] = s.z;
  }
}

#else

void seed_positions(const CellSteps& cells, const uint64_t* keys, const FoamSeeds& seeds,
                    CellIndex home, size_t count, double* x, double* y, double* z) {
  const hn::ScalableTag<double> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const size_t lanes = hn::Lanes(d);
  const Vec3 scale = seeds.scale();
  const auto jitter = static_cast<uint64_t>(seeds.jitter());
  const auto home_x = hn::Set(du, static_cast<uint32_t>(home.x));
  const auto sx = hn::Set(d, scale.x), sy = hn::Set(d, scale.y), sz = hn::Set(d, scale.z);
  for (size_t i = 0; i < count; i += lanes) {
    const auto n = hn::Add(home_x, hn::LoadU(du, cells.step_x.data() + i));
    const auto h = seed_bits(du, hn::LoadU(du, keys + i), n);
    const auto fx = seed_fraction(du, h, jitter),
               fy = seed_fraction(du, hn::ShiftRight<21>(h), jitter),
               fz = seed_fraction(du, hn::ShiftRight<42>(h), jitter);
    hn::StoreU(hn::Mul(hn::Add(hn::LoadU(d, cells.x.data() + i), fx), sx), d, x + i);
    hn::StoreU(hn::Mul(hn::Add(hn::LoadU(d, cells.y.data() + i), fy), sy), d, y + i);
    hn::StoreU(hn::Mul(hn::Add(hn::LoadU(d, cells.z.data() + i), fz), sz), d, z + i);
  }
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(squared_distances);
HWY_EXPORT(lifted_squares);
HWY_EXPORT(seed_positions);

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

void CellSeeds::plan(Block& block, size_t step) const {
  const Vec3 scale = seeds_->scale();
  int half[3];
  for (int axis = 0; axis < 3; ++axis)
    half[axis] = static_cast<int>(std::ceil(static_cast<double>(step + 1) / scale[axis]));
  if (std::equal(half, half + 3, block.half) && block.count > 0) return;
  block.count = 0;  // until memory is there
  size_t count = 1;
  for (const int h : half) count *= static_cast<size_t>(2 * h + 1);
  const size_t padded = count + max_simd_doubles;
  CellSteps& cells = block.cells;
  for (std::vector<double>* v : {&cells.x, &cells.y, &cells.z, &block.x, &block.y, &block.z})
    v->assign(padded, 0);
  cells.step_x.assign(padded, 0);
  size_t i = 0;
  for (int dz = -half[2]; dz <= half[2]; ++dz)
    for (int dy = -half[1]; dy <= half[1]; ++dy)
      for (int dx = -half[0]; dx <= half[0]; ++dx, ++i) {
        cells.x[i] = dx;
        cells.y[i] = dy;
        cells.z[i] = dz;
        cells.step_x[i] = static_cast<uint64_t>(int64_t{dx});
      }
  std::copy_n(half, 3, block.half);
  block.count = count;
}

const CellSeeds::Block& CellSeeds::block(size_t step) {
  while (known_ <= step) {
    if (blocks_.size() == known_) blocks_.emplace_back();
    Block& block = blocks_[known_];
    plan(block, known_);
    keys_.resize(block.count + max_simd_doubles);
    size_t i = 0;
    for (int dz = -block.half[2]; dz <= block.half[2]; ++dz)
      for (int dy = -block.half[1]; dy <= block.half[1]; ++dy) {
        const uint64_t key = seeds_->row_key(cell_, dy, dz);
        for (const size_t end = i + static_cast<size_t>(2 * block.half[0] + 1); i < end; ++i)
          keys_[i] = key;
      }
    HWY_DYNAMIC_DISPATCH(seed_positions)
    (block.cells, keys_.data(), *seeds_, cell_, block.count, block.x.data(), block.y.data(),
     block.z.data());
    for (std::vector<double>* v : {&block.x, &block.y, &block.z})
      std::fill(v->begin() + static_cast<ptrdiff_t>(block.count), v->end(), 1e100);
    if (seeds_->is_weighted()) find_lifts(block);
    ++known_;
  }
  return blocks_[step];
}

void CellSeeds::find_lifts(Block& block) const {
  block.lift.assign(block.count + max_simd_doubles, 0);
  for (size_t i = 0; i < block.count; ++i)
    block.lift[i] = seeds_->lift(splitmix_output(
        keys_[i], static_cast<uint32_t>(cell_.x + static_cast<int>(block.cells.x[i]))));
}

double CellSeeds::find_distances(const Block& block, Vec3 q) {
  distance_squared_.resize(block.count + max_simd_doubles);
  if (seeds_->is_weighted())
    return HWY_DYNAMIC_DISPATCH(lifted_squares)(block.x.data(), block.y.data(), block.z.data(),
                                                block.lift.data(), block.count, q,
                                                distance_squared_.data());
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
