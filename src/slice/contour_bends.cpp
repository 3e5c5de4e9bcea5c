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

/// Points in a row: of the piece from the third to the fourth, one in a lane.
struct Points {
  V x[6], y[6];
};

struct Bends {
  V size;      // squared, of the pieces
  M is_close;  // a point that tells about the direction is too near
  M bends;     // as far as the points tell
  M turns_one_way, turns_left, has_triangle, may_be_arc;
};

HWY_INLINE Bends bends_of(const Points& p, const BendLimits& limits) {
  const D d;
  const double tolerance2 = limits.tolerance * limits.tolerance;
  const V zero = hn::Zero(d), limit2 = hn::Set(d, tolerance2),
          limit2_4 = hn::Set(d, 4 * tolerance2);
  const V close2 = hn::Set(d, limits.close * limits.close);
  const V corner2 = hn::Set(d, limits.corner * limits.corner);
  const V d0_x = hn::Sub(p.x[1], p.x[0]), d0_y = hn::Sub(p.y[1], p.y[0]);
  const V d1_x = hn::Sub(p.x[2], p.x[1]), d1_y = hn::Sub(p.y[2], p.y[1]);
  const V ab_x = hn::Sub(p.x[3], p.x[2]), ab_y = hn::Sub(p.y[3], p.y[2]);
  const V d2_x = hn::Sub(p.x[4], p.x[3]), d2_y = hn::Sub(p.y[4], p.y[3]);
  const V d3_x = hn::Sub(p.x[5], p.x[4]), d3_y = hn::Sub(p.y[5], p.y[4]);
  const V size0 = squared(d0_x, d0_y), size1 = squared(d1_x, d1_y), size = squared(ab_x, ab_y);
  const V size2 = squared(d2_x, d2_y), size3 = squared(d3_x, d3_y);
  const V turn0 = cross_of(d0_x, d0_y, d1_x, d1_y), turn1 = cross_of(d1_x, d1_y, ab_x, ab_y);
  const V turn2 = cross_of(ab_x, ab_y, d2_x, d2_y), turn3 = cross_of(d2_x, d2_y, d3_x, d3_y);
  const V turn = cross_of(d1_x, d1_y, d2_x, d2_y), area = hn::Mul(turn1, turn2);
  // Where the boundary turns the other way before or behind a piece, by more than the tolerance
  // from the line through two points to the next, it may leave the triangle.
  const auto turns_back = [&](V other, V size_there) {
    return hn::And(hn::Lt(hn::Mul(other, turn1), zero),
                   hn::Gt(hn::Mul(other, other), hn::Mul(limit2, size_there)));
  };
  const M turns_both_ways = hn::Or(turns_back(turn0, size0), turns_back(turn3, size3));
  const M is_by_corner = hn::Or(hn::Gt(hn::Mul(turn0, turn0), hn::Mul(corner2, size0)),
                                hn::Gt(hn::Mul(turn3, turn3), hn::Mul(corner2, size3)));
  // Of an arc, less than a quarter of this.
  const M is_inflection = hn::Le(area, zero);
  const M bends_either_way = hn::Or(hn::Gt(hn::Mul(turn1, turn1), hn::Mul(limit2_4, size1)),
                                    hn::Gt(hn::Mul(turn2, turn2), hn::Mul(limit2_4, size2)));
  // The height of the triangle is area / (turn * the piece's length).
  const M has_triangle = hn::Gt(hn::Mul(turn, turn1), zero);
  const M is_flat =
      hn::And(has_triangle,
              hn::Le(hn::Mul(area, area), hn::Mul(hn::Mul(hn::Mul(limit2, turn), turn), size)));
  Bends b;
  b.size = size;
  b.is_close = hn::Or(hn::Lt(size1, close2), hn::Lt(size2, close2));
  b.bends = hn::Or(is_by_corner,
                   hn::Or(hn::And(is_inflection, bends_either_way),
                          hn::AndNot(is_inflection, hn::Or(turns_both_ways, hn::Not(is_flat)))));
  b.turns_one_way = hn::Not(hn::Or(is_inflection, hn::Or(is_by_corner, turns_both_ways)));
  b.turns_left = hn::Gt(turn1, zero);
  b.has_triangle = hn::AndNot(is_inflection, has_triangle);
  // 16 times the arc's height is less than twice the larger curvature times `size`.
  const V p1_x = hn::Sub(p.x[3], p.x[1]), p1_y = hn::Sub(p.y[3], p.y[1]);
  const V p2_x = hn::Sub(p.x[4], p.x[2]), p2_y = hn::Sub(p.y[4], p.y[2]);
  const V arc2 = hn::Set(d, 15.9 * limits.arc * limits.arc);
  const auto is_high = [&](V t, V size_there, V across) {
    return hn::Gt(hn::Mul(hn::Mul(t, t), size), hn::Mul(hn::Mul(arc2, size_there), across));
  };
  const M is_arc_high = hn::Or(is_high(turn1, size1, squared(p1_x, p1_y)),
                               is_high(turn2, size2, squared(p2_x, p2_y)));
  const M are_alike =
      hn::And(hn::Gt(hn::Mul(turn0, turn1), zero), hn::Gt(hn::Mul(turn3, turn1), zero));
  b.may_be_arc = hn::And(hn::Gt(area, zero), hn::And(are_alike, is_arc_high));
  return b;
}

