// SPDX-License-Identifier: Apache-2.0
// Rows of samples through frusta and balls in single precision, a vector of rows at a time.
// Included once for each instruction set.
//
// Lengths are in columns; u = 2^-24; d is the margin, which bounds the error of positions and the
// predicate. A sample is certainly inside in [inner_low, inner_high], and certainly outside beyond
// [outer_low, outer_high].
//
// The frustum. The row's line is nearest to the axis, unit vector (ux, uy, uz), at g = (v uy + w
// uz) / A along it, A = uy^2 + uz^2, at a distance |k| / sqrt(A), k = v uz - w uy, where the cone's
// radius is R = ra + K g. At x from there, the line is in the cone if
//   A x^2 + k^2 / A <= (R + K ux x)^2,
// so, with S = A - K^2 ux^2 > 0, if x is within sqrt(A E) / S of K ux R / S, E = R^2 - S k^2 / A^2;
// on the right nappe if R > 0. The end planes cut it at (z - m) / ux, m = v uy + w uz, z = 0 and
// the length.
//
// Bounds, where P is the larger radius and U = length + P. Rows that meet the frustum have |R| <= Q
// = P (1 + |K| / sqrt(A)), since the line meets it within P / sqrt(A) of the nearest point; other
// rows are left out.
// - v and w err by 6 u U, m and k by 12 u U, g by 17 u U / A, as |m| is at most 1.5 U. R errs by
//   eR = 26 u U |K| / A + 3 u P and by d (1 + |K|) more, since moving a point by d moves it along
//   the axis and across.
// - q = sqrt(S) k / A errs by eq = 12 u U sqrt(S) / A + 3 u Q. So E = R^2 - q^2 errs by
//   F = 2 Q (eR + eq) + eR^2 + eq^2 + 4 u Q^2: above F the line meets the cone, below -F it misses
//   it. Its root errs by at most F / (max(root, sqrt(F)) - 0.3 sqrt(F)).
// - The centre errs by |ux| 17 u U / A + |K ux / S| (eR + 3 u Q), the sums by 40 u (U / A + their
//   other terms), and column numbers by the target's slack. The cuts of planes err by
//   (26 u U + d) / |ux|. If |ux| is so small that this exceeds a column, the whole row is in doubt.
//
// The ball. E = r^2 - v^2 - w^2 errs by F = 32 u r^2 + 2 r d + d^2. The plane of a half ball cuts
// as those of a frustum do.
#if defined(MSQ_STRUCTURE_BEAMS_PART_SPANS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUCTURE_BEAMS_PART_SPANS_INL_H
#undef MSQ_STRUCTURE_BEAMS_PART_SPANS_INL_H
#else
#define MSQ_STRUCTURE_BEAMS_PART_SPANS_INL_H
#endif

#include <hwy/highway.h>

#include "structure/beams/part_batch.h"
#include "strut/fast_spans-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace parts {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using F = FullLanes;
using VF = hn::Vec<F>;

/// A number of each of a vector of parts, in single precision.
struct alignas(64) Floats {
  float of[max_simd_doubles];

  HWY_INLINE void set(V value) {
    const hn::Rebind<float, D> df;
    hn::StoreU(hn::DemoteTo(df, value), df, of);
  }
};
struct alignas(64) Indices {
  int32_t of[max_simd_doubles];

  HWY_INLINE void set(V value) {
    const hn::Rebind<int32_t, D> di;
    hn::StoreU(hn::DemoteTo(di, value), di, of);
  }
};

/// Which rows a vector of parts may meet, and how their columns count.
struct RowSetups {
  enum Kernel : int32_t { none = 0, general = 1, fast = 2 };
  RowOrders<max_simd_doubles> order;
  Indices kernel, j0, k0;
  Indices column;      // a whole one near the part's origin: columns count from it
  Floats first, last;  // columns of the target
  Floats origin;       // column of the part's origin
  Floats v, w;         // of row j0 and layer k0, in y and z, from the origin

