// SPDX-License-Identifier: Apache-2.0
// Let x(s) = D s + R s^2 + E be the change of an operand, |D| <= steep, |R| <= bend, |E| <= error
// and S the span. Then |x - E| <= X s with X = steep + bend S, and |x| <= X S + error, its reach.
//
// A smooth operation f gives f(v) + f'(v) x + f''(.) x^2 / 2. With q a bound of |f''| / 2 over the
// reach, and x^2 <= X^2 s^2 + 2 X S error + error^2, this is the same form again. For a product, x
// y <= X Y s^2 + X S error_y + Y S error_x + error_x error_y. A maximum is at least the operand
// that begins as the larger one. It is at most the other operand, v - gap + D s, where that begins
// lower by a gap: v - gap + D s <= v + (D - gap / S) s, as s <= S.
//
// Errors include two roundings. That of the evaluator is 2^-53 of a result's magnitude, and 2^-50
// for functions. That of these bounds is less than 2^-50 of the magnitude of their terms.
// Coordinates may run on into the next cells, where the evaluator's coordinates begin anew. There,
// nodes that repeat have the same values up to rounding, and nodes that grow round as their largest
// values do.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "expression/ray_bounds.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "expression/elementary-inl.h"
#include "expression/ray_bounds.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

/// Arrays of a register.
enum : size_t { value_array, low_array, high_array, bend_array, error_array, arrays };
constexpr size_t stride = arrays * RayBatch::lanes;

template <bool is_smooth>
class Kernel {
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;

  struct Part {
    V v, low, high, bend, error;
  };

 public:
  Kernel(const double* span, double* registers, double* waves)
      : span_(span), registers_(registers), waves_(waves) {}

  void HWY_INLINE run(const RayProgram::Instruction& instruction, size_t count) {
    const double* const a = registers_ + instruction.a * stride;
    const double* const b = registers_ + instruction.b * stride;
    double* const to = registers_ + instruction.to * stride;
    double* const waves = waves_ + instruction.waves * 2 * RayBatch::lanes;
    const bool is_first = instruction.is_first;
    const V rounding = set(instruction.rounding);
    with_op(instruction.op, [&](auto which) HWY_ATTR {
      run_op<decltype(which)::value>(span_, a, b, waves, is_first, rounding, count, to);
    });
  }

 private:
  static constexpr D d{};
  static constexpr Lanes<D> lanes{};

  static HWY_INLINE V set(double v) { return hn::Set(d, v); }

  /// Takes its arguments by value: vectors that it stores could be those of a lambda's captures.
  template <Op op>
  static HWY_INLINE void run_op(const double* spans, const double* a, const double* b,
                                double* waves, bool is_first, V rounding, size_t count,
                                double* to) {
    for (size_t i = 0; i < count; i += hn::Lanes(d)) {
      const V span = hn::Load(d, spans + i);
      const Part p = load(a + i);
      Part out;
      if constexpr (op == Op::sine || op == Op::cosine) {
        if (is_first) {
          hn::Store(sine(lanes, p.v, 0), d, waves + i);
          hn::Store(sine(lanes, p.v, 1), d, waves + RayBatch::lanes + i);
        }
        const V s = hn::Load(d, waves + i), c = hn::Load(d, waves + RayBatch::lanes + i);
        out = op == Op::sine ? wave(p, span, s, c) : wave(p, span, c, hn::Neg(s));
      } else if constexpr (has_one_operand(op)) {
        out = of_one<op>(p, span);
      } else {
        out = of_two<op>(p, load(b + i), span);
      }
      out.error = hn::Add(out.error, rounding);
      store(out, to + i);
    }
  }

