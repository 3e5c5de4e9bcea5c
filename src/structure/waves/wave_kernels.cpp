// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/waves/wave_kernels.cpp"
#include <algorithm>
#include <cstring>
#include <iterator>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/mask_bits-inl.h"
#include "base/pi.h"
#include "expression/elementary-inl.h"
#include "structure/waves/wave_kernels.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

// At most 8 lanes, so that each of the 16 partial sums has a lane of its own.
using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;

/// An angle from 0 to 2 pi, reduced by q = 0 to 4 quarters to r, at most 0.8 in magnitude. Sines
/// and cosines have the bits of sine().
class InTurn {
 public:
  HWY_INLINE explicit InTurn(V angle) {
    const D d;
    const V q =
        hn::Floor(hn::Add(hn::Mul(angle, hn::Set(d, quarters_per_radian)), hn::Set(d, 0.5)));
    V r = hn::Sub(angle, hn::Mul(q, hn::Set(d, quarter_turn[0])));
    r = hn::Sub(r, hn::Mul(q, hn::Set(d, quarter_turn[1])));
    r_ = hn::Sub(r, hn::Mul(q, hn::Set(d, quarter_turn[2])));
    z_ = hn::Mul(r_, r_);
    // The low bits of 2^52 + q are q.
    q_ = hn::BitCast(U(), hn::Add(q, hn::Set(d, 0x1p52)));
  }

  /// Even q leave a cosine, odd ones a sine. The first term of the sine's shorter polynomial is 0,
  /// which leaves the others as they are.
  HWY_INLINE V cosine() const {
    const D d;
    constexpr size_t last = std::size(cosine_terms) - 1;
    static_assert(std::size(sine_terms) == last);
    const auto is_odd = odd();
    V sum = hn::IfThenZeroElse(is_odd, hn::Set(d, cosine_terms[last]));
    for (size_t i = last; i-- > 0;)
      sum = hn::Add(hn::Mul(sum, z_),
                    hn::IfThenElse(is_odd, hn::Set(d, sine_terms[i]), hn::Set(d, cosine_terms[i])));
    return signed_by(next(), hn::Mul(sum, hn::IfThenElse(is_odd, r_, hn::Set(d, 1))));
  }
  HWY_INLINE void both(V& sine, V& cosine) const {
    const Lanes<D> lanes;
    const V s = hn::Mul(r_, polynomial(lanes, z_, sine_terms));
    const V c = polynomial(lanes, z_, cosine_terms);
    const auto is_odd = odd();
    sine = signed_by(q_, hn::IfThenElse(is_odd, c, s));
    cosine = signed_by(next(), hn::IfThenElse(is_odd, s, c));
  }

 private:
  using U = hn::RebindToUnsigned<D>;

  HWY_INLINE hn::Mask<D> odd() const {
    const auto bit = hn::And(q_, hn::Set(U(), uint64_t{1}));
    return hn::MaskFromVec(hn::BitCast(D(), hn::Sub(hn::Zero(U()), bit)));
  }
  /// The cosine is the sine a quarter later.
  HWY_INLINE hn::Vec<U> next() const { return hn::Add(q_, hn::Set(U(), uint64_t{1})); }
  /// Negative from two quarters on.
  HWY_INLINE static V signed_by(hn::Vec<U> quarters, V v) {
    const auto sign = hn::And(hn::ShiftLeft<62>(quarters), hn::Set(U(), uint64_t{1} << 63));
    return hn::Xor(v, hn::BitCast(D(), sign));
  }

  V r_, z_;
  hn::Vec<U> q_;
};

/// Adds the partial sums in the order of wave_set.h.
HWY_INLINE double total(const double* partial) {
  double sums[WaveSet::sums];
  std::memcpy(sums, partial, sizeof sums);
  for (size_t half = WaveSet::sums / 2; half > 0; half /= 2)
    for (size_t i = 0; i < half; ++i) sums[i] += sums[i + half];
  return sums[0];
}

