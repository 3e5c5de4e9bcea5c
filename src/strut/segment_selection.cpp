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

using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;

/// Selects segments by the numbers of their nodes.
class Selection {
 public:
  Selection(const SegmentSet& set, const float* low, const float* high, float* const* out)
      : set_(set), low_(low), high_(high), out_(out) {}

  size_t count() const { return count_; }

  /// Whether segments of these nodes, where `in`, meet the box along an axis.
  template <class VI>
  HWY_INLINE hn::Mask<D> meets(int axis, VI at_a, VI at_b, hn::Mask<D> in) const {
    const D d;
    const auto a = hn::GatherIndex(d, set_.nodes(axis), at_a),
               b = hn::GatherIndex(d, set_.nodes(axis), at_b);
    return hn::And(in, hn::And(hn::Le(hn::Min(a, b), hn::Set(d, high_[axis])),
                               hn::Ge(hn::Max(a, b), hn::Set(d, low_[axis]))));
  }

  /// Writes the components of those that meet the box.
  template <class VI>
  HWY_INLINE void add(VI at_a, VI at_b, hn::Mask<D> in) {
    const D d;
    hn::Vec<D> c[6];
    for (int axis = 0; axis < 3; ++axis) {
      c[axis] = hn::GatherIndex(d, set_.nodes(axis), at_a);
      c[axis + 3] = hn::GatherIndex(d, set_.nodes(axis), at_b);
      in = hn::And(in, hn::And(hn::Le(hn::Min(c[axis], c[axis + 3]), hn::Set(d, high_[axis])),
                               hn::Ge(hn::Max(c[axis], c[axis + 3]), hn::Set(d, low_[axis]))));
    }
    const size_t found = hn::CountTrue(d, in);
    if (!found) return;
    const Compression<D> compress(in);
    for (int k = 0; k < 6; ++k) hn::StoreU(compress(c[k]), d, out_[k] + count_);
    count_ += found;
  }

  /// The same, for an axis along which few meet it: those that do so wait until they fill vectors.
  template <class VI>
  HWY_INLINE void add_few(int axis, VI at_a, VI at_b, hn::Mask<D> in) {
    const DI di;
    in = meets(axis, at_a, at_b, in);
    const Compression<DI> compress(hn::RebindMask(di, in));
    hn::StoreU(compress(at_a), di, waiting_[0] + waiting_count_);
    hn::StoreU(compress(at_b), di, waiting_[1] + waiting_count_);
    waiting_count_ += hn::CountTrue(D(), in);
    if (waiting_count_ < hn::Lanes(di)) return;
    add(hn::Load(di, waiting_[0]), hn::Load(di, waiting_[1]), hn::FirstN(D(), hn::Lanes(di)));
    waiting_count_ -= hn::Lanes(di);
    for (int32_t* numbers : {waiting_[0], waiting_[1]})
      hn::Store(hn::Load(di, numbers + hn::Lanes(di)), di, numbers);
  }
  HWY_INLINE void finish() {
    const DI di;
    if (waiting_count_ == 0) return;
    add(hn::Load(di, waiting_[0]), hn::Load(di, waiting_[1]), hn::FirstN(D(), waiting_count_));
    waiting_count_ = 0;
  }

 private:
  const SegmentSet& set_;
  const float* const low_;
  const float* const high_;
  float* const* const out_;
  size_t count_ = 0, waiting_count_ = 0;
  // Lanes without a segment are gathered too, so they are numbers of nodes.
  HWY_ALIGN int32_t waiting_[2][4 * max_simd_doubles] = {};
};

/// Writes the components of the segments that meet the box [low, high] to `out`; returns their
/// number. The segments' ends are numbers of nodes.
template <class Number>
size_t select(const SegmentSet& set, const Number* a, const Number* b, const float* low,
              const float* high, float* const* out) {
  const D d;
  const DI di;
  const hn::Rebind<Number, D> dn;
  const size_t lanes = hn::Lanes(d);
  const auto numbers = [&](const Number* ends) HWY_ATTR {
    if constexpr (sizeof(Number) == 2)
      return hn::PromoteTo(di, hn::LoadU(dn, ends));
    else
      return hn::BitCast(di, hn::LoadU(dn, ends));
  };
  // Where the box is thin, as that of a single layer, most segments miss it along one axis.
  int thin = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (high[axis] - low[axis] < high[thin] - low[thin]) thin = axis;
  Selection selection(set, low, high, out);
  for (size_t run = 0; run < set.runs(); ++run) {
    bool meets = true;
    for (int axis = 0; axis < 3; ++axis)
      meets &= set.bound(axis)[run] <= high[axis] && set.bound(axis + 3)[run] >= low[axis];
    if (!meets) continue;
    const bool has_few =
        2 * (high[thin] - low[thin]) < set.bound(thin + 3)[run] - set.bound(thin)[run];
    const size_t end = set.run_end(run);
    for (size_t i = set.run_start(run); i < end; i += lanes) {
      const auto at_a = numbers(a + i), at_b = numbers(b + i);
      const auto in = hn::RebindMask(d, hn::FirstN(di, end - i));
      if (has_few)
        selection.add_few(thin, at_a, at_b, in);
      else
        selection.add(at_a, at_b, in);
    }
  }
  selection.finish();
  return selection.count();
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
