// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/edges/brick_seeds.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/compress-inl.h"
#include "base/simd.h"
#include "structure/foam/edges/brick_seeds.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

// With vectors of 64 bytes, two runs per vector.
#if HWY_MAX_BYTES == 64 && !HWY_HAVE_SCALABLE
using D = hn::ScalableTag<float>;
#else
using D = hn::CappedTag<float, BrickSeeds::Stretches::lanes>;
#endif

HWY_INLINE hn::Vec<D> load(const float* values, const ptrdiff_t* starts, size_t lane) {
  constexpr size_t stretch = BrickSeeds::Stretches::lanes;
#if HWY_MAX_BYTES == 64 && !HWY_HAVE_SCALABLE
  const hn::Half<D> half;
  return hn::Combine(D(), hn::LoadU(half, values + starts[lane / stretch + 1]),
                     hn::LoadU(half, values + starts[lane / stretch]));
#else
  return hn::LoadU(D(), values + starts[lane / stretch] + lane % stretch);
#endif
}

/// Stores the first lanes. Usually few are needed, and stores of half a vector cross fewer cache
/// lines.
template <class V, class T>
HWY_INLINE void store(V v, size_t wanted, T* to) {
  const hn::DFromV<V> d;
#if HWY_MAX_BYTES == 64 && !HWY_HAVE_SCALABLE
  const hn::Half<decltype(d)> half;
  if (wanted <= hn::Lanes(half)) return hn::StoreU(hn::LowerHalf(half, v), half, to);
#endif
  (void)wanted;
  hn::StoreU(v, d, to);
}

