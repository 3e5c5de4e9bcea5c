// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/row_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/functional/row_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/mask_bits-inl.h"
#include "expression/load-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

template <bool values_uniform, bool levels_uniform>
HWY_INLINE void compare_lanes(const double* values, const double* levels, size_t count,
                              uint64_t* bits) {
  const hn::ScalableTag<double> d;
  for (size_t word = 0; word * 64 < count; ++word) {
    uint64_t all = 0;
    for (size_t i = 0; i < 64 && word * 64 + i < count; i += hn::Lanes(d)) {
      const size_t at = word * 64 + i;
      all |= bits_of(d, hn::Le(load<values_uniform>(d, values, at),
                               load<levels_uniform>(d, levels, at)))
             << i;
    }
    bits[word] = all;
  }
}

void compare_all(Values values, Values levels, size_t count, uint64_t* bits) {
  if (values.is_uniform && levels.is_uniform)
    compare_lanes<true, true>(values.data, levels.data, count, bits);
  else if (values.is_uniform)
    compare_lanes<true, false>(values.data, levels.data, count, bits);
  else if (levels.is_uniform)
    compare_lanes<false, true>(values.data, levels.data, count, bits);
  else
    compare_lanes<false, false>(values.data, levels.data, count, bits);
}

void angles_of_points(const Neighbourhood& grid, Values x, Values y, Values z, size_t count,
                      double* const (&angles)[3]) {
  const hn::ScalableTag<double> d;
  const Values points[3] = {x, y, z};
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto from_origin = [&](int axis) HWY_ATTR {
      const Values& v = points[axis];
      return hn::Sub(v.is_uniform ? hn::Set(d, *v.data) : hn::LoadU(d, v.data + i),
                     hn::Set(d, grid.origin[axis]));
    };
    const auto px = from_origin(0), py = from_origin(1), pz = from_origin(2);
    for (int axis = 0; axis < 3; ++axis) {
      const auto m = [&](int row) HWY_ATTR {
        return hn::Set(d, grid.rotation.m[static_cast<size_t>(3 * row + axis)]);
      };
      const auto g = hn::Add(hn::Add(hn::Mul(m(0), px), hn::Mul(m(1), py)), hn::Mul(m(2), pz));
      const auto c = hn::Div(g, hn::Set(d, grid.cell_size[axis]));
      const auto fraction = hn::Sub(c, hn::Floor(c));
      hn::StoreU(hn::Mul(fraction, hn::Set(d, two_pi)), d, angles[axis] + i);
    }
  }
}

void turn_one(double sine, double cosine, const double* cosines, const double* sines, size_t count,
              float* to_sines, float* to_cosines) {
  const hn::ScalableTag<double> d;
  const hn::Rebind<float, decltype(d)> single;
  const auto a = hn::Set(d, sine), b = hn::Set(d, cosine);
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto c = hn::LoadU(d, cosines + i), s = hn::LoadU(d, sines + i);
    const auto sum = hn::Add(hn::Mul(a, c), hn::Mul(b, s));
    const auto difference = hn::Sub(hn::Mul(b, c), hn::Mul(a, s));
    hn::StoreU(hn::DemoteTo(single, sum), single, to_sines + i);
    hn::StoreU(hn::DemoteTo(single, difference), single, to_cosines + i);
  }
}

void turn_words(const float* sine, const float* cosine, size_t words, const float* cosines,
                const float* sines, float* to_sines, float* to_cosines) {
  const hn::CappedTag<float, 16> d;
  for (size_t i = 0; i < 64; i += hn::Lanes(d)) {
    const auto c = hn::LoadU(d, cosines + i), s = hn::LoadU(d, sines + i);
    for (size_t w = 0; w < words; ++w) {
      const auto a = hn::Set(d, sine[w]), b = hn::Set(d, cosine[w]);
      hn::StoreU(hn::MulAdd(c, a, hn::Mul(s, b)), d, to_sines + w * 64 + i);
      hn::StoreU(hn::NegMulAdd(s, a, hn::Mul(c, b)), d, to_cosines + w * 64 + i);
    }
  }
}

template <bool is_uniform, bool has_one_level>
HWY_INLINE void compare_words(const float* values, const uint32_t* words, size_t count,
                              const float* low, const float* high, uint64_t* at_most_low,
                              uint64_t* at_most_high) {
  const hn::CappedTag<float, linear_chunk> d;
  for (size_t n = 0; n < count; ++n) {
    uint64_t in = 0, maybe = 0;
    for (size_t i = 0; i < 64; i += hn::Lanes(d)) {
      const auto v = load<is_uniform>(d, values, n * 64 + i);
      const size_t chunk = has_one_level ? 0 : (size_t{words[n]} * 64 + i) / linear_chunk;
      in |= bits_of(d, hn::Le(v, hn::Set(d, low[chunk]))) << i;
      maybe |= bits_of(d, hn::Le(v, hn::Set(d, high[chunk]))) << i;
    }
    at_most_low[n] = in;
    at_most_high[n] = maybe;
  }
}

