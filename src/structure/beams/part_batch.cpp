// SPDX-License-Identifier: Apache-2.0
// part_spans-inl.h derives the bounds that are computed here.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/beams/part_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "structure/beams/part_batch.h"
#include "structure/beams/part_rows.h"
#include "structure/beams/part_spans-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace parts {

constexpr double u24 = 0x1p-24;

/// Whether lanes from i on hold parts of the batch.
template <class Batch>
HWY_INLINE auto holds_parts(D d, const Batch& batch, size_t i) {
  return hn::Lt(hn::Iota(d, static_cast<double>(i)), hn::Set(d, static_cast<double>(batch.count)));
}

/// Bound on the error of the column where a plane of slope 1 / over_x meets a row; `ur`: a unit of
/// rounding of the size of the part.
HWY_INLINE V plane_error_of(D d, V ur, V over_x, const RasterTarget& target) {
  const auto num = [&](double value) HWY_ATTR { return hn::Set(d, value); };
  const V margin = num(target.margin * target.inverse_dx);
  return with_room(hn::Add(
      hn::MulAdd(hn::MulAdd(num(26), ur, margin), hn::Abs(over_x), hn::Mul(num(4), num(u24))),
      num(target.slack)));
}

struct FrustumSetups {
  RowSetups rows;
  Floats ux, uy, uz, inverse_across;              // axis; 1 / A
  Floats radius, slope;                           // at a; K
  Floats q_factor;                                // sqrt(S) / A
  Floats scale, centre_factor;                    // sqrt(A) / S; K ux / S
  Floats max_radius;                              // Q, with room
  Floats inverse_slope, plane_step, plane_error;  // 1 / ux; length / ux
  Floats error, root_error, scaled_error, beside;