void planes_within(const BrickSeeds::Fractions& fractions, const BrickSeeds::Stretches& stretches,
                   size_t own, float distance_squared, VoronoiCell::Planes& planes) {
  const D d;
  const hn::RebindToSigned<D> di;
  const hn::RebindToUnsigned<D> du;
  const float *x = fractions.x.data() + own, *y = fractions.y.data() + own,
              *z = fractions.z.data() + own;
  const auto own_x = hn::Set(d, *x), own_y = hn::Set(d, *y), own_z = hn::Set(d, *z);
  const auto own_seed = hn::Set(di, static_cast<int32_t>(own));
  const auto most = hn::Set(d, distance_squared), half = hn::Set(d, 0.5f);
  size_t count = 0;
  for (size_t i = 0; i < stretches.x.size() && count <= VoronoiCell::max_planes;
       i += hn::Lanes(d)) {
    const ptrdiff_t* starts = stretches.starts.data();
    // Whole cells last: differences of fractions are exact, and so are the sums for cube cells.
    const auto nx = hn::Add(hn::Sub(load(x, starts, i), own_x), hn::LoadU(d, &stretches.x[i]));
    const auto ny = hn::Add(hn::Sub(load(y, starts, i), own_y), hn::LoadU(d, &stretches.y[i]));
    const auto nz = hn::Add(hn::Sub(load(z, starts, i), own_z), hn::LoadU(d, &stretches.z[i]));
    const auto d2 = hn::MulAdd(nx, nx, hn::MulAdd(ny, ny, hn::Mul(nz, nz)));
    const auto within = hn::Le(d2, most);
    const auto seed = hn::BitCast(du, hn::Add(own_seed, hn::LoadU(di, &stretches.seed[i])));
    const Compression<D> compressed(within);
    const size_t found = hn::CountTrue(d, within);
    store(compressed(nx), found, planes.x + count);
    store(compressed(ny), found, planes.y + count);
    store(compressed(nz), found, planes.z + count);
    store(compressed(seed), found, planes.seed + count);
    count += found;
  }
  planes.count = count;
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto nx = hn::LoadU(d, planes.x + i), ny = hn::LoadU(d, planes.y + i),
               nz = hn::LoadU(d, planes.z + i);
    const auto d2 = hn::MulAdd(nx, nx, hn::MulAdd(ny, ny, hn::Mul(nz, nz)));
    hn::StoreU(hn::Mul(d2, half), d, planes.offset + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(planes_within);

void BrickSeeds::move_to(const FoamSeeds& seeds, CellIndex corner, int side, double max_often) {
  const Vec3 scale = seeds.scale();
  const double reach = 2 * seeds.empty_radius();
  if (side != side_ || !(scale == scale_) || max_often != max_often_)
    plan(scale, reach, side, max_often);
  tile_.build(seeds, corner, {side, side, side}, halo_);
  const float *x = tile_.fraction(0), *y = tile_.fraction(1), *z = tile_.fraction(2);
  for (size_t i = 0; i < positions_.size(); ++i) {
    const Vec3 cell{double(cells_[i][0]), double(cells_[i][1]), double(cells_[i][2])};
    const Vec3 p = (cell + Vec3{x[i], y[i], z[i]}) * scale, corner_of_cell = cell * scale;
    positions_[i] = p;
    fractions_.x[i] = static_cast<float>(p.x - corner_of_cell.x);
    fractions_.y[i] = static_cast<float>(p.y - corner_of_cell.y);
    fractions_.z[i] = static_cast<float>(p.z - corner_of_cell.z);
  }
}

void BrickSeeds::plan(Vec3 scale, double reach, int side, double max_often) {
  side_ = 0;  // until everything is set
  for (int axis = 0; axis < 3; ++axis) {
    halo_[axis] = static_cast<int>(std::ceil(reach / scale[axis]));
    size_[axis] = static_cast<size_t>(side + 2 * halo_[axis]);
  }
  near_ = stretches(scale, max_often);
  all_ = stretches(scale, reach * reach);
  const size_t count = size_[0] * size_[1] * size_[2];
  positions_.resize(count);
  // Runs may end beyond the last seed.
  for (std::vector<float>* v : {&fractions_.x, &fractions_.y, &fractions_.z})
    v->assign(count + 2 * Stretches::lanes, 0);
  cells_.clear();
  for (int z = -halo_[2]; z < side + halo_[2]; ++z)
    for (int y = -halo_[1]; y < side + halo_[1]; ++y)
      for (int x = -halo_[0]; x < side + halo_[0]; ++x) cells_.push_back({x, y, z});
  side_ = side;
  scale_ = scale;
  max_often_ = max_often;
}

BrickSeeds::Stretches BrickSeeds::stretches(Vec3 scale, double distance_squared) const {
  constexpr float far = 1e3f;
  Stretches found;
  const auto gap = [](int cells, double size) { return std::max(0, std::abs(cells) - 1) * size; };
  for (int z = -halo_[2]; z <= halo_[2]; ++z)
    for (int y = -halo_[1]; y <= halo_[1]; ++y) {
      const double gap_y = gap(y, scale.y), gap_z = gap(z, scale.z);
      const double across = gap_y * gap_y + gap_z * gap_z;
      int reach = -1;  // cells along x that may contain seeds within the distance
      while (reach < halo_[0] && across + gap(reach + 1, scale.x) * gap(reach + 1, scale.x) <=
                                     distance_squared * (1 + 1e-5))
        ++reach;
      const ptrdiff_t row = (static_cast<ptrdiff_t>(z) * static_cast<ptrdiff_t>(size_[1]) + y) *
                            static_cast<ptrdiff_t>(size_[0]);
      for (int x0 = -reach; x0 <= reach; x0 += Stretches::lanes) {
        found.starts.push_back(row + x0);
        for (int x = x0; x < x0 + static_cast<int>(Stretches::lanes); ++x) {
          const bool is_there = x <= reach && (x || y || z);
          found.seed.push_back(static_cast<int32_t>(row + x));
          found.x.push_back(is_there ? static_cast<float>(x * scale.x) : far);
          found.y.push_back(static_cast<float>(y * scale.y));
          found.z.push_back(static_cast<float>(z * scale.z));
        }
      }
    }
  if (found.starts.size() % 2) {
    found.starts.push_back(0);
    for (size_t lane = 0; lane < Stretches::lanes; ++lane) {
      found.seed.push_back(0);
      for (std::vector<float>* v : {&found.x, &found.y, &found.z}) v->push_back(far);
    }
  }
  return found;
}

size_t BrickSeeds::refill(VoronoiCell& cell, size_t own, double distance_squared) const {
  VoronoiCell::Planes& planes = cell.refill(positions_.data(), positions_[own]);
  HWY_DYNAMIC_DISPATCH(planes_within)
  (fractions_, distance_squared <= max_often_ ? near_ : all_, own,
   static_cast<float>(distance_squared * (1 + 1e-5)), planes);
  return static_cast<size_t>(
      std::lower_bound(planes.seed, planes.seed + planes.count, static_cast<uint32_t>(own)) -
      planes.seed);
}

}  // namespace msq
#endif  // HWY_ONCE