/// Calls take(i, slot, turn) for each vector of waves from i on, whose partial sums begin at
/// `slot`; `turn` is the fraction of a cycle.
template <class Take>
HWY_INLINE void for_each_vector(const WaveSet& waves, Vec3 u, Take&& take) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  const V x = hn::Set(d, u.x), y = hn::Set(d, u.y), z = hn::Set(d, u.z);
  for (size_t i = 0; i < waves.padded(); i += WaveSet::sums)
    for (size_t slot = 0; slot < WaveSet::sums; slot += lanes) {
      const size_t at = i + slot;
      const V along = hn::Add(hn::Add(hn::Mul(hn::LoadU(d, waves.x() + at), x),
                                      hn::Mul(hn::LoadU(d, waves.y() + at), y)),
                              hn::Mul(hn::LoadU(d, waves.z() + at), z));
      const V t = hn::Add(along, hn::LoadU(d, waves.phases() + at));
      take(at, slot, hn::Sub(t, hn::Floor(t)));
    }
}

HWY_INLINE void add_to(double* partial, V term) {
  const D d;
  hn::StoreU(hn::Add(hn::LoadU(d, partial), term), d, partial);
}

double sum(const WaveSet& waves, Vec3 u) {
  const D d;
  double partial[WaveSet::sums] = {};
  for_each_vector(waves, u, [&](size_t i, size_t slot, V turn) HWY_ATTR {
    const V cosine = InTurn(hn::Mul(turn, hn::Set(d, two_pi))).cosine();
    add_to(partial + slot, hn::Mul(hn::LoadU(d, waves.amplitudes() + i), cosine));
  });
  return total(partial);
}

WaveExpansion expand(const WaveSet& waves, Vec3 u, Vec3 du) {
  const D d;
  double partial[4][WaveSet::sums] = {};
  const V x = hn::Set(d, two_pi * du.x), y = hn::Set(d, two_pi * du.y),
          z = hn::Set(d, two_pi * du.z);
  for_each_vector(waves, u, [&](size_t i, size_t slot, V turn) HWY_ATTR {
    V sine, cosine;
    InTurn(hn::Mul(turn, hn::Set(d, two_pi))).both(sine, cosine);
    const V amplitude = hn::LoadU(d, waves.amplitudes() + i);
    const V c = hn::Mul(amplitude, cosine);
    const V s = hn::Mul(amplitude, sine);
    const V rate = hn::Add(
        hn::Add(hn::Mul(hn::LoadU(d, waves.x() + i), x), hn::Mul(hn::LoadU(d, waves.y() + i), y)),
        hn::Mul(hn::LoadU(d, waves.z() + i), z));
    const V square = hn::Mul(rate, rate);
    add_to(partial[0] + slot, c);
    add_to(partial[1] + slot, hn::Neg(hn::Mul(rate, s)));
    add_to(partial[2] + slot, hn::Neg(hn::Mul(square, c)));
    add_to(partial[3] + slot, hn::Mul(hn::Mul(square, rate), s));
  });
  return {total(partial[0]), total(partial[1]), total(partial[2]), total(partial[3])};
}

double gradient_of(const WaveSet& waves, Vec3 u, Vec3& gradient) {
  const D d;
  double partial[4][WaveSet::sums] = {};
  for_each_vector(waves, u, [&](size_t i, size_t slot, V turn) HWY_ATTR {
    V sine, cosine;
    InTurn(hn::Mul(turn, hn::Set(d, two_pi))).both(sine, cosine);
    const V amplitude = hn::LoadU(d, waves.amplitudes() + i);
    const V s = hn::Mul(amplitude, sine);
    add_to(partial[0] + slot, hn::Mul(amplitude, cosine));
    add_to(partial[1] + slot, hn::Mul(hn::LoadU(d, waves.x() + i), s));
    add_to(partial[2] + slot, hn::Mul(hn::LoadU(d, waves.y() + i), s));
    add_to(partial[3] + slot, hn::Mul(hn::LoadU(d, waves.z() + i), s));
  });
  gradient = Vec3{total(partial[1]), total(partial[2]), total(partial[3])} * -two_pi;
  return total(partial[0]);
}

void sines(const double* turns, size_t count, double* to_sines, double* to_cosines) {
  const D d;
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const V t = hn::LoadU(d, turns + i);
    V sine, cosine;
    InTurn(hn::Mul(hn::Sub(t, hn::Floor(t)), hn::Set(d, two_pi))).both(sine, cosine);
    hn::StoreU(sine, d, to_sines + i);
    hn::StoreU(cosine, d, to_cosines + i);
  }
}

