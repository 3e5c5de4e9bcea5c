// SPDX-License-Identifier: Apache-2.0
// A sum of solid angles in each lane, as HalfAngles. Included once for each instruction set.
#if defined(MSQ_SHAPE_HALF_ANGLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_SHAPE_HALF_ANGLES_INL_H
#undef MSQ_SHAPE_HALF_ANGLES_INL_H
#else
#define MSQ_SHAPE_HALF_ANGLES_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

/// Also of -0, as std::signbit().
template <class D, class V = hwy::HWY_NAMESPACE::Vec<D>>
HWY_INLINE hwy::HWY_NAMESPACE::Mask<D> is_negative(D d, V v) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::RebindToSigned<D> di;
  return hn::MaskFromVec(hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(di, v))));
}

/// The product is kept at about 1. Terms must be neither so large nor so small that their product
/// with that vanishes or overflows.
template <class D>
struct HalfAngleLanes {
  using V = hwy::HWY_NAMESPACE::Vec<D>;

  V re, im, turns;

  explicit HalfAngleLanes(D d)
      : re(hwy::HWY_NAMESPACE::Set(d, 1.0)),
        im(hwy::HWY_NAMESPACE::Zero(d)),
        turns(hwy::HWY_NAMESPACE::Zero(d)) {}

  /// Adds the argument of (re, im) where that is not 0.
  HWY_INLINE void add(D d, V of_re, V of_im) {
    namespace hn = hwy::HWY_NAMESPACE;
    const V one = hn::Set(d, 1.0);
    const auto is_some = hn::Gt(hn::Add(hn::Abs(of_re), hn::Abs(of_im)), hn::Zero(d));
    const auto is_low = is_negative(d, of_im);
    const auto were_alike = hn::Not(hn::Xor(is_negative(d, im), is_low));
    const V next_im = hn::MulAdd(re, of_im, hn::Mul(im, of_re));
    const V next_re = hn::NegMulAdd(im, of_im, hn::Mul(re, of_re));
    const auto has_passed =
        hn::And(hn::And(were_alike, is_some), hn::Xor(is_negative(d, next_im), is_low));
    const V turn = hn::IfThenElse(is_low, hn::Set(d, -1.0), one);
    turns = hn::Add(turns, hn::IfThenElseZero(has_passed, turn));
    const V inverse = hn::Div(one, hn::Add(hn::Abs(next_re), hn::Abs(next_im)));
    re = hn::IfThenElse(is_some, hn::Mul(next_re, inverse), re);
    im = hn::IfThenElse(is_some, hn::Mul(next_im, inverse), im);
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