/// Whether the pieces that begin at x, y, one in a lane, may bend.
HWY_INLINE M may_bend(const double* x, const double* y, const BendLimits& limits) {
  const D d;
  Points p;
  for (ptrdiff_t i = 0; i < 6; ++i) {
    p.x[i] = hn::LoadU(d, x + i - 2);
    p.y[i] = hn::LoadU(d, y + i - 2);
  }
  const Bends b = bends_of(p, limits);
  const V limit2 = hn::Set(d, limits.tolerance * limits.tolerance);
  return hn::And(hn::Gt(b.size, limit2), hn::Or(b.is_close, b.bends));
}

void find_bends_of_pieces(PieceBlock& pieces, size_t count, const BendLimits& limits) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  for (size_t first = 0; first < count; first += 64) {
    PieceBlock::Bits bits = {};
    for (size_t i = 0; i < 64; i += lanes) {
      Points p;
      for (size_t n = 0; n < 6; ++n) {
        p.x[n] = hn::LoadU(d, pieces.x[n] + first + i);
        p.y[n] = hn::LoadU(d, pieces.y[n] + first + i);
      }
      const Bends b = bends_of(p, limits);
      const auto add = [&](uint64_t& word, M mask) { word |= bits_of(d, mask) << i; };
      add(bits.bends, b.bends);
      add(bits.turns_left, hn::And(b.turns_one_way, b.turns_left));
      add(bits.turns_right, hn::AndNot(b.turns_left, b.turns_one_way));
      add(bits.has_triangle, b.has_triangle);
      add(bits.may_be_arc, b.may_be_arc);
    }
    pieces.bits[first / 64] = bits;
  }
}

void find_some_bends(const double* x, const double* y, size_t count, const BendLimits& limits,
                     uint64_t* bits) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  const size_t words = (count + 63) / 64;
  for (size_t w = 0; w < words; ++w) {
    // Whole words alone, with the points that vectors read.
    if (w == 0 || w * 64 + 67 > count) {
      bits[w] = ~uint64_t{0};
      continue;
    }
    const double *const from_x = x + w * 64, *const from_y = y + w * 64;
    uint64_t word = 0;
    for (size_t i = 0; i < 64; i += lanes)
      word |= bits_of(d, may_bend(from_x + i, from_y + i, limits)) << i;
    bits[w] = word;
  }
}

void find_some_bends_at_ends(const double* x, const double* y, const RingPoints* rings,
                             size_t ring_count, const BendLimits& limits, uint64_t* bits) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  // Pieces 3 points before a ring's end to 2 points behind its start.
  constexpr uint32_t behind = 3, pieces = 5, before = 2, points = before + pieces + behind;
  double at_x[points + 2 * max_simd_doubles] = {}, at_y[points + 2 * max_simd_doubles] = {};
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
    uint64_t word = 0;
    for (size_t i = 0; i < pieces; i += lanes)
      word |= bits_of(d, may_bend(at_x + before + i, at_y + before + i, limits)) << i;
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
HWY_EXPORT(find_bends_of_pieces);

}  // namespace

void find_bends(const double* x, const double* y, size_t count, const BendLimits& limits,
                uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(find_some_bends)(x, y, count, limits, bits);
}

void find_bends_at_ends(const double* x, const double* y, std::span<const RingPoints> rings,
                        const BendLimits& limits, uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(find_some_bends_at_ends)
  (x, y, rings.data(), rings.size(), limits, bits);
}

void find_bends(PieceBlock& pieces, size_t count, const BendLimits& limits) {
  HWY_DYNAMIC_DISPATCH(find_bends_of_pieces)(pieces, count, limits);
}

}  // namespace msq
#endif  // HWY_ONCE
