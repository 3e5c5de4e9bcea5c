// SPDX-License-Identifier: Apache-2.0
// Spans of capsules in single precision: the raster's common case. Included once for each
// instruction set.
//
// Each end of a row's span lies on the capsule's cylinder or on one of its end spheres: centre -+
// sqrt(D), each with its own discriminant D. Let t be the position along the axis where the row
// meets the cylinder. If 0 <= t <= length the cylinder gives the end; if t < 0 the sphere about a,
// if t > length the sphere about b. Signed squares decide that without a root. Certain spans are
// gathered first and drawn later in one tight loop. Samples that single precision does not decide
// become doubtful spans.
//
// Bounds. Lengths are in columns; u = 2^-24, R the radius, U = length + R, A = uy^2 + uz^2, d the
// margin, which is the uncertainty of the radius. The error of offsets v, w of a row is at most 6 u
// U, so that of their products with the axis, k and m, at most 12 u U.
// - The cylinder's D = R^2 / A - (k / A)^2 has an error of at most
//   F = (32 u U R + (14 u U + d)^2) / A^2 + 2 R d / A
//   where the row may meet it (|k| <= sqrt(A) R), and so do the spheres', R^2 - v^2 - w^2.
// - The choice compares g |g|, g = m / A, with ux |ux| D. Where they are nearly the same, |g| <=
//   |ux| R / sqrt(A), so the error of their difference is at most C = F (0.95 |ux| + 1.05 ux^2). A
//   wrong choice thus has t^2 <= 2 C (|p - q|^2 <= 2 |p |p| - q |q||). There the cylinder's end is
//   at R^2 + t^2 from the sphere's centre, squared: the wrong choice is an error of t^2 in D. Of
//   two choices both can be wrong only if length <= 2 |t|, where length^2 <= 16 F.
// Together the error of D is at most E = F + 2 C, or F + 4 C. So if D is below -E for either end,
// or for the cylinder, the row misses the capsule; if D >= E at both ends, the row meets it. The
// error of the root q is E / q where D >= E and sqrt(2 E) below: at most E / (max(q, sqrt(E)) - 0.3
// sqrt(E)) everywhere. The error of the centre (g ux for the cylinder) and of the sums is at most
// 32 u (U / A + 1), and that of column numbers at most the target's slack. If the radius varies
// between bounds, the outer ends are those of the maximum and the inner ends those of the minimum,
// each within these bounds. If the radius is nearly linear, each row also has bounds of its own. A
// row's span reaches at most R / sqrt(A) from the cylinder's centre, or from the nearest of the
// columns between a and b if the centre is beyond them. So the linear function differs from its
// value there by at most |gx| R / sqrt(A), and the radius from that by its departure, which is up
// to sx R / sqrt(A) more than there, s its spread. As slopes and spreads are at most 1/2, the error
// of computing the function is at most 8 u U, and so is that of the departure. They add to D as
// much as the error that it has anyway. The radii of the two shells are bounded by the maximum,
// too, since the departure only holds within its reach.
#if defined(MSQ_STRUT_FAST_SPANS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUT_FAST_SPANS_INL_H
#undef MSQ_STRUT_FAST_SPANS_INL_H
#else
#define MSQ_STRUT_FAST_SPANS_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "base/mask_bits-inl.h"
#include "strut/span_buffer-inl.h"
#include "strut/strut_setup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The layout of a vector's lanes on rows and layers: `wide` rows of each of several layers.
struct LaneShape {
  size_t wide, deep;
  HWY_ALIGN float row[2 * max_simd_doubles], layer[2 * max_simd_doubles];
  HWY_ALIGN int32_t bit[2 * max_simd_doubles];  // relative to lane 0
};

template <class D>
void make_shapes(D d, const RasterTarget& target, LaneShape* out) {
  const size_t lanes = hn::Lanes(d);
  for (size_t s = 0; s < shapes(d, target); ++s) {
    LaneShape& shape = out[s];
    shape.wide = lanes >> s;
    shape.deep = size_t{1} << s;
    for (size_t l = 0; l < lanes; ++l) {
      const size_t row = l % shape.wide, layer = l / shape.wide;
      shape.row[l] = static_cast<float>(row);
      shape.layer[l] = static_cast<float>(layer);
      shape.bit[l] = static_cast<int32_t>((layer * target.layer_words + row * target.row_words) *
                                          bits_per_word);
    }
  }
}

