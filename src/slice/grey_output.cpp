// SPDX-License-Identifier: Apache-2.0
// Coverage by k x k samples per pixel, as 8-bit grey.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slice/grey_output.cpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd.h"
#include "slice/layer_output.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

#if HWY_TARGET == HWY_SCALAR  // a vector may be less than a pixel

template <unsigned k>
uint64_t write_row(const uint8_t* rows, size_t row_bytes, const uint8_t* greys, uint8_t* out,
                   size_t out_bytes) {
  uint64_t inside = 0;
  for (size_t i = 0; i < out_bytes; ++i) {
    unsigned count = 0;
    for (size_t row = 0; row < k; ++row)
      for (size_t bit = i * k; bit < (i + 1) * k && bit < row_bytes * 8; ++bit)
        count += rows[row * row_bytes + bit / 8] >> (bit % 8) & 1;
    inside += count;
    out[i] = greys[count];
  }
  return inside;
}

#else

using Bytes = hn::ScalableTag<uint8_t>;
using Vector = hn::VFromD<Bytes>;
using Sums = hn::Repartition<uint64_t, Bytes>;
constexpr size_t max_lanes = max_simd_doubles * sizeof(double);

Vector low_nibbles(Vector v) {
  return hn::And(v, hn::Set(Bytes(), uint8_t{0x0f}));
}
Vector high_nibbles(Vector v) {
  return low_nibbles(hn::ShiftRight<4>(v));
}

HWY_ALIGN constexpr uint8_t counts_of_nibbles[16] = {0, 1, 1, 2, 1, 2, 2, 3,
                                                     1, 2, 2, 3, 2, 3, 3, 4};

/// Entries of tables of 16 bytes.
Vector look_up(const uint8_t* table, Vector nibbles) {
  return hn::TableLookupBytes(hn::LoadDup128(Bytes(), table), nibbles);
}
/// Number of bits set in each byte of nibbles.
Vector counts_of(Vector nibbles) {
  return look_up(counts_of_nibbles, nibbles);
}

/// Tables from which pixels are looked up.
struct Tables {
  const uint8_t* greys;  ///< of 0 to k * k samples
  /// Of a pixel of 2 x 2 samples: those of the first row are bits 0 and 1. Of 4 x 4: of one sample
  /// to 16.
  alignas(16) uint8_t short_greys[16];

  Tables(unsigned k, const uint8_t* all) : greys(all) {
    for (size_t i = 0; i < 16; ++i)
      short_greys[i] = k == 2 ? all[counts_of_nibbles[i]] : k == 4 ? all[i + 1] : uint8_t{0};
  }
};

