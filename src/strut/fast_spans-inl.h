// SPDX-License-Identifier: Apache-2.0
// Spans of capsules in single precision: the raster's common case. Included once for each
// instruction set.
//
// A row cuts the capsule's cylinder or one of its end spheres at either end: centre -+ sqrt(D) with
// a discriminant D of its own. Where the cylinder is met at the distance t along the axis, 0 <= t
// <= length, it makes the end; at t < 0 the sphere about a does, at t > length that about b. Signed
// squares tell which, without a root. Spans that hold for certain are gathered first and drawn
// later in one tight loop; samples that single precision does not decide become doubtful spans.
//
// Bounds. Lengths are in columns; u = 2^-24, R the radius, U = length + R, A = uy^2 + uz^2, d the
// margin, by which the radius is uncertain. Offsets v, w of a row err by 6 u U at most, so their
// products with the axis, k and m, by 12 u U. Let e = 32 u U R + 2 R d + (14 u U + d)^2.
// - The cylinder's D = R^2 / A - (k / A)^2 errs by e / A^2 at most where the row may meet it (|k|
// <=
//   sqrt(A) R), and so do the spheres', R^2 - v^2 - w^2.
// - The choice compares g |g|, g = m / A, with ux |ux| D; the difference errs by 2.2 e / A^2. A
//   wrong choice has therefore t^2 <= 4.4 e / A^2 (|p - q|^2 <= 2 |p |p| - q |q||). There the
//   cylinder's end is at R^2 + t^2 from the sphere's centre, squared: the wrong choice is an error
//   of t^2 in D. With short struts two choices may be wrong.
// Together D errs by less than E = 12 e / A^2. So where it is below -E for either end, or for the
// cylinder, the row misses the capsule; from 2 E on at both ends it meets it. The root errs by E /
// sqrt(D) where D >= E, by sqrt(2 E) below: by 2 E / max(sqrt(D), sqrt(E)) everywhere. The centre
// (g ux for the cylinder) and the sums err by 32 u (U / A + 1), and column numbers by the target's
// slack.
// Where the radius varies, the outer ends are those of the greatest and the inner ones those of the
// least, each within these bounds.
#if defined(MSQ_STRUT_FAST_SPANS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUT_FAST_SPANS_INL_H
#undef MSQ_STRUT_FAST_SPANS_INL_H
#else
#define MSQ_STRUT_FAST_SPANS_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstring>

#include "base/sample_grid.h"
#include "strut/strut_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Spans waiting to be drawn.
class SpanBuffer {
  using D = hn::ScalableTag<int32_t>;

 public:
  explicit SpanBuffer(uint64_t* words) : words_(words) {}

  /// Bits [bit, bit + length) of the lanes in `mask`.
  HWY_INLINE void add(hn::Vec<D> bit, hn::Vec<D> length, hn::Mask<D> mask) {
    const D d;
    hn::StoreU(hn::Compress(bit, mask), d, reinterpret_cast<int32_t*>(bits_ + count_));
    hn::StoreU(hn::Compress(length, mask), d, reinterpret_cast<int32_t*>(lengths_ + count_));
    count_ += hn::CountTrue(d, mask);
    if (count_ >= capacity) draw();
  }

  HWY_INLINE void draw() {
    unsigned char* const bytes = reinterpret_cast<unsigned char*>(words_);
    for (size_t i = 0; i < count_; ++i) {
      const uint32_t bit = bits_[i], length = lengths_[i];
      if (length > 57) {
        set_bits(words_, bit, bit + length - 1);
        continue;
      }
      const uint64_t mask = (~uint64_t{0} >> (64 - length)) << (bit & 7);
      uint64_t word;
      std::memcpy(&word, bytes + (bit >> 3), sizeof word);
      word |= mask;
      std::memcpy(bytes + (bit >> 3), &word, sizeof word);
    }
    count_ = 0;
  }

 private:
  static constexpr size_t capacity = 1024;

  uint64_t* const words_;
  size_t count_ = 0;
  uint32_t bits_[capacity + 2 * most_simd_doubles], lengths_[capacity + 2 * most_simd_doubles];
};

/// How the lanes of a vector lie on rows and layers: `wide` rows of each of several layers.
struct LaneShape {
  size_t wide, deep;
  HWY_ALIGN float row[2 * most_simd_doubles], layer[2 * most_simd_doubles];
  HWY_ALIGN int32_t bit[2 * most_simd_doubles];  // from that of lane 0
};

class FastSpans {
  using D = hn::ScalableTag<float>;
  using V = hn::Vec<D>;
  using DI = hn::RebindToSigned<D>;
  using VI = hn::Vec<DI>;
  using M = hn::Mask<D>;