  /// For parts from `x`, `y`, `z` on that lie in y_low to y_high and z_low to z_high, within
  /// `reach` of an axis along (dy, dz), and are `size` columns long at most; the last four in
  /// columns. `serves`: whether the kernel's bounds hold; false of none of those that are not
  /// there.
  HWY_INLINE void set(const RasterTarget& target, V x, V y, V z, V y_low, V y_high, V z_low,
                      V z_high, V dy, V dz, V reach, V size, hn::Mask<D> is_there,
                      hn::Mask<D> serves) {
    const D d;
    const V zero = hn::Zero(d), scale = hn::Set(d, target.inverse_dx);
    V first_j, end_j, first_k, end_k, z_first = zero;
    index_range(d, target.y[0], target.dy, target.rows, y_low, y_high, first_j, end_j);
    if (target.dz > 0) {
      index_range(d, target.z[0], target.dz, target.layers, z_low, z_high, first_k, end_k);
      z_first = hn::Add(hn::Set(d, target.z[0]), hn::Mul(first_k, hn::Set(d, target.dz)));
    } else {
      index_range(d, target.z, target.layers, z_low, z_high, first_k, end_k);
    }
    const V y_first = hn::Add(hn::Set(d, target.y[0]), hn::Mul(first_j, hn::Set(d, target.dy)));
    const V place = hn::Mul(hn::Sub(x, hn::Set(d, target.x0)), scale), whole = hn::Floor(place);
    const V room = hn::Add(size, hn::Set(d, 2.0));
    const auto beyond = hn::Or(hn::Lt(hn::Add(place, room), zero),
                               hn::Gt(hn::Sub(place, room), hn::Set(d, target.last)));
    const auto meets = hn::And(hn::AndNot(beyond, is_there),
                               hn::And(hn::Lt(first_j, end_j), hn::Lt(first_k, end_k)));
    const double step = std::max(target.dy, target.dz) * target.inverse_dx;
    serves = hn::And(serves, hn::Gt(hn::Mul(size, hn::Set(d, 1e6)), hn::Set(d, step)));
    serves = hn::And(serves, hn::Gt(size, hn::Set(d, 1e-6)));
    serves = hn::And(serves, hn::Lt(size, hn::Set(d, 65536.0)));
    serves = hn::And(serves, hn::Lt(hn::Abs(whole), hn::Set(d, 0x1p30)));
    const V from_y = hn::Mul(hn::Sub(y_first, y), scale),
            from_z = hn::Mul(hn::Sub(z_first, z), scale);
    RowOrder<D> rows(d, target, hn::Sub(end_j, first_j), hn::Sub(end_k, first_k));
    rows.follow_axis(d, target, from_y, from_z, dy, dz, reach);
    serves = hn::And(serves, rows.fits(d));
    order.set(d, target, rows, 0);
    V chosen = hn::Set(d, double{general});
    if (RowOrder<D>::fits(target))
      chosen = hn::IfThenElse(serves, hn::Set(d, double{fast}), chosen);
    kernel.set(hn::IfThenElseZero(meets, chosen));
    j0.set(first_j);
    k0.set(first_k);
    const V bound = hn::Set(d, 0x1p23);
    const auto near = [&](V value)
                          HWY_ATTR { return hn::Min(hn::Max(value, hn::Neg(bound)), bound); };
    column.set(hn::Min(hn::Max(whole, hn::Set(d, -0x1p30)), hn::Set(d, 0x1p30)));
    first.set(near(hn::Neg(whole)));
    last.set(near(hn::Sub(hn::Set(d, target.last), whole)));
    origin.set(hn::Sub(place, whole));
    v.set(from_y);
    w.set(from_z);
  }
};

/// Where a vector of rows is in a part.
struct Ends {
  VF outer_low, outer_high, inner_low, inner_high;
  hn::Mask<F> met, sure;  // may be in it at all; is, in the inner part if that is not empty
};

/// Ends about a centre, by half of sqrt(e) times `scale`, and what that errs by.
struct RootError {
  VF squared, root, less, scaled, more;  // F, sqrt(F), 0.3 sqrt(F), F times the scale, beside it

  HWY_INLINE void set(const Floats& f, const Floats& f_root, const Floats& f_scaled,
                      const Floats& beside, size_t i) {
    const F d;
    squared = hn::Set(d, f.of[i]);
    root = hn::Set(d, f_root.of[i]);
    less = hn::Mul(root, hn::Set(d, 0.3f));
    scaled = hn::Set(d, f_scaled.of[i]);
    more = hn::Set(d, beside.of[i]);
  }
  HWY_INLINE VF of_root(VF computed) const {
    return hn::MulAdd(scaled, hn::ApproximateReciprocal(hn::Sub(hn::Max(computed, root), less)),
                      more);
  }
};

