// SPDX-License-Identifier: Apache-2.0
// An edge from a to b, both as vectors from p, contributes a x b F to the gradient of 4 pi w, with
// F = (1 / |a| + 1 / |b|) / Q and Q = |a| |b| + a b. As p moves, a x b changes by (b - a) x dp,
// which is across dp: in the quadratic form of second derivatives only the change of F counts. The
// third derivative is at most the integral of 6 |dl| / |r|^4: 6 L / d^4, nor more than 3 pi / d^3,
// that of the whole line. The derivatives of 4 pi S are the negative ones of 4 pi w.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/loop_expansions.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "base/lanes3-inl.h"
#include "base/pi.h"
#include "base/simd.h"
#include "shape/half_angles-inl.h"
#include "shape/half_angles.h"
#include "shape/loop_expansions.h"
#include "shape/triangle_rows.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using Vector = Lanes3<D>;

/// As boundary_loops.cpp has it, except that u, y and z are 0 where a vertex is beyond p on its
/// row.
struct CornerLanes {
  Vector way;
  V size, u, y, z;
};

HWY_INLINE CornerLanes corner(D d, Vec3 vertex, const Vector& p, double scale) {
  const V by = hn::Set(d, scale);
  // For equal coordinates -0: the vertex is the lower one.
  const Vector way{
      hn::Mul(hn::Sub(hn::Set(d, vertex.x), p.x), by),
      hn::Neg(hn::Mul(hn::Sub(p.y, hn::Set(d, vertex.y)), by)),
      hn::Neg(hn::Mul(hn::Sub(p.z, hn::Set(d, vertex.z)), by)),
  };
  const V across = hn::MulAdd(way.y, way.y, hn::Mul(way.z, way.z));
  const V size = hn::Sqrt(hn::MulAdd(way.x, way.x, across));
  const auto is_before = hn::Le(way.x, hn::Zero(d));
  const V factor = hn::IfThenElse(is_before, hn::Set(d, 1.0), hn::Add(size, way.x));
  const V u = hn::IfThenElse(is_before, hn::Sub(size, way.x), across);
  return {way, size, u, hn::Mul(way.y, factor), hn::Mul(way.z, factor)};
}

/// Of some balls, one in each lane.
struct Sums {
  D d;
  Vector p;
  V radius;
  HalfAngleLanes<D> angles;
  V error, third;
  Vector first;
  V second[6];
  hn::Mask<D> is_known;
  double x[max_simd_doubles], y[max_simd_doubles], z[max_simd_doubles], turns[max_simd_doubles];

  Sums(D of, const Ball* balls, size_t count, double scale);
  HWY_INLINE void add_turns(Vec3 from, Vec3 to, V im);
  HWY_INLINE void add_edge(Vec3 from, Vec3 to, const CornerLanes& start, const CornerLanes& end,
                           const LoopEdges& edges);
  void write(size_t count, Expansion* made) const;
};

Sums::Sums(D of, const Ball* balls, size_t count, double scale)
    : d(of),
      angles(of),
      error(hn::Zero(of)),
      third(hn::Zero(of)),
      first(set_lanes(of, {})),
      is_known(hn::Eq(error, error)) {
  double radii[max_simd_doubles];
  for (size_t i = 0; i < hn::Lanes(d); ++i) {
    const Ball& ball = balls[std::min(i, count - 1)];
    x[i] = ball.centre.x;
    y[i] = ball.centre.y;
    z[i] = ball.centre.z;
    radii[i] = ball.radius * scale;
    turns[i] = 0;
  }
  p = {hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z)};
  radius = hn::LoadU(d, radii);
  for (V& factor : second) factor = hn::Zero(d);
}

