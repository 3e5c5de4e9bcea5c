// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/turned_waves.h"

#include <algorithm>

namespace msq {

namespace {

constexpr size_t batch_words = single_points / bits_per_word;
constexpr size_t wave_stride = single_points + batch_padding;

}  // namespace

TurnedWaves::TurnedWaves(const TrigonometricForm& form, const TurnedStarts& starts)
    : form_(form), starts_(starts), values_(form.values()) {
  const size_t waves = form_.waves().size();
  steps_ = allocate_aligned(2 * waves * bits_per_word);
  float* to = steps_.get();
  for (size_t wave = 0; wave < waves; ++wave)
    for (const bool is_cosine : {true, false}) {
      const auto part = static_cast<TurnedStarts::Part>(2 * wave + is_cosine);
      for (size_t i = 0; i < bits_per_word; ++i)
        *to++ = static_cast<float>(starts_.step(part, 0, static_cast<double>(i)));
    }
  waves_ = allocate_aligned(2 * waves * wave_stride);
  std::fill_n(waves_.get(), 2 * waves * wave_stride, 0.0f);
  for (size_t i = 0; i < 2 * waves; ++i)
    values_.set_input(i, {waves_.get() + i * wave_stride, false});
}

void TurnedWaves::keep(const TurnedRow& row) {
  for (size_t first = 0; first < row.words.size(); first += batch_words)
    decide(row, first, std::min(batch_words, row.words.size() - first));
}

void TurnedWaves::decide(const TurnedRow& row, size_t first, size_t count) {
  for (size_t wave = 0; wave < form_.waves().size(); ++wave) {
    const float* steps = steps_.get() + 2 * wave * bits_per_word;
    const float* from = starts_.of(static_cast<TurnedStarts::Part>(2 * wave)) + first;
    float* to = waves_.get() + 2 * wave * wave_stride;
    turn_angles(from, from + starts_.stride(), count, steps, steps + bits_per_word, to,
                to + wave_stride);
  }
  values_.run(count * bits_per_word);
  const ValuesOf<float> values = values_.output(0);
  uint64_t at_most_low[batch_words], at_most_high[batch_words];
  compare_singles(values, row.words.data() + first, count, row.bounds.low.data(),
                  row.bounds.high.data(), row.structure.level().is_constant(), at_most_low,
                  at_most_high);
  uint64_t* const words = row.alive();
  for (size_t n = 0; n < count; ++n) {
    const uint32_t w = row.words[first + n];
    uint64_t in = at_most_low[n];
    in |= row.decide(w, at_most_high[n] & ~in & words[w],
                     [&](size_t i) { return values[n * bits_per_word + i]; });
    words[w] &= in;
  }
}

}  // namespace msq