  static HWY_INLINE Part load(const double* from) {
    Part p;
    p.v = hn::Load(d, from + value_array * RayBatch::lanes);
    p.low = hn::Load(d, from + low_array * RayBatch::lanes);
    p.high = is_smooth ? p.low : hn::Load(d, from + high_array * RayBatch::lanes);
    p.bend = hn::Load(d, from + bend_array * RayBatch::lanes);
    p.error = hn::Load(d, from + error_array * RayBatch::lanes);
    return p;
  }
  static HWY_INLINE void store(const Part& p, double* to) {
    hn::Store(p.v, d, to + value_array * RayBatch::lanes);
    hn::Store(p.low, d, to + low_array * RayBatch::lanes);
    if (!is_smooth) hn::Store(p.high, d, to + high_array * RayBatch::lanes);
    hn::Store(p.bend, d, to + bend_array * RayBatch::lanes);
    hn::Store(p.error, d, to + error_array * RayBatch::lanes);
  }

  static HWY_INLINE V steep(const Part& p) {
    return is_smooth ? hn::Abs(p.low) : hn::Max(hn::Abs(p.low), hn::Abs(p.high));
  }
  /// The X defined above.
  static HWY_INLINE V spread(const Part& p, V span) {
    return hn::Add(steep(p), hn::Mul(p.bend, span));
  }

  static HWY_INLINE void scale_slope(const Part& p, V by, Part& out) {
    out.low = hn::Mul(by, p.low);
    if (is_smooth) return;
    const V other = hn::Mul(by, p.high);
    out.high = hn::Max(out.low, other);
    out.low = hn::Min(out.low, other);
  }

  /// v: f(v); slope: f'(v); half: a bound of |f''| / 2 over the reach.
  static HWY_INLINE Part smooth(const Part& p, V span, V v, V slope, V half, V rounding) {
    Part out;
    out.v = v;
    scale_slope(p, slope, out);
    const V x = spread(p, span), size = hn::Abs(slope);
    out.bend = hn::Add(hn::Mul(size, p.bend), hn::Mul(half, hn::Mul(x, x)));
    const V twice = hn::Add(hn::Mul(set(2), hn::Mul(x, span)), p.error);
    out.error = hn::Add(hn::Mul(p.error, hn::Add(size, hn::Mul(half, twice))), rounding);
    return out;
  }

  static HWY_INLINE Part wave(const Part& p, V span, V v, V slope) {
    const V reach = hn::Add(hn::Mul(spread(p, span), span), p.error);
    // The second derivative is minus the wave itself.
    const V most = hn::Min(set(1), hn::Add(hn::Abs(v), reach));
    const V rounding = hn::Mul(set(0x1p-48), hn::Add(set(1), reach));
    // Larger sines have no accuracy.
    const auto is_known = hn::Lt(hn::Add(hn::Abs(p.v), reach), set(0x1p19));
    const V half = hn::IfThenElse(is_known, hn::Mul(set(0.5 * (1 + 0x1p-45)), most),
                                  set(std::numeric_limits<double>::infinity()));
    return smooth(p, span, v, slope, half, rounding);
  }

  /// Returns `half` if `least`, a lower bound of the operand on the piece, is positive; otherwise
  /// infinity: nothing is known.
  static HWY_INLINE V unless_positive(V least, V half) {
    return hn::IfThenElse(hn::Gt(least, hn::Zero(d)), half,
                          set(std::numeric_limits<double>::infinity()));
  }

  static HWY_INLINE Part inverse(const Part& p, V span) {
    const V reach = hn::Add(hn::Mul(spread(p, span), span), p.error);
    const V least = hn::Mul(set(1 - 0x1p-45), hn::Sub(hn::Abs(p.v), reach));
    const V v = hn::Div(set(1), p.v);
    const V slope = hn::Neg(hn::Mul(v, v));
    const V half = hn::Div(set(1), hn::Mul(least, hn::Mul(least, least)));
    const V rounding = hn::Mul(set(0x1p-48), hn::Add(hn::Abs(v), hn::Mul(hn::Mul(v, v), reach)));
    return smooth(p, span, v, slope, unless_positive(least, half), rounding);
  }

