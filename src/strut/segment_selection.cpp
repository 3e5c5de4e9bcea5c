// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "strut/segment_selection.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cmath>
#include <limits>

#include "base/compress-inl.h"
#include "base/simd.h"
#include "strut/segment_selection.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

/// Writes the components of the segments that meet the box [low, high] to `out`; returns their
/// number. The segments' ends are numbers of nodes.
template <class Number>
size_t select(const SegmentSet& set, const Number* a, const Number* b, const float* low,
              const float* high, float* const* out) {
  using D = hn::ScalableTag<float>;
  using V = hn::Vec<D>;
  const D d;
  const hn::RebindToSigned<D> di;
  const hn::Rebind<Number, D> dn;
  const size_t lanes = hn::Lanes(d);
  const auto numbers = [&](const Number* ends) HWY_ATTR {
    if constexpr (sizeof(Number) == 2)
      return hn::PromoteTo(di, hn::LoadU(dn, ends));
    else
      return hn::BitCast(di, hn::LoadU(dn, ends));
  };
  const V lx = hn::Set(d, low[0]), ly = hn::Set(d, low[1]), lz = hn::Set(d, low[2]);
  const V hx = hn::Set(d, high[0]), hy = hn::Set(d, high[1]), hz = hn::Set(d, high[2]);
  size_t count = 0;
  for (size_t run = 0; run < set.runs(); ++run) {
    bool meets = true;
    for (int axis = 0; axis < 3; ++axis)
      meets &= set.bound(axis)[run] <= high[axis] && set.bound(axis + 3)[run] >= low[axis];
    if (!meets) continue;
    const size_t end = set.run_end(run);
    for (size_t i = set.run_start(run); i < end; i += lanes) {
      const auto at_a = numbers(a + i), at_b = numbers(b + i);
      V c[6];
      for (int axis = 0; axis < 3; ++axis) {
        c[axis] = hn::GatherIndex(d, set.nodes(axis), at_a);
        c[axis + 3] = hn::GatherIndex(d, set.nodes(axis), at_b);
      }
      auto in = hn::RebindMask(d, hn::FirstN(di, end - i));
      in = hn::And(in, hn::And(hn::Le(hn::Min(c[0], c[3]), hx), hn::Ge(hn::Max(c[0], c[3]), lx)));
      in = hn::And(in, hn::And(hn::Le(hn::Min(c[1], c[4]), hy), hn::Ge(hn::Max(c[1], c[4]), ly)));
      in = hn::And(in, hn::And(hn::Le(hn::Min(c[2], c[5]), hz), hn::Ge(hn::Max(c[2], c[5]), lz)));
      const size_t found = hn::CountTrue(d, in);
      if (!found) continue;
      const Compression<D> compress(in);
      for (int k = 0; k < 6; ++k) hn::StoreU(compress(c[k]), d, out[k] + count);
      count += found;
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
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;
  const D d;
  const hn::Rebind<float, D> df;
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
