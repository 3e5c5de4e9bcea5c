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
// For a row at (v, w) from a, in y and z: A = uy^2 + uz^2, k = v uz - w uy, and g = (v uy + w uz) /
// A, where the row is nearest to the axis. g and k / A are linear in the row's place in the order
// (row_order-inl.h). Since v^2 + w^2 = A (g^2 + (k / A)^2), nothing else of the row is needed.
//
// Bounds. Lengths are in columns; u = 2^-24, R the radius, U = length + R, d the margin, which is
// the uncertainty of the radius. Rows have |v|, |w| <= U. So g and k / A err by at most 12 u U / A:
// their terms by 4.3 u U / A, the sums by 4.9.
// - The cylinder's D = R^2 / A - (k / A)^2 has an error of at most
//   F = (44 u U R + (17 u U + d)^2) / A^2 + 2 R d / A
//   where the row may meet it (|k| <= sqrt(A) R). So do the spheres', A (R^2 / A - (k / A)^2 -
//   g^2): there |k| + A |g| <= sqrt(2 A) R, which makes 34 u U R of the first term, and
//   roundings 8.
// - The choice compares g |g|, g = m / A, with ux |ux| D. Where they are nearly the same, |g| <=
//   |ux| R / sqrt(A), so the error of their difference is at most C = F (0.95 |ux| + 1.05 ux^2). A
//   wrong choice thus has t^2 <= 2 C (|p - q|^2 <= 2 |p |p| - q |q||). There the cylinder's end is
//   at R^2 + t^2 from the sphere's centre, squared: the wrong choice is an error of t^2 in D. Of
//   two choices both can be wrong only if length <= 2 |t|, where length^2 <= 16 F.
// Together the error of D is at most E = F + 2 C, or F + 4 C. So if D is below -E for either end,
// or for the cylinder, the row misses the capsule; if D >= E at both ends, the row meets it. The
// error of the root q is E / q where D >= E and sqrt(2 E) below: at most E / (max(q, sqrt(E)) - 0.3
// sqrt(E)) everywhere. Both ends get the error of the smaller root. The error of the centre (g ux
// for the cylinder) and of the sums is at most 33 u (U / A + 1), and that of column numbers at most
// the target's slack. If the radius varies between bounds, the outer ends are those of the maximum
// and the inner ends those of the minimum, each within these bounds. If the radius is nearly
// linear, each row also has bounds of its own. A row's span reaches at most R / sqrt(A) from the
// cylinder's centre, or from the nearest of the columns between a and b if the centre is beyond
// them. So the linear function differs from its value there by at most |gx| R / sqrt(A), and the
// radius from that by its departure, which is up to sx R / sqrt(A) more than there, s its spread.
// As slopes and spreads are at most 1/2, the error of computing the function is at most 8 u U, and
// so is that of the departure. They add to D as much as the error that it has anyway. The radii of
// the two shells are bounded by the maximum, too, since the departure only holds within its reach.
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

