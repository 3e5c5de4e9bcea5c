// SPDX-License-Identifier: Apache-2.0
// BoxClass by k x k samples per pixel, as 8-bit grey.
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "slice/layer_output.h"

namespace msq {

namespace {

constexpr uint64_t strip_rows = 64;

/// The number of bits set in each group of k bits of a word, in place.
template <unsigned k>
uint64_t counts_of_groups(uint64_t v) {
  v = (v & 0x5555555555555555u) + (v >> 1 & 0x5555555555555555u);
  if constexpr (k >= 4) v = (v & 0x3333333333333333u) + (v >> 2 & 0x3333333333333333u);
  if constexpr (k >= 8) v = (v + (v >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  if constexpr (k >= 16) v = (v + (v >> 8)) & 0x00ff00ff00ff00ffu;
  return v;
}

class GreyOutput final : public LayerOutput {
 public:
  explicit GreyOutput(const GreyScale& grey) : samples_(grey.samples) {
    const unsigned all = samples_ * samples_;
    for (unsigned n = 0; n <= all; ++n) {
      const double value = 255 * std::pow(static_cast<double>(n) / all, grey.gamma);
      const auto rounded = static_cast<unsigned>(std::floor(value + 0.5));
      greys_[n] = static_cast<uint8_t>(rounded < grey.threshold ? 0 : rounded);
    }
  }

  unsigned pixel_bytes() const override { return 1; }
  unsigned samples_across() const override { return samples_; }

  uint64_t write(const LayerSource& source, uint8_t* out) const override {
    const uint64_t height = source.pixels.ny, strips = (height + strip_rows - 1) / strip_rows;
    std::vector<uint64_t> inside(strips);
    source.model.context().executor.for_each(strips, [&](uint64_t strip) {
      const uint64_t first = strip * strip_rows, last = std::min(height, first + strip_rows);
      inside[strip] = write_rows(source, first, last, out);
    });
    uint64_t sum = 0;
    for (const uint64_t count : inside) sum += count;
    return sum;
  }

 private:
  uint64_t write_rows(const LayerSource& source, uint64_t first, uint64_t last,
                      uint8_t* out) const {
    const uint64_t width = source.pixels.nx, stride = layer_stride(1, width);
    uint64_t inside = 0;
    for (uint64_t j = first; j < last; ++j) {
      uint8_t* bytes = out + j * stride;
      switch (samples_) {
        case 2:
          inside += write_row<2>(source.words, width, j, bytes);
          break;
        case 4:
          inside += write_row<4>(source.words, width, j, bytes);
          break;
        case 8:
          inside += write_row<8>(source.words, width, j, bytes);
          break;
        default:
          inside += write_row<16>(source.words, width, j, bytes);
      }
      std::fill(bytes + width, bytes + stride, uint8_t{0});
    }
    return inside;
  }

  /// One row of pixels, from k rows of words. Most words are all outside or all inside.
  template <unsigned k>
  uint64_t write_row(const uint64_t* samples, uint64_t width, uint64_t j, uint8_t* bytes) const {
    constexpr unsigned groups = 64 / k;
    constexpr uint64_t mask = (uint64_t{1} << k) - 1;
    const size_t words = words_for(width * k);
    const uint64_t* rows = samples + j * k * words;
    uint64_t inside = 0;
    for (size_t w = 0; w < words; ++w) {
      const uint64_t first = w * groups;
      const auto count = static_cast<unsigned>(std::min<uint64_t>(groups, width - first));
      uint64_t any = 0, all = ~uint64_t{0};
      for (unsigned n = 0; n < k; ++n) {
        any |= rows[n * words + w];
        all &= rows[n * words + w];
      }
      if (any == 0 || all == ~uint64_t{0}) {
        const unsigned samples_in = any ? k * k : 0;
        inside += uint64_t{count} * samples_in;
        std::fill_n(bytes + first, count, greys_[samples_in]);
        continue;
      }
      uint16_t counts[groups] = {};
      for (unsigned n = 0; n < k; ++n) {
        const uint64_t v = counts_of_groups<k>(rows[n * words + w]);
        for (unsigned g = 0; g < groups; ++g)
          counts[g] = static_cast<uint16_t>(counts[g] + (v >> (g * k) & mask));
      }
      for (unsigned g = 0; g < count; ++g) {
        inside += counts[g];
        bytes[first + g] = greys_[counts[g]];
      }
    }
    return inside;
  }

  const unsigned samples_;
  std::array<uint8_t, 257> greys_{};
};

}  // namespace

std::unique_ptr<const LayerOutput> make_grey_output(const GreyScale& grey) {
  return std::make_unique<GreyOutput>(grey);
}

}  // namespace msq