  /// The larger or the smaller of two.
  template <Op op>
  static HWY_INLINE Part extreme(const Part& p, const Part& q, V span) {
    constexpr bool is_max = op == Op::maximum;
    const auto is_p = is_max ? hn::Gt(p.v, q.v) : hn::Lt(p.v, q.v);
    const auto choose = [&](V a, V b) HWY_ATTR { return hn::IfThenElse(is_p, a, b); };
    const Part w{choose(p.v, q.v), choose(p.low, q.low), choose(p.high, q.high),
                 choose(p.bend, q.bend), choose(p.error, q.error)};
    const Part l{choose(q.v, p.v), choose(q.low, p.low), choose(q.high, p.high),
                 choose(q.bend, p.bend), choose(q.error, p.error)};
    const V gap = hn::Mul(set(1 - 0x1p-50), hn::Abs(hn::Sub(w.v, l.v)));
    const V reaches = hn::Add(hn::Mul(hn::Add(spread(w, span), spread(l, span)), span),
                              hn::Add(w.error, l.error));
    const V fall = hn::Div(gap, span);
    Part both = w;
    if (is_max)
      both.high = hn::Max(w.high, hn::Sub(l.high, fall));
    else
      both.low = hn::Min(w.low, hn::Add(l.low, fall));
    // NaN if either is NaN, or if nothing is known of it.
    const V unknown = hn::Mul(hn::Zero(d), hn::Add(gap, hn::Add(w.bend, l.bend)));
    both.bend = hn::Add(hn::Max(w.bend, l.bend), unknown);
    both.error =
        hn::Add(hn::Max(w.error, l.error), hn::Mul(set(0x1p-48), hn::Add(hn::Abs(w.v), reaches)));
    const auto is_decided = hn::Gt(gap, reaches);
    return {result<op>(lanes, p.v, q.v), hn::IfThenElse(is_decided, w.low, both.low),
            hn::IfThenElse(is_decided, w.high, both.high),
            hn::IfThenElse(is_decided, w.bend, both.bend),
            hn::IfThenElse(is_decided, w.error, both.error)};
  }

  /// How far an operand may be from its value at the start, on the piece.
  static HWY_INLINE V reach_of(const Part& p, V span) {
    return hn::Mul(set(1 + 0x1p-45), hn::Add(hn::Mul(spread(p, span), span), p.error));
  }

  /// A value that does not change if `is_known`; otherwise nothing is known.
  template <class M>
  static HWY_INLINE Part step(V v, M is_known) {
    const V zero = hn::Zero(d);
    const V bend = hn::IfThenElse(is_known, zero, set(std::numeric_limits<double>::infinity()));
    return {v, zero, zero, bend, zero};
  }

  static HWY_INLINE Part floor_of(const Part& p, V span, V v) {
    const V reach = hn::Add(reach_of(p, span), hn::Mul(set(0x1p-50), hn::Abs(p.v)));
    return step(v, hn::Eq(hn::Floor(hn::Sub(p.v, reach)), hn::Floor(hn::Add(p.v, reach))));
  }

  static HWY_INLINE Part less(const Part& p, const Part& q, V span, V v) {
    const V gap = hn::Mul(set(1 - 0x1p-50), hn::Abs(hn::Sub(p.v, q.v)));
    return step(v, hn::Gt(gap, hn::Add(reach_of(p, span), reach_of(q, span))));
  }

  /// q where the choice p stays above 1/2 (`is_keep`), or not above.
  template <bool is_keep>
  static HWY_INLINE Part kept(const Part& p, const Part& q, V span, V v) {
    const V half = set(0.5), reach = reach_of(p, span);
    const auto is_above = hn::Gt(hn::Mul(set(1 - 0x1p-50), hn::Sub(p.v, half)), reach);
    const auto is_below = hn::Gt(hn::Mul(set(1 - 0x1p-50), hn::Sub(half, p.v)), reach);
    const auto is_kept = is_keep ? is_above : is_below;
    Part out = step(v, is_keep ? is_below : is_above);
    out.low = hn::IfThenElse(is_kept, q.low, out.low);
    out.high = hn::IfThenElse(is_kept, q.high, out.high);
    out.bend = hn::IfThenElse(is_kept, q.bend, out.bend);
    out.error = hn::IfThenElse(is_kept, q.error, out.error);
    return out;
  }

