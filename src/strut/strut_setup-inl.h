// SPDX-License-Identifier: Apache-2.0
// The input of the fast kernel for each strut of a batch. It is computed for a vector of struts at
// a time in double precision and stored in single precision. Included once for each instruction
// set.
//
// Lengths are in columns, so that ends of spans are column numbers.
#if defined(MSQ_STRUT_STRUT_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUT_STRUT_SETUP_INL_H
#undef MSQ_STRUT_STRUT_SETUP_INL_H
#else
#define MSQ_STRUT_STRUT_SETUP_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "strut/raster_target.h"
#include "strut/row_order-inl.h"
#include "strut/strut_batch.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

struct StrutSetups {
  enum Kernel : int32_t { none = 0, general = 1, few = 2, fast = 3 };
  /// Maximum number of vectors of a strut of kernel `few`; half of it if they have 16 lanes or
  /// more.
  static constexpr size_t max_few = 4;
  static constexpr size_t room = StrutBatch::capacity + StrutBatch::padding;

  int32_t kernel[room];  // none: meets no row of the target
  int32_t j0[room], j1[room], k0[room], k1[room];
  RowOrders<room> order;
  int32_t column[room];                  // an integer near the end a: the origin of column numbers
  int32_t clipped[room];                 // by the first or the last column
  float first[room], last[room];         // columns of the target
  float a_column[room], b_column[room];  // of the ends
  // Linear in the place of a row: what it is at the first row, and steps in a line and from line to
  // line. If layers are anywhere, lines count by their z from a, in columns. g and k / A, see
  // fast_spans-inl.h; and y and z, from a.
  struct Steps {
    float first[room], inner[room], outer[room];
  } g, cross, v, w;
  float dy[room], dz[room];                  // from a to b
  float ux[room], length[room];              // axis
  float signed_ux2[room];                    // ux |ux|
  float across[room], inverse_across[room];  // A = uy^2 + uz^2
  float high2[room], low2[room];             // squared radii; low2 negative: no inner span
  // Of a linear radius: its gradient, its value at a, and what it may differ by along a row: a
  // number and, for each axis, a part of the distance from the strut's middle.
  float gradient[3][room], radius_a[room], departure[room], spread[3][room];
  float error[room], root_error[room], end_error[room];  // E, sqrt(E); see fast_spans-inl.h
};

/// Rows of evenly spaced values, [first, end), that may lie in [low, high]. One extra row does no
/// harm.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void index_range(D d, double start, double step, size_t count, V low, V high, V& first,
                            V& end) {
  const V zero = hn::Zero(d), most = hn::Set(d, static_cast<double>(count));
  const V from = hn::Set(d, start), inverse = hn::Set(d, 1 / step), slack = hn::Set(d, 1e-3);
  const V a = hn::Ceil(hn::Sub(hn::Mul(hn::Sub(low, from), inverse), slack));
  const V b = hn::Floor(hn::Add(hn::Mul(hn::Sub(high, from), inverse), slack));
  first = hn::Min(hn::Max(a, zero), most);
  end = hn::Min(hn::Max(hn::Add(b, hn::Set(d, 1.0)), zero), most);
}

/// The same for any ascending values.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void index_range(D d, const double* values, size_t count, V low, V high, V& first,
                            V& end) {
  HWY_ALIGN double bounds[2][max_simd_doubles];
  hn::Store(low, d, bounds[0]);
  hn::Store(high, d, bounds[1]);
  for (size_t l = 0; l < hn::Lanes(d); ++l) {
    bounds[0][l] =
        static_cast<double>(std::lower_bound(values, values + count, bounds[0][l]) - values);
    bounds[1][l] =
        static_cast<double>(std::upper_bound(values, values + count, bounds[1][l]) - values);
  }
  first = hn::Load(d, bounds[0]);
  end = hn::Load(d, bounds[1]);
}