void products(Complex a, Complex b, size_t count, Complex to) {
  const D d;
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const V p = hn::LoadU(d, a.real + i), q = hn::LoadU(d, a.imaginary + i);
    const V r = hn::LoadU(d, b.real + i), s = hn::LoadU(d, b.imaginary + i);
    hn::StoreU(hn::MulSub(p, r, hn::Mul(q, s)), d, to.real + i);
    hn::StoreU(hn::MulAdd(p, s, hn::Mul(q, r)), d, to.imaginary + i);
  }
}

void factors(Complex layer, Complex along_y, size_t count, KnotFactors to) {
  const D d;
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const V real = hn::LoadU(d, layer.real + i), imaginary = hn::LoadU(d, layer.imaginary + i);
    const V c = hn::LoadU(d, along_y.real + i), s = hn::LoadU(d, along_y.imaginary + i);
    const V minus = hn::Neg(imaginary);
    hn::StoreU(hn::Mul(real, c), d, to.even_even + i);
    hn::StoreU(hn::Mul(minus, c), d, to.even_odd + i);
    hn::StoreU(hn::Mul(minus, s), d, to.odd_even + i);
    hn::StoreU(hn::Neg(hn::Mul(real, s)), d, to.odd_odd + i);
  }
}

/// The waves of one vector of knots, of one pair of rows or, to hide the latency of the sums, two.
void knots(const KnotFactors& first, const KnotFactors* second, size_t count, const double* cosines,
           const double* sines_at, size_t width, double* to_first, double* to_second) {
  const D d;
  const KnotFactors p = first, q = second ? *second : first;
  for (size_t j = 0; j < width; j += hn::Lanes(d)) {
    const double* const c = cosines + j;
    const double* const s = sines_at + j;
    double* const at = to_first + j;
    V a0 = hn::LoadU(d, at), a1 = hn::LoadU(d, at + width);
    V a2 = hn::LoadU(d, at + 2 * width), a3 = hn::LoadU(d, at + 3 * width);
    if (second) {
      double* const there = to_second + j;
      V b0 = hn::LoadU(d, there), b1 = hn::LoadU(d, there + width);
      V b2 = hn::LoadU(d, there + 2 * width), b3 = hn::LoadU(d, there + 3 * width);
      for (size_t i = 0; i < count; ++i) {
        const V u = hn::LoadU(d, c + i * width), v = hn::LoadU(d, s + i * width);
        a0 = hn::MulAdd(hn::Set(d, p.even_even[i]), u, a0);
        a1 = hn::MulAdd(hn::Set(d, p.even_odd[i]), v, a1);
        a2 = hn::MulAdd(hn::Set(d, p.odd_even[i]), u, a2);
        a3 = hn::MulAdd(hn::Set(d, p.odd_odd[i]), v, a3);
        b0 = hn::MulAdd(hn::Set(d, q.even_even[i]), u, b0);
        b1 = hn::MulAdd(hn::Set(d, q.even_odd[i]), v, b1);
        b2 = hn::MulAdd(hn::Set(d, q.odd_even[i]), u, b2);
        b3 = hn::MulAdd(hn::Set(d, q.odd_odd[i]), v, b3);
      }
      hn::StoreU(b0, d, there);
      hn::StoreU(b1, d, there + width);
      hn::StoreU(b2, d, there + 2 * width);
      hn::StoreU(b3, d, there + 3 * width);
    } else {
      for (size_t i = 0; i < count; ++i) {
        const V u = hn::LoadU(d, c + i * width), v = hn::LoadU(d, s + i * width);
        a0 = hn::MulAdd(hn::Set(d, p.even_even[i]), u, a0);
        a1 = hn::MulAdd(hn::Set(d, p.even_odd[i]), v, a1);
        a2 = hn::MulAdd(hn::Set(d, p.odd_even[i]), u, a2);
        a3 = hn::MulAdd(hn::Set(d, p.odd_odd[i]), v, a3);
      }
    }
    hn::StoreU(a0, d, at);
    hn::StoreU(a1, d, at + width);
    hn::StoreU(a2, d, at + 2 * width);
    hn::StoreU(a3, d, at + 3 * width);
  }
}

