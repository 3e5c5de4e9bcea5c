// SPDX-License-Identifier: Apache-2.0
// Sine, cosine, exponential, logarithm, angle and hyperbolic tangent from IEEE additions, products,
// quotients and comparisons alone. They are written once for scalars and for vectors. Their bits
// are the same on every instruction set; those of the C library depend on its version and on the
// machine. Included once for each instruction set.
//
// Source: Cody and Waite, "Software Manual for the Elementary Functions", 1980. Arguments are
// reduced by multiples of pi/2 and ln 2 in parts whose products are exact. The polynomials are
// Taylor series, whose remainders on the reduced arguments are below 2^-54 of the result. Errors of
// the results are below 2^-50: absolute for sines and cosines of arguments up to 2^19 and for
// logarithms about 0, absolute for hyperbolic tangents, relative for the others; of angles, below
// 2^-49 absolute (tests/unit/test_expression_elementary.cpp).
#if defined(MSQ_EXPRESSION_ELEMENTARY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_EXPRESSION_ELEMENTARY_INL_H
#undef MSQ_EXPRESSION_ELEMENTARY_INL_H
#else
#define MSQ_EXPRESSION_ELEMENTARY_INL_H
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "expression/tape.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {

/// Arithmetic of one number.
struct Single {
  using V = double;
  V set(double v) const { return v; }
  V add(V a, V b) const { return a + b; }
  V subtract(V a, V b) const { return a - b; }
  V multiply(V a, V b) const { return a * b; }
  V divide(V a, V b) const { return a / b; }
  V root(V a) const { return std::sqrt(a); }
  V floor(V a) const { return std::floor(a); }
  V absolute(V a) const { return std::fabs(a); }
  V negate(V a) const { return -a; }
  /// The bitwise or of both.
  V either(V a, V b) const { return number_of(bits_of(a) | bits_of(b)); }
  bool less(V a, V b) const { return a < b; }
  bool equal(V a, V b) const { return a == b; }
  V choose(bool c, V yes, V no) const { return c ? yes : no; }
  /// 2^n for a whole n from -1000 to 1000: the low bits of 2^52 + 1023 + n are the exponent's.
  V power_of_two(V n) const {
    const uint64_t bits = bits_of(n + (0x1p52 + 1023)) << 52;
    return number_of(bits);
  }
  /// A positive normal number is m 2^k with m from sqrt(1/2) to sqrt(2).
  void split(V v, V& m, V& k) const {
    const uint64_t u = bits_of(v) + (one_bits - half_root_bits);
    k = number_of((u >> 52) | 0x4330000000000000) - (0x1p52 + 1023);
    m = number_of((u & 0x000fffffffffffff) + half_root_bits);
  }

  static constexpr uint64_t one_bits = 0x3ff0000000000000, half_root_bits = 0x3fe6a09e667f3bcd;

 private:
  static uint64_t bits_of(double v) {
    uint64_t bits;
    std::memcpy(&bits, &v, sizeof bits);
    return bits;
  }
  static double number_of(uint64_t bits) {
    double v;
    std::memcpy(&v, &bits, sizeof v);
    return v;
  }
};