  HWY_INLINE void set(const RasterTarget& target, const FrustumBatch& batch, size_t i) {
    const D d;
    const auto num = [&](double value) HWY_ATTR { return hn::Set(d, value); };
    const V ax = hn::LoadU(d, batch.a[0] + i), ay = hn::LoadU(d, batch.a[1] + i),
            az = hn::LoadU(d, batch.a[2] + i);
    const V bx = hn::LoadU(d, batch.b[0] + i), by = hn::LoadU(d, batch.b[1] + i),
            bz = hn::LoadU(d, batch.b[2] + i);
    const V model_ra = hn::LoadU(d, batch.radius_a + i),
            model_rb = hn::LoadU(d, batch.radius_b + i);
    const V per_unit = num(target.inverse_dx), one = num(1), zero = hn::Zero(d), u = num(u24);
    const V dx = hn::Mul(hn::Sub(bx, ax), per_unit), dy = hn::Mul(hn::Sub(by, ay), per_unit),
            dz = hn::Mul(hn::Sub(bz, az), per_unit);
    const V length2 = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
    const V length = hn::Sqrt(length2), inverse_length = hn::Div(one, length);
    const V ax_x = hn::Mul(dx, inverse_length), ax_y = hn::Mul(dy, inverse_length),
            ax_z = hn::Mul(dz, inverse_length);
    const V a = hn::MulAdd(ax_y, ax_y, hn::Mul(ax_z, ax_z)), inverse = hn::Div(one, a);
    const V ra = hn::Mul(model_ra, per_unit), rb = hn::Mul(model_rb, per_unit);
    const V most = hn::Max(ra, rb), whole = hn::Add(length, most);
    const V grows = hn::Mul(hn::Sub(rb, ra), inverse_length), steep = hn::Abs(grows);
    const V along = hn::Mul(grows, ax_x);
    const V s = hn::Sub(a, hn::Mul(along, along));
    const V margin = num(target.margin * target.inverse_dx);

    auto serves = hn::And(hn::Gt(a, num(0.05)), hn::Gt(s, num(0.05)));
    serves = hn::And(serves, hn::Le(steep, one));
    serves = hn::And(serves, hn::Gt(length, hn::Mul(whole, num(1e-9))));
    serves = hn::And(serves, hn::Gt(most, hn::Mul(whole, num(1e-4))));
    serves = hn::And(serves, hn::Lt(margin, hn::Mul(most, num(1e-3))));
    const auto is_there = holds_parts(d, batch, i);
    // The discs at the ends, wider by what the margin moves points.
    const V wide = num(4 * target.margin);
    const auto low_of = [&](V from, V to, V component) HWY_ATTR {
      const V reach =
          hn::Sqrt(hn::Max(zero, hn::Sub(num(1 + 0x1p-40), hn::Mul(component, component))));
      return hn::Sub(
          hn::Min(hn::Sub(from, hn::Mul(model_ra, reach)), hn::Sub(to, hn::Mul(model_rb, reach))),
          wide);
    };
    const auto high_of = [&](V from, V to, V component) HWY_ATTR {
      return hn::Neg(low_of(hn::Neg(from), hn::Neg(to), component));
    };
    rows.set(target, ax, ay, az, low_of(ay, by, ax_y), high_of(ay, by, ax_y), low_of(az, bz, ax_z),
             high_of(az, bz, ax_z), dy, dz, hn::MulAdd(num(4), margin, most), whole, is_there,
             serves);

    // Those that are not served may be anything.
    const V s_used = hn::IfThenElse(serves, s, one), inverse_s = hn::Div(one, s_used);
    const V root_a = hn::Sqrt(a), factor = hn::Mul(hn::Sqrt(s_used), inverse);
    const V size = hn::Mul(root_a, inverse_s), to_centre = hn::Mul(along, inverse_s);
    const V reached = hn::Mul(most, hn::Add(one, hn::Div(steep, root_a)));
    const V uu = hn::Mul(u, whole), uq = hn::Mul(u, reached);
    const V r_error = hn::Add(hn::MulAdd(hn::Mul(num(26), uu), hn::Mul(steep, inverse),
                                         hn::Mul(num(3), hn::Mul(u, most))),
                              hn::MulAdd(margin, steep, margin));
    const V q_error = hn::MulAdd(hn::Mul(num(12), uu), factor, hn::Mul(num(3), uq));
    const V errors = hn::Add(r_error, q_error);
    const V squared =
        with_room(hn::Add(hn::MulAdd(hn::Mul(num(2), reached), errors, hn::Mul(errors, errors)),
                          hn::Mul(hn::Mul(num(4), uq), reached)));
    const V sums = hn::Add(hn::MulAdd(hn::Abs(to_centre), reached, hn::Mul(size, reached)),
                           hn::MulAdd(whole, inverse, one));
    const V centre_error = hn::MulAdd(hn::Abs(ax_x), hn::Mul(num(17), hn::Mul(uu, inverse)),
                                      hn::Mul(hn::Abs(to_centre), hn::MulAdd(num(3), uq, r_error)));
    const V slack = num(target.slack), over_x = parts::inverse_slope(ax_x);
    ux.set(ax_x);
    uy.set(ax_y);
    uz.set(ax_z);
    inverse_across.set(inverse);
    radius.set(ra);
    slope.set(grows);
    q_factor.set(factor);
    scale.set(size);
    centre_factor.set(to_centre);
    max_radius.set(hn::MulAdd(reached, num(1.01), r_error));
    inverse_slope.set(over_x);
    plane_step.set(hn::Mul(length, over_x));
    plane_error.set(plane_error_of(d, uu, over_x, target));
    error.set(squared);
    root_error.set(hn::Sqrt(squared));
    scaled_error.set(with_room(hn::Mul(size, squared)));
    beside.set(with_room(hn::Add(hn::MulAdd(hn::Mul(num(40), u), sums, centre_error), slack)));
  }
};

struct FrustumKernel {
  VF ux, uy, uz, inverse_across, radius, slope, q_factor, scale, centre_factor, max_radius;
  VF inverse_slope, plane_step, plane_error, origin;
  RootError error;

