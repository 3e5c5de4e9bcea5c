// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "strut/capsule_list.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "strut/meet_capsules-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {

size_t meet_listed(const CapsuleList::Arrays& arrays, size_t begin, size_t end,
                   const CapsuleList::Ray& ray, CapsuleList::Met* met) {
  return meet_capsules(arrays, begin, end, ray, met);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(meet_listed);

void CapsuleList::add(const Segment& axis, double factor) {
  const double values[8] = {
      axis.a.x, axis.a.y, axis.a.z, axis.ab.x, axis.ab.y, axis.ab.z, axis.inverse_length_squared,
      factor};
  for (size_t i = 0; i < 8; ++i) arrays_[i].push_back(values[i]);
  ++count_;
}

void CapsuleList::finish() {
  for (std::vector<double>& array : arrays_) {
    array.resize(count_ + max_simd_doubles);
    array.shrink_to_fit();
  }
}

size_t CapsuleList::meet(size_t begin, size_t end, const Ray& ray, Met* met) const {
  return HWY_DYNAMIC_DISPATCH(meet_listed)(arrays(), begin, end, ray, met);
}

}  // namespace msq
#endif  // HWY_ONCE