HWY_INLINE void set_up_struts(const RasterTarget& target, const StrutBatch& batch,
                              StrutSetups& setups) {
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;
  const D d;
  const hn::Rebind<float, D> df;
  const hn::Rebind<int32_t, D> di;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const V margin = hn::Set(d, target.margin), scale = hn::Set(d, target.inverse_dx);
  const V shift = hn::Mul(margin, scale);
  constexpr double u = 0x1p-24;
  const double step = std::max(target.dy, target.dz) * target.inverse_dx;

  for (size_t i = 0; i < batch.count; i += hn::Lanes(d)) {
    const V ax = hn::LoadU(d, batch.a[0] + i), ay = hn::LoadU(d, batch.a[1] + i),
            az = hn::LoadU(d, batch.a[2] + i);
    const V bx = hn::LoadU(d, batch.b[0] + i), by = hn::LoadU(d, batch.b[1] + i),
            bz = hn::LoadU(d, batch.b[2] + i);
    const V high = hn::LoadU(d, batch.high + i), low = hn::LoadU(d, batch.low + i);
    const V thick = hn::Add(high, margin);

    V j0, j1, k0, k1;
    index_range(d, target.y[0], target.dy, target.rows, hn::Sub(hn::Min(ay, by), thick),
                hn::Add(hn::Max(ay, by), thick), j0, j1);
    const V z_low = hn::Sub(hn::Min(az, bz), thick), z_high = hn::Add(hn::Max(az, bz), thick);
    V z_first;
    if (target.dz > 0) {
      index_range(d, target.z[0], target.dz, target.layers, z_low, z_high, k0, k1);
      z_first = hn::Add(hn::Set(d, target.z[0]), hn::Mul(k0, hn::Set(d, target.dz)));
    } else {
      index_range(d, target.z, target.layers, z_low, z_high, k0, k1);
      z_first = az;  // the kernel reads it from a table
    }
    const V y_first = hn::Add(hn::Set(d, target.y[0]), hn::Mul(j0, hn::Set(d, target.dy)));

    const V dx = hn::Mul(hn::Sub(bx, ax), scale), dy = hn::Mul(hn::Sub(by, ay), scale),
            dz = hn::Mul(hn::Sub(bz, az), scale);
    const V across2 = hn::Add(hn::Mul(dy, dy), hn::Mul(dz, dz));
    const V length2 = hn::Add(across2, hn::Mul(dx, dx));
    const V length = hn::Sqrt(length2), inverse_length = hn::Div(one, length);
    const V inverse_across = hn::Div(length2, across2);
    const V r = hn::Mul(high, scale), whole = hn::Add(length, r);

    const V a_column = hn::Mul(hn::Sub(ax, hn::Set(d, target.x0)), scale);
    const V column = hn::Floor(a_column), fraction = hn::Sub(a_column, column);
    const V b_column = hn::Add(fraction, dx);

    // See fast_spans-inl.h.
    const V across_error = hn::Mul(hn::Mul(whole, r), hn::Set(d, 44 * u));
    const V ru = hn::Mul(whole, hn::Set(d, 17 * u)), both = hn::Add(ru, shift);
    const V squared_error =
        hn::Mul(inverse_across, hn::MulAdd(inverse_across, hn::MulAdd(both, both, across_error),
                                           hn::Mul(hn::Set(d, 2.0), hn::Mul(r, shift))));
    const V along = hn::Abs(hn::Mul(dx, inverse_length));
    const V choices =
        batch.linear ? hn::Set(d, 4.0)
                     : hn::IfThenElse(hn::Gt(length2, hn::Mul(squared_error, hn::Set(d, 16.0))),
                                      hn::Set(d, 2.0), hn::Set(d, 4.0));
    const V choice = hn::MulAdd(hn::Mul(choices, along),
                                hn::MulAdd(along, hn::Set(d, 1.05), hn::Set(d, 0.95)), one);
    // If the radius is linear, its value at a sample and its bounds have an error, too.
    const V room = hn::Mul(choice, hn::Set(d, batch.linear ? 2.0 : 1.0));
    const V error = hn::Mul(squared_error, room);
    const V end_error = hn::MulAdd(hn::Set(d, 33 * u), hn::MulAdd(whole, inverse_across, one),
                                   hn::Set(d, target.slack));

    const V reach = hn::Add(hn::Add(r, shift), one);
    // Also if overflow leads to NaN.
    const auto before = hn::Lt(hn::Add(hn::Max(a_column, hn::Add(a_column, dx)), reach), zero);
    const auto beyond =
        hn::Gt(hn::Sub(hn::Min(a_column, hn::Add(a_column, dx)), reach), hn::Set(d, target.last));
    const auto meets = hn::AndNot(hn::Or(before, beyond), hn::And(hn::Lt(j0, j1), hn::Lt(k0, k1)));
    // Not nearly along x, not points, not needles; and grids neither so fine nor so coarse that
    // single precision overflows.
    auto serves = hn::Lt(inverse_across, hn::Set(d, 20.0));
    serves = hn::And(serves, hn::Gt(length, hn::Mul(whole, hn::Set(d, 1e-9))));
    serves = hn::And(serves, hn::Gt(r, hn::Mul(whole, hn::Set(d, 1e-4))));
    serves = hn::And(serves, hn::Lt(shift, hn::Mul(r, hn::Set(d, 1e-3))));
    serves = hn::And(serves, hn::Gt(hn::Mul(whole, hn::Set(d, 1e6)), hn::Set(d, step)));
    serves = hn::And(serves, hn::Gt(whole, hn::Set(d, 1e-6)));
    serves = hn::And(serves, hn::Lt(whole, hn::Set(d, 65536.0)));
    serves = hn::And(serves, hn::Lt(hn::Abs(column), hn::Set(d, 0x1p30)));
    const V v = hn::Mul(hn::Sub(y_first, ay), scale), w = hn::Mul(hn::Sub(z_first, az), scale);
    RowOrder<D> order(d, target, hn::Sub(j1, j0), hn::Sub(k1, k0));
    order.follow_axis(d, target, v, w, dy, dz, hn::Add(r, shift));
    serves = hn::And(serves, order.fits(d));
    const double most =
        hn::Lanes(FullLanes()) < 16 ? StrutSetups::max_few : StrutSetups::max_few / 2;
    const auto is_few = hn::Le(order.vectors(d), hn::Set(d, most));
    const auto fast = hn::IfThenElse(is_few, hn::Set(d, double{StrutSetups::few}),
                                     hn::Set(d, double{StrutSetups::fast}));
    V kernel = hn::Set(d, double{StrutSetups::general});
    if (RowOrder<D>::fits(target)) kernel = hn::IfThenElse(serves, fast, kernel);
    kernel = hn::IfThenElseZero(meets, kernel);
    const V least = hn::Sub(hn::Min(a_column, hn::Add(a_column, dx)), reach);
    const V greatest = hn::Add(hn::Max(a_column, hn::Add(a_column, dx)), reach);
    const auto clipped = hn::Or(hn::Lt(least, zero), hn::Gt(greatest, hn::Set(d, target.last)));

    const auto put = [&](V value, float* out) { hn::StoreU(hn::DemoteTo(df, value), df, out + i); };
    const auto put_index = [&](V value, int32_t* out) {
      hn::StoreU(hn::DemoteTo(di, value), di, out + i);
    };
    const V bound = hn::Set(d, 0x1p23);
    const auto near = [&](V value) { return hn::Min(hn::Max(value, hn::Neg(bound)), bound); };
    put_index(kernel, setups.kernel);
    setups.order.set(d, target, order, i);
    put_index(hn::IfThenElseZero(clipped, one), setups.clipped);
    put_index(j0, setups.j0);
    put_index(j1, setups.j1);
    put_index(k0, setups.k0);
    put_index(k1, setups.k1);
    put_index(hn::Min(hn::Max(column, hn::Set(d, -0x1p30)), hn::Set(d, 0x1p30)), setups.column);
    put(fraction, setups.a_column);
    put(b_column, setups.b_column);
    put(near(hn::Neg(column)), setups.first);
    put(near(hn::Sub(hn::Set(d, target.last), column)), setups.last);
    const V ux = hn::Mul(dx, inverse_length);
    put(ux, setups.ux);
    put(hn::Mul(ux, along), setups.signed_ux2);
    put(length, setups.length);
    put(hn::Mul(across2, hn::Mul(inverse_length, inverse_length)), setups.across);
    put(inverse_across, setups.inverse_across);
    const V along_of_y = hn::Mul(hn::Mul(dy, inverse_length), inverse_across),
            along_of_z = hn::Mul(hn::Mul(dz, inverse_length), inverse_across);
    const double row_step = target.dy * target.inverse_dx,
                 layer_step = target.dz > 0 ? target.dz * target.inverse_dx : 1;
    const auto put_steps = [&](V of_y, V of_z, StrutSetups::Steps& out) {
      const auto at = [&](V y, V z) { return hn::MulAdd(of_y, y, hn::Mul(of_z, z)); };
      put(at(v, w), out.first);
      put(at(order.either(d, row_step, 0), order.either(d, 0, layer_step)), out.inner);
      put(at(order.either(d, 0, row_step), order.either(d, layer_step, 0)), out.outer);
    };
    put_steps(along_of_y, along_of_z, setups.g);
    put_steps(along_of_z, hn::Neg(along_of_y), setups.cross);
    put(hn::Mul(r, r), setups.high2);
    const V thin = hn::Mul(low, scale);
    put(hn::IfThenElse(hn::Gt(thin, zero), hn::Mul(thin, thin), hn::Set(d, -1.0)), setups.low2);
    put(hn::Mul(error, hn::Set(d, 1.01)), setups.error);
    put(hn::Sqrt(hn::Mul(error, hn::Set(d, 1.01))), setups.root_error);
    put(end_error, setups.end_error);
    if (!batch.linear) continue;
    put_steps(one, zero, setups.v);
    put_steps(zero, one, setups.w);
    put(dy, setups.dy);
    put(dz, setups.dz);
    const V generously = hn::Set(d, 1.01);
    const V along_row = hn::Mul(r, hn::Sqrt(inverse_across));
    const V slopes =
        hn::Add(hn::Abs(hn::LoadU(d, batch.gradient[0] + i)), hn::LoadU(d, batch.spread[0] + i));
    const V departure =
        hn::MulAdd(hn::LoadU(d, batch.departure + i), scale, hn::Mul(along_row, slopes));
    put(hn::Mul(hn::LoadU(d, batch.at_a + i), scale), setups.radius_a);
    put(hn::Mul(departure, generously), setups.departure);
    for (size_t axis = 0; axis < 3; ++axis) {
      put(hn::LoadU(d, batch.gradient[axis] + i), setups.gradient[axis]);
      put(hn::Mul(hn::LoadU(d, batch.spread[axis] + i), generously), setups.spread[axis]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
