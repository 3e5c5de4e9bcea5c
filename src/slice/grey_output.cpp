// SPDX-License-Identifier: Apache-2.0
// Coverage by k x k samples per pixel, as 8-bit grey.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slice/grey_output.cpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
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
using Counts = hn::VFromD<Bytes>;
constexpr size_t max_lanes = max_simd_doubles * sizeof(double);

/// Number of bits set in each group of `bits` bits of a byte.
template <unsigned bits>
Counts counts_of_groups(Counts v) {
  const Bytes d;
  const auto odd = hn::Set(d, uint8_t{0x55}), pairs = hn::Set(d, uint8_t{0x33}),
             nibble = hn::Set(d, uint8_t{0x0f});
  v = hn::Sub(v, hn::And(hn::ShiftRight<1>(v), odd));
  if constexpr (bits >= 4) v = hn::Add(hn::And(v, pairs), hn::And(hn::ShiftRight<2>(v), pairs));
  if constexpr (bits >= 8) v = hn::And(hn::Add(v, hn::ShiftRight<4>(v)), nibble);
  return v;
}

/// Greys of counts up to 16.
Counts greys_of(Counts counts, const uint8_t* greys) {
  const Bytes d;
  const auto all = hn::Eq(counts, hn::Set(d, uint8_t{16}));
  return hn::IfThenElse(all, hn::Set(d, greys[16]),
                        hn::TableLookupBytes(hn::LoadDup128(d, greys), counts));
}

/// Pixels from as many bytes of samples as a vector has, of each of k rows. Adds the number of
/// samples inside.
template <unsigned k>
void write_block(const uint8_t* rows, size_t stride, const uint8_t* greys, uint8_t* out,
                 uint64_t& inside) {
  const Bytes d;
  const auto load = [&](size_t row) { return hn::LoadU(d, rows + row * stride); };
  const auto pairs = hn::Set(d, uint8_t{0x33}), nibble = hn::Set(d, uint8_t{0x0f});
  const auto low = [&](Counts v) { return hn::And(v, nibble); };
  const auto high = [&](Counts v) { return hn::And(hn::ShiftRight<4>(v), nibble); };
  Counts sum;
  if constexpr (k == 2) {
    const auto a = counts_of_groups<2>(load(0)), b = counts_of_groups<2>(load(1));
    const auto even = hn::Add(hn::And(a, pairs), hn::And(b, pairs));
    const auto odd =
        hn::Add(hn::And(hn::ShiftRight<2>(a), pairs), hn::And(hn::ShiftRight<2>(b), pairs));
    const auto both = hn::Add(even, odd);  // nibbles of at most 8
    sum = hn::Add(low(both), high(both));
    hn::StoreInterleaved4(greys_of(low(even), greys), greys_of(low(odd), greys),
                          greys_of(high(even), greys), greys_of(high(odd), greys), d, out);
  } else if constexpr (k == 4) {
    // Two rows have at most 8 samples in a nibble, four have 16.
    const auto a = hn::Add(counts_of_groups<4>(load(0)), counts_of_groups<4>(load(1)));
    const auto b = hn::Add(counts_of_groups<4>(load(2)), counts_of_groups<4>(load(3)));
    const auto first = hn::Add(low(a), low(b)), second = hn::Add(high(a), high(b));
    sum = hn::Add(first, second);
    hn::StoreInterleaved2(greys_of(first, greys), greys_of(second, greys), d, out);
  } else {
    sum = counts_of_groups<8>(load(0));
    for (size_t row = 1; row < k; ++row) sum = hn::Add(sum, counts_of_groups<8>(load(row)));
    HWY_ALIGN uint8_t counts[max_lanes];
    hn::Store(sum, d, counts);
    if constexpr (k == 8)
      for (size_t i = 0; i < hn::Lanes(d); ++i) out[i] = greys[counts[i]];
    else
      for (size_t i = 0; i + 1 < hn::Lanes(d); i += 2)
        out[i / 2] = greys[counts[i] + counts[i + 1]];
  }
  inside += hn::GetLane(hn::SumOfLanes(hn::Repartition<uint64_t, Bytes>(), hn::SumsOf8(sum)));
}

template <unsigned k>
uint64_t write_row(const uint8_t* rows, size_t row_bytes, const uint8_t* greys, uint8_t* out,
                   size_t out_bytes) {
  const size_t lanes = hn::Lanes(Bytes());
  uint64_t inside = 0;
  size_t at = 0, written = 0;
  for (; at + lanes <= row_bytes && written + lanes * 8 / k <= out_bytes;
       at += lanes, written += lanes * 8 / k)
    write_block<k>(rows + at, row_bytes, greys, out + written, inside);
  for (; at < row_bytes; at += lanes) {
    uint8_t last[k * max_lanes] = {}, pixels[max_lanes * 8 / k];
    for (size_t row = 0; row < k; ++row)
      std::memcpy(last + row * max_lanes, rows + row * row_bytes + at,
                  std::min(lanes, row_bytes - at));
    write_block<k>(last, max_lanes, greys, pixels, inside);
    const size_t fit = std::min(lanes * 8 / k, out_bytes - written);
    std::memcpy(out + written, pixels, fit);
    written += fit;
  }
  std::memset(out + written, 0, out_bytes - written);
  return inside;
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
    const size_t row_bytes = words_for(width * samples_) * sizeof(uint64_t);
    const auto* samples = reinterpret_cast<const uint8_t*>(source.words);
    uint64_t inside = 0;
    for (uint64_t j = first; j < last; ++j)
      inside +=
          HWY_DYNAMIC_DISPATCH(write_grey_row)(samples_, samples + j * samples_ * row_bytes,
                                               row_bytes, greys_.data(), out + j * stride, stride);
    return inside;
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