  /// f(p, q) with the slopes a and b at the start, and `half` a bound of half of the norm of its
  /// second derivatives over the reach.
  static HWY_INLINE Part of_plane(const Part& p, const Part& q, V span, V v, V a, V b, V half,
                                  V rounding) {
    Part out, r;
    out.v = v;
    scale_slope(p, a, out);
    scale_slope(q, b, r);
    out.low = hn::Add(out.low, r.low);
    if (!is_smooth) out.high = hn::Add(out.high, r.high);
    const V x = spread(p, span), y = spread(q, span);
    out.bend = hn::Add(hn::Add(hn::Mul(hn::Abs(a), p.bend), hn::Mul(hn::Abs(b), q.bend)),
                       hn::Mul(half, hn::Add(hn::Mul(x, x), hn::Mul(y, y))));
    const auto of_error = [&](V slope, const Part& part, V spread) HWY_ATTR {
      const V twice = hn::Add(hn::Mul(set(2), hn::Mul(spread, span)), part.error);
      return hn::Mul(part.error, hn::Add(hn::Abs(slope), hn::Mul(half, twice)));
    };
    out.error = hn::Add(hn::Add(of_error(a, p, x), of_error(b, q, y)), rounding);
    return out;
  }

  /// The second derivatives of the distance r from the origin have the norm 1 / r. Near the origin
  /// it changes by no more than the operands do.
  static HWY_INLINE Part hypotenuse(const Part& p, const Part& q, V span, V v) {
    const V reach = hn::Add(reach_of(p, span), reach_of(q, span));
    const V least = hn::Mul(set(1 - 0x1p-45), hn::Sub(v, reach));
    const V rounding = hn::Add(hn::Mul(set(0x1p-47), hn::Add(v, reach)), set(0x1p-500));
    const auto is_apart = hn::Gt(least, set(0x1p-400));
    const V by = hn::IfThenElse(is_apart, v, set(1));
    const V half = hn::Div(set(0.5 * (1 + 0x1p-45)), hn::IfThenElse(is_apart, least, set(1)));
    Part out = of_plane(p, q, span, v, hn::Div(p.v, by), hn::Div(q.v, by), half, rounding);
    const V all = hn::Mul(set(1 + 0x1p-45), hn::Add(steep(p), steep(q)));
    out.low = hn::IfThenElse(is_apart, out.low, hn::Neg(all));
    if (!is_smooth) out.high = hn::IfThenElse(is_apart, out.high, all);
    out.bend = hn::IfThenElse(is_apart, out.bend, hn::Add(p.bend, q.bend));
    out.error = hn::IfThenElse(is_apart, out.error, hn::Add(hn::Add(p.error, q.error), rounding));
    return out;
  }

  /// The angle of (q, p). Its slopes are 1 / r, its second derivatives have the norm 1 / r^2.
  static HWY_INLINE Part arctangent(const Part& p, const Part& q, V span, V v) {
    const V square = hn::Add(hn::Mul(p.v, p.v), hn::Mul(q.v, q.v));
    const V reach_p = reach_of(p, span), reach_q = reach_of(q, span);
    const V reach = hn::Add(reach_p, reach_q);
    const V least = hn::Mul(set(1 - 0x1p-45), hn::Sub(hn::Sqrt(square), reach));
    // Off the negative axis, where the angle jumps, and the origin.
    const auto is_clear = hn::Or(hn::Gt(q.v, reach_q), hn::Gt(hn::Abs(p.v), reach_p));
    const auto is_known = hn::And(is_clear, hn::Gt(least, set(0x1p-400)));
    const V half = hn::IfThenElse(is_known, hn::Div(set(0.5), hn::Mul(least, least)),
                                  set(std::numeric_limits<double>::infinity()));
    const V rounding = hn::Mul(set(0x1p-47), hn::Add(set(4), hn::Div(reach, least)));
    return of_plane(p, q, span, v, hn::Div(q.v, square), hn::Neg(hn::Div(p.v, square)), half,
                    rounding);
  }

  static HWY_INLINE Part negated(const Part& p) {
    return {hn::Neg(p.v), hn::Neg(p.high), hn::Neg(p.low), p.bend, p.error};
  }

