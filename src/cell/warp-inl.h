// SPDX-License-Identifier: Apache-2.0
// The definition of warped cells, once for scalars and for vectors: the arithmetic A is Single or
// Lanes of expression/elementary-inl.h. Included once for each instruction set.
#if defined(MSQ_CELL_WARP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_CELL_WARP_INL_H
#undef MSQ_CELL_WARP_INL_H
#else
#define MSQ_CELL_WARP_INL_H
#endif

#include "cell/warp.h"
#include "expression/elementary-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

template <class A>
struct WarpedPlace {
  typename A::V u, v, w, radius;
};

/// v from the position across the axis.
template <class A>
HWY_INLINE typename A::V cells_around(const A& a, const Warp::Numbers& n, typename A::V x,
                                      typename A::V y) {
  const auto zero = a.set(0), count = a.set(n.count);
  auto v = a.multiply(arctangent(a, y, x), a.set(n.around));
  v = a.choose(a.less(v, zero), a.add(v, count), v);
  // A tiny negative angle is a whole turn once rounded.
  return a.choose(a.less(v, count), v, zero);
}

/// v in sheared cells.
template <class A>
HWY_INLINE typename A::V sheared(const A& a, const Warp::Numbers& n, typename A::V u,
                                 typename A::V v, typename A::V w) {
  const auto zero = a.set(0), count = a.set(n.count);
  v = a.add(v, a.add(a.multiply(u, a.set(n.shear_outwards)), a.multiply(w, a.set(n.shear_along))));
  v = a.subtract(v, a.multiply(count, a.floor(a.divide(v, count))));
  // Rounding may leave it just outside.
  v = a.choose(a.less(v, zero), zero, v);
  return a.choose(a.less(v, count), v, zero);
}

/// u from the radius.
template <class A>
HWY_INLINE typename A::V cells_outwards(const A& a, const Warp::Numbers& n, typename A::V radius) {
  return a.divide(a.subtract(radius, a.set(n.inner)), a.set(n.radial));
}

/// The radius of a position in the grid's frame, as warped_place() computes it.
template <class A>
HWY_INLINE typename A::V warped_radius(const A& a, const Warp::Numbers& n, typename A::V x,
                                       typename A::V y, typename A::V z) {
  const auto across = a.add(a.multiply(x, x), a.multiply(y, y));
  return a.root(n.is_spherical ? a.add(across, a.multiply(z, z)) : across);
}

/// Of a position in the grid's frame.
template <class A>
HWY_INLINE WarpedPlace<A> warped_place(const A& a, const Warp::Numbers& n, typename A::V x,
                                       typename A::V y, typename A::V z) {
  WarpedPlace<A> place;
  const auto across = a.add(a.multiply(x, x), a.multiply(y, y));
  place.v = cells_around(a, n, x, y);
  if (n.is_spherical) {
    place.radius = a.root(a.add(across, a.multiply(z, z)));
    const auto latitude = arctangent(a, z, a.root(across));
    const auto w = a.multiply(a.add(latitude, a.set(n.quarter_turn)), a.set(n.along));
    place.w = a.choose(a.less(w, a.set(n.last)), w, a.set(n.last));
  } else {
    place.radius = a.root(across);
    place.w = a.divide(z, a.set(n.along));
  }
  place.u = cells_outwards(a, n, place.radius);
  if (n.is_sheared) place.v = sheared(a, n, place.u, place.v, place.w);
  return place;
}

/// The position in the grid's frame, as Neighbourhood::to_grid() computes it.
template <class A>
HWY_INLINE void to_warp_frame(const A& a, const Warp::Numbers& n, typename A::V& x,
                              typename A::V& y, typename A::V& z) {
  const auto px = a.subtract(x, a.set(n.origin[0])), py = a.subtract(y, a.set(n.origin[1])),
             pz = a.subtract(z, a.set(n.origin[2]));
  const auto along = [&](int axis) HWY_ATTR {
    return a.add(
        a.add(a.multiply(a.set(n.matrix[axis]), px), a.multiply(a.set(n.matrix[3 + axis]), py)),
        a.multiply(a.set(n.matrix[6 + axis]), pz));
  };
  x = along(0);
  y = along(1);
  z = along(2);
}

/// The position in the cell, 0 to 1, along w.
template <class A>
HWY_INLINE typename A::V fraction_along(const A& a, const Warp::Numbers& n, typename A::V w) {
  const auto cell = a.floor(w);
  if (!n.is_spherical) return a.subtract(w, cell);
  const auto last = a.set(n.last - 1);
  return a.subtract(w, a.choose(a.less(cell, last), cell, last));
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
