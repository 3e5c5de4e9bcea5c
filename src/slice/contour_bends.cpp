// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slice/contour_bends.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/mask_bits-inl.h"
#include "base/simd.h"
#include "slice/contour_bends.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

HWY_INLINE V cross_of(V ax, V ay, V bx, V by) {
  return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx));
}
HWY_INLINE V squared(V x, V y) {
  return hn::Add(hn::Mul(x, x), hn::Mul(y, y));
}

/// Of pieces of the boundary, one in a lane.
struct Bends {
  M may_bend, is_close;
};

/// What three segments tell about the pieces that begin at x, y. The arithmetic is that of
/// ContourDetails::suspect().
HWY_INLINE Bends bends_by_triangles(const double* x, const double* y, double tolerance,
                                    double close) {
  const D d;
  const V zero = hn::Zero(d), limit2 = hn::Set(d, tolerance * tolerance);
  const V close2 = hn::Set(d, close * close), limit2_4 = hn::Set(d, 4 * (tolerance * tolerance));
  const V ax = hn::LoadU(d, x), ay = hn::LoadU(d, y);
  const V bx = hn::LoadU(d, x + 1), by = hn::LoadU(d, y + 1);
  const V d1_x = hn::Sub(ax, hn::LoadU(d, x - 1)), d1_y = hn::Sub(ay, hn::LoadU(d, y - 1));
  const V ab_x = hn::Sub(bx, ax), ab_y = hn::Sub(by, ay);
  const V d2_x = hn::Sub(hn::LoadU(d, x + 2), bx), d2_y = hn::Sub(hn::LoadU(d, y + 2), by);
  const V size1 = squared(d1_x, d1_y), size = squared(ab_x, ab_y), size2 = squared(d2_x, d2_y);
  const V turn1 = cross_of(d1_x, d1_y, ab_x, ab_y), turn2 = cross_of(ab_x, ab_y, d2_x, d2_y);
  const V turn = cross_of(d1_x, d1_y, d2_x, d2_y), area = hn::Mul(turn1, turn2);
  const M is_close = hn::Or(hn::Lt(size1, close2), hn::Lt(size2, close2));
  const M is_inflection = hn::Le(area, zero);
  const M bends_either_way = hn::Or(hn::Gt(hn::Mul(turn1, turn1), hn::Mul(limit2_4, size1)),
                                    hn::Gt(hn::Mul(turn2, turn2), hn::Mul(limit2_4, size2)));
  const M is_flat =
      hn::And(hn::Gt(hn::Mul(turn, turn1), zero),
              hn::Le(hn::Mul(area, area), hn::Mul(hn::Mul(hn::Mul(limit2, turn), turn), size)));
  const M bends =
      hn::Or(hn::And(is_inflection, bends_either_way), hn::Not(hn::Or(is_inflection, is_flat)));
  return {hn::And(hn::Gt(size, limit2), hn::Or(is_close, bends)), is_close};
}

/// Of the circles through the points at x, y and their neighbours.
HWY_INLINE V curvature_of(const double* x, const double* y) {
  const D d;
  const V ax = hn::LoadU(d, x - 1), ay = hn::LoadU(d, y - 1);
  const V bx = hn::LoadU(d, x), by = hn::LoadU(d, y);
  const V cx = hn::LoadU(d, x + 1), cy = hn::LoadU(d, y + 1);
  const V ab_x = hn::Sub(bx, ax), ab_y = hn::Sub(by, ay);
  const V bc_x = hn::Sub(cx, bx), bc_y = hn::Sub(cy, by);
  const V sizes = hn::Mul(hn::Mul(squared(ab_x, ab_y), squared(bc_x, bc_y)),
                          squared(hn::Sub(cx, ax), hn::Sub(cy, ay)));
  const V turn = cross_of(ab_x, ab_y, bc_x, bc_y);
  const V curvature = hn::Div(hn::Add(turn, turn), hn::Sqrt(sizes));
  return hn::IfThenElseZero(hn::Gt(sizes, hn::Zero(d)), curvature);
}

