// SPDX-License-Identifier: Apache-2.0
// Spans of capsules of one radius in single precision: the raster's common case. Rows for which
// single precision does not prove the columns go to the careful kernel, which is right for all.
// Included once for each instruction set.
//
// Lengths are scaled so that the capsule's length plus radius is 1; u = 2^-24, and d is the
// raster's margin, by which the axis itself may be displaced. Offsets v, w of a row carry at most 6
// u, their products with the axis (k, m) 12 u, beside d. The discriminants across r^2 - k^2 and r^2
// - rho^2 then err by at most 32 u r + 2 r d + (12 u + d)^2, called e: where one is between -e and
// 64 e the row grazes and is left to the careful kernel; beyond, a root q errs by e / q, so an end
// of a span by (16 u + d + e / q), over `across` for ends on the cylinder. Which of cylinder and
// end spheres makes an end depends on the sign of its distance t along the axis (0 to length):
// where t is within its own error of a switch, the row is left to the careful kernel too.
#if defined(MSQ_STRUT_FAST_SPANS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUT_FAST_SPANS_INL_H
#undef MSQ_STRUT_FAST_SPANS_INL_H
#else
#define MSQ_STRUT_FAST_SPANS_INL_H
#endif

#include <hwy/highway.h>

#include <cstring>

#include "strut/general_spans-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace fast {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
using DI = hn::RebindToSigned<D>;

/// Sets columns [x, x + length) of a row with one unaligned word; length at most 57.
HWY_INLINE void set_short_span(uint64_t* row, int64_t x, int64_t length) {
  unsigned char* at = reinterpret_cast<unsigned char*>(row) + (x >> 3);
  const uint64_t mask = (~uint64_t{0} >> (64 - length)) << (x & 7);
  uint64_t word;
  std::memcpy(&word, at, sizeof word);
  word |= mask;
  std::memcpy(at, &word, sizeof word);
}

/// Capsules that single precision serves: not nearly along x, not points, not needles; and grids
/// whose steps are not so much larger that they overflow.
HWY_INLINE bool serves(const RasterTarget& target, const RasterStrut& strut,
                       const CapsuleAxis& axis) {
  const double unit = axis.length + strut.high;
  return !axis.is_point && axis.across > 0.05 && strut.high > 1e-4 * unit &&
         target.margin < 1e-3 * strut.high && target.dy < 1e6 * unit && target.dz < 1e6 * unit;
}

