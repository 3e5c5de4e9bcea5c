// SPDX-License-Identifier: Apache-2.0
// Spans of bit rows, gathered without branches and drawn later in one tight loop. Included once for
// each instruction set.
#if defined(MSQ_STRUT_SPAN_BUFFER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUT_SPAN_BUFFER_INL_H
#undef MSQ_STRUT_SPAN_BUFFER_INL_H
#else
#define MSQ_STRUT_SPAN_BUFFER_INL_H
#endif

#include <hwy/highway.h>

#include <cstring>

#include "base/compress-inl.h"
#include "base/sample_grid.h"
#include "base/simd.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Spans that are not drawn yet.
class SpanBuffer {
 public:
  explicit SpanBuffer(uint64_t* words) : words_(words) {}

  /// Bits [bit, bit + more] of the lanes in `mask`.
  template <class D>
  HWY_INLINE void add(D d, hn::Vec<D> bit, hn::Vec<D> more, hn::Mask<D> mask) {
    const Compression<D> compress(mask);
    hn::StoreU(compress(bit), d, bits_ + count_);
    hn::StoreU(compress(more), d, more_ + count_);
    count_ += hn::CountTrue(d, mask);
    if (count_ >= capacity) draw();
  }

  HWY_INLINE void draw() {
    unsigned char* const bytes = reinterpret_cast<unsigned char*>(words_);
    for (size_t i = 0; i < count_; ++i) {
      const uint32_t bit = static_cast<uint32_t>(bits_[i]), more = static_cast<uint32_t>(more_[i]);
      if (more > 56) {
        set_bits(words_, bit, uint64_t{bit} + more);
        continue;
      }
      // One unaligned word, for any start bit of the span.
      const uint64_t mask = (~uint64_t{0} >> (63 - more)) << (bit & 7);
      uint64_t word;
      std::memcpy(&word, bytes + (bit >> 3), sizeof word);
      word |= mask;
      std::memcpy(bytes + (bit >> 3), &word, sizeof word);
    }
    count_ = 0;
  }

 private:
  static constexpr size_t capacity = 256;

  uint64_t* const words_;
  size_t count_ = 0;
  int32_t bits_[capacity + 2 * max_simd_doubles], more_[capacity + 2 * max_simd_doubles];
};

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
