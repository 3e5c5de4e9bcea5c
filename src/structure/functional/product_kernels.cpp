// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/product_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/functional/product_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/mask_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

template <bool has_one_level, bool is_absolute>
HWY_INLINE bool product_words(const ProductRow& row, const LinearWords& words,
                              const LinearResult& to) {
  const hn::CappedTag<float, linear_chunk> d;
  using V = hn::Vec<decltype(d)>;
  constexpr size_t half = ProductRow::half;
  const size_t lanes = hn::Lanes(d);
  const V constant = hn::Set(d, row.constant), one_low = hn::Set(d, *words.low),
          one_high = hn::Set(d, *words.high);
  uint64_t any = 0;
  for (size_t n = 0; n < words.count; ++n) {
    const size_t w = words.numbers[n];
    uint64_t in = 0, maybe = 0;
    const auto compare = [&](V value, size_t first) HWY_ATTR {
      if constexpr (is_absolute) value = hn::Abs(value);
      V low = one_low, high = one_high;
      if constexpr (!has_one_level) {
        const size_t chunk = (w * 64 + first) / linear_chunk;
        low = hn::Set(d, words.low[chunk]);
        high = hn::Set(d, words.high[chunk]);
      }
      in |= bits_of(d, hn::Le(value, low)) << first;
      maybe |= bits_of(d, hn::Le(value, high)) << first;
    };
    for (size_t i = 0; i < half; i += 2 * lanes) {
      V even = constant, other_even = constant, odd = hn::Zero(d), other_odd = hn::Zero(d);
      const float* coefficients = row.coefficients + n;
      for (size_t f = 0; f < row.evens; ++f, coefficients += row.stride) {
        const V c = hn::Set(d, *coefficients);
        even = hn::MulAdd(hn::LoadU(d, row.even[f] + i), c, even);
        other_even = hn::MulAdd(hn::LoadU(d, row.even[f] + i + lanes), c, other_even);
      }
      for (size_t f = 0; f < row.odds; ++f, coefficients += row.stride) {
        const V c = hn::Set(d, *coefficients);
        odd = hn::MulAdd(hn::LoadU(d, row.odd[f] + i), c, odd);
        other_odd = hn::MulAdd(hn::LoadU(d, row.odd[f] + i + lanes), c, other_odd);
      }
      compare(hn::Add(even, odd), half + i);
      compare(hn::Add(other_even, other_odd), half + i + lanes);
      compare(hn::Reverse(d, hn::Sub(even, odd)), half - i - lanes);
      compare(hn::Reverse(d, hn::Sub(other_even, other_odd)), half - i - 2 * lanes);
    }
    const uint64_t mask = words.mask[w], doubt = maybe & ~in & mask;
    to.in[w] |= in & mask;
    to.doubt[n] = doubt;
    any |= doubt;
  }
  return any != 0;
}

bool products_of_row(const ProductRow& row, const LinearWords& words, const LinearResult& to) {
  if (words.has_one_level)
    return row.is_absolute ? product_words<true, true>(row, words, to)
                           : product_words<true, false>(row, words, to);
  return row.is_absolute ? product_words<false, true>(row, words, to)
                         : product_words<false, false>(row, words, to);
}

void sum_of_products(const ProductFactor* products, size_t count, size_t words, float* to) {
  const hn::CappedTag<float, linear_chunk> d;
  for (size_t n = 0; n < words; n += hn::Lanes(d)) {
    auto sum = hn::Zero(d);
    for (size_t p = 0; p < count; ++p) {
      auto product = hn::Set(d, products[p].factor);
      for (uint32_t part = 0; part < products[p].count; ++part)
        product = hn::Mul(product, hn::LoadU(d, products[p].parts[part] + n));
      sum = hn::Add(sum, product);
    }
    hn::StoreU(sum, d, to + n);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(products_of_row);
HWY_EXPORT(sum_of_products);

bool decide_products(const ProductRow& row, const LinearWords& words, const LinearResult& to) {
  return HWY_DYNAMIC_DISPATCH(products_of_row)(row, words, to);
}

void add_products(const ProductFactor* products, size_t count, size_t words, float* to) {
  HWY_DYNAMIC_DISPATCH(sum_of_products)(products, count, words, to);
}

}  // namespace msq
#endif  // HWY_ONCE
