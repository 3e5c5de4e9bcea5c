// SPDX-License-Identifier: Apache-2.0
// Loads vectors of values that may be uniform. Included once for each instruction set.
#if defined(MSQ_EXPRESSION_LOAD_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_EXPRESSION_LOAD_INL_H
#undef MSQ_EXPRESSION_LOAD_INL_H
#else
#define MSQ_EXPRESSION_LOAD_INL_H
#endif

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

/// One value in all lanes, or the values from i on.
template <bool is_uniform, class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> load(D d, const hwy::HWY_NAMESPACE::TFromD<D>* data,
                                           size_t i) {
  return is_uniform ? hwy::HWY_NAMESPACE::Set(d, *data) : hwy::HWY_NAMESPACE::LoadU(d, data + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
