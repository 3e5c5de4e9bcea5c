// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/waves/wave_kernels.cpp"
#include <algorithm>
#include <cstring>

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
  const Lanes<D> lanes;
  double partial[WaveSet::sums] = {};
  for_each_vector(waves, u, [&](size_t i, size_t slot, V turn) HWY_ATTR {
    const V cosine = sine(lanes, hn::Mul(turn, hn::Set(d, two_pi)), 1);
    add_to(partial + slot, hn::Mul(hn::LoadU(d, waves.amplitudes() + i), cosine));
  });
  return total(partial);
}

WaveExpansion expand(const WaveSet& waves, Vec3 u, Vec3 du) {
  const D d;
  const Lanes<D> lanes;
  double partial[4][WaveSet::sums] = {};
  const V x = hn::Set(d, two_pi * du.x), y = hn::Set(d, two_pi * du.y),
          z = hn::Set(d, two_pi * du.z);
  for_each_vector(waves, u, [&](size_t i, size_t slot, V turn) HWY_ATTR {
    const V angle = hn::Mul(turn, hn::Set(d, two_pi));
    const V amplitude = hn::LoadU(d, waves.amplitudes() + i);
    const V c = hn::Mul(amplitude, sine(lanes, angle, 1));
    const V s = hn::Mul(amplitude, sine(lanes, angle, 0));
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
  const Lanes<D> lanes;
  double partial[4][WaveSet::sums] = {};
  for_each_vector(waves, u, [&](size_t i, size_t slot, V turn) HWY_ATTR {
    const V angle = hn::Mul(turn, hn::Set(d, two_pi));
    const V amplitude = hn::LoadU(d, waves.amplitudes() + i);
    const V s = hn::Mul(amplitude, sine(lanes, angle, 0));
    add_to(partial[0] + slot, hn::Mul(amplitude, sine(lanes, angle, 1)));
    add_to(partial[1] + slot, hn::Mul(hn::LoadU(d, waves.x() + i), s));
    add_to(partial[2] + slot, hn::Mul(hn::LoadU(d, waves.y() + i), s));
    add_to(partial[3] + slot, hn::Mul(hn::LoadU(d, waves.z() + i), s));
  });
  gradient = Vec3{total(partial[1]), total(partial[2]), total(partial[3])} * -two_pi;
  return total(partial[0]);
}

void sines(const double* turns, size_t count, double* to_sines, double* to_cosines) {
  const D d;
  const Lanes<D> lanes;
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const V t = hn::LoadU(d, turns + i);
    const V angle = hn::Mul(hn::Sub(t, hn::Floor(t)), hn::Set(d, two_pi));
    hn::StoreU(sine(lanes, angle, 0), d, to_sines + i);
    hn::StoreU(sine(lanes, angle, 1), d, to_cosines + i);
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

/// Two vectors of knots in four rows.
void knots(const Complex (&p)[4], size_t count, const double* cosines, const double* sines_at,
           size_t width, double* const (&to)[4]) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  for (size_t j = 0; j < width; j += 2 * lanes) {
    V a0 = hn::Zero(d), a1 = a0, b0 = a0, b1 = a0, c0 = a0, c1 = a0, e0 = a0, e1 = a0;
    for (size_t i = 0; i < count; ++i) {
      const double* const c = cosines + i * width + j;
      const double* const s = sines_at + i * width + j;
      const V u = hn::LoadU(d, c), v = hn::LoadU(d, c + lanes);
      const V w = hn::LoadU(d, s), x = hn::LoadU(d, s + lanes);
      const auto add = [&](const Complex& row, V& low, V& high) HWY_ATTR {
        const V real = hn::Set(d, row.real[i]), imaginary = hn::Set(d, row.imaginary[i]);
        low = hn::NegMulAdd(imaginary, w, hn::MulAdd(real, u, low));
        high = hn::NegMulAdd(imaginary, x, hn::MulAdd(real, v, high));
      };
      add(p[0], a0, a1);
      add(p[1], b0, b1);
      add(p[2], c0, c1);
      add(p[3], e0, e1);
    }
    const V low[4] = {a0, b0, c0, e0}, high[4] = {a1, b1, c1, e1};
    for (size_t r = 0; r < 4; ++r) {
      hn::StoreU(low[r], d, to[r] + j);
      hn::StoreU(high[r], d, to[r] + j + lanes);
    }
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

template <bool is_absolute>
WordBits word(const float* knot_values, const float* weights, size_t terms, float low, float high,
              float* values) {
  const hn::CappedTag<float, 16> d;
  using F = hn::Vec<decltype(d)>;
  const size_t lanes = hn::Lanes(d);
  const F at_low = hn::Set(d, low), at_high = hn::Set(d, high);
  WordBits bits{0, 0};
  // Four vectors at once hide the latency of the sums.
  const size_t vectors = std::min<size_t>(4, 64 / lanes);
  for (size_t s = 0; s < 64; s += vectors * lanes) {
    F a = hn::Zero(d), b = a, c = a, e = a;
    for (size_t k = 0; k < terms; ++k) {
      const F knot = hn::Set(d, knot_values[k]);
      const float* const w = weights + k * 64 + s;
      a = hn::MulAdd(knot, hn::LoadU(d, w), a);
      b = hn::MulAdd(knot, hn::LoadU(d, w + lanes), b);
      c = hn::MulAdd(knot, hn::LoadU(d, w + 2 * lanes), c);
      e = hn::MulAdd(knot, hn::LoadU(d, w + 3 * lanes), e);
    }
    const auto compare = [&](F v, size_t at) HWY_ATTR {
      if (is_absolute) v = hn::Abs(v);
      hn::StoreU(v, d, values + at);
      bits.at_most_low |= bits_of(d, hn::Le(v, at_low)) << at;
      bits.at_most_high |= bits_of(d, hn::Le(v, at_high)) << at;
    };
    compare(a, s);
    compare(b, s + lanes);
    compare(c, s + 2 * lanes);
    compare(e, s + 3 * lanes);
  }
  return bits;
}

WordBits any_word(const float* knot_values, const float* weights, size_t terms, bool is_absolute,
                  float low, float high, float* values) {
  return is_absolute ? word<true>(knot_values, weights, terms, low, high, values)
                     : word<false>(knot_values, weights, terms, low, high, values);
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
HWY_EXPORT(knots);
HWY_EXPORT(weighted);
HWY_EXPORT(largest_of);
HWY_EXPORT(any_word);

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
void knot_sums(const Complex (&p)[4], size_t count, const double* cosines, const double* sines_at,
               size_t width, double* const (&to)[4]) {
  HWY_DYNAMIC_DISPATCH(knots)(p, count, cosines, sines_at, width, to);
}
void weighted_sum(const double* rows, size_t stride, const double* weights, size_t terms,
                  size_t width, double* to) {
  HWY_DYNAMIC_DISPATCH(weighted)(rows, stride, weights, terms, width, to);
}
double largest(const double* numbers, size_t count) {
  return HWY_DYNAMIC_DISPATCH(largest_of)(numbers, count);
}
WordBits row_word(const float* knots, const float* weights, size_t terms, bool is_absolute,
                  float low, float high, float* values) {
  return HWY_DYNAMIC_DISPATCH(any_word)(knots, weights, terms, is_absolute, low, high, values);
}

}  // namespace msq
#endif  // HWY_ONCE