/// What is undecided of the doubtful lanes: columns [x0, x1], without [i0, i1] where they are sure.
/// `at`: the solid, the row and layer of lane 0, and the column that others count from.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void add_doubts(D d, const LaneShape& shape, const DoubtfulSpan& at,
                           hn::Mask<D> doubtful, hn::Mask<D> sure, V x0, V i0, V i1, V x1,
                           DoubtfulSpans& doubts) {
  const V one = hn::Set(d, 1.0f);
  HWY_ALIGN float columns[4][2 * max_simd_doubles];
  hn::Store(x0, d, columns[0]);
  hn::Store(hn::IfThenElse(sure, i0, hn::Add(x1, one)), d, columns[1]);
  hn::Store(hn::Add(hn::IfThenElse(sure, i1, x1), one), d, columns[2]);
  hn::Store(hn::Add(x1, one), d, columns[3]);
  DoubtfulSpan* next = doubts.room(2 * hn::Lanes(d));
  for (uint64_t rest = bits_of(d, doubtful); rest; rest &= rest - 1) {
    const size_t l = static_cast<size_t>(std::countr_zero(rest));
    const uint32_t j = at.j + static_cast<uint32_t>(l % shape.wide),
                   k = at.k + static_cast<uint32_t>(l / shape.wide);
    const auto add = [&](float from, float to) {
      *next = {at.strut, j, k, at.first + static_cast<uint32_t>(static_cast<int32_t>(from)),
               static_cast<uint32_t>(static_cast<int32_t>(to - from))};
      next += from < to;
    };
    add(columns[0][l], columns[1][l]);
    add(columns[2][l], columns[3][l]);
  }
  doubts.count(next);
}

/// The radii of one strut: constant, between a minimum and a maximum, or nearly linear in the
/// position and between the two.
enum class Radii { constant, bounded, linear };

template <Radii radii>
class FastSpans {
 public:
  FastSpans(const RasterTarget& target, const StrutBatch& batch, const StrutSetups& setups,
            DoubtfulSpans& doubts)
      : target_(target),
        batch_(batch),
        setups_(setups),
        doubts_(doubts),
        buffer_(target.certain),
        row_step_(static_cast<float>(target.dy * target.inverse_dx)),
        layer_step_(static_cast<float>(target.dz * target.inverse_dx)) {
    make_shapes(FullLanes(), target, shapes_);
  }

  /// Adds a strut of the batch, of kernel `fast`.
  HWY_INLINE void add(size_t strut) {
    add_vectors(FullLanes(), shapes_[setups_.shape[strut]], strut, 0,
                static_cast<size_t>(setups_.vectors[strut]));
  }
  /// Adds one of kernel `few`: gathered, for a loop without a branch on the number of vectors.
  HWY_INLINE void add_few(size_t strut) {
    for (uint32_t v = 0; v < StrutSetups::max_few; ++v)
      waiting_[waiting_count_ + v] = {static_cast<uint32_t>(strut), v};
    waiting_count_ += static_cast<size_t>(setups_.vectors[strut]);
  }

  /// Draws all added struts.
  HWY_INLINE void draw() {
    for (size_t i = 0; i < waiting_count_; ++i) {
      const RowVector& w = waiting_[i];
      add_vectors(FullLanes(), shapes_[setups_.shape[w.strut]], w.strut, w.vector, w.vector + 1);
    }
    waiting_count_ = 0;
    buffer_.draw();
  }

 private:
  /// One of the vectors that hold a strut's rows.
  struct RowVector {
    uint32_t strut, vector;
  };

  template <class D>
  HWY_INLINE void add_vectors(D d, const LaneShape& shape, size_t strut, size_t begin, size_t end);