  HWY_INLINE FrustumKernel(const FrustumSetups& s, size_t i) {
    const F d;
    const auto set = [&](const Floats& values) HWY_ATTR { return hn::Set(d, values.of[i]); };
    ux = set(s.ux);
    uy = set(s.uy);
    uz = set(s.uz);
    inverse_across = set(s.inverse_across);
    radius = set(s.radius);
    slope = set(s.slope);
    q_factor = set(s.q_factor);
    scale = set(s.scale);
    centre_factor = set(s.centre_factor);
    max_radius = set(s.max_radius);
    inverse_slope = set(s.inverse_slope);
    plane_step = set(s.plane_step);
    plane_error = set(s.plane_error);
    origin = set(s.rows.origin);
    error.set(s.error, s.root_error, s.scaled_error, s.beside, i);
  }
  HWY_INLINE void operator()(VF v, VF w, Ends& ends) const {
    const F d;
    const VF m = hn::MulAdd(v, uy, hn::Mul(w, uz));
    const VF q = hn::Mul(hn::MulSub(v, uz, hn::Mul(w, uy)), q_factor);
    const VF g = hn::Mul(m, inverse_across), r = hn::MulAdd(slope, g, radius);
    const VF e = hn::MulSub(r, r, hn::Mul(q, q)), root = hn::Sqrt(hn::Max(e, hn::Zero(d)));
    const VF half = hn::Mul(scale, root), off = error.of_root(root);
    const VF centre = hn::MulAdd(centre_factor, r, hn::MulAdd(g, ux, origin));
    const VF one = hn::NegMulAdd(m, inverse_slope, origin), other = hn::Add(one, plane_step);
    const VF low = hn::Min(one, other), high = hn::Max(one, other);
    const VF from = hn::Sub(centre, half), to = hn::Add(centre, half);
    ends.outer_low = hn::Max(hn::Sub(from, off), hn::Sub(low, plane_error));
    ends.outer_high = hn::Min(hn::Add(to, off), hn::Add(high, plane_error));
    ends.inner_low = hn::Max(hn::Add(from, off), hn::Add(low, plane_error));
    ends.inner_high = hn::Min(hn::Sub(to, off), hn::Sub(high, plane_error));
    ends.met = hn::And(hn::Gt(e, hn::Neg(error.squared)), hn::Le(hn::Abs(r), max_radius));
    ends.sure = hn::And(hn::Gt(e, error.squared), hn::Gt(r, hn::Zero(d)));
  }
};

struct BallSetups {
  RowSetups rows;
  Floats radius2, ny, nz;
  Floats inverse_slope, plane_error;
  Indices cuts_low, cuts_high;  // whether the plane bounds the columns from that side
  Floats error, root_error, beside;

  HWY_INLINE void set(const RasterTarget& target, const BallBatch& batch, size_t i) {
    const D d;
    const auto num = [&](double value) HWY_ATTR { return hn::Set(d, value); };
    const V x = hn::LoadU(d, batch.centre[0] + i), y = hn::LoadU(d, batch.centre[1] + i),
            z = hn::LoadU(d, batch.centre[2] + i);
    const V model_r = hn::LoadU(d, batch.radius + i), thick = hn::Add(model_r, num(target.margin));
    const V out_x = hn::LoadU(d, batch.out[0] + i), out_y = hn::LoadU(d, batch.out[1] + i),
            out_z = hn::LoadU(d, batch.out[2] + i);
    const V r = hn::Mul(model_r, num(target.inverse_dx)), u = num(u24), zero = hn::Zero(d);
    const V margin = num(target.margin * target.inverse_dx), slack = num(target.slack);
    const auto serves = hn::Lt(margin, hn::Mul(r, num(1e-3)));
    const auto is_there = holds_parts(d, batch, i);
    rows.set(target, x, y, z, hn::Sub(y, thick), hn::Add(y, thick), hn::Sub(z, thick),
             hn::Add(z, thick), zero, zero, r, r, is_there, serves);
    const auto is_whole =
        hn::Eq(hn::MulAdd(out_x, out_x, hn::MulAdd(out_y, out_y, hn::Mul(out_z, out_z))), zero);
    const V over_x = parts::inverse_slope(out_x), ur = hn::Mul(u, r);
    const auto is_up = hn::Gt(over_x, zero);
    radius2.set(hn::Mul(r, r));
    ny.set(out_y);
    nz.set(out_z);
    inverse_slope.set(over_x);
    plane_error.set(plane_error_of(d, ur, over_x, target));
    cuts_low.set(hn::IfThenZeroElse(is_whole, hn::IfThenElseZero(is_up, num(1))));
    cuts_high.set(hn::IfThenZeroElse(is_whole, hn::IfThenZeroElse(is_up, num(1))));
    const V squared = with_room(hn::MulAdd(
        margin, margin, hn::MulAdd(hn::Mul(num(32), ur), r, hn::Mul(num(2), hn::Mul(r, margin)))));
    error.set(squared);
    root_error.set(hn::Sqrt(squared));
    beside.set(with_room(hn::MulAdd(num(8), hn::Add(ur, u), slack)));
  }
};

struct BallKernel {
  VF radius2, ny, nz, inverse_slope, plane_error, origin;
  bool cuts_low, cuts_high;
  RootError error;