// If the edge is beyond a point, the row rule decides on which side of it the point is.
HWY_INLINE void Sums::add_turns(Vec3 from, Vec3 to, V im) {
  const bool is_up = from.z <= to.z;
  const Vec3 &low = is_up ? from : to, &high = is_up ? to : from;
  const auto crosses = hn::And(hn::Le(hn::Set(d, low.z), p.z), hn::Lt(p.z, hn::Set(d, high.z)));
  if (hn::AllFalse(d, crosses)) return;
  double of_im[max_simd_doubles];
  hn::StoreU(im, d, of_im);
  for (size_t i = 0; i < hn::Lanes(d); ++i) {
    if (!(low.z <= z[i] && z[i] < high.z)) continue;
    const PlanePoint crossing = cross_edge(low, high, z[i]);
    if (!(crossing.x > x[i])) continue;
    const bool is_negative = is_up == (crossing.y <= y[i]);
    if (std::signbit(of_im[i]) != is_negative) turns[i] += is_negative ? -1 : 1;
  }
}

HWY_INLINE void Sums::add_edge(Vec3 from, Vec3 to, const CornerLanes& start, const CornerLanes& end,
                               const LoopEdges& edges) {
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0), two = hn::Set(d, 2.0);
  const Vec3 step = (to - from) * edges.scale;
  const double length_of_step = length(step), squared = dot(step, step);
  const Vector along = set_lanes(d, step);
  const Vector &a = start.way, &b = end.way;

  const V im = hn::Sub(hn::Mul(start.y, end.z), hn::Mul(start.z, end.y));
  const V re = hn::MulAdd(start.u, end.u, hn::MulAdd(start.y, end.y, hn::Mul(start.z, end.z)));
  angles.add(d, re, im);
  add_turns(from, to, im);

  const V t = clamp01(d, hn::Mul(fast_dot(a, along), hn::Set(d, squared > 0 ? -1 / squared : 0)));
  const Vector nearest = fast_add_scaled(a, along, t);
  const V distance =
      hn::Sub(hn::Sqrt(fast_dot(nearest, nearest)),
              hn::Mul(hn::Set(d, 0x1p-47), hn::Add(start.size, hn::Set(d, length_of_step))));
  const V q = hn::MulAdd(start.size, end.size, fast_dot(a, b));
  const auto is_apart = hn::Gt(hn::Min(start.u, end.u), hn::Set(d, 0x1p-300));
  is_known =
      hn::And(is_known,
              hn::And(hn::And(hn::Gt(distance, hn::Mul(two, radius)), hn::Gt(q, zero)), is_apart));

  const Vector across = cross(a, along);
  const V of_a = hn::Div(one, start.size), of_b = hn::Div(one, end.size), of_q = hn::Div(one, q);
  const V f = hn::Mul(hn::Add(of_a, of_b), of_q);
  const V of_first =
      hn::MulAdd(hn::Mul(of_a, of_a), of_a, hn::MulAdd(hn::Mul(f, end.size), of_a, f));
  const V of_second =
      hn::MulAdd(hn::Mul(of_b, of_b), of_b, hn::MulAdd(hn::Mul(f, start.size), of_b, f));
  const Vector slope =
      fast_add_scaled(scale(a, hn::Mul(of_q, of_first)), b, hn::Mul(of_q, of_second));
  first = fast_add_scaled(first, across, f);
  second[0] = hn::MulAdd(across.x, slope.x, second[0]);
  second[1] = hn::MulAdd(across.y, slope.y, second[1]);
  second[2] = hn::MulAdd(across.z, slope.z, second[2]);
  second[3] = hn::MulAdd(across.x, slope.y, hn::MulAdd(across.y, slope.x, second[3]));
  second[4] = hn::MulAdd(across.x, slope.z, hn::MulAdd(across.z, slope.x, second[4]));
  second[5] = hn::MulAdd(across.y, slope.z, hn::MulAdd(across.z, slope.y, second[5]));

  const V size = hn::Set(d, length_of_step);
  const V inverse = hn::Div(one, distance), part = hn::Mul(size, inverse);
  const V in_ball = hn::Div(one, hn::Sub(distance, radius));
  const V of_slope = hn::Mul(hn::Min(part, two), inverse);
  third = hn::MulAdd(hn::Min(hn::Mul(hn::Set(d, 6 * length_of_step), in_ball), hn::Set(d, 3 * pi)),
                     hn::Mul(hn::Mul(in_ball, in_ball), in_ball), third);
  // What is lost in these sums and, at half the distance, in BoundaryLoops::turns().
  const V lost = hn::Mul(hn::Mul(hn::Set(d, 0x1p-42), hn::MulAdd(part, part, one)), radius);
  error =
      hn::Add(error, hn::MulAdd(hn::Set(d, 0x1p-44), hn::Add(part, one),
                                hn::Mul(of_slope, hn::Add(hn::Set(d, 8 * edges.rounding), lost))));
}