/// Pixels from as many bytes of samples as a vector has, of each of k rows. Adds the number of
/// samples inside.
template <unsigned k>
HWY_INLINE void write_block(const uint8_t* rows, size_t stride, const Tables& tables, uint8_t* out,
                            hn::VFromD<Sums>& inside) {
  const Bytes d;
  const auto load = [&](size_t row) HWY_ATTR { return hn::LoadU(d, rows + row * stride); };
  Vector sum;
  if constexpr (k == 2) {
    // Nibbles of both rows' samples of a pixel: of pixels 0 and 2 of a byte, and of 1 and 3.
    const auto pairs = hn::Set(d, uint8_t{0x33}), others = hn::Set(d, uint8_t{0xcc});
    const auto a = load(0), b = load(1);
    const auto even = hn::Or(hn::And(a, pairs), hn::And(hn::ShiftLeft<2>(b), others));
    const auto odd = hn::Or(hn::And(hn::ShiftRight<2>(a), pairs), hn::And(b, others));
    const auto p0 = low_nibbles(even), p1 = low_nibbles(odd), p2 = high_nibbles(even),
               p3 = high_nibbles(odd);
    sum = hn::Add(hn::Add(counts_of(p0), counts_of(p1)), hn::Add(counts_of(p2), counts_of(p3)));
    hn::StoreInterleaved4(look_up(tables.short_greys, p0), look_up(tables.short_greys, p1),
                          look_up(tables.short_greys, p2), look_up(tables.short_greys, p3), d, out);
  } else if constexpr (k == 4) {
    auto first = counts_of(low_nibbles(load(0))), second = counts_of(high_nibbles(load(0)));
    for (size_t row = 1; row < k; ++row) {
      first = hn::Add(first, counts_of(low_nibbles(load(row))));
      second = hn::Add(second, counts_of(high_nibbles(load(row))));
    }
    sum = hn::Add(first, second);
    // 16 entries from one sample on; without samples the index is negative and the grey 0.
    const auto one = hn::Set(d, uint8_t{1}), greys = hn::LoadDup128(d, tables.short_greys);
    hn::StoreInterleaved2(hn::TableLookupBytesOr0(greys, hn::Sub(first, one)),
                          hn::TableLookupBytesOr0(greys, hn::Sub(second, one)), d, out);
  } else {
    sum = hn::Zero(d);
    for (size_t row = 0; row < k; ++row)
      sum = hn::Add(sum,
                    hn::Add(counts_of(low_nibbles(load(row))), counts_of(high_nibbles(load(row)))));
    HWY_ALIGN uint8_t counts[max_lanes];
    hn::Store(sum, d, counts);
    if constexpr (k == 8)
      for (size_t i = 0; i < hn::Lanes(d); ++i) out[i] = tables.greys[counts[i]];
    else
      for (size_t i = 0; i + 1 < hn::Lanes(d); i += 2)
        out[i / 2] = tables.greys[counts[i] + counts[i + 1]];
  }
  inside = hn::Add(inside, hn::SumsOf8(sum));
}

template <unsigned k>
uint64_t write_row(const uint8_t* rows, size_t row_bytes, const uint8_t* greys, uint8_t* out,
                   size_t out_bytes) {
  const size_t lanes = hn::Lanes(Bytes());
  const Tables tables(k, greys);
  auto inside = hn::Zero(Sums());
  size_t at = 0, written = 0;
  for (; at + lanes <= row_bytes && written + lanes * 8 / k <= out_bytes;
       at += lanes, written += lanes * 8 / k)
    write_block<k>(rows + at, row_bytes, tables, out + written, inside);
  for (; at < row_bytes; at += lanes) {
    uint8_t last[k * max_lanes] = {}, pixels[max_lanes * 8 / k];
    for (size_t row = 0; row < k; ++row)
      std::memcpy(last + row * max_lanes, rows + row * row_bytes + at,
                  std::min(lanes, row_bytes - at));
    write_block<k>(last, max_lanes, tables, pixels, inside);
    const size_t fit = std::min(lanes * 8 / k, out_bytes - written);
    std::memcpy(out + written, pixels, fit);
    written += fit;
  }
  std::memset(out + written, 0, out_bytes - written);
  return hn::GetLane(hn::SumOfLanes(Sums(), inside));
}

#endif

