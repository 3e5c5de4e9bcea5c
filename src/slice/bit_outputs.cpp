// SPDX-License-Identifier: Apache-2.0
// One sample per pixel, as bits and as bytes.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slice/bit_outputs.cpp"
#include <bit>
#include <cstring>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd.h"
#include "slice/layer_output.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

/// Number of bits set.
uint64_t count_bits(const uint64_t* words, size_t count) {
  const hn::ScalableTag<uint64_t> d;
  const size_t lanes = hn::Lanes(d);
  auto sum = hn::Zero(d);
  size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    sum = hn::Add(sum, hn::PopulationCount(hn::LoadU(d, words + i)));
  uint64_t total = hn::GetLane(hn::SumOfLanes(d, sum));
  for (; i < count; ++i) total += static_cast<uint64_t>(std::popcount(words[i]));
  return total;
}

using Words = hn::ScalableTag<uint64_t>;

/// Reverses the bits of each byte.
class ReversedBits {
 public:
  HWY_INLINE hn::Vec<Words> operator()(hn::Vec<Words> v) const {
    const Words d;
    const auto nibbles = hn::Set(d, 0x0f0f0f0f0f0f0f0fu);
#if HWY_TARGET == HWY_SCALAR
    const auto odd = hn::Set(d, 0x5555555555555555u), pairs = hn::Set(d, 0x3333333333333333u);
    v = hn::Or(hn::And(hn::ShiftRight<1>(v), odd), hn::ShiftLeft<1>(hn::And(v, odd)));
    v = hn::Or(hn::And(hn::ShiftRight<2>(v), pairs), hn::ShiftLeft<2>(hn::And(v, pairs)));
    return hn::Or(hn::And(hn::ShiftRight<4>(v), nibbles), hn::ShiftLeft<4>(hn::And(v, nibbles)));
#else
    // Of the 16 nibbles: one becomes the high one, the other the low one.
    alignas(16) static constexpr uint8_t reversed[16] = {0, 8, 4, 12, 2, 10, 6, 14,
                                                         1, 9, 5, 13, 3, 11, 7, 15};
    const hn::Repartition<uint8_t, Words> bytes;
    const auto table = hn::LoadDup128(bytes, reversed);
    const auto low = hn::And(v, nibbles), high = hn::And(hn::ShiftRight<4>(v), nibbles);
    const auto look_up = [&](auto of) HWY_ATTR {
      return hn::BitCast(d, hn::TableLookupBytes(table, hn::BitCast(bytes, of)));
    };
    return hn::Or(hn::ShiftLeft<4>(look_up(low)), look_up(high));
#endif
  }
};

/// Copies words with the bits of each byte reversed: sample 0 moves to the high bit of byte 0.
/// Returns the number of bits set. `out` may be the words themselves.
uint64_t reverse_bits_of_bytes(const uint64_t* words, size_t count, uint8_t* out) {
  const Words d;
  const size_t lanes = hn::Lanes(d);
  const ReversedBits reversed;
  auto sum = hn::Zero(d);
  size_t i = 0;
  HWY_ALIGN uint64_t last[max_simd_doubles];  // words are as wide as doubles
  for (; i + lanes <= count; i += lanes) {
    const auto v = hn::LoadU(d, words + i);
    sum = hn::Add(sum, hn::PopulationCount(v));
    hn::Store(reversed(v), d, last);
    std::memcpy(out + i * sizeof(uint64_t), last, lanes * sizeof(uint64_t));
  }
  uint64_t total = hn::GetLane(hn::SumOfLanes(d, sum));
  for (; i < count; ++i) {
    total += static_cast<uint64_t>(std::popcount(words[i]));
    hn::Store(reversed(hn::Set(d, words[i])), d, last);
    std::memcpy(out + i * sizeof(uint64_t), last, sizeof(uint64_t));
  }
  return total;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

static_assert(std::endian::native == std::endian::little,
              "bit rows are written as bytes in the order of a little-endian word");

HWY_EXPORT(count_bits);
HWY_EXPORT(reverse_bits_of_bytes);

namespace {

uint64_t write_bits(const uint64_t* rows, size_t words, uint8_t* out) {
  return HWY_DYNAMIC_DISPATCH(reverse_bits_of_bytes)(rows, words, out);
}

class BitOutput final : public RowOutput {
 public:
  unsigned pixel_bytes() const override { return 0; }
  unsigned samples_across() const override { return 1; }
  uint64_t write_rows(const uint64_t* words, uint64_t width, uint64_t rows,
                      uint8_t* out) const override {
    return write_bits(words, words_for(width) * rows, out);
  }
};

class ByteOutput final : public RowOutput {
 public:
  unsigned pixel_bytes() const override { return 1; }
  unsigned samples_across() const override { return 1; }
  uint64_t write_rows(const uint64_t* words, uint64_t width, uint64_t rows,
                      uint8_t* out) const override {
    const size_t row_words = words_for(width);
    const uint64_t stride = layer_stride(1, width);
    for (uint64_t j = 0; j < rows; ++j) {
      const uint64_t* row = words + j * row_words;
      uint8_t* bytes = out + j * stride;
      for (uint64_t i = 0; i < stride; ++i)  // bits past the width are 0
        bytes[i] = (row[i / bits_per_word] >> (i % bits_per_word) & 1) ? 255 : 0;
    }
    return HWY_DYNAMIC_DISPATCH(count_bits)(words, row_words * rows);
  }
};

}  // namespace

std::unique_ptr<const LayerOutput> make_bit_output() {
  return std::make_unique<BitOutput>();
}

void read_bit_output(const uint8_t* written, size_t words, uint64_t* rows) {
  std::memcpy(rows, written, words * sizeof(uint64_t));
  write_bits(rows, words, reinterpret_cast<uint8_t*>(rows));
}

std::unique_ptr<const LayerOutput> make_byte_output() {
  return std::make_unique<ByteOutput>();
}

}  // namespace msq
#endif  // HWY_ONCE