  template <Op op>
  static HWY_INLINE Part of_one(const Part& p, V span) {
    if constexpr (op == Op::negate) return negated(p);
    if constexpr (op == Op::absolute) {
      Part out = extreme<Op::maximum>(p, negated(p), span);
      out.v = result<op>(lanes, p.v, p.v);
      return out;
    }
    const V v = result<op>(lanes, p.v, p.v);
    if constexpr (op == Op::floor) return floor_of(p, span, v);
    const V reach = hn::Add(hn::Mul(spread(p, span), span), p.error);
    const V least = hn::Mul(set(1 - 0x1p-45), hn::Sub(p.v, reach));
    if constexpr (op == Op::square_root) {
      const V slope = hn::Div(set(0.5), v);
      const V half = hn::Div(set(0.125), hn::Mul(least, hn::Sqrt(least)));
      const V rounding = hn::Mul(set(0x1p-48), hn::Add(v, hn::Mul(slope, reach)));
      return smooth(p, span, v, slope, unless_positive(least, half), rounding);
    }
    if constexpr (op == Op::exponential) {
      const V most = hn::Mul(set(1 + 0x1p-45), exponential(lanes, hn::Add(p.v, reach)));
      const V rounding =
          hn::Add(hn::Mul(hn::Mul(set(0x1p-48), most), hn::Add(set(1), reach)), set(0x1p-1000));
      return smooth(p, span, v, v, hn::Mul(set(0.5), most), rounding);
    }
    if constexpr (op == Op::tangent_hyperbolic) {
      const V slope = hn::Sub(set(1), hn::Mul(v, v));
      // The second derivative is -2 v (1 - v v), of which the magnitude is below 0.77.
      const V rounding = hn::Mul(set(0x1p-48), hn::Add(set(1), reach));
      return smooth(p, span, v, slope, set(0.385), rounding);
    }
    if constexpr (op == Op::logarithm) {
      const V slope = hn::Div(set(1), p.v);
      const V half = hn::Div(set(0.5), hn::Mul(least, least));
      const V rounding =
          hn::Mul(set(0x1p-48), hn::Add(hn::Add(set(1), hn::Abs(v)), hn::Div(reach, least)));
      return smooth(p, span, v, slope, unless_positive(least, half), rounding);
    }
  }

  template <Op op>
  static HWY_INLINE Part of_two(const Part& p, const Part& q, V span) {
    if constexpr (op == Op::minimum || op == Op::maximum) return extreme<op>(p, q, span);
    if constexpr (op == Op::divide) {
      Part out = product(p, inverse(q, span), span);
      out.v = hn::Div(p.v, q.v);
      return out;
    }
    if constexpr (op == Op::multiply) return product(p, q, span);
    const V v = result<op>(lanes, p.v, q.v);
    if constexpr (op == Op::less) return less(p, q, span, v);
    if constexpr (op == Op::keep) return kept<true>(p, q, span, v);
    if constexpr (op == Op::drop) return kept<false>(p, q, span, v);
    if constexpr (op == Op::hypotenuse) return hypotenuse(p, q, span, v);
    if constexpr (op == Op::arctangent) return arctangent(p, q, span, v);
    if constexpr (op == Op::add || op == Op::subtract) {
      Part out;
      out.v = v;
      out.low = op == Op::add ? hn::Add(p.low, q.low) : hn::Sub(p.low, q.high);
      out.high = op == Op::add ? hn::Add(p.high, q.high) : hn::Sub(p.high, q.low);
      out.bend = hn::Add(p.bend, q.bend);
      const V size = hn::Add(hn::Abs(out.v), hn::Mul(spread(out, span), span));
      out.error = hn::Add(hn::Add(p.error, q.error), hn::Mul(set(0x1p-50), size));
      return out;
    }
  }

