// SPDX-License-Identifier: Apache-2.0
// Vectors of three dimensions, one in each lane. dot(), cross() and add_scaled() round each
// operation as Vec3 does, so their lanes have the bits of the scalar code. The fast_ functions may
// use fused operations: only estimates use them. Included once for each instruction set.
#if defined(MSQ_BASE_LANES3_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_BASE_LANES3_INL_H
#undef MSQ_BASE_LANES3_INL_H
#else
#define MSQ_BASE_LANES3_INL_H
#endif

#include <hwy/highway.h>

#include "base/vec.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

template <class D>
struct Lanes3 {
  using V = hwy::HWY_NAMESPACE::Vec<D>;
  V x, y, z;
};

/// The same vector in each lane.
template <class D>
HWY_INLINE Lanes3<D> set_lanes(D d, Vec3 v) {
  namespace hn = hwy::HWY_NAMESPACE;
  using T = hn::TFromD<D>;
  return {hn::Set(d, static_cast<T>(v.x)), hn::Set(d, static_cast<T>(v.y)),
          hn::Set(d, static_cast<T>(v.z))};
}

/// From component by component, aligned to vectors; and back.
template <class D, size_t N>
HWY_INLINE Lanes3<D> load_lanes(D d, const hwy::HWY_NAMESPACE::TFromD<D> (&v)[3][N], size_t i) {
  namespace hn = hwy::HWY_NAMESPACE;
  return {hn::Load(d, v[0] + i), hn::Load(d, v[1] + i), hn::Load(d, v[2] + i)};
}
template <class D, size_t N>
HWY_INLINE void store_lanes(D d, const Lanes3<D>& v, hwy::HWY_NAMESPACE::TFromD<D> (&to)[3][N],
                            size_t i) {
  namespace hn = hwy::HWY_NAMESPACE;
  hn::Store(v.x, d, to[0] + i);
  hn::Store(v.y, d, to[1] + i);
  hn::Store(v.z, d, to[2] + i);
}

template <class D>
HWY_INLINE Lanes3<D> subtract(const Lanes3<D>& a, const Lanes3<D>& b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

template <class D>
HWY_INLINE Lanes3<D> scale(const Lanes3<D>& a, hwy::HWY_NAMESPACE::Vec<D> s) {
  namespace hn = hwy::HWY_NAMESPACE;
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}

template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> dot(const Lanes3<D>& a, const Lanes3<D>& b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> fast_dot(const Lanes3<D>& a, const Lanes3<D>& b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

template <class D>
HWY_INLINE Lanes3<D> cross(const Lanes3<D>& a, const Lanes3<D>& b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

/// a + b s
template <class D>
HWY_INLINE Lanes3<D> add_scaled(const Lanes3<D>& a, const Lanes3<D>& b,
                                hwy::HWY_NAMESPACE::Vec<D> s) {
  namespace hn = hwy::HWY_NAMESPACE;
  return {hn::Add(a.x, hn::Mul(b.x, s)), hn::Add(a.y, hn::Mul(b.y, s)),
          hn::Add(a.z, hn::Mul(b.z, s))};
}

template <class D>
HWY_INLINE Lanes3<D> fast_add_scaled(const Lanes3<D>& a, const Lanes3<D>& b,
                                     hwy::HWY_NAMESPACE::Vec<D> s) {
  namespace hn = hwy::HWY_NAMESPACE;
  return {hn::MulAdd(b.x, s, a.x), hn::MulAdd(b.y, s, a.y), hn::MulAdd(b.z, s, a.z)};
}

template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> clamp01(D d, hwy::HWY_NAMESPACE::Vec<D> s) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::Min(hn::Max(s, hn::Zero(d)), hn::Set(d, 1));
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
