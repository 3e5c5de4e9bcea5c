// SPDX-License-Identifier: Apache-2.0
// Sixteen facets of the walk over tetrahedra (facet_walk.h): the seeds beyond them, the spheres
// through both, and the proof that these are empty. Included once for each instruction set.
#if defined(MSQ_STRUCTURE_FOAM_EDGES_FACET_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUCTURE_FOAM_EDGES_FACET_BATCH_INL_H
#undef MSQ_STRUCTURE_FOAM_EDGES_FACET_BATCH_INL_H
#else
#define MSQ_STRUCTURE_FOAM_EDGES_FACET_BATCH_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "base/mask_bits-inl.h"
#include "structure/foam/edges/facet_state.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int B = FacetState::batch;
using D = hn::CappedTag<float, B>;
using DI = hn::RebindToSigned<D>;
using DU = hn::RebindToUnsigned<D>;
using VF = hn::Vec<D>;
using VU = hn::Vec<DU>;

/// Facets a < b < c of the batch. The unknown side is that of (b - a) x (c - a) times `side`.
struct Batch {
  alignas(64) uint32_t a[B], b[B], c[B], found[B];
  alignas(64) float side[B];
  alignas(64) uint32_t bucket[B], slot[B];
  size_t count;
  // In cells: a, and b, c, and the seed found relative to it.
  alignas(64) float from[3][B], u[3][B], v[3][B], w[3][B];
  // Foam units: the circle's middle, its squared radius (negative), and the unit normal.
  alignas(64) float middle[3][B], lesser[B], normal[3][B];
  // The patch that is searched: its first cell, its corner, and its first layer.
  alignas(64) uint32_t first[B];
  alignas(64) int32_t layer[B];
  alignas(64) float low[3][B];
  alignas(64) float centre[3][B], reach_squared[B];  // radius and margin
};
/// Points of consecutive seeds of a list, by coordinates.
HWY_INLINE void fetch(const float (*points)[4], const uint32_t* seeds, VF& x, VF& y, VF& z) {
  const D d;
#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE
  const auto at = hn::ShiftLeft<2>(hn::BitCast(DI(), hn::LoadU(DU(), seeds)));
  x = hn::GatherIndex(d, points[0], at);
  y = hn::GatherIndex(d, points[0] + 1, at);
  z = hn::GatherIndex(d, points[0] + 2, at);
#else
  // Loads of 16 bytes and a transposition; a gather of one coordinate takes as long.
  const hn::FixedTag<float, 4> d4;
  const auto row = [&](int j) {
    const auto one = [&](int block) { return hn::Load(d4, points[seeds[4 * block + j]]); };
#if HWY_MAX_BYTES == 64
    const hn::FixedTag<float, 8> d8;
    return hn::Combine(d, hn::Combine(d8, one(3), one(2)), hn::Combine(d8, one(1), one(0)));
#elif HWY_MAX_BYTES == 32
    return hn::Combine(d, one(1), one(0));
#else
    return one(0);
#endif
  };
  const hn::Repartition<double, D> dd;
  const auto wide = [&](VF v) { return hn::BitCast(dd, v); };
  const VF r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
#if HWY_TARGET == HWY_NEON && !HWY_ARCH_ARM_A64
  const hn::Repartition<uint64_t, D> d64;
#define MSQ_WIDE(v) hn::BitCast(d64, v)
#else
  const auto& d64 = dd;
#define MSQ_WIDE(v) wide(v)
#endif
  const VF xy01 = hn::InterleaveLower(d, r0, r1), xy23 = hn::InterleaveLower(d, r2, r3);
  const VF z01 = hn::InterleaveUpper(d, r0, r1), z23 = hn::InterleaveUpper(d, r2, r3);
  x = hn::BitCast(d, hn::InterleaveLower(d64, MSQ_WIDE(xy01), MSQ_WIDE(xy23)));
  y = hn::BitCast(d, hn::InterleaveUpper(d64, MSQ_WIDE(xy01), MSQ_WIDE(xy23)));
  z = hn::BitCast(d, hn::InterleaveLower(d64, MSQ_WIDE(z01), MSQ_WIDE(z23)));
#undef MSQ_WIDE
#endif
}

HWY_INLINE VF dot3(VF ax, VF ay, VF az, VF bx, VF by, VF bz) {
  return hn::MulAdd(ax, bx, hn::MulAdd(ay, by, hn::Mul(az, bz)));
}