  const RasterTarget& target_;
  const StrutBatch& batch_;
  const StrutSetups& setups_;
  DoubtfulSpans& doubts_;
  SpanBuffer buffer_;
  const float row_step_, layer_step_;
  LaneShape shapes_[max_shapes];
  size_t waiting_count_ = 0;
  RowVector waiting_[StrutSetups::max_few * (StrutBatch::capacity + 1)];
};

/// Vectors `begin` to `end` of the strut's.
template <Radii radii>
template <class D>
HWY_INLINE void FastSpans<radii>::add_vectors(D d, const LaneShape& shape, size_t strut,
                                              size_t begin, size_t end) {
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  const hn::RebindToSigned<D> di;
  using VI = hn::Vec<decltype(di)>;
  const auto set = [&](const float* values) HWY_ATTR { return hn::Set(d, values[strut]); };
  const V uy = set(setups_.uy), uz = set(setups_.uz), ux = set(setups_.ux);
  const V inverse = set(setups_.inverse_across), length = set(setups_.length);
  const V dy = set(setups_.dy), dz = set(setups_.dz);
  const V a_column = set(setups_.a_column), b_column = set(setups_.b_column);
  const bool clipped = setups_.clipped[strut];
  const V error = set(setups_.error), root_error = set(setups_.root_error);
  const V base_error = set(setups_.end_error);
  const V root_less = hn::Mul(root_error, hn::Set(d, 0.3f));
  const V none = hn::Neg(error), zero = hn::Zero(d);
  const V signed_ux2 = set(setups_.signed_ux2);
  const V v0 = set(setups_.v), w0 = set(setups_.w);
  const V row_step = hn::Set(d, row_step_), layer_step = hn::Set(d, layer_step_);

  const size_t j0 = static_cast<size_t>(setups_.j0[strut]);
  const size_t k0 = static_cast<size_t>(setups_.k0[strut]);
  const V rows = hn::Set(d, static_cast<float>(setups_.j1[strut] - setups_.j0[strut]));
  const V layers = hn::Set(d, static_cast<float>(setups_.k1[strut] - setups_.k0[strut]));
  const V lane_row = hn::Load(d, shape.row), lane_layer = hn::Load(d, shape.layer);
  const VI lane_bit = hn::Load(di, shape.bit);
  const size_t across = shape.wide * static_cast<size_t>(setups_.row_vectors[strut]);
  size_t j = begin * shape.wide, k = 0;
  for (; j >= across; j -= across) k += shape.deep;

  for (size_t vector = begin; vector < end; ++vector, j += shape.wide) {
    if (j == across) {
      j = 0;
      k += shape.deep;
    }
    const V row = hn::Add(lane_row, hn::Set(d, static_cast<float>(j)));
    const V layer = hn::Add(lane_layer, hn::Set(d, static_cast<float>(k)));
    const M in = hn::And(hn::Lt(row, rows), hn::Lt(layer, layers));
    const V v = hn::MulAdd(row, row_step, v0), vb = hn::Sub(v, dy);
    V w = hn::MulAdd(layer, layer_step, w0);
    if (!(target_.dz > 0)) {
      const double from_a = target_.z[k0 + k] - batch_.a[2][strut];
      w = hn::Set(d, static_cast<float>(from_a * target_.inverse_dx));
    }
    const V wb = hn::Sub(w, dz);

    const V cross = hn::Mul(hn::MulSub(v, uz, hn::Mul(w, uy)), inverse);
    const V cross2 = hn::Mul(cross, cross);
    const V g = hn::Mul(hn::MulAdd(v, uy, hn::Mul(w, uz)), inverse), h = hn::Sub(g, length);
    const V g2 = hn::Mul(g, hn::Abs(g)), h2 = hn::Mul(h, hn::Abs(h));
    const V body_centre = hn::MulAdd(g, ux, a_column);
    const V rho2_a = hn::MulAdd(v, v, hn::Mul(w, w)), rho2_b = hn::MulAdd(vb, vb, hn::Mul(wb, wb));

    // Ends for a squared radius, with their errors; returns the minimum of the discriminants.
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
      const auto error_of = [&](V root) HWY_ATTR {
        const V q = hn::Sub(hn::Max(root, root_error), root_less);
        return hn::MulAdd(error, hn::ApproximateReciprocal(q), base_error);
      };
      low = hn::Sub(low_centre, low_root);
      high = hn::Add(high_centre, high_root);
      low_error = error_of(low_root);
      high_error = error_of(high_root);
      return hn::Min(body, hn::Min(low_d, high_d));
    };

    V high2 = set(setups_.high2), low2 = set(setups_.low2);
    if constexpr (radii == Radii::linear) {
      const V middle =
          hn::Min(hn::Max(body_centre, hn::Min(a_column, b_column)), hn::Max(a_column, b_column));
      V r = hn::MulAdd(hn::Sub(middle, a_column), set(setups_.gradient[0]), set(setups_.radius_a));
      r = hn::MulAdd(v, set(setups_.gradient[1]), r);
      r = hn::MulAdd(w, set(setups_.gradient[2]), r);
      const auto add_spread = [&](size_t axis, V from, V to, V sum) HWY_ATTR {
        return hn::MulAdd(hn::AbsDiff(from, to), set(setups_.spread[axis]), sum);
      };
      const V half = hn::Set(d, 0.5f);
      V spread =
          add_spread(0, middle, hn::Mul(hn::Add(a_column, b_column), half), set(setups_.departure));
      spread = add_spread(1, v, hn::Mul(dy, half), spread);
      spread = add_spread(2, w, hn::Mul(dz, half), spread);
      const V most = hn::Add(r, spread), least = hn::Max(hn::Sub(r, spread), zero);
      low2 = hn::Min(hn::Max(low2, hn::Mul(least, least)), high2);
      high2 = hn::Min(high2, hn::Mul(most, most));
    }
    V low, high, low_error, high_error;
    V least = ends(high2, low, high, low_error, high_error);
    const M met = hn::And(in, hn::Gt(least, none));
    if (hn::AllFalse(d, met)) continue;
    // Columns [x0, x1] may be inside; columns [i0, i1] are certainly inside.
    V x0 = hn::Ceil(hn::Sub(low, low_error)), x1 = hn::Floor(hn::Add(high, high_error));
    if constexpr (radii != Radii::constant) least = ends(low2, low, high, low_error, high_error);
    V i0 = hn::Ceil(hn::Add(low, low_error)), i1 = hn::Floor(hn::Sub(high, high_error));
    if (clipped) {
      const V first = set(setups_.first), last = set(setups_.last);
      x0 = hn::Max(x0, first);
      i0 = hn::Max(i0, first);
      x1 = hn::Min(x1, last);
      i1 = hn::Min(i1, last);
    }
    const M some = hn::And(met, hn::Le(x0, x1));
    const M sure = hn::And(hn::And(some, hn::Gt(least, error)), hn::Le(i0, i1));

    // The last bits of a whole number below 2^22 plus 1.5 * 2^23 are that number.
    const V whole = hn::Set(d, 0x1.8p23f);
    const VI from = hn::BitCast(di, hn::Add(i0, whole)), to = hn::BitCast(di, hn::Add(i1, whole));
    const size_t at = (k0 + k) * target_.layer_words + (j0 + j) * target_.row_words;
    const uint32_t bit = static_cast<uint32_t>(at * bits_per_word) +
                         static_cast<uint32_t>(setups_.column[strut]) - 0x4b400000u;
    buffer_.add(di, hn::Add(hn::Add(from, lane_bit), hn::Set(di, static_cast<int32_t>(bit))),
                hn::Sub(to, from), hn::RebindMask(di, sure));

    const M decided = hn::And(sure, hn::And(hn::Eq(x0, i0), hn::Eq(x1, i1)));
    const M doubtful = hn::AndNot(decided, some);
    if (!hn::AllFalse(d, doubtful))
      add_doubts(d, shape,
                 {static_cast<uint32_t>(strut), static_cast<uint32_t>(j0 + j),
                  static_cast<uint32_t>(k0 + k), static_cast<uint32_t>(setups_.column[strut]), 0},
                 doubtful, sure, x0, i0, i1, x1, doubts_);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
