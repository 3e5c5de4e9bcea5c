// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/seed_block.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/simd.h"
#include "structure/foam/seed_block.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Appends to `out` the indices of seeds start .. start + count - 1 within the distance, but for
/// own.
size_t seeds_within(const float* x, const float* y, const float* z, size_t start, size_t count,
                    size_t own, float distance_squared, uint32_t* out) {
  const hn::ScalableTag<float> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const size_t lanes = hn::Lanes(d);
  const auto ox = hn::Set(d, x[own]), oy = hn::Set(d, y[own]), oz = hn::Set(d, z[own]);
  const auto most = hn::Set(d, distance_squared);
  const auto self = hn::Set(du, static_cast<uint32_t>(own));
  const auto end = hn::Set(du, static_cast<uint32_t>(start + count));
  auto index = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<uint32_t>(start)));
  const auto step = hn::Set(du, static_cast<uint32_t>(lanes));
  size_t found = 0;
  for (size_t i = 0; i < count; i += lanes, index = hn::Add(index, step)) {
    const auto dx = hn::Sub(hn::LoadU(d, x + start + i), ox);
    const auto dy = hn::Sub(hn::LoadU(d, y + start + i), oy);
    const auto dz = hn::Sub(hn::LoadU(d, z + start + i), oz);
    const auto d2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
    const auto wanted = hn::And(hn::Lt(index, end), hn::Ne(index, self));
    const auto within = hn::And(hn::RebindMask(du, hn::Le(d2, most)), wanted);
    // In two steps: a compressing store to memory is microcode on some processors.
    hn::StoreU(hn::Compress(index, within), du, out + found);
    found += hn::CountTrue(du, within);
  }
  return found;
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(seeds_within);

SeedBlock::SeedBlock(const FoamSeeds& seeds, CellIndex corner, int side) {
  const Vec3 scale = seeds.scale();
  const double reach = 2 * seeds.empty_radius();
  for (int axis = 0; axis < 3; ++axis) {
    halo_[axis] = static_cast<int>(std::ceil(reach / scale[axis]));
    size_[axis] = static_cast<size_t>(side + 2 * halo_[axis]);
  }
  const size_t count = size_[0] * size_[1] * size_[2];
  positions_.reserve(count);
  for (int z = -halo_[2]; z < side + halo_[2]; ++z)
    for (int y = -halo_[1]; y < side + halo_[1]; ++y)
      for (int x = -halo_[0]; x < side + halo_[0]; ++x)
        positions_.push_back(seeds.at(corner, x, y, z));
  for (std::vector<float>* v : {&x_, &y_, &z_}) v->reserve(count + 2 * most_simd_doubles);
  for (const Vec3& p : positions_) {
    x_.push_back(static_cast<float>(p.x));
    y_.push_back(static_cast<float>(p.y));
    z_.push_back(static_cast<float>(p.z));
  }
  for (std::vector<float>* v : {&x_, &y_, &z_}) v->resize(count + 2 * most_simd_doubles);

  for (int z = -halo_[2]; z <= halo_[2]; ++z)
    for (int y = -halo_[1]; y <= halo_[1]; ++y) {
      const double gap_y = std::max(0, std::abs(y) - 1) * scale.y;
      const double gap_z = std::max(0, std::abs(z) - 1) * scale.z;
      rows_.push_back({(static_cast<ptrdiff_t>(z) * static_cast<ptrdiff_t>(size_[1]) + y) *
                               static_cast<ptrdiff_t>(size_[0]) -
                           halo_[0],
                       gap_y * gap_y + gap_z * gap_z});
    }
}

size_t SeedBlock::near(size_t own, double distance_squared, std::vector<uint32_t>& found) const {
  const size_t length = static_cast<size_t>(2 * halo_[0] + 1);
  found.resize(rows_.size() * length + 2 * most_simd_doubles);
  size_t count = 0;
  for (const Row& row : rows_)
    if (row.least_squared <= distance_squared)
      count += HWY_DYNAMIC_DISPATCH(seeds_within)(
          x_.data(), y_.data(), z_.data(),
          static_cast<size_t>(static_cast<ptrdiff_t>(own) + row.start), length, own,
          static_cast<float>(distance_squared * (1 + 1e-5)), found.data() + count);
  return count;
}

}  // namespace msq
#endif  // HWY_ONCE