/// One row of pixels, from k rows of `row_bytes` bytes of samples. Returns the number of samples
/// inside.
uint64_t write_grey_row(unsigned k, const uint8_t* rows, size_t row_bytes, const uint8_t* greys,
                        uint8_t* out, size_t out_bytes) {
  const auto write = k == 2   ? write_row<2>
                     : k == 4 ? write_row<4>
                     : k == 8 ? write_row<8>
                              : write_row<16>;
  return write(rows, row_bytes, greys, out, out_bytes);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(write_grey_row);

namespace {

constexpr uint64_t strip_rows = 64;

class GreyOutput final : public RowOutput {
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

  bool takes_repeats() const override { return true; }

  uint64_t write_rows(const uint64_t* words, uint64_t width, uint64_t rows,
                      uint8_t* out) const override {
    uint64_t inside = 0;
    for (uint64_t j = 0; j < rows; ++j)
      inside += write_row(words + j * samples_ * row_words(width), width, j, out);
    return inside;
  }

  uint64_t write(const LayerSource& source, uint8_t* out) const override {
    const uint64_t height = source.pixels.ny;
    if (!source.repeats) return write_strips(source, 0, height, out);
    // Rows of pixels repeat, too: after a period of samples that is a whole number of pixels.
    const RowRepeats& rows = *source.repeats;
    const uint64_t period = std::lcm(rows.period, uint64_t{samples_}) / samples_;
    const uint64_t first = (rows.first + samples_ - 1) / samples_, end = rows.end / samples_;
    if (!source.flips->all().empty() || end < first + 2 * period)
      return write_strips(source, 0, height, out);
    const uint64_t whole = (end - first) / period, rest = (end - first) % period;
    const uint64_t sum = write_strips(source, 0, first, out) +
                         (whole + 1) * write_strips(source, first, first + rest, out) +
                         whole * write_strips(source, first + rest, first + period, out) +
                         write_strips(source, end, height, out);
    const uint64_t stride = layer_stride(1, source.pixels.nx);
    source.model.context().executor.for_each(whole - 1 + (rest > 0), [&](uint64_t n) {
      const uint64_t from = first + (n + 1) * period;
      std::memcpy(out + from * stride, out + first * stride, std::min(period, end - from) * stride);
    });
    return sum;
  }

 private:
  uint64_t write_strips(const LayerSource& source, uint64_t begin, uint64_t end,
                        uint8_t* out) const {
    const uint64_t strips = (end - begin + strip_rows - 1) / strip_rows;
    std::vector<uint64_t> inside(strips);
    source.model.context().executor.for_each(strips, [&](uint64_t strip) {
      const uint64_t first = begin + strip * strip_rows, last = std::min(end, first + strip_rows);
      inside[strip] = write_source(source, first, last, out);
    });
    uint64_t sum = 0;
    for (const uint64_t count : inside) sum += count;
    return sum;
  }

  uint64_t write_source(const LayerSource& source, uint64_t first, uint64_t last,
                        uint8_t* out) const {
    const uint64_t width = source.pixels.nx;
    const size_t across = row_words(width);
    if (!source.repeats)
      return write_rows(source.words + first * samples_ * across, width, last - first,
                        out + first * layer_stride(1, width));
    std::vector<uint64_t> gathered(samples_ * across);
    uint64_t inside = 0;
    for (uint64_t j = first; j < last; ++j) {
      gather(source, j * samples_, across, gathered.data());
      inside += write_row(gathered.data(), width, j, out);
    }
    return inside;
  }

  /// Row j of an output, from its rows of samples.
  uint64_t write_row(const uint64_t* samples, uint64_t width, uint64_t j, uint8_t* out) const {
    const uint64_t stride = layer_stride(1, width);
    return HWY_DYNAMIC_DISPATCH(write_grey_row)(samples_, reinterpret_cast<const uint8_t*>(samples),
                                                row_words(width) * sizeof(uint64_t), greys_.data(),
                                                out + j * stride, stride);
  }

  size_t row_words(uint64_t width) const { return words_for(width * samples_); }

  /// The rows of samples of a row of pixels, from `first` on, some of which repeat others.
  void gather(const LayerSource& source, uint64_t first, size_t row_words, uint64_t* rows) const {
    for (uint64_t row = 0; row < samples_; ++row)
      std::copy_n(source.words + source.repeats->source(first + row) * row_words, row_words,
                  rows + row * row_words);
    const std::vector<RowFlip>& flips = source.flips->all();
    auto flip = std::lower_bound(flips.begin(), flips.end(), first,
                                 [](const RowFlip& f, uint64_t row) { return f.j < row; });
    for (; flip != flips.end() && flip->j < first + samples_; ++flip)
      rows[(flip->j - first) * row_words + flip->i / bits_per_word] ^= uint64_t{1}
                                                                       << (flip->i % bits_per_word);
  }

  const unsigned samples_;
  std::array<uint8_t, 257> greys_{};  // of each number of samples inside; of 0 it is 0
};

}  // namespace

std::unique_ptr<const LayerOutput> make_grey_output(const GreyScale& grey) {
  return std::make_unique<GreyOutput>(grey);
}

}  // namespace msq
#endif  // HWY_ONCE
