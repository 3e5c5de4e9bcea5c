// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/functional/piece_steps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/mask_bits-inl.h"
#include "structure/functional/piece_steps.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

/// Bounds of ends of pieces, which positive_until() computes, by the same operations. Returns the
/// lanes in which squares are out of range, as bits.
uint32_t find_steps(bool wanted, const RayBatch::Bounds& bounds, const PieceLevels& levels,
                    double cell_size, size_t count, PieceSteps& steps) {
  const hn::ScalableTag<double> d;
  const auto zero = hn::Zero(d), cell = hn::Set(d, cell_size);
  const auto infinity = hn::Inf(d);
  uint32_t out_of_range = 0;
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto load = [&](const double* from) HWY_ATTR { return hn::LoadU(d, from + i); };
    const auto difference = hn::Sub(load(bounds.value), load(levels.value));
    const auto error = load(bounds.error), bend = load(bounds.bend);
    const auto gap = wanted ? hn::Sub(hn::Sub(difference, error), load(levels.above))
                            : hn::Sub(hn::Sub(hn::Neg(difference), error), load(levels.below));
    const auto slope = wanted ? hn::Sub(load(bounds.low), hn::Mul(load(levels.high), cell))
                              : hn::Sub(hn::Mul(load(levels.low), cell), load(bounds.high));
    const auto most = hn::Div(load(steps.most), cell);
    // False for NaN.
    const auto is_bounded = hn::And(
        hn::And(hn::Lt(hn::Abs(slope), infinity), hn::Lt(bend, infinity)), hn::Gt(gap, zero));
    const auto is_all =
        hn::Or(hn::And(hn::Ge(slope, zero), hn::Eq(bend, zero)), hn::Eq(gap, infinity));
    const auto square = hn::Add(hn::Mul(slope, slope), hn::Mul(hn::Mul(hn::Set(d, 4), bend), gap));
    const auto is_in_range =
        hn::And(hn::Gt(square, hn::Set(d, 0x1p-900)), hn::Lt(square, infinity));
    const auto span = hn::Sqrt(square);
    const auto divisor = hn::Sub(span, slope);
    const auto plain = hn::Div(hn::Mul(hn::Set(d, (1 - 0x1p-40) * 2), gap), divisor);
    const auto last = hn::Div(hn::Mul(hn::Set(d, (1 - 0x1p-41) / 2), hn::Add(span, slope)), bend);
    const auto root = hn::Min(hn::IfThenElse(hn::Gt(divisor, zero), plain, infinity),
                              hn::IfThenElse(hn::Gt(slope, zero), last, infinity));
    const auto is_root = hn::AndNot(is_all, hn::Lt(root, most));
    const auto until = hn::Mul(cell, hn::IfThenElse(is_root, root, most));
    hn::StoreU(gap, d, steps.gap + i);
    hn::StoreU(slope, d, steps.slope + i);
    hn::StoreU(hn::IfThenElse(is_bounded, until, zero), d, steps.step + i);
    const auto is_odd = hn::AndNot(hn::Or(is_all, is_in_range), is_bounded);
    out_of_range |= static_cast<uint32_t>(bits_of(d, is_odd)) << i;
  }
  return out_of_range;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <bit>
#include <cmath>

#include "base/infinity.h"

namespace msq {

HWY_EXPORT(find_steps);

namespace {

/// The s, at most `most`, up to which gap + slope s - bend s^2 stays positive. Slope and bend are
/// finite; bend is not negative. The root has two forms. With a positive slope the first one
/// loses digits in the difference sqrt(square) - slope, all of them if 4 bend gap is below the
/// rounding of slope^2. The second one is exact then, and a bound of the first.
double positive_until(double gap, double slope, double bend, double most) {
  if (!(gap > 0)) return 0;
  if ((slope >= 0 && bend == 0) || gap == infinity) return most;
  double square = slope * slope + 4 * bend * gap;
  // If squares are out of range, scaling by a power of two, which does not change the root, brings
  // the largest number to 1. Numbers that then vanish are negligible, or the root is far beyond
  // `most`.
  if (!(square > 0x1p-900 && square < infinity)) {
    const int exponent = std::ilogb(std::max(std::max(gap, bend), std::abs(slope)));
    gap = std::scalbn(gap, -exponent);
    slope = std::scalbn(slope, -exponent);
    bend = std::scalbn(bend, -exponent);
    square = slope * slope + 4 * bend * gap;
  }
  const double span = std::sqrt(square), divisor = span - slope;
  const double plain = divisor > 0 ? (1 - 0x1p-40) * 2 * gap / divisor : infinity;
  const double last = slope > 0 ? (1 - 0x1p-41) / 2 * (span + slope) / bend : infinity;
  const double root = std::min(plain, last);
  return root < most ? root : most;
}

}  // namespace

void PieceSteps::find(bool wanted, const RayBatch::Bounds& bounds, const PieceLevels& levels,
                      double cell, size_t count) {
  static_assert(lanes <= 32);
  uint32_t odd = HWY_DYNAMIC_DISPATCH(find_steps)(wanted, bounds, levels, cell, count, *this);
  if (count < 32) odd &= (uint32_t{1} << count) - 1;
  for (; odd; odd &= odd - 1) {
    const size_t i = static_cast<size_t>(std::countr_zero(odd));
    step[i] = cell * positive_until(gap[i], slope[i], bounds.bend[i], most[i] / cell);
  }
}

}  // namespace msq
#endif  // HWY_ONCE
