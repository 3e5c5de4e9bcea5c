// SPDX-License-Identifier: Apache-2.0
// constant + sine sin(a) + cosine cos(a) = constant + r cos(a - p), with r = hypot(sine, cosine)
// and p = acos(cosine / r), negative if the sine's coefficient is. It is at most the threshold
// where a - p is from q to 2 pi - q, with q = acos((threshold - constant) / r).
//
// Bounds. Let u = 2^-53. An error of the angle changes the value by at most r times that. cosine /
// r has an error below 4 u, and p one below 2 sqrt(4 u) < 2^-24, where the arc cosine is steepest.
// The error of q comes from that of its argument, which is one of the threshold by 4 u r, and from
// a few u of its own.
#include "structure/functional/single_wave.h"

#include <cmath>

#include "base/pi.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/functional/single_wave.cpp"
#include <hwy/foreach_target.h>

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

void find_ends(const SingleWaves& rows, const double* thresholds, WaveEnds& ends) {
  const hn::ScalableTag<double> d;
  const hn::Rebind<int32_t, decltype(d)> di;
  using V = hn::Vec<decltype(d)>;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0), whole = hn::Set(d, ColumnSets::buckets);
  const V to_buckets = hn::Set(d, ColumnSets::buckets / two_pi);
  for (size_t row = 0; row < rows.count; row += hn::Lanes(d)) {
    const V sine = hn::LoadU(d, rows.sine + row), cosine = hn::LoadU(d, rows.cosine + row);
    const V r = hn::Sqrt(hn::MulAdd(sine, sine, hn::Mul(cosine, cosine)));
    const V beyond = hn::Sub(hn::LoadU(d, thresholds + row),
                             rows.constant.is_uniform ? hn::Set(d, *rows.constant.data)
                                                      : hn::LoadU(d, rows.constant.data + row));
    const auto is_all = hn::Ge(beyond, r), is_none = hn::Lt(beyond, hn::Neg(r));
    const V divisor = hn::IfThenElse(hn::Gt(r, zero), r, one);
    const auto arc_cosine = [&](V v) HWY_ATTR {
      return hn::Acos(d, hn::Min(hn::Max(hn::Div(v, divisor), hn::Neg(one)), one));
    };
    const V p = hn::CopySign(arc_cosine(cosine), sine), q = arc_cosine(beyond);
    V low = hn::Floor(hn::Mul(hn::Add(p, q), to_buckets));
    V high = hn::Floor(hn::MulAdd(hn::Sub(p, q), to_buckets, whole));
    // All buckets are one more than there are, on either side of both.
    low = hn::IfThenElse(is_none, one, hn::IfThenElse(is_all, hn::Neg(one), low));
    high = hn::IfThenElse(is_none, zero, hn::IfThenElse(is_all, whole, high));
    hn::StoreU(hn::DemoteTo(di, low), di, ends.low + row);
    hn::StoreU(hn::DemoteTo(di, high), di, ends.high + row);
  }
}

bool mark(const ColumnSets& columns, const WaveLevels& levels, size_t row, uint64_t* inside,
          uint64_t* doubt) {
  constexpr size_t words = ColumnSets::part_words;
  const hn::CappedTag<uint64_t, words> d;
  const auto inner = [&](const WaveEnds& ends) {
    return columns.range(ends.low[row] + 1, ends.high[row]);
  };
  const auto outer = [&](const WaveEnds& ends) {
    return columns.range(ends.low[row], ends.high[row] + 1);
  };
  const bool has_hole = levels.has_hole;
  using Levels = WaveLevels;
  const ColumnSets::Range least = inner(levels.ends[Levels::least]),
                          most = outer(levels.ends[Levels::most]);
  ColumnSets::Range hole_least = least, hole_most = most;
  if (has_hole) {
    hole_least = inner(levels.ends[Levels::hole_least]);
    hole_most = outer(levels.ends[Levels::hole_most]);
  }
  const uint64_t* const sets = columns.sets();
  const size_t parts = columns.parts();
  const bool is_one = least.flip == most.flip && hole_least.flip == hole_most.flip;
  bool any = false;
  for (size_t part = 0; part < parts; ++part, inside += words, doubt += words) {
    const auto columns_of = [&](const ColumnSets::Range& range, size_t word) HWY_ATTR {
      return hn::Xor(hn::Xor(hn::LoadU(d, sets + range.from[part] * words + word),
                             hn::LoadU(d, sets + range.to[part] * words + word)),
                     hn::Set(d, range.flip));
    };
    const bool is_sure =
        is_one && least.from[part] == most.from[part] && least.to[part] == most.to[part] &&
        hole_least.from[part] == hole_most.from[part] && hole_least.to[part] == hole_most.to[part];
    for (size_t word = 0; word < words; word += hn::Lanes(d)) {
      auto in = columns_of(least, word);
      if (has_hole) in = hn::AndNot(columns_of(hole_most, word), in);
      hn::StoreU(in, d, inside + word);
      if (HWY_LIKELY(is_sure)) {
        hn::StoreU(hn::Zero(d), d, doubt + word);
      } else {
        auto maybe = columns_of(most, word);
        if (has_hole) maybe = hn::AndNot(columns_of(hole_least, word), maybe);
        hn::StoreU(hn::AndNot(in, maybe), d, doubt + word);
      }
    }
    any = any || !is_sure;
  }
  return any;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(find_ends);
HWY_EXPORT(mark);

void find_wave_ends(const SingleWaves& rows, const double* thresholds, WaveEnds& ends) {
  HWY_DYNAMIC_DISPATCH(find_ends)(rows, thresholds, ends);
}

bool mark_wave(const ColumnSets& columns, const WaveLevels& levels, size_t row, uint64_t* inside,
               uint64_t* doubt) {
  return HWY_DYNAMIC_DISPATCH(mark)(columns, levels, row, inside, doubt);
}

}  // namespace msq
#endif  // HWY_ONCE
