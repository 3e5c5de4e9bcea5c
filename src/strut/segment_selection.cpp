// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "strut/segment_selection.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/compress-inl.h"
#include "base/simd.h"
#include "strut/segment_selection.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::ScalableTag<float>;
using Floats = hn::Vec<D>;

/// Copies of the ends of some segments, x, y, z and a number without meaning each. Vectors of x, y
/// and z are made of these copies: to gather them from the nodes takes several times as long.
class CopiedEnds {
 public:
  static constexpr size_t capacity = 64;
  static_assert(capacity % (2 * max_simd_doubles) == 0);

  template <class Number>
  HWY_INLINE void copy(const SegmentSet& set, const Number* numbers, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      hwy::Prefetch(set.node(numbers[i + capacity]));  // at most the padding of the numbers
      std::memcpy(&ends_[4 * i], set.node(numbers[i]), 4 * sizeof(float));
    }
  }
  HWY_INLINE void get(size_t first, Floats& x, Floats& y, Floats& z) const {
    Floats no_meaning;
    hn::LoadInterleaved4(D(), &ends_[4 * first], x, y, z, no_meaning);
  }

 private:
  HWY_ALIGN float ends_[4 * capacity] = {};
};

/// Writes the components of the segments that meet the box [low, high] to `out`; returns their
/// number. The segments' ends are numbers of nodes.
template <class Number>
size_t select(const SegmentSet& set, const Number* a, const Number* b, const float* low,
              const float* high, float* const* out) {
  const D d;
  CopiedEnds of_a, of_b;
  size_t count = 0;
  const auto add = [&](size_t first, size_t lanes) HWY_ATTR {
    Floats c[6];
    of_a.get(first, c[0], c[1], c[2]);
    of_b.get(first, c[3], c[4], c[5]);
    auto in = hn::FirstN(d, lanes);
    for (size_t axis = 0; axis < 3; ++axis)
      in = hn::And(in, hn::And(hn::Le(hn::Min(c[axis], c[axis + 3]), hn::Set(d, high[axis])),
                               hn::Ge(hn::Max(c[axis], c[axis + 3]), hn::Set(d, low[axis]))));
    const size_t found = hn::CountTrue(d, in);
    if (!found) return;
    const Compression<D> compress(in);
    for (int k = 0; k < 6; ++k) hn::StoreU(compress(c[k]), d, out[k] + count);
    count += found;
  };
  for (size_t run = 0; run < set.runs(); ++run) {
    bool meets = true;
    for (int axis = 0; axis < 3; ++axis)
      meets &= set.bound(axis)[run] <= high[axis] && set.bound(axis + 3)[run] >= low[axis];
    if (!meets) continue;
    for (size_t i = set.run_start(run); i < set.run_end(run); i += CopiedEnds::capacity) {
      const size_t copied = std::min(CopiedEnds::capacity, set.run_end(run) - i);
      of_a.copy(set, a + i, copied);
      of_b.copy(set, b + i, copied);
      for (size_t n = 0; n < copied; n += hn::Lanes(d)) add(n, copied - n);
    }
  }
  return count;
}

size_t select_segments(const SegmentSet& set, const float* low, const float* high,
                       float* const* out) {
  return set.is_wide() ? select(set, set.wide_ends(0), set.wide_ends(1), low, high, out)
                       : select(set, set.narrow_ends(0), set.narrow_ends(1), low, high, out);
}

/// Computes a and b of `count` segments from their components.
void place_segments(const SegmentFrame& frame, const float* const* components, size_t count,
                    StrutBatch& batch) {
  const hn::ScalableTag<double> d;
  using V = hn::Vec<decltype(d)>;
  const hn::Rebind<float, decltype(d)> df;
  const auto& m = frame.matrix;
  for (int end = 0; end < 2; ++end)
    for (int axis = 0; axis < 3; ++axis) {
      double* out = end ? batch.b[axis] : batch.a[axis];
      const V origin = hn::Set(d, frame.origin[axis]);
      const V mx = hn::Set(d, m[3 * axis]), my = hn::Set(d, m[3 * axis + 1]),
              mz = hn::Set(d, m[3 * axis + 2]);
      for (size_t i = 0; i < count; i += hn::Lanes(d)) {
        const V x = hn::PromoteTo(d, hn::LoadU(df, components[3 * end] + i));
        const V y = hn::PromoteTo(d, hn::LoadU(df, components[3 * end + 1] + i));
        const V z = hn::PromoteTo(d, hn::LoadU(df, components[3 * end + 2] + i));
        const V sum = hn::MulAdd(mz, z, hn::MulAdd(my, y, hn::MulAdd(mx, x, origin)));
        hn::StoreU(sum, d, out + i);
      }
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

namespace {

HWY_EXPORT(select_segments);
HWY_EXPORT(place_segments);

/// The nearest number in single precision that is not greater.
float rounded_down(double x) {
  const float f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

}  // namespace

void SegmentSelection::select(const SegmentSet& set, const Box3& box) {
  constexpr size_t vector = 2 * max_simd_doubles;
  float low[3], high[3];
  float* out[6];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = rounded_down(box.min[axis]);
    high[axis] = -rounded_down(-box.max[axis]);
  }
  for (size_t k = 0; k < 6; ++k) {
    if (components_[k].size() < set.count() + vector) components_[k].resize(set.count() + vector);
    out[k] = components_[k].data();
  }
  count_ = HWY_DYNAMIC_DISPATCH(select_segments)(set, low, high, out);
}

void SegmentSelection::place(const SegmentFrame& frame, size_t first, StrutBatch& batch) const {
  const float* components[6];
  for (size_t k = 0; k < 6; ++k) components[k] = components_[k].data() + first;
  batch.count = std::min(StrutBatch::capacity, count_ - first);
  HWY_DYNAMIC_DISPATCH(place_segments)(frame, components, batch.count, batch);
}

}  // namespace msq
#endif  // HWY_ONCE