 public:
  explicit FastSpans(const RasterTarget& target)
      : target_(target),
        buffer_(target.certain),
        row_step_(static_cast<float>(target.dy * target.inverse_dx)),
        layer_step_(static_cast<float>(target.dz * target.inverse_dx)) {
    const size_t lanes = hn::Lanes(D());
    for (size_t wide = lanes; shapes_ == 0 || (wide >= 2 && shapes_ < most_shapes); wide /= 2) {
      LaneShape& shape = shape_[shapes_++];
      shape.wide = wide;
      shape.deep = lanes / wide;
      for (size_t l = 0; l < lanes; ++l) {
        const size_t row = l % wide, layer = l / wide;
        shape.row[l] = static_cast<float>(row);
        shape.layer[l] = static_cast<float>(layer);
        shape.bit[l] = static_cast<int32_t>((layer * target.layer_words + row * target.row_words) *
                                            bits_per_word);
      }
      if (!(target.dz > 0)) break;  // layers one by one
    }
  }

  /// Adds the spans of strut `index` of a batch.
  template <bool varying>
  HWY_INLINE void add(const StrutBatch& batch, const StrutSetups& setups, size_t index,
                      DoubtfulSpans& doubts);
  void draw() { buffer_.draw(); }

 private:
  static constexpr size_t most_shapes = 4;

  /// That which needs the fewest vectors.
  const LaneShape& shape_for(size_t rows, size_t layers) const {
    size_t best = 0, least = SIZE_MAX;
    for (size_t s = 0; s < shapes_; ++s) {
      const size_t wide = shape_[s].wide, deep = shape_[s].deep;
      const size_t vectors = ((rows + wide - 1) >> std::countr_zero(wide)) *
                             ((layers + deep - 1) >> std::countr_zero(deep));
      if (vectors < least) {
        least = vectors;
        best = s;
      }
    }
    return shape_[best];
  }

  const RasterTarget& target_;
  SpanBuffer buffer_;
  const float row_step_, layer_step_;
  size_t shapes_ = 0;
  LaneShape shape_[most_shapes];
};