void Sums::write(size_t count, Expansion* made) const {
  constexpr double factor = 1 / (4 * pi);
  const auto store = [&](V of, auto&& use) HWY_ATTR {
    double stored[max_simd_doubles];
    hn::StoreU(of, d, stored);
    for (size_t i = 0; i < count; ++i) use(made[i], stored[i]);
  };
  const V cube = hn::Mul(hn::Mul(radius, radius), radius);
  const V off = hn::MulAdd(third, hn::Mul(cube, hn::Set(d, (1 + 0x1p-40) / 6)), error);
  store(off, [](Expansion& of, double got) { of.error = got * factor; });
  store(hn::IfThenElseZero(is_known, hn::Set(d, 1.0)),
        [](Expansion& of, double got) { of.is_known = got != 0; });
  store(first.x, [](Expansion& of, double got) { of.first.x = -got * factor; });
  store(first.y, [](Expansion& of, double got) { of.first.y = -got * factor; });
  store(first.z, [](Expansion& of, double got) { of.first.z = -got * factor; });
  for (size_t k = 0; k < 6; ++k)
    store(second[k], [k](Expansion& of, double got) { of.second[k] = -0.5 * got * factor; });
  double re[max_simd_doubles], im[max_simd_doubles], passed[max_simd_doubles];
  hn::StoreU(angles.re, d, re);
  hn::StoreU(angles.im, d, im);
  hn::StoreU(angles.turns, d, passed);
  for (size_t i = 0; i < count; ++i) {
    made[i].turns = 0;
    if (!made[i].is_known) continue;  // there may be no numbers
    const HalfAngles sum(re[i], im[i], static_cast<int64_t>(passed[i] + turns[i]));
    made[i].turns = static_cast<double>(sum.turns()) + sum.rest() / (2 * pi);
  }
}

void expand_balls(const LoopEdges& edges, const Ball* balls, size_t count, Expansion* made) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  for (size_t begin = 0; begin < count; begin += lanes) {
    const size_t size = std::min(lanes, count - begin);
    Sums sums(d, balls + begin, size, edges.scale);
    for (size_t loop = 0; loop < edges.loops; ++loop) {
      const Vec3* const from = edges.vertices + edges.starts[loop];
      const Vec3* const to = edges.vertices + edges.starts[loop + 1];
      const CornerLanes first = corner(d, *from, sums.p, edges.scale);
      CornerLanes last = first;
      for (const Vec3* v = from + 1; v != to; ++v) {
        const CornerLanes next = corner(d, *v, sums.p, edges.scale);
        sums.add_edge(v[-1], *v, last, next, edges);
        last = next;
      }
      sums.add_edge(to[-1], *from, last, first, edges);
    }
    sums.write(size, made + begin);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(expand_balls);

void expand_loops(const LoopEdges& edges, const Ball* balls, size_t count, Expansion* made) {
  HWY_DYNAMIC_DISPATCH(expand_balls)(edges, balls, count, made);
}

}  // namespace msq
#endif  // HWY_ONCE