/// What is undecided of the doubtful lanes: columns [x0, x1], without [i0, i1] where they are sure.
/// `row`, `layer`: of each lane. `at`: the solid, the row and layer that these count from, and the
/// column that others count from.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void add_doubts(D d, V row, V layer, const DoubtfulSpan& at, hn::Mask<D> doubtful,
                           hn::Mask<D> sure, V x0, V i0, V i1, V x1, DoubtfulSpans& doubts) {
  const V one = hn::Set(d, 1.0f);
  HWY_ALIGN float rows[2 * max_simd_doubles], layers[2 * max_simd_doubles];
  hn::Store(row, d, rows);
  hn::Store(layer, d, layers);
  HWY_ALIGN float columns[4][2 * max_simd_doubles];
  hn::Store(x0, d, columns[0]);
  hn::Store(hn::IfThenElse(sure, i0, hn::Add(x1, one)), d, columns[1]);
  hn::Store(hn::Add(hn::IfThenElse(sure, i1, x1), one), d, columns[2]);
  hn::Store(hn::Add(x1, one), d, columns[3]);
  DoubtfulSpan* next = doubts.room(2 * hn::Lanes(d));
  for (uint64_t rest = bits_of(d, doubtful); rest; rest &= rest - 1) {
    const size_t l = static_cast<size_t>(std::countr_zero(rest));
    const uint32_t j = at.j + static_cast<uint32_t>(static_cast<int32_t>(rows[l])),
                   k = at.k + static_cast<uint32_t>(static_cast<int32_t>(layers[l]));
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

/// What bits count from if rows and layers count from j and k, and columns, plus 1.5 * 2^23, as
/// bits of a number, from `column`.
HWY_INLINE int32_t first_bit_of(const RasterTarget& target, size_t j, size_t k, int32_t column) {
  const auto word = static_cast<size_t>(target.row(j, k) - target.certain);
  return static_cast<int32_t>(static_cast<uint32_t>(word * bits_per_word) +
                              static_cast<uint32_t>(column) - 0x4b400000u);
}

/// The radii of one strut: constant, between a minimum and a maximum, or nearly linear in the
/// position and between the two.
enum class Radii { constant, bounded, linear };

template <Radii radii>
class FastSpans {
 public:
  FastSpans(const RasterTarget& target, const StrutBatch& batch, const StrutSetups& setups,
            DoubtfulSpans& doubts)
      : target_(target), batch_(batch), setups_(setups), doubts_(doubts), buffer_(target.certain) {}

  /// Adds a strut of the batch, of kernel `fast`.
  HWY_INLINE void add(size_t strut) {
    add_vectors(strut, 0, static_cast<size_t>(setups_.order.vectors[strut]));
  }
  /// Adds one of kernel `few`: gathered, for a loop without a branch on the number of vectors.
  HWY_INLINE void add_few(size_t strut) {
    for (uint32_t v = 0; v < StrutSetups::max_few; ++v)
      waiting_[waiting_count_ + v] = {static_cast<uint32_t>(strut), v};
    waiting_count_ += static_cast<size_t>(setups_.order.vectors[strut]);
  }

  /// Draws all added struts.
  HWY_INLINE void draw() {
    for (size_t i = 0; i < waiting_count_; ++i) {
      const RowVector& w = waiting_[i];
      add_vectors(w.strut, w.vector, w.vector + 1);
    }
    waiting_count_ = 0;
    buffer_.draw();
  }

 private:
  /// One of the vectors that hold a strut's rows.
  struct RowVector {
    uint32_t strut, vector;
  };

  HWY_INLINE void add_vectors(size_t strut, size_t begin, size_t end);

  const RasterTarget& target_;
  const StrutBatch& batch_;
  const StrutSetups& setups_;
  DoubtfulSpans& doubts_;
  SpanBuffer buffer_;
  size_t waiting_count_ = 0;
  RowVector waiting_[StrutSetups::max_few * (StrutBatch::capacity + 1)];
};

/// Vectors `begin` to `end` of the strut's.
template <Radii radii>
HWY_INLINE void FastSpans<radii>::add_vectors(size_t strut, size_t begin, size_t end) {
  using D = FullLanes;
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;
  const D d;
  const hn::RebindToSigned<D> di;
  const auto set = [&](const float* values) HWY_ATTR { return hn::Set(d, values[strut]); };
  const auto line_of = [&](const StrutSetups::Steps& steps, V line) HWY_ATTR {
    return hn::MulAdd(line, set(steps.outer), set(steps.first));
  };
  const RowVectors rows(setups_.order, strut);
  const V ux = set(setups_.ux), length = set(setups_.length), signed_ux2 = set(setups_.signed_ux2);
  const V across = set(setups_.across), inverse = set(setups_.inverse_across);
  const V g_step = set(setups_.g.inner), cross_step = set(setups_.cross.inner);
  const V a_column = set(setups_.a_column), b_column = set(setups_.b_column);
  const bool clipped = setups_.clipped[strut];
  const V error = set(setups_.error), root_error = set(setups_.root_error);
  const V root_less = hn::Mul(root_error, hn::Set(d, 0.3f));
  const V none = hn::Neg(error), zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  // The last bits of a whole number below 2^22 plus 1.5 * 2^23 are that number. The sum rounds to
  // the nearest one, so half a column makes it round up or down.
  const V whole = hn::Set(d, 0x1.8p23f);
  const V base_error = hn::Add(set(setups_.end_error), hn::Set(d, 0.5f));

  const auto j0 = static_cast<size_t>(setups_.j0[strut]),
             k0 = static_cast<size_t>(setups_.k0[strut]);
  const auto first_bit = hn::Set(di, first_bit_of(target_, j0, k0, setups_.column[strut]));

  for (size_t vector = begin; vector < end; ++vector) {
    V inner, outer;
    const M in = rows.find(vector, inner, outer);
    V line = outer;
    if (!(target_.dz > 0)) {
      const size_t k = k0 + static_cast<size_t>(hn::GetLane(outer));
      line =
          hn::Set(d, static_cast<float>((target_.z[k] - batch_.a[2][strut]) * target_.inverse_dx));
    }
    const V g = hn::MulAdd(inner, g_step, line_of(setups_.g, line)), h = hn::Sub(g, length);
    const V cross = hn::MulAdd(inner, cross_step, line_of(setups_.cross, line));
    const V gg = hn::Mul(g, g), hh = hn::Mul(h, h);
    const V g2 = hn::CopySignToAbs(gg, g), h2 = hn::CopySignToAbs(hh, h);
    const V body_centre = hn::MulAdd(g, ux, a_column);

    // Ends for a squared radius, with their error; returns the minimum of the discriminants.
    const auto ends = [&](V r2, V& low, V& high, V& end_error) HWY_ATTR {
      const V body = hn::NegMulAdd(cross, cross, hn::Mul(r2, inverse));
      const V at_a = hn::Mul(across, hn::Sub(body, gg)), at_b = hn::Mul(across, hn::Sub(body, hh));
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
      const V q = hn::Sub(hn::Max(hn::Min(low_root, high_root), root_error), root_less);
      end_error = hn::MulAdd(error, hn::ApproximateReciprocal(q), base_error);
      return hn::Min(body, hn::Min(low_d, high_d));
    };

    V high2 = set(setups_.high2), low2 = set(setups_.low2);
    if constexpr (radii == Radii::linear) {
      const V v = hn::MulAdd(inner, set(setups_.v.inner), line_of(setups_.v, line));
      const V w = hn::MulAdd(inner, set(setups_.w.inner), line_of(setups_.w, line));
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
      spread = add_spread(1, v, hn::Mul(set(setups_.dy), half), spread);
      spread = add_spread(2, w, hn::Mul(set(setups_.dz), half), spread);
      const V most = hn::Add(r, spread), least = hn::Max(hn::Sub(r, spread), zero);
      low2 = hn::Min(hn::Max(low2, hn::Mul(least, least)), high2);
      high2 = hn::Min(high2, hn::Mul(most, most));
    }
    V low, high, end_error;
    V least = ends(high2, low, high, end_error);
    const M met = hn::And(in, hn::Gt(least, none));
    if (hn::AllFalse(d, met)) continue;
    // Columns [x0, x1] may be inside; columns [i0, i1] are certainly inside. All are numbers plus
    // `whole`.
    V x0 = hn::Add(hn::Sub(low, end_error), hn::Add(whole, one)),
      x1 = hn::Add(hn::Add(high, end_error), hn::Sub(whole, one));
    if constexpr (radii != Radii::constant) least = ends(low2, low, high, end_error);
    V i0 = hn::Add(hn::Add(low, end_error), whole), i1 = hn::Add(hn::Sub(high, end_error), whole);
    if (clipped) {
      const V first = hn::Add(set(setups_.first), whole), last = hn::Add(set(setups_.last), whole);
      x0 = hn::Max(x0, first);
      i0 = hn::Max(i0, first);
      x1 = hn::Min(x1, last);
      i1 = hn::Min(i1, last);
    }
    const M some = hn::And(met, hn::Le(x0, x1));
    const M sure = hn::And(hn::And(some, hn::Gt(least, error)), hn::Le(i0, i1));
    const auto from = hn::BitCast(di, i0), to = hn::BitCast(di, i1);
    buffer_.add(di, hn::Add(hn::Add(from, rows.bits(inner, outer)), first_bit), hn::Sub(to, from),
                hn::RebindMask(di, sure));

    const M decided = hn::And(sure, hn::And(hn::Eq(x0, i0), hn::Eq(x1, i1)));
    const M doubtful = hn::AndNot(decided, some);
    if (!hn::AllFalse(d, doubtful))
      add_doubts(d, rows.row(inner, outer), rows.layer(inner, outer),
                 {static_cast<uint32_t>(strut), static_cast<uint32_t>(j0),
                  static_cast<uint32_t>(k0), static_cast<uint32_t>(setups_.column[strut]), 0},
                 doubtful, sure, hn::Sub(x0, whole), hn::Sub(i0, whole), hn::Sub(i1, whole),
                 hn::Sub(x1, whole), doubts_);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