void compare_all_singles(ValuesOf<float> values, const uint32_t* words, size_t count,
                         const float* low, const float* high, bool has_one_level,
                         uint64_t* at_most_low, uint64_t* at_most_high) {
  if (values.is_uniform && has_one_level)
    compare_words<true, true>(values.data, words, count, low, high, at_most_low, at_most_high);
  else if (values.is_uniform)
    compare_words<true, false>(values.data, words, count, low, high, at_most_low, at_most_high);
  else if (has_one_level)
    compare_words<false, true>(values.data, words, count, low, high, at_most_low, at_most_high);
  else
    compare_words<false, false>(values.data, words, count, low, high, at_most_low, at_most_high);
}

template <size_t terms, bool has_one_level, bool is_absolute>
HWY_INLINE bool linear_words(const LinearRow& row, const LinearWords& words,
                             const LinearResult& to) {
  const hn::CappedTag<float, linear_chunk> d;
  const size_t lanes = hn::Lanes(d);
  const size_t all_terms = terms ? terms : row.terms;
  const auto constant = hn::Set(d, row.constant);
  auto low = hn::Set(d, *words.low), high = hn::Set(d, *words.high);
  uint64_t any = 0;
  for (size_t n = 0; n < words.count; ++n) {
    const size_t w = words.numbers[n], begin = w * 64;
    uint64_t in = 0, maybe = 0;
    for (size_t i = 0; i < 64; i += lanes) {
      auto sum = constant;
      for (size_t t = 0; t < all_terms; ++t)
        sum = hn::MulAdd(hn::LoadU(d, row.tables[t] + begin + i), hn::Set(d, row.coefficients[t]),
                         sum);
      if constexpr (is_absolute) sum = hn::Abs(sum);
      if constexpr (!has_one_level) {
        low = hn::Set(d, words.low[(begin + i) / linear_chunk]);
        high = hn::Set(d, words.high[(begin + i) / linear_chunk]);
      }
      in |= bits_of(d, hn::Le(sum, low)) << i;
      maybe |= bits_of(d, hn::Le(sum, high)) << i;
    }
    const uint64_t mask = words.mask[w], doubt = maybe & ~in & mask;
    to.in[w] |= in & mask;
    to.doubt[n] = doubt;
    any |= doubt;
  }
  return any != 0;
}

template <bool has_one_level, bool is_absolute>
HWY_INLINE bool linear_terms(const LinearRow& row, const LinearWords& words,
                             const LinearResult& to) {
  switch (row.terms) {
    case 1:
      return linear_words<1, has_one_level, is_absolute>(row, words, to);
    case 2:
      return linear_words<2, has_one_level, is_absolute>(row, words, to);
    case 3:
      return linear_words<3, has_one_level, is_absolute>(row, words, to);
    case 4:
      return linear_words<4, has_one_level, is_absolute>(row, words, to);
    default:
      return linear_words<0, has_one_level, is_absolute>(row, words, to);
  }
}

bool linear(const LinearRow& row, const LinearWords& words, const LinearResult& to) {
  if (words.has_one_level)
    return row.is_absolute ? linear_terms<true, true>(row, words, to)
                           : linear_terms<true, false>(row, words, to);
  return row.is_absolute ? linear_terms<false, true>(row, words, to)
                         : linear_terms<false, false>(row, words, to);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(turn_one);
HWY_EXPORT(turn_words);
HWY_EXPORT(compare_all_singles);
HWY_EXPORT(compare_all);
HWY_EXPORT(angles_of_points);
HWY_EXPORT(linear);

void turn_angle(double sine, double cosine, const double* cosines, const double* sines,
                size_t count, float* to_sines, float* to_cosines) {
  HWY_DYNAMIC_DISPATCH(turn_one)(sine, cosine, cosines, sines, count, to_sines, to_cosines);
}

void turn_angles(const float* sine, const float* cosine, size_t words, const float* cosines,
                 const float* sines, float* to_sines, float* to_cosines) {
  HWY_DYNAMIC_DISPATCH(turn_words)(sine, cosine, words, cosines, sines, to_sines, to_cosines);
}

void compare_singles(ValuesOf<float> values, const uint32_t* words, size_t count, const float* low,
                     const float* high, bool has_one_level, uint64_t* at_most_low,
                     uint64_t* at_most_high) {
  HWY_DYNAMIC_DISPATCH(compare_all_singles)
  (values, words, count, low, high, has_one_level, at_most_low, at_most_high);
}

void compare_values(Values values, Values levels, size_t count, uint64_t* bits) {
  HWY_DYNAMIC_DISPATCH(compare_all)(values, levels, count, bits);
}

void find_angles(const Neighbourhood& grid, Values x, Values y, Values z, size_t count,
                 double* const (&angles)[3]) {
  HWY_DYNAMIC_DISPATCH(angles_of_points)(grid, x, y, z, count, angles);
}

bool decide_linear(const LinearRow& row, const LinearWords& words, const LinearResult& to) {
  return HWY_DYNAMIC_DISPATCH(linear)(row, words, to);
}

}  // namespace msq
#endif  // HWY_ONCE