/// How far beyond a facet centres are expected, in sizes of a cube of a cell's volume.
constexpr float ahead = 0.22f;

/// Fills from, u, v; middle, lesser, normal; first, layer, low.
HWY_INLINE void find_lines(const FacetState& s, Batch& batch) {
  const D d;
  const DI di;
  const auto scale_x = hn::Set(d, static_cast<float>(s.scale[0])),
             scale_y = hn::Set(d, static_cast<float>(s.scale[1])),
             scale_z = hn::Set(d, static_cast<float>(s.scale[2]));
  const VF scale[3] = {scale_x, scale_y, scale_z};
  for (size_t i = 0; i < B; i += hn::Lanes(d)) {
    VF pa[3], u[3], v[3];
    fetch(s.points, batch.a + i, pa[0], pa[1], pa[2]);
    fetch(s.points, batch.b + i, u[0], u[1], u[2]);
    fetch(s.points, batch.c + i, v[0], v[1], v[2]);
    for (int k = 0; k < 3; ++k) {
      u[k] = hn::Sub(u[k], pa[k]);
      v[k] = hn::Sub(v[k], pa[k]);
      hn::Store(pa[k], d, batch.from[k] + i);
      hn::Store(u[k], d, batch.u[k] + i);
      hn::Store(v[k], d, batch.v[k] + i);
      pa[k] = hn::Mul(pa[k], scale[k]);
      u[k] = hn::Mul(u[k], scale[k]);
      v[k] = hn::Mul(v[k], scale[k]);
    }
    const auto minor = [](VF p, VF q, VF r, VF t) { return hn::MulSub(p, q, hn::Mul(r, t)); };
    const VF m[3] = {minor(u[1], v[2], u[2], v[1]), minor(u[2], v[0], u[0], v[2]),
                     minor(u[0], v[1], u[1], v[0])};
    const VF mm = dot3(m[0], m[1], m[2], m[0], m[1], m[2]);
    const VF inverse = hn::Div(hn::Set(d, 0.5f), mm);
    const VF unit = hn::Mul(hn::Sqrt(hn::Add(inverse, inverse)), hn::Load(d, batch.side + i));
    const VF ku = hn::Mul(dot3(u[0], u[1], u[2], u[0], u[1], u[2]), inverse),
             kv = hn::Mul(dot3(v[0], v[1], v[2], v[0], v[1], v[2]), inverse);
    VF g[3];
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, n = (k + 2) % 3;
      g[k] =
          hn::MulAdd(ku, minor(v[l], m[n], v[n], m[l]), hn::Mul(kv, minor(m[l], u[n], m[n], u[l])));
    }
    hn::Store(hn::Neg(dot3(g[0], g[1], g[2], g[0], g[1], g[2])), d, batch.lesser + i);
    hn::Vec<DI> first[3];
    const VF far = hn::Set(d, ahead * s.unit);
    for (int k = 0; k < 3; ++k) {
      const VF normal = hn::Mul(m[k], unit), middle = hn::Add(pa[k], g[k]);
      hn::Store(normal, d, batch.normal[k] + i);
      hn::Store(middle, d, batch.middle[k] + i);
      const VF at =
          hn::Add(hn::Div(hn::MulAdd(far, normal, middle), scale[k]),
                  hn::Set(d, static_cast<float>(s.half_width - FacetState::half_patch) + 0.5f));
      // Also where rounding has made it infinite or no number.
      const VF small = hn::IfThenElseZero(hn::Lt(hn::Abs(at), hn::Set(d, 1000.0f)), at);
      first[k] = hn::Min(hn::Max(hn::ConvertTo(di, small), hn::Zero(di)),
                         hn::Set(di, s.width - FacetState::patch));
      hn::Store(
          hn::Mul(hn::Sub(hn::ConvertTo(d, first[k]), hn::Set(d, static_cast<float>(s.half_width))),
                  scale[k]),
          d, batch.low[k] + i);
    }
    hn::Store(hn::BitCast(DU(), hn::Or(first[0], hn::Or(hn::ShiftLeft<4>(first[1]),
                                                        hn::ShiftLeft<8>(first[2])))),
              DU(), batch.first + i);
    const auto row = hn::Set(di, FacetState::patches_in_row),
               high = hn::Set(di, FacetState::max_width);
    hn::Store(hn::Add(first[2], hn::Mul(high, hn::Add(first[0], hn::Mul(first[1], row)))), di,
              batch.layer + i);
  }
}

