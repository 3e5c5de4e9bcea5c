// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/warped_places.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/functional/warped_places.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "cell/warp-inl.h"
#include "expression/elementary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

void places(const Warp::Numbers& n, Values x, Values y, Values z, size_t count,
            double* const (&angles)[3], double* radii) {
  const hn::ScalableTag<double> d;
  const Lanes<hn::ScalableTag<double>> a;
  const auto load = [&](const Values& v, size_t i) HWY_ATTR {
    return v.is_uniform ? hn::Set(d, *v.data) : hn::LoadU(d, v.data + i);
  };
  const auto store = [&](auto fraction, double* to)
                         HWY_ATTR { hn::StoreU(hn::Mul(fraction, hn::Set(d, two_pi)), d, to); };
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto px = load(x, i), py = load(y, i), pz = load(z, i);
    to_warp_frame(a, n, px, py, pz);
    const auto place = warped_place(a, n, px, py, pz);
    store(hn::Sub(place.u, hn::Floor(place.u)), angles[0] + i);
    store(hn::Sub(place.v, hn::Floor(place.v)), angles[1] + i);
    store(fraction_along(a, n, place.w), angles[2] + i);
    hn::StoreU(place.radius, d, radii + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(places);

void find_warped_places(const Warp& warp, Values x, Values y, Values z, size_t count,
                        double* const (&angles)[3], double* radii) {
  HWY_DYNAMIC_DISPATCH(places)(warp.numbers(), x, y, z, count, angles, radii);
}

}  // namespace msq
#endif  // HWY_ONCE