/// Arithmetic of the lanes of a vector of doubles; for floats, only the operations that make sense.
template <class D>
struct Lanes {
  using V = hwy::HWY_NAMESPACE::Vec<D>;
  using M = hwy::HWY_NAMESPACE::Mask<D>;
  HWY_INLINE V set(double v) const {
    return hwy::HWY_NAMESPACE::Set(D(), static_cast<hwy::HWY_NAMESPACE::TFromD<D>>(v));
  }
  HWY_INLINE V add(V a, V b) const { return hwy::HWY_NAMESPACE::Add(a, b); }
  HWY_INLINE V subtract(V a, V b) const { return hwy::HWY_NAMESPACE::Sub(a, b); }
  HWY_INLINE V multiply(V a, V b) const { return hwy::HWY_NAMESPACE::Mul(a, b); }
  HWY_INLINE V divide(V a, V b) const { return hwy::HWY_NAMESPACE::Div(a, b); }
  HWY_INLINE V root(V a) const { return hwy::HWY_NAMESPACE::Sqrt(a); }
  HWY_INLINE V floor(V a) const { return hwy::HWY_NAMESPACE::Floor(a); }
  HWY_INLINE V absolute(V a) const { return hwy::HWY_NAMESPACE::Abs(a); }
  HWY_INLINE V negate(V a) const { return hwy::HWY_NAMESPACE::Neg(a); }
  HWY_INLINE V either(V a, V b) const { return hwy::HWY_NAMESPACE::Or(a, b); }
  HWY_INLINE M less(V a, V b) const { return hwy::HWY_NAMESPACE::Lt(a, b); }
  HWY_INLINE M equal(V a, V b) const { return hwy::HWY_NAMESPACE::Eq(a, b); }
  HWY_INLINE V choose(M c, V yes, V no) const { return hwy::HWY_NAMESPACE::IfThenElse(c, yes, no); }
  HWY_INLINE V power_of_two(V n) const {
    namespace hn = hwy::HWY_NAMESPACE;
    return hn::BitCast(D(), hn::ShiftLeft<52>(hn::BitCast(U(), add(n, set(0x1p52 + 1023)))));
  }
  HWY_INLINE void split(V v, V& m, V& k) const {
    namespace hn = hwy::HWY_NAMESPACE;
    const auto half_root = hn::Set(U(), Single::half_root_bits);
    const auto u =
        hn::Add(hn::BitCast(U(), v), hn::Set(U(), Single::one_bits - Single::half_root_bits));
    const auto exponent = hn::Or(hn::ShiftRight<52>(u), hn::Set(U(), uint64_t{0x4330000000000000}));
    k = subtract(hn::BitCast(D(), exponent), set(0x1p52 + 1023));
    m = hn::BitCast(D(),
                    hn::Add(hn::And(u, hn::Set(U(), uint64_t{0x000fffffffffffff})), half_root));
  }

 private:
  using U = hwy::HWY_NAMESPACE::RebindToUnsigned<D>;
};

/// c[0] + z (c[1] + z (...)).
template <class A, size_t count>
HWY_INLINE typename A::V polynomial(const A& a, typename A::V z, const double (&c)[count]) {
  auto sum = a.set(c[count - 1]);
  for (size_t i = count - 1; i-- > 0;) sum = a.add(a.multiply(sum, z), a.set(c[i]));
  return sum;
}

/// Of x up to 0.8 in magnitude: sin x = x S(x^2) and cos x = C(x^2).
inline constexpr double sine_terms[] = {
    1.0,          -1.0 / 6,        1.0 / 120,        -1.0 / 5040,
    1.0 / 362880, -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000};
inline constexpr double cosine_terms[] = {1.0,
                                          -0.5,
                                          1.0 / 24,
                                          -1.0 / 720,
                                          1.0 / 40320,
                                          -1.0 / 3628800,
                                          1.0 / 479001600,
                                          -1.0 / 87178291200,
                                          1.0 / 20922789888000};
