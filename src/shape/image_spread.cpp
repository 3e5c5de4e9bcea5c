// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/image_spread.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "base/simd.h"
#include "shape/image_spread.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

HWY_INLINE V load(D d, const double* from) {
  return hn::LoadU(d, from);
}

HWY_INLINE V load(D d, const float* from) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), from));
}

template <class T>
V load(D d, const T* from) {
  double wide[max_simd_doubles];
  for (size_t i = 0; i < hn::Lanes(d); ++i) wide[i] = from[i];
  return hn::LoadU(d, wide);
}

/// Up to `end`, beyond which nothing may be read; 0 there.
template <class T>
HWY_INLINE V load_before(D d, const T* from, const T* end) {
  const auto left = static_cast<size_t>(end - from);
  if (left >= hn::Lanes(d)) return load(d, from);
  T last[max_simd_doubles] = {};
  std::copy_n(from, left, last);
  return load(d, last);
}

/// The least and the greatest number of each lane.
struct Extremes {
  V least, most;

  explicit Extremes(D d)
      : least(hn::Set(d, std::numeric_limits<double>::max())),
        most(hn::Set(d, std::numeric_limits<double>::lowest())) {}
  HWY_INLINE void add(V v) {
    least = hn::Min(least, v);
    most = hn::Max(most, v);
  }
  HWY_INLINE void add(V v, hn::Mask<D> which) {
    least = hn::IfThenElse(which, hn::Min(least, v), least);
    most = hn::IfThenElse(which, hn::Max(most, v), most);
  }
  void write(D d, double& low, double& high) const {
    low = hn::GetLane(hn::MinOfLanes(d, least));
    high = hn::GetLane(hn::MaxOfLanes(d, most));
  }
};

template <class T>
void spread(const T* first, const uint64_t* count, uint64_t dy, uint64_t dz, ImageSpread& found) {
  const D d;
  // Lanes past the end of a row have samples of the next one, which do not count.
  const T* const end = first + (count[2] - 1) * dz + (count[1] - 1) * dy + count[0];
  Extremes range(d), along[3] = {Extremes(d), Extremes(d), Extremes(d)};
  for (uint64_t i = 0; i < count[0]; i += hn::Lanes(d)) {
    const size_t left = std::min<size_t>(count[0] - i, hn::Lanes(d) + 1);
    const auto is_sample = hn::FirstN(d, std::min(left, hn::Lanes(d)));
    const auto has_next = hn::FirstN(d, left - 1);
    for (uint64_t k = 0; k < count[2]; ++k) {
      V before = hn::Zero(d);
      for (uint64_t j = 0; j < count[1]; ++j) {
        const T* const row = first + k * dz + j * dy + i;
        const V v = load_before(d, row, end);
        range.add(v, is_sample);
        along[0].add(hn::Sub(load_before(d, row + 1, end), v), has_next);
        if (j > 0) along[1].add(hn::Sub(v, before), is_sample);
        if (k > 0) along[2].add(hn::Sub(v, load_before(d, row - dz, end)), is_sample);
        before = v;
      }
    }
  }
  range.write(d, found.range.low, found.range.high);
  found.slopes = {};
  for (int axis = 0; axis < 3; ++axis)
    if (count[axis] > 1) along[axis].write(d, found.slopes.min[axis], found.slopes.max[axis]);
}

#define MSQ_SPREAD(T, name)                                                                        \
  void name(const T* first, const uint64_t* count, uint64_t dy, uint64_t dz, ImageSpread& found) { \
    spread(first, count, dy, dz, found);                                                           \
  }
MSQ_SPREAD(uint8_t, spread_uint8)
MSQ_SPREAD(int16_t, spread_int16)
MSQ_SPREAD(uint16_t, spread_uint16)
MSQ_SPREAD(float, spread_float)
MSQ_SPREAD(double, spread_double)
#undef MSQ_SPREAD

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

#define MSQ_SPREAD(T, name)                                                                    \
  HWY_EXPORT(name);                                                                            \
  ImageSpread spread_of(const T* first, const uint64_t(&count)[3], uint64_t dy, uint64_t dz) { \
    ImageSpread found;                                                                         \
    HWY_DYNAMIC_DISPATCH(name)(first, count, dy, dz, found);                                   \
    return found;                                                                              \
  }
MSQ_SPREAD(uint8_t, spread_uint8)
MSQ_SPREAD(int16_t, spread_int16)
MSQ_SPREAD(uint16_t, spread_uint16)
MSQ_SPREAD(float, spread_float)
MSQ_SPREAD(double, spread_double)
#undef MSQ_SPREAD

}  // namespace msq
#endif  // HWY_ONCE