  HWY_INLINE BallKernel(const BallSetups& s, size_t i) {
    const F d;
    const auto set = [&](const Floats& values) HWY_ATTR { return hn::Set(d, values.of[i]); };
    radius2 = set(s.radius2);
    ny = set(s.ny);
    nz = set(s.nz);
    inverse_slope = set(s.inverse_slope);
    plane_error = set(s.plane_error);
    origin = set(s.rows.origin);
    cuts_low = s.cuts_low.of[i];
    cuts_high = s.cuts_high.of[i];
    error.set(s.error, s.root_error, s.error, s.beside, i);
    error.scaled = hn::Mul(error.scaled, hn::Set(d, 1.02f));
  }
  HWY_INLINE void operator()(VF v, VF w, Ends& ends) const {
    const F d;
    const VF e = hn::Sub(radius2, hn::MulAdd(v, v, hn::Mul(w, w)));
    const VF half = hn::Sqrt(hn::Max(e, hn::Zero(d))), off = error.of_root(half);
    const VF from = hn::Sub(origin, half), to = hn::Add(origin, half);
    ends.outer_low = hn::Sub(from, off);
    ends.outer_high = hn::Add(to, off);
    ends.inner_low = hn::Add(from, off);
    ends.inner_high = hn::Sub(to, off);
    ends.met = hn::Gt(e, hn::Neg(error.squared));
    ends.sure = hn::Gt(e, error.squared);
    if (!cuts_low && !cuts_high) return;
    const VF plane = hn::NegMulAdd(hn::MulAdd(v, ny, hn::Mul(w, nz)), inverse_slope, origin);
    if (cuts_low) {
      ends.outer_low = hn::Max(ends.outer_low, hn::Sub(plane, plane_error));
      ends.inner_low = hn::Max(ends.inner_low, hn::Add(plane, plane_error));
    } else {
      ends.outer_high = hn::Min(ends.outer_high, hn::Add(plane, plane_error));
      ends.inner_high = hn::Min(ends.inner_high, hn::Sub(plane, plane_error));
    }
  }
};

/// Calls general(part) for the parts of a batch that kernels do not serve.
template <class Kernel, class Setups, class Batch, class General>
HWY_INLINE void draw_parts(const RasterTarget& target, const Batch& batch, const double* origin_z,
                           DoubtfulSpans& doubts, General&& general) {
  RowDrawing drawing(target, doubts);
  Setups setups;
  const size_t lanes = hn::Lanes(D());
  for (size_t first = 0; first < batch.count; first += lanes) {
    setups.set(target, batch, first);
    for (size_t i = 0; i < std::min(lanes, batch.count - first); ++i) {
      const size_t part = first + i;
      if (setups.rows.kernel.of[i] == RowSetups::fast)
        drawing.draw(setups.rows, i, origin_z[part], batch.number[part], Kernel(setups, i));
      else if (setups.rows.kernel.of[i] == RowSetups::general)
        general(part);
    }
  }
  drawing.finish();
}

}  // namespace parts

void draw_frustum_rows(const RasterTarget& target, const FrustumBatch& batch, const Beam* beams,
                       DoubtfulSpans& doubts) {
  parts::draw_parts<parts::FrustumKernel, parts::FrustumSetups>(
      target, batch, batch.a[2], doubts, [&](size_t part) {
        const uint32_t number = batch.number[part];
        draw_frustum(target, beams[number], number, doubts);
      });
}

void draw_ball_rows(const RasterTarget& target, const BallBatch& batch, const Beam* beams,
                    DoubtfulSpans& doubts) {
  parts::draw_parts<parts::BallKernel, parts::BallSetups>(
      target, batch, batch.centre[2], doubts, [&](size_t part) {
        const uint32_t number = batch.number[part];
        draw_ball(target, beams[number], batch.is_at_b[part], number, doubts);
      });
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(draw_frustum_rows);
HWY_EXPORT(draw_ball_rows);

void draw_frusta(const RasterTarget& target, const FrustumBatch& batch, const Beam* beams,
                 DoubtfulSpans& doubts) {
  HWY_DYNAMIC_DISPATCH(draw_frustum_rows)(target, batch, beams, doubts);
}

void draw_balls(const RasterTarget& target, const BallBatch& batch, const Beam* beams,
                DoubtfulSpans& doubts) {
  HWY_DYNAMIC_DISPATCH(draw_ball_rows)(target, batch, beams, doubts);
}

}  // namespace msq
#endif  // HWY_ONCE