template <bool varying>
HWY_INLINE void FastSpans::add(const StrutBatch& batch, const StrutSetups& setups, size_t index,
                               DoubtfulSpans& doubts) {
  const D d;
  const DI di;
  const auto set = [&](const float* values) { return hn::Set(d, values[index]); };
  const V uy = set(setups.uy), uz = set(setups.uz), ux = set(setups.ux);
  const V inverse = set(setups.inverse_across), length = set(setups.length);
  const V dy = set(setups.dy), dz = set(setups.dz);
  const V a_column = set(setups.a_column), b_column = set(setups.b_column);
  const V first = set(setups.first), last = set(setups.last);
  const V error = set(setups.error), base_error = set(setups.end_error);
  const V root_error = hn::Sqrt(error), none = hn::Neg(error);
  // 1.01: the approximate reciprocal is good to half a hundredth.
  const V twice_error = hn::Mul(error, hn::Set(d, 2.02f));
  const V high2 = set(setups.high2), low2 = set(setups.low2);
  const V zero = hn::Zero(d);
  const V signed_ux2 = hn::Mul(ux, hn::Abs(ux));

  const size_t rows = static_cast<size_t>(setups.j1[index] - setups.j0[index]);
  const size_t layers = static_cast<size_t>(setups.k1[index] - setups.k0[index]);
  const size_t j0 = static_cast<size_t>(setups.j0[index]);
  const size_t k0 = static_cast<size_t>(setups.k0[index]);
  const LaneShape& shape = shape_for(rows, layers);
  const V lane_row = hn::Load(d, shape.row), lane_layer = hn::Load(d, shape.layer);
  const VI lane_bit = hn::Load(di, shape.bit);
  const V v0 = set(setups.v), w0 = set(setups.w);
  const V row_step = hn::Set(d, row_step_), layer_step = hn::Set(d, layer_step_);
  const V row_count = hn::Set(d, static_cast<float>(rows));
  const V layer_count = hn::Set(d, static_cast<float>(layers));

  for (size_t k = 0; k < layers; k += shape.deep) {
    const V layer = hn::Add(lane_layer, hn::Set(d, static_cast<float>(k)));
    V w = hn::MulAdd(layer, layer_step, w0);
    if (!(target_.dz > 0)) {
      const double from_a = target_.z[k0 + k] - batch.a[2][index];
      w = hn::Set(d, static_cast<float>(from_a * target_.inverse_dx));
    }
    const V wb = hn::Sub(w, dz);
    const M layer_in = hn::Lt(layer, layer_count);
    for (size_t j = 0; j < rows; j += shape.wide) {
      const V row = hn::Add(lane_row, hn::Set(d, static_cast<float>(j)));
      const V v = hn::MulAdd(row, row_step, v0), vb = hn::Sub(v, dy);
      const M in = hn::And(layer_in, hn::Lt(row, row_count));

      const V cross = hn::Mul(hn::MulSub(v, uz, hn::Mul(w, uy)), inverse);
      const V cross2 = hn::Mul(cross, cross);
      const V g = hn::Mul(hn::MulAdd(v, uy, hn::Mul(w, uz)), inverse), h = hn::Sub(g, length);
      const V g2 = hn::Mul(g, hn::Abs(g)), h2 = hn::Mul(h, hn::Abs(h));
      const V body_centre = hn::MulAdd(g, ux, a_column);
      const V rho2_a = hn::MulAdd(v, v, hn::Mul(w, w)),
              rho2_b = hn::MulAdd(vb, vb, hn::Mul(wb, wb));

      // Ends for a squared radius, with their errors; returns the least of the discriminants.
      const auto ends = [&](V r2, V& low, V& high, V& low_error, V& high_error) HWY_ATTR {
        const V body = hn::MulSub(r2, inverse, cross2);
        const V at_a = hn::Sub(r2, rho2_a), at_b = hn::Sub(r2, rho2_b);
        const V moved = hn::Mul(signed_ux2, body), back = hn::Neg(moved);
        const M low_a = hn::Lt(g2, moved), low_b = hn::Gt(h2, moved);
        const M high_a = hn::Lt(g2, back), high_b = hn::Gt(h2, back);
        const V low_d = hn::IfThenElse(low_b, at_b, hn::IfThenElse(low_a, at_a, body));
        const V high_d = hn::IfThenElse(high_b, at_b, hn::IfThenElse(high_a, at_a, body));
        const V low_centre =
            hn::IfThenElse(low_b, b_column, hn::IfThenElse(low_a, a_column, body_centre));
        const V high_centre =
            hn::IfThenElse(high_b, b_column, hn::IfThenElse(high_a, a_column, body_centre));
        const V low_root = hn::Sqrt(hn::Max(low_d, zero));
        const V high_root = hn::Sqrt(hn::Max(high_d, zero));
        low = hn::Sub(low_centre, low_root);
        high = hn::Add(high_centre, high_root);
        low_error = hn::MulAdd(
            twice_error, hn::ApproximateReciprocal(hn::Max(low_root, root_error)), base_error);
        high_error = hn::MulAdd(
            twice_error, hn::ApproximateReciprocal(hn::Max(high_root, root_error)), base_error);
        return hn::Min(body, hn::Min(low_d, high_d));
      };

      V low, high, low_error, high_error;
      V least = ends(high2, low, high, low_error, high_error);
      const M met = hn::And(in, hn::Gt(least, none));
      if (hn::AllFalse(d, met)) continue;
      // Columns [x0, x1] may be inside, those of [i0, i1] are.
      const V x0 = hn::Max(hn::Ceil(hn::Sub(low, low_error)), first);
      const V x1 = hn::Min(hn::Floor(hn::Add(high, high_error)), last);
      if constexpr (varying) least = ends(low2, low, high, low_error, high_error);
      const V i0 = hn::Max(hn::Ceil(hn::Add(low, low_error)), first);
      const V i1 = hn::Min(hn::Floor(hn::Sub(high, high_error)), last);
      const M some = hn::And(met, hn::Le(x0, x1));
      const M sure = hn::And(hn::And(some, hn::Gt(least, twice_error)), hn::Le(i0, i1));

      const size_t at = (k0 + k) * target_.layer_words + (j0 + j) * target_.row_words;
      const int32_t bit = static_cast<int32_t>(at * bits_per_word) + setups.column[index];
      const VI start = hn::ConvertTo(di, i0);
      const VI count = hn::ConvertTo(di, hn::Add(hn::Sub(i1, i0), hn::Set(d, 1.0f)));
      buffer_.add(hn::Add(hn::Add(start, lane_bit), hn::Set(di, bit)), count,
                  hn::RebindMask(di, sure));

      const M decided = hn::And(sure, hn::And(hn::Eq(x0, i0), hn::Eq(x1, i1)));
      const M doubtful = hn::AndNot(decided, some);
      if (hn::AllFalse(d, doubtful)) continue;
      HWY_ALIGN float ends_of[4][2 * most_simd_doubles];
      hn::Store(x0, d, ends_of[0]);
      hn::Store(hn::IfThenElse(sure, i0, hn::Add(x1, hn::Set(d, 1.0f))), d, ends_of[1]);
      hn::Store(hn::IfThenElse(sure, i1, x1), d, ends_of[2]);
      hn::Store(x1, d, ends_of[3]);
      uint8_t bits[8] = {};
      hn::StoreMaskBits(d, doubtful, bits);
      uint64_t rest;
      std::memcpy(&rest, bits, sizeof rest);
      for (; rest; rest &= rest - 1) {
        const size_t l = static_cast<size_t>(std::countr_zero(rest));
        const auto add = [&](float from, float to) {
          if (from >= to) return;
          doubts.push_back(
              {static_cast<uint32_t>(index), static_cast<uint32_t>(j0 + j + l % shape.wide),
               static_cast<uint32_t>(k0 + k + l / shape.wide),
               static_cast<uint32_t>(setups.column[index] + static_cast<int32_t>(from)),
               static_cast<uint32_t>(to - from)});
        };
        add(ends_of[0][l], ends_of[1][l]);
        add(ends_of[2][l] + 1, ends_of[3][l] + 1);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