/// pi / 2 in three parts, the first two of 33 bits: their products with q < 2^19 are exact.
inline constexpr double quarter_turn[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
constexpr double quarters_per_radian = 0x1.45f306dc9c883p-1;

/// The sine of x + quarters pi / 2. Its magnitude is at most 1 + 2^-50, also for huge arguments,
/// whose reduction has no accuracy left.
template <class A>
HWY_INLINE typename A::V sine(const A& a, typename A::V x, double quarters) {
  const auto q = a.floor(a.add(a.multiply(x, a.set(quarters_per_radian)), a.set(0.5)));
  auto r = a.subtract(x, a.multiply(q, a.set(quarter_turn[0])));
  r = a.subtract(r, a.multiply(q, a.set(quarter_turn[1])));
  r = a.subtract(r, a.multiply(q, a.set(quarter_turn[2])));
  r = a.choose(a.less(r, a.set(-0.8)), a.set(-0.8), r);
  r = a.choose(a.less(a.set(0.8), r), a.set(0.8), r);
  const auto z = a.multiply(r, r);
  const auto s = a.multiply(r, polynomial(a, z, sine_terms));
  const auto c = polynomial(a, z, cosine_terms);
  const auto turned = a.add(q, a.set(quarters));
  const auto quarter =
      a.subtract(turned, a.multiply(a.set(4), a.floor(a.multiply(turned, a.set(0.25)))));
  const auto odd =
      a.subtract(quarter, a.multiply(a.set(2), a.floor(a.multiply(quarter, a.set(0.5)))));
  const auto v = a.choose(a.equal(odd, a.set(1)), c, s);
  return a.choose(a.less(quarter, a.set(2)), v, a.negate(v));
}

template <class A>
HWY_INLINE typename A::V exponential(const A& a, typename A::V x) {
  static constexpr double terms[] = {1.0,
                                     1.0,
                                     0.5,
                                     1.0 / 6,
                                     1.0 / 24,
                                     1.0 / 120,
                                     1.0 / 720,
                                     1.0 / 5040,
                                     1.0 / 40320,
                                     1.0 / 362880,
                                     1.0 / 3628800,
                                     1.0 / 39916800,
                                     1.0 / 479001600,
                                     1.0 / 6227020800};
  // Beyond these the result is 0 or infinite.
  x = a.choose(a.less(x, a.set(-800)), a.set(-800), x);
  x = a.choose(a.less(a.set(800), x), a.set(800), x);
  const auto n = a.floor(a.add(a.multiply(x, a.set(0x1.71547652b82fep+0)), a.set(0.5)));
  auto r = a.subtract(x, a.multiply(n, a.set(0x1.62e42feep-1)));
  r = a.subtract(r, a.multiply(n, a.set(0x1.a39ef35793c76p-33)));
  // In two steps, since 2^n alone may be out of range.
  const auto half = a.floor(a.multiply(n, a.set(0.5)));
  const auto scaled = a.multiply(polynomial(a, r, terms), a.power_of_two(half));
  return a.multiply(scaled, a.power_of_two(a.subtract(n, half)));
}

template <class A>
HWY_INLINE typename A::V logarithm(const A& a, typename A::V x) {
  // ln((1 + s) / (1 - s)) / s - 2 over s^2.
  static constexpr double terms[] = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11,
                                     2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto is_small = a.less(x, a.set(0x1p-1022));
  typename A::V m, k;
  a.split(a.choose(is_small, a.multiply(x, a.set(0x1p54)), x), m, k);
  k = a.choose(is_small, a.subtract(k, a.set(54)), k);
  const auto f = a.subtract(m, a.set(1));
  const auto s = a.divide(f, a.add(m, a.set(1)));
  const auto z = a.multiply(s, s);
  const auto tail = a.multiply(s, a.multiply(z, polynomial(a, z, terms)));
  const auto low = a.add(tail, a.multiply(k, a.set(0x1.a39ef35793c76p-33)));
  const auto sum = a.add(a.multiply(k, a.set(0x1.62e42feep-1)), a.add(a.add(s, s), low));
  auto v = a.choose(a.less(x, a.set(infinity)), sum, x);  // infinity and NaN: unchanged
  v = a.choose(a.equal(x, a.set(0)), a.set(-infinity), v);
  return a.choose(a.less(x, a.set(0)), a.set(std::numeric_limits<double>::quiet_NaN()), v);
}

/// The angle of the point (x, y), with atan(t) = pi/4 + atan((t - 1) / (t + 1)) for large slopes t.
template <class A>
HWY_INLINE typename A::V arctangent(const A& a, typename A::V y, typename A::V x) {
  static constexpr double terms[] = {1.0,      -1.0 / 3,  1.0 / 5,  -1.0 / 7,  1.0 / 9,  -1.0 / 11,
                                     1.0 / 13, -1.0 / 15, 1.0 / 17, -1.0 / 19, 1.0 / 21, -1.0 / 23,
                                     1.0 / 25, -1.0 / 27, 1.0 / 29, -1.0 / 31, 1.0 / 33, -1.0 / 35,
                                     1.0 / 37, -1.0 / 39, 1.0 / 41};
  constexpr double pi = 0x1.921fb54442d18p+1;
  const auto zero = a.set(0), one = a.set(1);
  const auto wide = a.absolute(x), high = a.absolute(y);
  const auto is_steep = a.less(wide, high);
  const auto most = a.choose(is_steep, high, wide);
  const auto least = a.choose(is_steep, wide, high);
  // The origin has the slope 0.
  const auto t = a.divide(least, a.choose(a.equal(most, zero), one, most));
  const auto is_large = a.less(a.set(0.4142135623730950), t);
  const auto s = a.choose(is_large, a.divide(a.subtract(t, one), a.add(t, one)), t);
  auto v = a.multiply(s, polynomial(a, a.multiply(s, s), terms));
  v = a.choose(is_large, a.add(a.set(pi / 4), v), v);
  v = a.choose(is_steep, a.subtract(a.set(pi / 2), v), v);
  v = a.choose(a.less(x, zero), a.subtract(a.set(pi), v), v);
  v = a.choose(a.less(y, zero), a.negate(v), v);
  v = a.choose(a.equal(x, x), v, x);  // NaN
  return a.choose(a.equal(y, y), v, y);
}

template <class A>
HWY_INLINE typename A::V tangent_hyperbolic(const A& a, typename A::V x) {
  const auto one = a.set(1);
  const auto t = exponential(a, a.multiply(a.set(-2), a.absolute(x)));
  const auto v = a.divide(a.subtract(one, t), a.add(one, t));
  return a.choose(a.less(x, a.set(0)), a.negate(v), v);
}

/// The smaller of two numbers. Either order of the operands is a valid minimum. If the operands are
/// equal, or one is NaN, the two orders return different operands. The bitwise or of both is then
/// -0 if one is -0, and NaN if one is NaN.
template <class A>
HWY_INLINE typename A::V minimum(const A& a, typename A::V p, typename A::V q) {
  return a.either(a.choose(a.less(p, q), p, q), a.choose(a.less(q, p), q, p));
}

/// The result of an operation of a tape.
template <Op op, class A>
HWY_INLINE typename A::V result(const A& a, typename A::V p, typename A::V q) {
  if constexpr (op == Op::add) return a.add(p, q);
  if constexpr (op == Op::subtract) return a.subtract(p, q);
  if constexpr (op == Op::multiply) return a.multiply(p, q);
  if constexpr (op == Op::divide) return a.divide(p, q);
  if constexpr (op == Op::minimum) return minimum(a, p, q);
  if constexpr (op == Op::maximum) return a.negate(minimum(a, a.negate(p), a.negate(q)));
  if constexpr (op == Op::arctangent) return arctangent(a, p, q);
  if constexpr (op == Op::hypotenuse) return a.root(a.add(a.multiply(p, p), a.multiply(q, q)));
  if constexpr (op == Op::less) {
    const auto v = a.choose(a.less(p, q), a.set(1), a.set(0));
    return a.choose(a.equal(p, p), a.choose(a.equal(q, q), v, q), p);
  }
  if constexpr (op == Op::keep)
    return a.choose(a.less(a.set(0.5), p), q, a.choose(a.equal(p, p), a.set(-0.0), p));
  if constexpr (op == Op::drop)
    return a.choose(a.less(a.set(0.5), p), a.set(-0.0), a.choose(a.equal(p, p), q, p));
  if constexpr (op == Op::negate) return a.negate(p);
  if constexpr (op == Op::absolute) return a.absolute(p);
  if constexpr (op == Op::square_root) return a.root(p);
  if constexpr (op == Op::sine) return sine(a, p, 0);
  if constexpr (op == Op::cosine) return sine(a, p, 1);
  if constexpr (op == Op::exponential) return exponential(a, p);
  if constexpr (op == Op::logarithm) return logarithm(a, p);
  if constexpr (op == Op::tangent_hyperbolic) return tangent_hyperbolic(a, p);
  // The sum turns -0 into 0: instruction sets differ in the sign of a floor that is 0.
  if constexpr (op == Op::floor) return a.add(a.floor(p), a.set(0));
}

/// Calls body(std::integral_constant<Op, op>) for an operation with operands.
template <class Body>
HWY_INLINE void with_op(Op op, Body&& body) {
  switch (op) {
    case Op::add:
      return body(std::integral_constant<Op, Op::add>());
    case Op::subtract:
      return body(std::integral_constant<Op, Op::subtract>());
    case Op::multiply:
      return body(std::integral_constant<Op, Op::multiply>());
    case Op::divide:
      return body(std::integral_constant<Op, Op::divide>());
    case Op::minimum:
      return body(std::integral_constant<Op, Op::minimum>());
    case Op::maximum:
      return body(std::integral_constant<Op, Op::maximum>());
    case Op::negate:
      return body(std::integral_constant<Op, Op::negate>());
    case Op::absolute:
      return body(std::integral_constant<Op, Op::absolute>());
    case Op::square_root:
      return body(std::integral_constant<Op, Op::square_root>());
    case Op::sine:
      return body(std::integral_constant<Op, Op::sine>());
    case Op::cosine:
      return body(std::integral_constant<Op, Op::cosine>());
    case Op::exponential:
      return body(std::integral_constant<Op, Op::exponential>());
    case Op::logarithm:
      return body(std::integral_constant<Op, Op::logarithm>());
    case Op::tangent_hyperbolic:
      return body(std::integral_constant<Op, Op::tangent_hyperbolic>());
    case Op::floor:
      return body(std::integral_constant<Op, Op::floor>());
    case Op::arctangent:
      return body(std::integral_constant<Op, Op::arctangent>());
    case Op::hypotenuse:
      return body(std::integral_constant<Op, Op::hypotenuse>());
    case Op::less:
      return body(std::integral_constant<Op, Op::less>());
    case Op::keep:
      return body(std::integral_constant<Op, Op::keep>());
    case Op::drop:
      return body(std::integral_constant<Op, Op::drop>());
    default:
      return;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