/// Rows of parts, drawn with what a kernel says of a vector of them.
class RowDrawing {
 public:
  RowDrawing(const RasterTarget& target, DoubtfulSpans& doubts)
      : target_(target),
        doubts_(doubts),
        buffer_(target.certain),
        row_step_(static_cast<float>(target.dy * target.inverse_dx)),
        layer_step_(static_cast<float>(target.dz * target.inverse_dx)) {}

  /// kernel(v, w) answers Ends for rows at these offsets from the part's origin, whose z is given.
  template <class Kernel>
  HWY_INLINE void draw(const RowSetups& setups, size_t i, double origin_z, uint32_t number,
                       const Kernel& kernel) {
    const F d;
    const hn::RebindToSigned<F> di;
    using VI = hn::Vec<decltype(di)>;
    const auto index = [&](const Indices& values) { return static_cast<size_t>(values.of[i]); };
    const auto set = [&](const Floats& values) HWY_ATTR { return hn::Set(d, values.of[i]); };
    const RowVectors rows(setups.order, i);
    const size_t j0 = index(setups.j0), k0 = index(setups.k0);
    const VI first_bit = hn::Set(di, first_bit_of(target_, j0, k0, setups.column.of[i]));
    const VF v0 = set(setups.v), w0 = set(setups.w);
    const VF first = set(setups.first), last = set(setups.last);
    const VF row_step = hn::Set(d, row_step_), layer_step = hn::Set(d, layer_step_);
    const auto vectors = static_cast<size_t>(setups.order.vectors[i]);
    for (size_t vector = 0; vector < vectors; ++vector) {
      VF inner, outer;
      const auto in = rows.find(vector, inner, outer);
      const VF row = rows.row(inner, outer), layer = rows.layer(inner, outer);
      const VF v = hn::MulAdd(row, row_step, v0);
      VF w = hn::MulAdd(layer, layer_step, w0);
      if (!(target_.dz > 0)) {
        const size_t k = k0 + static_cast<size_t>(hn::GetLane(layer));
        w = hn::Set(d, static_cast<float>((target_.z[k] - origin_z) * target_.inverse_dx));
      }
      Ends ends;
      kernel(v, w, ends);
      const auto met = hn::And(in, ends.met);
      if (hn::AllFalse(d, met)) continue;
      const VF x0 = hn::Max(hn::Ceil(ends.outer_low), first);
      const VF x1 = hn::Min(hn::Floor(ends.outer_high), last);
      const VF i0 = hn::Max(hn::Ceil(ends.inner_low), first);
      const VF i1 = hn::Min(hn::Floor(ends.inner_high), last);
      const auto some = hn::And(met, hn::Le(x0, x1));
      const auto sure = hn::And(hn::And(some, ends.sure), hn::Le(i0, i1));

      // A whole number below 2^22 plus 1.5 * 2^23 has it in its last bits.
      const VF whole = hn::Set(d, 0x1.8p23f);
      const VI from = hn::BitCast(di, hn::Add(i0, whole)), to = hn::BitCast(di, hn::Add(i1, whole));
      buffer_.add(di, hn::Add(hn::Add(from, rows.bits(inner, outer)), first_bit), hn::Sub(to, from),
                  hn::RebindMask(di, sure));

      const auto decided = hn::And(sure, hn::And(hn::Eq(x0, i0), hn::Eq(x1, i1)));
      const auto doubtful = hn::AndNot(decided, some);
      if (hn::AllFalse(d, doubtful)) continue;
      add_doubts(d, row, layer,
                 {number, static_cast<uint32_t>(j0), static_cast<uint32_t>(k0),
                  static_cast<uint32_t>(setups.column.of[i]), 0},
                 doubtful, sure, x0, i0, i1, x1, doubts_);
    }
  }
  HWY_INLINE void finish() { buffer_.draw(); }

 private:
  const RasterTarget& target_;
  DoubtfulSpans& doubts_;
  SpanBuffer buffer_;
  const float row_step_, layer_step_;
};

/// The least component of a normal that planes are cut by; with less, rows are in doubt all along.
constexpr double min_slope = 1e-20;
HWY_INLINE V inverse_slope(V slope) {
  const D d;
  const V least = hn::Max(hn::Abs(slope), hn::Set(d, min_slope));
  return hn::Div(hn::Set(d, 1.0), hn::CopySign(least, slope));
}
/// Bounds of errors are themselves computed.
HWY_INLINE V with_room(V error) {
  return hn::Mul(error, hn::Set(D(), 1.05));
}

}  // namespace parts
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