/// Rows lie `wide` to a vector, with as many layers as fill it.
HWY_INLINE void write_rows(const RasterTarget& target, const RasterStrut& strut,
                           const CapsuleAxis& axis, const RowRange& range, size_t wide) {
  const D d;
  const DI di;
  const size_t lanes = hn::Lanes(d), deep = lanes / wide;
  const double unit = axis.length + strut.high, s = 1 / unit;
  constexpr float u = 0x1p-24f;

  const float r = static_cast<float>(strut.high * s);
  const float inverse_across = static_cast<float>(1 / axis.across);
  const float shift = static_cast<float>(target.margin * s * (1 + 1e-6));
  const float e = 32 * u * r + 2 * r * shift + (12 * u + shift) * (12 * u + shift);
  const V ux = hn::Set(d, static_cast<float>(axis.ux)),
          uy = hn::Set(d, static_cast<float>(axis.uy)),
          uz = hn::Set(d, static_cast<float>(axis.uz));
  const V dx = hn::Set(d, static_cast<float>(axis.dx * s)),
          dy = hn::Set(d, static_cast<float>(axis.dy * s)),
          dz = hn::Set(d, static_cast<float>(axis.dz * s));
  const V length = hn::Set(d, static_cast<float>(axis.length * s));
  const V r2 = hn::Set(d, r * r), body_r2 = hn::Set(d, static_cast<float>(axis.across) * r * r);
  const V ux_over_across = hn::Set(d, static_cast<float>(axis.ux / axis.across));
  const V inverse = hn::Set(d, inverse_across);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), error = hn::Set(d, e);
  const V none = hn::Set(d, -e), grazing = hn::Set(d, 64 * e),
          base_error = hn::Set(d, 16 * u + shift);
  const V abs_ux = hn::Abs(ux);

  // Columns from a whole one near a.
  const double a_column = (strut.a.x - target.x0) * target.inverse_dx;
  const double base = std::floor(a_column);
  const int64_t base_column = static_cast<int64_t>(std::clamp(base, -0x1p53, 0x1p53));
  const double per_unit = unit * target.inverse_dx;
  const V columns = hn::Set(d, static_cast<float>(per_unit));
  const V fraction = hn::Set(d, static_cast<float>(a_column - base));
  const V column_error = hn::Set(d, static_cast<float>(8 * u * (2 * per_unit + 1) + target.slack));
  const double least = std::max(-base, -0x1p30), most = std::min(target.last - base, 0x1p30);
  if (most < least || std::abs(base) > 0x1p52) {
    general::write_rows(target, strut, axis, range);
    return;
  }
  const V first = hn::Set(d, static_cast<float>(std::max(least, -0x1p23)));
  const V last = hn::Set(d, static_cast<float>(std::min(most, 0x1p23)));
  const bool whole = per_unit < 0x1p20;  // columns are whole numbers in single precision

  const auto lane = hn::Iota(di, 0);
  const auto lane_row = hn::And(lane, hn::Set(di, static_cast<int32_t>(wide - 1)));
  HWY_ALIGN int32_t lane_layers[2 * most_simd_doubles];
  size_t lane_words[2 * most_simd_doubles];  // from a vector's first row to a lane's
  for (size_t l = 0; l < lanes; ++l) {
    lane_layers[l] = static_cast<int32_t>(l / wide);
    lane_words[l] = (l / wide * target.rows + l % wide) * target.words;
  }
  const auto lane_layer = hn::Load(di, lane_layers);
  const V v_lane =
      hn::Mul(hn::ConvertTo(d, lane_row), hn::Set(d, static_cast<float>(target.dy * s)));
  const V w_lane =
      hn::Mul(hn::ConvertTo(d, lane_layer), hn::Set(d, static_cast<float>(target.dz * s)));
  HWY_ALIGN int32_t x_first[2 * most_simd_doubles], x_last[2 * most_simd_doubles];

  for (size_t k = range.k0; k < range.k1; k += deep) {
    const V w = hn::Add(hn::Set(d, static_cast<float>((target.z[k] - strut.a.z) * s)), w_lane);
    const auto layer_in =
        hn::Lt(lane_layer, hn::Set(di, static_cast<int32_t>(std::min(range.k1 - k, lanes))));
    for (size_t j = range.j0; j < range.j1; j += wide) {
      const V v = hn::Add(hn::Set(d, static_cast<float>((target.y[j] - strut.a.y) * s)), v_lane);
      const auto row_in =
          hn::Lt(lane_row, hn::Set(di, static_cast<int32_t>(std::min(range.j1 - j, lanes))));
      const V cross = hn::Sub(hn::Mul(v, uz), hn::Mul(w, uy));
      const V along = hn::Add(hn::Mul(v, uy), hn::Mul(w, uz));
      const V under = hn::Sub(body_r2, hn::Mul(cross, cross));
      auto met = hn::And(hn::RebindMask(d, hn::And(layer_in, row_in)), hn::Gt(under, none));
      if (hn::AllFalse(d, met)) continue;

      const V root = hn::Sqrt(hn::Max(under, zero));
      const V mid = hn::Mul(along, ux_over_across), half = hn::Mul(root, inverse);
      V low = hn::Sub(mid, half), high = hn::Add(mid, half);
      const V t_low = hn::Add(hn::Mul(low, ux), along), t_high = hn::Add(hn::Mul(high, ux), along);
      const V body_error = hn::Mul(
          hn::Add(base_error, hn::Mul(error, hn::ApproximateReciprocal(hn::Max(root, error)))),
          inverse);
      // 1.01: the approximate reciprocal is good to half a hundredth.
      V low_error = hn::Mul(body_error, hn::Set(d, 1.01f)), high_error = low_error;
      auto careful = hn::Lt(under, grazing);
      const V t_error = hn::Add(hn::Mul(low_error, abs_ux), base_error);
      careful = hn::Or(careful,
                       hn::Lt(hn::Min(hn::Abs(t_low), hn::Abs(hn::Sub(t_low, length))), t_error));
      careful = hn::Or(careful,
                       hn::Lt(hn::Min(hn::Abs(t_high), hn::Abs(hn::Sub(t_high, length))), t_error));

      const auto low_a = hn::Lt(t_low, zero), low_b = hn::Gt(t_low, length);
      const auto high_a = hn::Lt(t_high, zero), high_b = hn::Gt(t_high, length);
      const auto capped = hn::Or(hn::Or(low_a, low_b), hn::Or(high_a, high_b));
      if (!hn::AllFalse(d, hn::And(capped, met))) {
        const V vb = hn::Sub(v, dy), wb = hn::Sub(w, dz);
        const V under_a = hn::Sub(r2, hn::Add(hn::Mul(v, v), hn::Mul(w, w)));
        const V under_b = hn::Sub(r2, hn::Add(hn::Mul(vb, vb), hn::Mul(wb, wb)));
        const auto cap = [&](decltype(low_a) at_a, decltype(low_a) at_b, bool is_low, V& end,
                             V& end_error) {
          const auto either = hn::Or(at_a, at_b);
          const V below = hn::IfThenElse(at_a, under_a, under_b);
          met = hn::And(met, hn::Or(hn::Not(either), hn::Gt(below, none)));
          careful = hn::Or(careful, hn::And(either, hn::Lt(below, grazing)));
          const V q = hn::Sqrt(hn::Max(below, zero));
          const V centre = hn::IfThenElse(at_a, zero, dx);
          end = hn::IfThenElse(either, is_low ? hn::Sub(centre, q) : hn::Add(centre, q), end);
          const V cap_error = hn::Mul(
              hn::Add(base_error, hn::Mul(error, hn::ApproximateReciprocal(hn::Max(q, error)))),
              hn::Set(d, 1.01f));
          end_error = hn::IfThenElse(either, cap_error, end_error);
        };
        cap(low_a, low_b, true, low, low_error);
        cap(high_a, high_b, false, high, high_error);
      }

      const V c_low = hn::Add(hn::Mul(low, columns), fraction);
      const V c_high = hn::Add(hn::Mul(high, columns), fraction);
      const V e_low = hn::Add(hn::Mul(low_error, columns), column_error);
      const V e_high = hn::Add(hn::Mul(high_error, columns), column_error);
      const V x0 = hn::Ceil(hn::Sub(c_low, e_low)), x1 = hn::Floor(hn::Add(c_high, e_high));
      careful = hn::Or(careful, hn::Ne(x0, hn::Ceil(hn::Add(c_low, e_low))));
      careful = hn::Or(careful, hn::Ne(x1, hn::Floor(hn::Sub(c_high, e_high))));
      if (!whole) careful = hn::Eq(one, one);
      careful = hn::And(careful, met);

      const V clipped0 = hn::Max(x0, first), clipped1 = hn::Min(x1, last);
      const auto sure = hn::And(hn::AndNot(careful, met), hn::Le(clipped0, clipped1));
      hn::Store(hn::ConvertTo(di, clipped0), di, x_first);
      hn::Store(hn::ConvertTo(di, clipped1), di, x_last);
      uint8_t bits[8] = {};
      hn::StoreMaskBits(d, sure, bits);
      uint64_t rest;
      std::memcpy(&rest, bits, sizeof rest);
      uint64_t* const first_row = target.certain + (k * target.rows + j) * target.words;
      for (; rest; rest &= rest - 1) {
        const size_t l = static_cast<size_t>(__builtin_ctzll(rest));
        uint64_t* const row = first_row + lane_words[l];
        const int64_t x = base_column + x_first[l];
        const int64_t count = int64_t{x_last[l]} - x_first[l] + 1;
        if (count <= 57)
          set_short_span(row, x, count);
        else
          set_bits(row, static_cast<uint64_t>(x), static_cast<uint64_t>(x + count - 1));
      }
      if (hn::AllFalse(d, careful)) continue;
      std::memset(bits, 0, sizeof bits);
      hn::StoreMaskBits(d, careful, bits);
      std::memcpy(&rest, bits, sizeof rest);
      for (; rest; rest &= rest - 1) {
        const size_t l = static_cast<size_t>(__builtin_ctzll(rest));
        const size_t jl = j + l % wide, kl = k + l / wide;
        general::write_rows(target, strut, axis, {jl, jl + 1, kl, kl + 1});
      }
    }
  }
}

}  // namespace fast
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