HWY_INLINE VF reciprocal(VF v) {
  const auto r = hn::ApproximateReciprocal(v);
#if HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
  return r;  // 14 bits
#else
  return hn::Mul(r, hn::NegMulAdd(v, r, hn::Set(D(), 2.0f)));
#endif
}

/// The seed that the growing sphere of a facet meets first. Rounding may mislead it.
HWY_INLINE void search(const FacetState& s, Batch& batch) {
  constexpr float flat = 1e-5f;  // leaves out the facet's own seeds
  const D d;
  const DI di;
  const auto none = hn::Set(d, 1e9f), flattest = hn::Set(d, flat);
  const auto high_bits = hn::Set(di, -64);
  for (size_t i = 0; i < batch.count; ++i) {
    const VF mx = hn::Set(d, batch.middle[0][i]), my = hn::Set(d, batch.middle[1][i]),
             mz = hn::Set(d, batch.middle[2][i]), less = hn::Set(d, batch.lesser[i]);
    const VF nx = hn::Set(d, batch.normal[0][i]), ny = hn::Set(d, batch.normal[1][i]),
             nz = hn::Set(d, batch.normal[2][i]);
    const float* layer = s.layers[batch.layer[i]];
    VF best = none;
    auto number = hn::Iota(di, 0);
    for (int k = 0; k < FacetState::patch; ++k, layer += 48)
      for (size_t j = 0; j < 16; j += hn::Lanes(d)) {
        const VF qx = hn::Sub(hn::Load(d, layer + j), mx),
                 qy = hn::Sub(hn::Load(d, layer + 16 + j), my),
                 qz = hn::Sub(hn::Load(d, layer + 32 + j), mz);
        // From the middle of the facet's circle: q^2 less its squared radius, over q . n, is twice
        // the distance of the centre.
        const VF over = hn::MulAdd(qx, qx, hn::MulAdd(qy, qy, hn::MulAdd(qz, qz, less)));
        const VF along = dot3(qx, qy, qz, nx, ny, nz);
        const VF t =
            hn::IfThenElse(hn::Gt(along, flattest), hn::Mul(over, reciprocal(along)), none);
        // The last bits: the candidate's number.
        const VF named = hn::BitCast(d, hn::Or(hn::And(hn::BitCast(di, t), high_bits), number));
        best = hn::Min(best, named);
        number = hn::Add(number, hn::Set(di, static_cast<int32_t>(hn::Lanes(d))));
      }
    const uint32_t m = std::bit_cast<uint32_t>(hn::GetLane(hn::MinOfLanes(d, best))) & 63;
    batch.found[i] = batch.first[i] + ((m & 3) | (m & 12) << 2 | (m & 48) << 4);
  }
}

/// The sphere about a and a + u, v, w: its centre from a. Returns 6 times the signed volume.
/// Without multiply-add: all instruction sets give the same bits.
template <class DD, class V = hn::Vec<DD>>
HWY_INLINE V sphere(DD dd, const V* u, const V* v, const V* w, V* centre) {
  const auto minor = [](V p, V q, V r, V t) { return hn::Sub(hn::Mul(p, q), hn::Mul(r, t)); };
  const auto dot = [](const V* a, const V* b) {
    return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
  };
  const auto cross = [&](const V* a, const V* b, V* to) {
    to[0] = minor(a[1], b[2], a[2], b[1]);
    to[1] = minor(a[2], b[0], a[0], b[2]);
    to[2] = minor(a[0], b[1], a[1], b[0]);
  };
  V vw[3], wu[3], uv[3];
  cross(v, w, vw);
  cross(w, u, wu);
  cross(u, v, uv);
  const V det = dot(u, vw), scale = hn::Div(hn::Set(dd, 0.5), det);
  const V ku = hn::Mul(scale, dot(u, u)), kv = hn::Mul(scale, dot(v, v)),
          kw = hn::Mul(scale, dot(w, w));
  for (int k = 0; k < 3; ++k)
    centre[k] = hn::Add(hn::Add(hn::Mul(ku, vw[k]), hn::Mul(kv, wu[k])), hn::Mul(kw, uv[k]));
  return det;
}