void weighted(const double* rows, size_t stride, const double* weights, size_t terms, size_t width,
              double* to) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  for (size_t j = 0; j < width; j += 2 * lanes) {
    V low = hn::Zero(d), high = low;
    for (size_t k = 0; k < terms; ++k) {
      const V weight = hn::Set(d, weights[k]);
      low = hn::MulAdd(weight, hn::LoadU(d, rows + k * stride + j), low);
      high = hn::MulAdd(weight, hn::LoadU(d, rows + k * stride + j + lanes), high);
    }
    hn::StoreU(low, d, to + j);
    hn::StoreU(high, d, to + j + lanes);
  }
}

double largest_of(const double* numbers, size_t count) {
  const D d;
  V most = hn::Zero(d);
  for (size_t i = 0; i < count; i += hn::Lanes(d))
    most = hn::Max(most, hn::Abs(hn::LoadU(d, numbers + i)));
  double all[8] = {};
  hn::StoreU(most, d, all);
  return *std::max_element(all, all + 8);
}

HWY_INLINE void find_rows(const KnotRows& rows, float* upper, float* lower) {
  const D d;
  const hn::Rebind<float, D> narrow;
  const size_t lanes = hn::Lanes(d), width = 2 * rows.width;
  for (size_t j = 0; j < width; j += 2 * lanes) {
    V a0 = hn::Zero(d), a1 = a0, b0 = a0, b1 = a0;
    for (size_t k = 0; k < rows.terms; ++k) {
      const double* const at = rows.layer + 2 * k * width + j;
      const V w = hn::Set(d, rows.even[k]), x = hn::Set(d, rows.odd[k]);
      a0 = hn::MulAdd(w, hn::LoadU(d, at), a0);
      a1 = hn::MulAdd(w, hn::LoadU(d, at + lanes), a1);
      b0 = hn::MulAdd(x, hn::LoadU(d, at + width), b0);
      b1 = hn::MulAdd(x, hn::LoadU(d, at + width + lanes), b1);
    }
    hn::StoreU(hn::DemoteTo(narrow, hn::Add(a0, b0)), narrow, upper + j);
    hn::StoreU(hn::DemoteTo(narrow, hn::Add(a1, b1)), narrow, upper + j + lanes);
    hn::StoreU(hn::DemoteTo(narrow, hn::Sub(a0, b0)), narrow, lower + j);
    hn::StoreU(hn::DemoteTo(narrow, hn::Sub(a1, b1)), narrow, lower + j + lanes);
  }
}

template <bool is_absolute, bool has_values>
void words(const KnotRows& knot_rows, const float* weights, size_t terms,
           const WordLimits (&limits)[2], float* values, WordBits (&to)[2]) {
  HWY_ALIGN float rows[2][64];
  find_rows(knot_rows, rows[0], rows[1]);
  const size_t odd = knot_rows.width;
  const hn::CappedTag<float, 16> d;
  using F = hn::Vec<decltype(d)>;
  const size_t lanes = hn::Lanes(d);
  constexpr size_t half = 32;
  to[0] = to[1] = {0, 0};
  // Eight sums at once hide their latency.
  for (size_t s = 0; s < half; s += 2 * lanes) {
    F a0 = hn::Zero(d), a1 = a0, b0 = a0, b1 = a0, c0 = a0, c1 = a0, e0 = a0, e1 = a0;
    for (size_t k = 0; k < terms; ++k) {
      const float* const at = weights + 2 * half * k + s;
      const F u0 = hn::LoadU(d, at), u1 = hn::LoadU(d, at + lanes);
      const F v0 = hn::LoadU(d, at + half), v1 = hn::LoadU(d, at + half + lanes);
      const F p = hn::Set(d, rows[0][k]), q = hn::Set(d, rows[1][k]);
      a0 = hn::MulAdd(p, u0, a0);
      a1 = hn::MulAdd(p, u1, a1);
      c0 = hn::MulAdd(q, u0, c0);
      c1 = hn::MulAdd(q, u1, c1);
      const F r = hn::Set(d, rows[0][odd + k]), t = hn::Set(d, rows[1][odd + k]);
      b0 = hn::MulAdd(r, v0, b0);
      b1 = hn::MulAdd(r, v1, b1);
      e0 = hn::MulAdd(t, v0, e0);
      e1 = hn::MulAdd(t, v1, e1);
    }
    const auto compare = [&](size_t row, F v, size_t at) HWY_ATTR {
      if (is_absolute) v = hn::Abs(v);
      if (has_values) hn::StoreU(v, d, values + 2 * half * row + at);
      to[row].at_most_low |= bits_of(d, hn::Le(v, hn::Set(d, limits[row].low))) << at;
      to[row].above_high |= bits_of(d, hn::Gt(v, hn::Set(d, limits[row].high))) << at;
    };
    const auto both = [&](size_t row, F even, F odd_part, size_t at) HWY_ATTR {
      compare(row, hn::Add(even, odd_part), half + at);
      compare(row, hn::Reverse(d, hn::Sub(even, odd_part)), half - lanes - at);
    };
    both(0, a0, b0, s);
    both(0, a1, b1, s + lanes);
    both(1, c0, e0, s);
    both(1, c1, e1, s + lanes);
  }
}

