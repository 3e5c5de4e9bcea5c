// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/turned_products.h"

#include <algorithm>
#include <cmath>

namespace msq {

TurnedProducts::TurnedProducts(const WaveProducts& products, const RowBlock& block,
                               const TurnedStarts& starts)
    : products_(products), starts_(starts) {
  std::vector<const WaveProducts::Function*> functions;
  for (const bool is_odd : {false, true}) {
    for (const WaveProducts::Function& function : products_.functions())
      if (function.is_odd() == is_odd) functions.push_back(&function);
    if (!is_odd) evens_ = functions.size();
  }
  constexpr size_t half = ProductRow::half;
  functions_ = allocate_aligned(functions.size() * half);
  for (size_t f = 0; f < functions.size(); ++f) {
    float* const to = functions_.get() + f * half;
    function_pointers_.push_back(to);
    for (size_t i = 0; i < half; ++i) {
      double value = 1;
      for (const WaveProducts::Part part : functions[f]->parts)
        value *= starts_.step(part, 0, static_cast<double>(i) + 0.5);
      to[i] = static_cast<float>(value);
    }
    std::vector<ProductFactor>& factors = factors_.emplace_back();
    for (const WaveProducts::Product& product : functions[f]->coefficient) {
      ProductFactor factor{
          static_cast<float>(product.factor), static_cast<uint32_t>(product.parts.size()), {}};
      for (size_t p = 0; p < product.parts.size(); ++p)
        factor.parts[p] = starts_.of(product.parts[p]);
      factors.push_back(factor);
    }
  }
  coefficients_.resize(functions.size() * starts_.stride());
  in_.resize(block.row_words());
  doubt_.resize(block.row_words());
  mask_.assign(block.row_words(), ~uint64_t{0});
}

float TurnedProducts::value_at(size_t n, size_t sample) const {
  constexpr size_t half = ProductRow::half;
  const bool is_behind = sample >= half;
  const size_t at = is_behind ? sample - half : half - 1 - sample;
  auto value = static_cast<float>(products_.constant());
  for (size_t f = 0; f < function_pointers_.size(); ++f) {
    const float term = function_pointers_[f][at] * coefficients_[f * starts_.stride() + n];
    value += f < evens_ || is_behind ? term : -term;
  }
  return products_.is_absolute() ? std::abs(value) : value;
}

void TurnedProducts::keep(const TurnedRow& row) {
  for (size_t f = 0; f < factors_.size(); ++f)
    add_products(factors_[f].data(), factors_[f].size(), row.words.size(),
                 coefficients_.data() + f * starts_.stride());
  std::fill(in_.begin(), in_.end(), 0);
  const ProductRow products{function_pointers_.data(),
                            evens_,
                            function_pointers_.data() + evens_,
                            function_pointers_.size() - evens_,
                            coefficients_.data(),
                            starts_.stride(),
                            static_cast<float>(products_.constant()),
                            products_.is_absolute()};
  const LinearWords words{row.words.data(),
                          row.words.size(),
                          row.bounds.low.data(),
                          row.bounds.high.data(),
                          row.structure.level().is_constant(),
                          mask_.data()};
  const bool has_doubt = decide_products(products, words, {in_.data(), doubt_.data()});
  uint64_t* const alive = row.alive();
  for (size_t n = 0; n < row.words.size(); ++n) {
    const uint32_t w = row.words[n];
    uint64_t in = in_[w];
    if (has_doubt && (doubt_[n] & alive[w]))
      in |= row.decide(w, doubt_[n] & alive[w], [&](size_t i) { return value_at(n, i); });
    alive[w] &= in;
  }
}

}  // namespace msq