/// Fills w, centre and reach_squared. Returns the facets whose sphere is in the patch, and whose
/// volume is on the unknown side.
HWY_INLINE uint32_t find_centres(const FacetState& s, Batch& batch) {
  const D d;
  const hn::CappedTag<double, B / 2> dd;
  const hn::Rebind<float, decltype(dd)> half;
  for (size_t i = 0; i < B; i += hn::Lanes(d)) {
    VF w[3];
    fetch(s.points, batch.found + i, w[0], w[1], w[2]);
    for (int k = 0; k < 3; ++k)
      hn::Store(hn::Sub(w[k], hn::Load(d, batch.from[k] + i)), d, batch.w[k] + i);
  }
  uint32_t good = 0;
  for (size_t i = 0; i < B; i += hn::Lanes(dd)) {
    using V = hn::Vec<decltype(dd)>;
    V u[3], v[3], w[3], centre[3];
    for (int k = 0; k < 3; ++k) {
      const V scale = hn::Set(dd, s.scale[k]);
      u[k] = hn::Mul(hn::PromoteTo(dd, hn::LoadU(half, batch.u[k] + i)), scale);
      v[k] = hn::Mul(hn::PromoteTo(dd, hn::LoadU(half, batch.v[k] + i)), scale);
      w[k] = hn::Mul(hn::PromoteTo(dd, hn::LoadU(half, batch.w[k] + i)), scale);
    }
    const V det = sphere(dd, u, v, w, centre);
    const V squared = hn::Add(hn::Add(hn::Mul(centre[0], centre[0]), hn::Mul(centre[1], centre[1])),
                              hn::Mul(centre[2], centre[2]));
    const V volume = hn::Mul(det, hn::PromoteTo(dd, hn::LoadU(half, batch.side + i)));
    const auto is_full =
        hn::Ge(volume, hn::Mul(hn::Mul(squared, squared), hn::Set(dd, walk_min_volume)));
    good |= static_cast<uint32_t>(bits_of(dd, is_full) & ((uint64_t{1} << hn::Lanes(dd)) - 1)) << i;
    for (int k = 0; k < 3; ++k) {
      const V from =
          hn::Mul(hn::PromoteTo(dd, hn::LoadU(half, batch.from[k] + i)), hn::Set(dd, s.scale[k]));
      hn::StoreU(hn::DemoteTo(half, hn::Add(from, centre[k])), half, batch.centre[k] + i);
    }
    hn::StoreU(hn::Add(hn::DemoteTo(half, squared), hn::Set(half, walk_margin)), half,
               batch.reach_squared + i);
  }
  uint32_t within = 0;
  for (size_t i = 0; i < B; i += hn::Lanes(d)) {
    const VF reach =
        hn::Add(hn::Sqrt(hn::Load(d, batch.reach_squared + i)), hn::Set(d, walk_margin));
    auto is_in = hn::Lt(reach, hn::Set(d, 1.5f));
    for (int k = 0; k < 3; ++k) {
      const VF c = hn::Load(d, batch.centre[k] + i), low = hn::Load(d, batch.low[k] + i);
      const VF high = hn::Add(low, hn::Set(d, static_cast<float>(FacetState::patch * s.scale[k])));
      is_in =
          hn::And(is_in, hn::And(hn::Ge(hn::Sub(c, reach), low), hn::Le(hn::Add(c, reach), high)));
    }
    within |= static_cast<uint32_t>(bits_of(d, is_in)) << i;
  }
  return good & within;
}

/// Of the `good` ones, those whose sphere contains no seed of the patch, except its own four.
HWY_INLINE uint32_t prove(const FacetState& s, const Batch& batch, uint32_t good) {
  const D d;
  uint32_t proven = 0;
  for (size_t i = 0; i < batch.count; ++i) {
    const VF cx = hn::Set(d, batch.centre[0][i]), cy = hn::Set(d, batch.centre[1][i]),
             cz = hn::Set(d, batch.centre[2][i]), reach = hn::Set(d, batch.reach_squared[i]);
    const float* layer = s.layers[batch.layer[i]];
    size_t inside = 0;
    for (int k = 0; k < FacetState::patch; ++k, layer += 48)
      for (size_t j = 0; j < 16; j += hn::Lanes(d)) {
        const VF x = hn::Sub(hn::Load(d, layer + j), cx),
                 y = hn::Sub(hn::Load(d, layer + 16 + j), cy),
                 z = hn::Sub(hn::Load(d, layer + 32 + j), cz);
        inside +=
            hn::CountTrue(d, hn::Le(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))), reach));
      }
    proven |= static_cast<uint32_t>(inside <= 4) << i;
  }
  return proven & good;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