void any_words(const KnotRows& rows, const float* weights, size_t terms, bool is_absolute,
               const WordLimits (&limits)[2], float* values, WordBits (&to)[2]) {
  if (values)
    is_absolute ? words<true, true>(rows, weights, terms, limits, values, to)
                : words<false, true>(rows, weights, terms, limits, values, to);
  else
    is_absolute ? words<true, false>(rows, weights, terms, limits, values, to)
                : words<false, false>(rows, weights, terms, limits, values, to);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(sum);
HWY_EXPORT(expand);
HWY_EXPORT(gradient_of);
HWY_EXPORT(sines);
HWY_EXPORT(products);
HWY_EXPORT(factors);
HWY_EXPORT(knots);
HWY_EXPORT(weighted);
HWY_EXPORT(largest_of);
HWY_EXPORT(any_words);

double wave_sum(const WaveSet& waves, Vec3 u) {
  return HWY_DYNAMIC_DISPATCH(sum)(waves, u);
}
WaveExpansion expand_waves(const WaveSet& waves, Vec3 u, Vec3 du) {
  return HWY_DYNAMIC_DISPATCH(expand)(waves, u, du);
}
double wave_gradient(const WaveSet& waves, Vec3 u, Vec3& gradient) {
  return HWY_DYNAMIC_DISPATCH(gradient_of)(waves, u, gradient);
}
void sines_of_turns(const double* turns, size_t count, double* to_sines, double* to_cosines) {
  HWY_DYNAMIC_DISPATCH(sines)(turns, count, to_sines, to_cosines);
}
void complex_products(Complex a, Complex b, size_t count, Complex to) {
  HWY_DYNAMIC_DISPATCH(products)(a, b, count, to);
}
void knot_factors(Complex layer, Complex along_y, size_t count, KnotFactors to) {
  HWY_DYNAMIC_DISPATCH(factors)(layer, along_y, count, to);
}
void add_knots(const KnotFactors& first, const KnotFactors* second, size_t count,
               const double* cosines, const double* sines_at, size_t width, double* to_first,
               double* to_second) {
  HWY_DYNAMIC_DISPATCH(knots)
  (first, second, count, cosines, sines_at, width, to_first, to_second);
}
void weighted_sum(const double* rows, size_t stride, const double* weights, size_t terms,
                  size_t width, double* to) {
  HWY_DYNAMIC_DISPATCH(weighted)(rows, stride, weights, terms, width, to);
}
double largest(const double* numbers, size_t count) {
  return HWY_DYNAMIC_DISPATCH(largest_of)(numbers, count);
}
void pair_words(const KnotRows& rows, const float* weights, size_t terms, bool is_absolute,
                const WordLimits (&limits)[2], float* values, WordBits (&to)[2]) {
  HWY_DYNAMIC_DISPATCH(any_words)(rows, weights, terms, is_absolute, limits, values, to);
}

}  // namespace msq
#endif  // HWY_ONCE