  static HWY_INLINE Part product(const Part& p, const Part& q, V span) {
    Part out;
    out.v = hn::Mul(p.v, q.v);
    Part a, b;
    scale_slope(q, p.v, a);
    scale_slope(p, q.v, b);
    out.low = hn::Add(a.low, b.low);
    if (!is_smooth) out.high = hn::Add(a.high, b.high);
    const V x = spread(p, span), y = spread(q, span);
    const V v = hn::Abs(p.v), w = hn::Abs(q.v);
    out.bend = hn::Add(hn::Add(hn::Mul(v, q.bend), hn::Mul(w, p.bend)), hn::Mul(x, y));
    const V max_p = hn::Add(v, hn::Mul(x, span)), max_q = hn::Add(w, hn::Mul(y, span));
    const V of_errors = hn::Add(hn::Mul(max_p, q.error), hn::Mul(hn::Add(max_q, q.error), p.error));
    out.error =
        hn::Add(hn::Mul(set(1 + 0x1p-40), of_errors), hn::Mul(set(0x1p-49), hn::Mul(max_p, max_q)));
    return out;
  }

  const double* const span_;
  double* const registers_;
  double* const waves_;
};

/// Values and slopes by the operations of Kernel<true>, for the three coordinates at once.
class SlopeKernel {
  using D = hn::ScalableTag<double>;
  using V = hn::Vec<D>;

 public:
  SlopeKernel(double* registers, double* waves) : registers_(registers), waves_(waves) {}

  void HWY_INLINE run(const RayProgram::Instruction& instruction, size_t count) {
    const double* const a = registers_ + instruction.a * stride;
    const double* const b = registers_ + instruction.b * stride;
    double* const to = registers_ + instruction.to * stride;
    double* const waves = waves_ + instruction.waves * 2 * RayBatch::lanes;
    const bool is_first = instruction.is_first;
    with_op(instruction.op, [&](auto which) HWY_ATTR {
      constexpr Op op = decltype(which)::value;
      if constexpr (RayProgram::has_slope(op)) run_op<op>(a, b, waves, is_first, count, to);
    });
  }

 private:
  static constexpr D d{};
  static constexpr Lanes<D> lanes{};
  struct Part {
    V v, along[3];
  };

  static HWY_INLINE Part load(const double* from) {
    Part p;
    p.v = hn::Load(d, from);
    for (size_t i = 0; i < 3; ++i) p.along[i] = hn::Load(d, from + (i + 1) * RayBatch::lanes);
    return p;
  }

  template <Op op>
  static HWY_INLINE void run_op(const double* a, const double* b, double* waves, bool is_first,
                                size_t count, double* to) {
    for (size_t n = 0; n < count; n += hn::Lanes(d)) {
      const Part p = load(a + n);
      Part out;
      if constexpr (op == Op::sine || op == Op::cosine) {
        if (is_first) {
          hn::Store(sine(lanes, p.v, 0), d, waves + n);
          hn::Store(sine(lanes, p.v, 1), d, waves + RayBatch::lanes + n);
        }
        const V s = hn::Load(d, waves + n), c = hn::Load(d, waves + RayBatch::lanes + n);
        out.v = op == Op::sine ? s : c;
        const V slope = op == Op::sine ? c : hn::Neg(s);
        for (size_t i = 0; i < 3; ++i) out.along[i] = hn::Mul(slope, p.along[i]);
      } else if constexpr (op == Op::negate) {
        out.v = hn::Neg(p.v);
        for (size_t i = 0; i < 3; ++i) out.along[i] = hn::Neg(p.along[i]);
      } else {
        const Part q = load(b + n);
        out.v = result<op>(lanes, p.v, q.v);
        for (size_t i = 0; i < 3; ++i) {
          const V r = p.along[i], s = q.along[i];
          if constexpr (op == Op::add) out.along[i] = hn::Add(r, s);
          if constexpr (op == Op::subtract) out.along[i] = hn::Sub(r, s);
          if constexpr (op == Op::multiply)
            out.along[i] = hn::Add(hn::Mul(p.v, s), hn::Mul(q.v, r));
        }
      }
      hn::Store(out.v, d, to + n);
      for (size_t i = 0; i < 3; ++i) hn::Store(out.along[i], d, to + (i + 1) * RayBatch::lanes + n);
    }
  }

  double* const registers_;
  double* const waves_;
};

void run_slopes(const RayProgram& program, double* registers, double* waves, size_t count) {
  SlopeKernel kernel(registers, waves);
  for (const RayProgram::Instruction& i : program.code()) kernel.run(i, count);
}