/// Whether the six points around the pieces that begin at x, y lie on arcs that are near their
/// chords. `curvature`: at the points before the pieces, and on. See ContourDetails::suspect().
HWY_INLINE M are_flat_arcs(const double* x, const double* y, const double* curvature,
                           double tolerance) {
  const D d;
  const V k0 = hn::LoadU(d, curvature), k1 = hn::LoadU(d, curvature + 1);
  const V k2 = hn::LoadU(d, curvature + 2), k3 = hn::LoadU(d, curvature + 3);
  const V zero = hn::Zero(d);
  const V ab_x = hn::Sub(hn::LoadU(d, x + 1), hn::LoadU(d, x));
  const V ab_y = hn::Sub(hn::LoadU(d, y + 1), hn::LoadU(d, y));
  const V height = hn::Mul(hn::Mul(hn::Set(d, 0.125 * 0.5), hn::Add(k1, k2)), squared(ab_x, ab_y));
  const M turns_one_way =
      hn::And(hn::Gt(hn::Mul(k1, k2), zero),
              hn::And(hn::Gt(hn::Mul(k0, k1), zero), hn::Gt(hn::Mul(k3, k1), zero)));
  const M is_even = hn::Le(hn::Max(hn::Abs(k1), hn::Abs(k2)),
                           hn::Mul(hn::Set(d, even_curvature), hn::Min(hn::Abs(k0), hn::Abs(k3))));
  // Where the height is 0, the scalar arithmetic has no arc.
  const M is_low =
      hn::And(hn::Le(hn::Abs(height), hn::Set(d, flat_arc * tolerance)), hn::Ne(height, zero));
  return hn::And(hn::And(turns_one_way, is_even), is_low);
}

void find_some_bends(const double* x, const double* y, size_t count, double tolerance, double close,
                     uint64_t* bits) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  constexpr size_t curvatures = 64 + 3;
  double curvature[curvatures + max_simd_doubles];
  const size_t words = (count + 63) / 64;
  for (size_t w = 0; w < words; ++w) {
    // Whole words alone, with the points that vectors read.
    if (w == 0 || w * 64 + curvatures + lanes > count) {
      bits[w] = ~uint64_t{0};
      continue;
    }
    const double *const from_x = x + w * 64, *const from_y = y + w * 64;
    uint64_t word = 0, apart = 0;
    for (size_t i = 0; i < 64; i += lanes) {
      const Bends bends = bends_by_triangles(from_x + i, from_y + i, tolerance, close);
      word |= bits_of(d, bends.may_bend) << i;
      apart |= bits_of(d, hn::AndNot(bends.is_close, bends.may_bend)) << i;
    }
    if (apart) {
      for (size_t i = 0; i < curvatures; i += lanes)
        hn::StoreU(curvature_of(from_x + i - 1, from_y + i - 1), d, curvature + i);
      for (size_t i = 0; i < 64; i += lanes)
        word &= ~(bits_of(d, are_flat_arcs(from_x + i, from_y + i, curvature + i, tolerance)) << i &
                  apart);
    }
    bits[w] = word;
  }
}

void find_some_bends_at_ends(const double* x, const double* y, const RingPoints* rings,
                             size_t ring_count, double tolerance, double close, uint64_t* bits) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  // Pieces 3 points before a ring's end to 2 points behind its start.
  constexpr uint32_t behind = 3, pieces = 5, before = 2, points = before + pieces + behind;
  double at_x[points + 2 * max_simd_doubles] = {}, at_y[points + 2 * max_simd_doubles] = {};
  double curvature[pieces + 3 + 2 * max_simd_doubles] = {};
  const auto put = [&](uint32_t id, bool bends) {
    bits[id / 64] = (bits[id / 64] & ~(uint64_t{1} << (id % 64))) | uint64_t{bends} << (id % 64);
  };
  for (size_t r = 0; r < ring_count; ++r) {
    const uint32_t first = rings[r].first, end = rings[r].end;
    if (end - first < points) {
      for (uint32_t id = first; id < end; ++id) put(id, true);
      continue;
    }
    const auto copy = [&](const double* from, double* to) {
      std::copy(from + end - before - behind, from + end, to);
      std::copy(from + first, from + first + points - before - behind, to + before + behind);
    };
    copy(x, at_x);
    copy(y, at_y);
    for (size_t i = 0; i < pieces + 3; i += lanes)
      hn::StoreU(curvature_of(at_x + 1 + i, at_y + 1 + i), d, curvature + i);
    uint64_t word = 0;
    for (size_t i = 0; i < pieces; i += lanes) {
      const double *const from_x = at_x + before + i, *const from_y = at_y + before + i;
      const Bends bends = bends_by_triangles(from_x, from_y, tolerance, close);
      const M are_flat =
          hn::AndNot(bends.is_close, are_flat_arcs(from_x, from_y, curvature + i, tolerance));
      word |= bits_of(d, hn::AndNot(are_flat, bends.may_bend)) << i;
    }
    for (uint32_t i = 0; i < pieces; ++i)
      put(i < behind ? end - behind + i : first + i - behind, word >> i & 1);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

namespace {

HWY_EXPORT(find_some_bends);
HWY_EXPORT(find_some_bends_at_ends);

}  // namespace

void find_bends(const double* x, const double* y, size_t count, double tolerance, double close,
                uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(find_some_bends)(x, y, count, tolerance, close, bits);
}

void find_bends_at_ends(const double* x, const double* y, std::span<const RingPoints> rings,
                        double tolerance, double close, uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(find_some_bends_at_ends)
  (x, y, rings.data(), rings.size(), tolerance, close, bits);
}

}  // namespace msq
#endif  // HWY_ONCE
