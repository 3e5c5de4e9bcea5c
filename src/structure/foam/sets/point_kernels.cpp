// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/sets/point_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/lanes3-inl.h"
#include "base/mask_bits-inl.h"
#include "structure/foam/point/edge_line.h"
#include "structure/foam/point/point.h"
#include "structure/foam/sets/point_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

void block_of(const SeedTile& tile, size_t home, const int (&half)[3], Vec3 scale, float* x,
              float* y, float* z) {
  // Four seeds of a row at a time: most rows have three. The next row overwrites the extra seeds.
  const hn::CappedTag<float, 4> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto scale_x = hn::Set(d, static_cast<float>(scale.x)),
             scale_y = hn::Set(d, static_cast<float>(scale.y)),
             scale_z = hn::Set(d, static_cast<float>(scale.z));
  const auto first = hn::Iota(d, 0);
  size_t count = 0;
  for (int dz = -half[2]; dz <= half[2]; ++dz) {
    const auto cell_z = hn::Set(d, static_cast<float>(dz));
    for (int dy = -half[1]; dy <= half[1]; ++dy) {
      const auto cell_y = hn::Set(d, static_cast<float>(dy));
      const size_t row = home + static_cast<size_t>(tile.offset(0, dy, dz));
      for (int dx = -half[0]; dx <= half[0]; dx += lanes) {
        const size_t from = row + static_cast<size_t>(ptrdiff_t{dx});
        const size_t to = count + static_cast<size_t>(dx + half[0]);
        const auto cell_x = hn::Add(first, hn::Set(d, static_cast<float>(dx)));
        hn::StoreU(hn::Mul(hn::Add(hn::LoadU(d, tile.fraction(0) + from), cell_x), scale_x), d,
                   x + to);
        hn::StoreU(hn::Mul(hn::Add(hn::LoadU(d, tile.fraction(1) + from), cell_y), scale_y), d,
                   y + to);
        hn::StoreU(hn::Mul(hn::Add(hn::LoadU(d, tile.fraction(2) + from), cell_z), scale_z), d,
                   z + to);
      }
      count += static_cast<size_t>(2 * half[0] + 1);
    }
  }
  const hn::ScalableTag<float> whole;
  const auto far = hn::Set(whole, 1e3f);
  for (float* out : {x, y, z}) hn::StoreU(far, whole, out + count);
}

// Lanes are seeds: so no lane waits for another's seeds, for any points.
void near_seeds(const SeedBlockView& block, Vec3 scale, const PlacesView& places, uint16_t* near,
                uint64_t* masks) {
  HWY_ALIGN float x[PlacesView::most], y[PlacesView::most], z[PlacesView::most],
      add[PlacesView::most], reach[PlacesView::most];
  {
    const hn::ScalableTag<double> d;
    const hn::Rebind<float, decltype(d)> df;
    const auto to_border = [&](auto place, double size, double room) {
      const auto edge = hn::Min(place, hn::Sub(hn::Set(d, size), place));
      return hn::Add(edge, hn::Set(d, room - static_cast<double>(block.slack)));
    };
    // A distance, the nearest, and their comparison: three times the slack (point_batch.cpp).
    const auto slack = hn::Set(df, 3 * block.slack);
    for (size_t i = 0; i < places.count; i += hn::Lanes(d)) {
      const auto px = hn::LoadU(d, places.x + i), py = hn::LoadU(d, places.y + i),
                 pz = hn::LoadU(d, places.z + i), radius = hn::LoadU(d, places.radius + i);
      hn::Store(hn::DemoteTo(df, px), df, x + i);
      hn::Store(hn::DemoteTo(df, py), df, y + i);
      hn::Store(hn::DemoteTo(df, pz), df, z + i);
      hn::Store(hn::Add(hn::DemoteTo(df, hn::Add(radius, radius)), slack), df, add + i);
      const auto border = hn::Min(
          hn::Min(to_border(px, scale.x, block.room.x), to_border(py, scale.y, block.room.y)),
          to_border(pz, scale.z, block.room.z));
      hn::Store(hn::DemoteTo(df, border), df, reach + i);
    }
  }
  const hn::ScalableTag<float> d;
  const size_t lanes = hn::Lanes(d);
  HWY_ALIGN float distance_squared[max_block_seeds + 2 * max_simd_doubles];
  for (size_t i = 0; i < places.count; ++i, masks += block.mask_words) {
    const auto qx = hn::Set(d, x[i]), qy = hn::Set(d, y[i]), qz = hn::Set(d, z[i]);
    auto least = hn::Set(d, 1e30f);
    for (size_t s = 0; s < block.count; s += lanes) {
      const auto dx = hn::Sub(hn::LoadU(d, block.x + s), qx);
      const auto dy = hn::Sub(hn::LoadU(d, block.y + s), qy);
      const auto dz = hn::Sub(hn::LoadU(d, block.z + s), qz);
      const auto d2 = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
      hn::Store(d2, d, distance_squared + s);
      least = hn::Min(least, d2);
    }
    const auto needed = hn::Add(hn::Sqrt(hn::MinOfLanes(d, least)), hn::Set(d, add[i]));
    const auto needed_squared = hn::Mul(needed, needed);
    uint64_t word = 0;
    size_t s = 0, count = 0;
    for (; s < block.count; s += lanes) {
      if (s % 64 == 0 && s > 0) {
        masks[s / 64 - 1] = word;
        word = 0;
      }
      const auto is_near = hn::Le(hn::Load(d, distance_squared + s), needed_squared);
      word |= bits_of(d, is_near) << (s % 64);
      count += hn::CountTrue(d, is_near);
    }
    masks[(s - 1) / 64] = word;
    near[i] = hn::GetLane(needed) <= reach[i] ? static_cast<uint16_t>(count) : beyond_block;
  }
}