void run_ray_program(const RayProgram& program, const double* span, double* registers,
                     double* waves, size_t count) {
  if (program.is_smooth()) {
    Kernel<true> kernel(span, registers, waves);
    for (const RayProgram::Instruction& i : program.code()) kernel.run(i, count);
  } else {
    Kernel<false> kernel(span, registers, waves);
    for (const RayProgram::Instruction& i : program.code()) kernel.run(i, count);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "expression/period.h"

namespace msq {

HWY_EXPORT(run_ray_program);
HWY_EXPORT(run_slopes);

namespace {

void fill(double (&lanes)[RayBatch::lanes], double v) {
  std::fill(std::begin(lanes), std::end(lanes), v);
}

}  // namespace

RayProgram::RayProgram(const Tape& tape) : program_(compile(tape)) {
  std::vector<double> largest(tape.nodes.size());  // of nodes that grow from cell to cell
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> growth = growths(tape, axis);
    for (size_t i = 0; i < growth.size(); ++i)
      if (std::isfinite(growth[i])) largest[i] += two_pi * std::abs(growth[i]);
  }
  std::map<uint32_t, uint16_t> waves;  // by operand
  size_t next = 0;
  for (size_t i = 0; i < tape.nodes.size(); ++i) {
    const Node& node = tape.nodes[i];
    if (node.op < Op::add) continue;
    const Program::Instruction& from = program_.code[next++];
    Instruction instruction{from.op, from.to, from.a, from.b};
    instruction.rounding = 0x1p-50 * largest[i];
    if (node.op == Op::sine || node.op == Op::cosine) {
      const auto [found, is_new] = waves.try_emplace(node.a, static_cast<uint16_t>(waves.size()));
      instruction.waves = found->second;
      instruction.is_first = is_new;
    }
    is_smooth_ = is_smooth_ && node.op != Op::minimum && node.op != Op::maximum &&
                 node.op != Op::absolute && node.op != Op::hypotenuse;
    has_slopes_ = has_slopes_ && has_slope(node.op);
    code_.push_back(instruction);
  }
  waves_ = waves.size();
}

RayBatch::RayBatch(const RayProgram& program)
    : program_(program),
      registers_(program.program().registers()),
      waves_(std::max<size_t>(program.waves(), 1)) {
  const std::vector<double>& constants = program.program().constants;
  for (size_t i = 0; i < constants.size(); ++i)
    fill(registers_[program.program().inputs + i].arrays[0], constants[i]);
}

RayBatch::Bounds RayBatch::run(const Pieces& pieces, size_t count) {
  for (size_t axis = 0; axis < 3; ++axis) {
    auto& arrays = registers_[axis].arrays;
    std::copy_n(pieces.coordinates[axis], count, arrays[0]);
    std::copy_n(pieces.rates[axis], count, arrays[1]);
    if (!program_.is_smooth()) std::copy_n(pieces.rates[axis], count, arrays[2]);
    std::copy_n(pieces.bends[axis], count, arrays[3]);
    std::copy_n(pieces.error, count, arrays[4]);
  }
  HWY_DYNAMIC_DISPATCH(run_ray_program)
  (program_, pieces.span, registers_[0].arrays[0], waves_[0].arrays[0], count);
  const auto& root = registers_[program_.program().outputs[0]].arrays;
  return {root[0], root[1], program_.is_smooth() ? root[1] : root[2], root[3], root[4]};
}

RayBatch::Slopes RayBatch::slopes(const double (&coordinates)[3][lanes], size_t count) {
  for (size_t axis = 0; axis < 3; ++axis) {
    auto& arrays = registers_[axis].arrays;
    std::copy_n(coordinates[axis], count, arrays[0]);
    for (size_t along = 0; along < 3; ++along) fill(arrays[1 + along], along == axis ? 1 : 0);
  }
  HWY_DYNAMIC_DISPATCH(run_slopes)
  (program_, registers_[0].arrays[0], waves_[0].arrays[0], count);
  const auto& root = registers_[program_.program().outputs[0]].arrays;
  return {{root[1], root[2], root[3]}};
}

}  // namespace msq
#endif  // HWY_ONCE
