// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/seeds/seed_tile.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd.h"
#include "structure/foam/seeds/seed_bits-inl.h"
#include "structure/foam/seeds/seed_tile.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

// Both kernels: splitmix_output (base/random.h) and FoamSeeds::fraction for cells first_x,
// first_x + 1, ... of a row. They may write up to a vector past `count`.
#if HWY_TARGET == HWY_SCALAR

void seeds_of_row(uint64_t row_key, uint32_t first_x, size_t count, uint64_t jitter, float* x,
                  float* y, float* z) {
  const uint64_t shift = (uint64_t{1} << 51) - (jitter << 20);
  const auto fraction = [&](uint64_t bits) {
    const uint64_t sum = (bits & 0x1fffff) * jitter + shift;
    return static_cast<float>(sum >> 31) * 0x1p-21f;
  };
  for (size_t i = 0; i < count; ++i) {
    const uint64_t h = splitmix_output(row_key, static_cast<uint32_t>(first_x + i));
    x[i] = fraction(h);
    y[i] = fraction(h >> 21);
    z[i] = fraction(h >> 42);
  }
}

#else

void seeds_of_row(uint64_t row_key, uint32_t first_x, size_t count, uint64_t jitter, float* x,
                  float* y, float* z) {
  const hn::ScalableTag<uint64_t> d;
  const hn::Rebind<float, decltype(d)> df;
  const size_t lanes = hn::Lanes(d);
  const auto key = hn::Set(d, row_key), step = hn::Set(d, lanes);
  const auto fraction = [&](auto bits) { return hn::DemoteTo(df, seed_fraction(d, bits, jitter)); };
  auto n = hn::Add(hn::Iota(d, 0), hn::Set(d, first_x));
  for (size_t i = 0; i < count; i += lanes, n = hn::Add(n, step)) {
    const auto h = seed_bits(d, key, n);
    hn::StoreU(fraction(h), df, x + i);
    hn::StoreU(fraction(hn::ShiftRight<21>(h)), df, y + i);
    hn::StoreU(fraction(hn::ShiftRight<42>(h)), df, z + i);
  }
}

#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(seeds_of_row);

void SeedTile::build(const FoamSeeds& seeds, CellIndex low, const int (&size)[3],
                     const int (&halo)[3]) {
  first_ = {low.x - halo[0], low.y - halo[1], low.z - halo[2]};
  for (int axis = 0; axis < 3; ++axis) length_[axis] = size[axis] + 2 * halo[axis];
  const size_t count = static_cast<size_t>(SeedTile::seeds(size, halo)) + 2 * max_simd_doubles;
  for (std::vector<float>& v : fraction_)
    if (v.size() < count) v.resize(count);
  // A row's last vector extends into the next row, which is written after it.
  for (int z = 0; z < length_[2]; ++z)
    for (int y = 0; y < length_[1]; ++y) {
      const size_t start = static_cast<size_t>(offset(0, y, z));
      HWY_DYNAMIC_DISPATCH(seeds_of_row)
      (seeds.row_key(first_, y, z), static_cast<uint32_t>(first_.x),
       static_cast<size_t>(length_[0]), static_cast<uint64_t>(seeds.jitter()),
       fraction_[0].data() + start, fraction_[1].data() + start, fraction_[2].data() + start);
    }
}

}  // namespace msq
#endif  // HWY_ONCE