// Lanes are points. The operations are those of foam_point_inside(), EdgeLine and Vec3, in their
// order, each rounded as IEEE 754 says. So the results are the same, to the last bit. All triples
// are tried, in any order, since one that holds is enough.
void triples(const TripleBatch& batch, size_t seeds, uint8_t* held) {
  const hn::ScalableTag<double> d;
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;
  const size_t lanes = hn::Lanes(d);
  const V zero = hn::Zero(d), half = hn::Set(d, 0.5);
  HWY_ALIGN double distance_squared[TripleBatch::max_seeds][max_simd_doubles];
  for (size_t first = 0; first < batch.count; first += lanes) {
    const auto seed = [&](size_t i) -> Lanes3<D> {
      return {hn::LoadU(d, batch.seed[i][0] + first), hn::LoadU(d, batch.seed[i][1] + first),
              hn::LoadU(d, batch.seed[i][2] + first)};
    };
    const Lanes3<D> q{hn::LoadU(d, batch.point[0] + first), hn::LoadU(d, batch.point[1] + first),
                      hn::LoadU(d, batch.point[2] + first)};
    const V radius = hn::LoadU(d, batch.radius + first);
    const V r2 = hn::Mul(radius, radius);

    V least = hn::Set(d, 1e300);
    for (size_t i = 0; i < seeds; ++i) {
      const Lanes3<D> e = subtract(seed(i), q);
      const V d2 = dot(e, e);
      hn::Store(d2, d, distance_squared[i]);
      least = hn::Min(least, d2);
    }
    const V needed =
        hn::Add(hn::Add(hn::Sqrt(least), hn::Mul(hn::Set(d, 2.0), radius)), hn::Set(d, near_slack));
    const V needed_squared = hn::Mul(needed, needed);
    const auto is_near = [&](size_t i) {
      return hn::Le(hn::Load(d, distance_squared[i]), needed_squared);
    };

    auto inside = hn::Lt(zero, zero);
    for (size_t c = 2; c < seeds; ++c)
      for (size_t b = 1; b < c; ++b)
        for (size_t a = 0; a < b; ++a) {
          const Lanes3<D> corner = seed(a);
          const Lanes3<D> u = subtract(seed(b), corner), v = subtract(seed(c), corner);
          const Lanes3<D> direction = cross(u, v);
          const V squared = dot(direction, direction);
          const auto exists = hn::Gt(squared, zero);
          const V inverse = hn::IfThenElseZero(exists, hn::Div(hn::Set(d, 1.0), squared));
          const Lanes3<D> offset =
              scale(cross(subtract(scale(v, dot(u, u)), scale(u, dot(v, v))), direction),
                    hn::Mul(half, inverse));
          const Lanes3<D> w = subtract(subtract(q, corner), offset);
          const V foot = hn::Mul(dot(w, direction), inverse);
          const Lanes3<D> away = subtract(w, scale(direction, foot));
          const V under = hn::Mul(hn::Sub(r2, dot(away, away)), inverse);
          auto holds = hn::And(hn::And(is_near(a), is_near(b)),
                               hn::And(hn::And(is_near(c), exists), hn::Ge(under, zero)));
          if (hn::AllFalse(d, hn::AndNot(inside, holds))) continue;
          const V half_chord = hn::Sqrt(hn::Max(under, zero));
          V low = hn::Sub(foot, half_chord), high = hn::Add(foot, half_chord);
          for (size_t i = 0; i < seeds; ++i) {
            if (i == a || i == b || i == c) continue;
            const Lanes3<D> e = subtract(seed(i), corner);
            const V across = dot(direction, e);
            const V room = hn::Sub(hn::Mul(half, dot(e, e)), dot(offset, e));
            const V ratio = hn::Div(room, across);
            const auto near = is_near(i);
            const auto ahead = hn::Gt(across, hn::Set(d, EdgeLine::coplanar));
            const auto behind = hn::Lt(across, hn::Set(d, -EdgeLine::coplanar));
            high = hn::IfThenElse(hn::And(near, ahead), hn::Min(high, ratio), high);
            low = hn::IfThenElse(hn::And(near, behind), hn::Max(low, ratio), low);
            const auto cut_all =
                hn::AndNot(hn::Or(ahead, behind), hn::Lt(room, hn::Set(d, -EdgeLine::cocircular)));
            holds = hn::AndNot(hn::And(near, cut_all), holds);
          }
          const V gap = hn::Sub(low, high);
          const auto is_part = hn::Or(
              hn::Le(gap, zero),
              hn::Le(hn::Mul(gap, gap), hn::Mul(hn::Set(d, EdgeLine::forgiven_squared), inverse)));
          inside = hn::Or(inside, hn::And(holds, is_part));
        }
    const uint64_t bits = bits_of(d, inside);
    for (size_t i = 0; i < lanes && first + i < batch.count; ++i) held[first + i] = bits >> i & 1;
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(block_of);
HWY_EXPORT(near_seeds);
HWY_EXPORT(triples);

void fill_block(const SeedTile& tile, size_t home, const int (&half)[3], Vec3 scale, float* x,
                float* y, float* z) {
  HWY_DYNAMIC_DISPATCH(block_of)(tile, home, half, scale, x, y, z);
}

void find_near_seeds(const SeedBlockView& block, Vec3 scale, const PlacesView& places,
                     uint16_t* near, uint64_t* masks) {
  HWY_DYNAMIC_DISPATCH(near_seeds)(block, scale, places, near, masks);
}

void decide_triples(const TripleBatch& batch, size_t seeds, uint8_t* held) {
  HWY_DYNAMIC_DISPATCH(triples)(batch, seeds, held);
}

}  // namespace msq
#endif  // HWY_ONCE
