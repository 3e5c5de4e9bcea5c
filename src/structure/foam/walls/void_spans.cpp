// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/walls/void_spans.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/borrowed.h"
#include "base/sample_grid.h"
#include "base/simd.h"
#include "structure/foam/walls/void_spans.h"

#ifndef MSQ_VOID_SPANS_ONCE
#define MSQ_VOID_SPANS_ONCE
namespace msq {

/// Planes by the side on which they bound a span, solved for x: x <= base - y_slope y - z_slope z
/// on the right, >= on the left; and those along x, that no x changes.
struct SolvedPlanes {
  std::vector<float> base, y_slope, z_slope, shift;
  std::vector<float> inner, outer;  // of a layer: the base with the margin, less the part of z
  size_t right = 0, left = 0;       // how many; left ones come after right ones
  std::vector<VoidPlane> along;

  size_t bytes() const { return 6 * base.capacity() * sizeof(float); }
};

}  // namespace msq
#endif

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

/// Planes with a smaller part along x are taken to lie along it; 4 times this is added to their
/// margin, x being within 4.
constexpr float min_part = 1e-6f;
constexpr float farthest = 4;

void solve(const std::vector<VoidPlane>& planes, SolvedPlanes& solved) {
  for (std::vector<float>* v : {&solved.base, &solved.y_slope, &solved.z_slope, &solved.shift})
    v->clear();
  solved.along.clear();
  solved.right = solved.left = 0;
  const auto add = [&](const VoidPlane& plane) {
    const float inverse = 1 / plane.n[0];
    solved.base.push_back(plane.offset * inverse);
    solved.y_slope.push_back(plane.n[1] * inverse);
    solved.z_slope.push_back(plane.n[2] * inverse);
    solved.shift.push_back(plane.margin * inverse);
  };
  for (const VoidPlane& plane : planes)
    if (plane.n[0] > min_part) add(plane);
  solved.right = solved.base.size();
  for (const VoidPlane& plane : planes)
    if (plane.n[0] < -min_part) add(plane);
  solved.left = solved.base.size() - solved.right;
  for (const VoidPlane& plane : planes)
    if (std::abs(plane.n[0]) <= min_part) solved.along.push_back(plane);
  const size_t padded = solved.base.size() + hn::Lanes(D());
  for (std::vector<float>* v : {&solved.base, &solved.z_slope, &solved.shift}) v->resize(padded);
  solved.inner.resize(padded);
  solved.outer.resize(padded);
}

HWY_INLINE void clear_bits(uint64_t* row, uint64_t first, uint64_t last) {
  const uint64_t a = first / bits_per_word, b = last / bits_per_word;
  const uint64_t head = ~uint64_t{0} << (first % bits_per_word);
  const uint64_t tail = ~uint64_t{0} >> (bits_per_word - 1 - last % bits_per_word);
  if (a == b) {
    row[a] &= ~(head & tail);
    return;
  }
  row[a] &= ~head;
  for (uint64_t w = a + 1; w < b; ++w) row[w] = 0;
  row[b] &= ~tail;
}

/// Spans of at most so many samples are cleared without a branch, by a word that may begin at any
/// byte of the row.
constexpr int64_t short_span = 57;

HWY_INLINE void clear_short(uint64_t* row, uint64_t last_byte, uint64_t first, uint64_t count) {
  const uint64_t byte = std::min(first / 8, last_byte);
  uint64_t word;
  char* const at = reinterpret_cast<char*>(row) + byte;
  std::memcpy(&word, at, sizeof word);
  word &= ~(((uint64_t{1} << count) - 1) << (first - 8 * byte));
  std::memcpy(at, &word, sizeof word);
}

/// The spans of a vector of rows: from the sample next after the seed's, `count` 0 where there is
/// none.
struct Spans {
  alignas(64) int32_t first[2 * max_simd_doubles], count[2 * max_simd_doubles];
};

class RowSpans {
 public:
  using DI = hn::RebindToSigned<D>;
  using I = hn::Vec<DI>;

  explicit RowSpans(const VoidRows& rows)
      : low_(hn::Set(DI(), near(-rows.base))), high_(hn::Set(DI(), near(rows.last - rows.base))) {}

  /// Cut off at the ends of the row; returns the counts.
  HWY_INLINE I store(I first, I last, Spans& spans) const {
    const DI di;
    first = hn::Max(first, low_);
    last = hn::Min(last, high_);
    const I count = hn::Max(hn::Zero(di), hn::Add(hn::Sub(last, first), hn::Set(di, 1)));
    // Where there is none, any sample of the row.
    hn::StoreU(hn::Min(first, high_), di, spans.first);
    hn::StoreU(count, di, spans.count);
    return count;
  }

 private:
  /// No span ends farther from the seed.
  static int32_t near(int64_t samples) {
    constexpr int64_t most = int64_t{1} << 28;
    return static_cast<int32_t>(std::clamp(samples, -most, most));
  }

  const I low_, high_;
};

void clear_void_of(const std::vector<VoidPlane>& planes, const VoidRows& rows,
                   std::vector<DoubtfulSamples>& doubts) {
  const D d;
  const RowSpans::DI di;
  const size_t lanes = hn::Lanes(d);
  const Borrowed<SolvedPlanes> borrowed;
  SolvedPlanes& solved = *borrowed;
  solve(planes, solved);
  const size_t right = solved.right, all = right + solved.left;
  const float *const slope = solved.y_slope.data(), *const inner = solved.inner.data(),
                     *const outer = solved.outer.data();
  const V per_unit = hn::Set(d, rows.per_unit), after = hn::Set(d, rows.seed_after);
  const V most = hn::Set(d, farthest), none = hn::Set(d, 2 * farthest);
  const RowSpans ends(rows);
  constexpr bool has_bytes_in_order = std::endian::native == std::endian::little;
  const uint64_t last_byte = static_cast<uint64_t>(rows.last) / bits_per_word * 8;
  Spans certain, possible;
  for (size_t k = 0; k < rows.layers; ++k) {
    const V z = hn::Set(d, rows.z[k]);
    for (size_t i = 0; i < all; i += lanes) {
      const V base = hn::Sub(hn::LoadU(d, &solved.base[i]),
                             hn::Mul(hn::LoadU(d, &solved.z_slope[i]), z)),
              shift = hn::LoadU(d, &solved.shift[i]);
      hn::StoreU(hn::Sub(base, shift), d, &solved.inner[i]);
      hn::StoreU(hn::Add(base, shift), d, &solved.outer[i]);
    }
    for (size_t j = 0; j < rows.rows; j += lanes) {
      const V y = hn::LoadU(d, rows.y + j);
      V high_in = most, high_out = most, low_in = hn::Neg(most), low_out = low_in;
      for (size_t i = 0; i < right; ++i) {
        const V part = hn::Mul(hn::Set(d, slope[i]), y);
        high_in = hn::Min(high_in, hn::Sub(hn::Set(d, inner[i]), part));
        high_out = hn::Min(high_out, hn::Sub(hn::Set(d, outer[i]), part));
      }
      for (size_t i = right; i < all; ++i) {
        const V part = hn::Mul(hn::Set(d, slope[i]), y);
        low_in = hn::Max(low_in, hn::Sub(hn::Set(d, inner[i]), part));
        low_out = hn::Max(low_out, hn::Sub(hn::Set(d, outer[i]), part));
      }
      for (const VoidPlane& plane : solved.along) {
        const V room = hn::Sub(hn::Set(d, plane.offset - plane.n[2] * rows.z[k]),
                               hn::Mul(hn::Set(d, plane.n[1]), y));
        const float margin = plane.margin + farthest * min_part;
        low_in = hn::IfThenElse(hn::Lt(room, hn::Set(d, margin)), none, low_in);
        low_out = hn::IfThenElse(hn::Lt(room, hn::Set(d, -margin)), none, low_out);
      }
      const auto is_there = hn::Le(low_out, high_out);
      if (hn::AllFalse(d, is_there)) continue;
      // Ends beyond `farthest` are of empty spans.
      const auto first = [&](V low) {
        return hn::Ceil(hn::MulAdd(hn::Min(low, none), per_unit, after));
      };
      const auto last = [&](V high) {
        return hn::Floor(hn::MulAdd(hn::Max(high, hn::Neg(none)), per_unit, after));
      };
      const V first_in = first(low_in), last_in = last(high_in), first_out = first(low_out),
              last_out = last(high_out);
      const RowSpans::I count =
          ends.store(hn::ConvertTo(di, first_in), hn::ConvertTo(di, last_in), certain);
      const bool are_short =
          has_bytes_in_order &&
          hn::AllTrue(di, hn::Lt(count, hn::Set(di, static_cast<int32_t>(short_span) + 1)));
      const size_t end = std::min(lanes, rows.rows - j);
      uint64_t* row = rows.words + k * rows.layer_stride + j * rows.row_stride;
      if (are_short) {
        for (size_t l = 0; l < end; ++l, row += rows.row_stride)
          clear_short(row, last_byte, static_cast<uint64_t>(rows.base + certain.first[l]),
                      static_cast<uint64_t>(certain.count[l]));
      } else {
        for (size_t l = 0; l < end; ++l, row += rows.row_stride) {
          if (certain.count[l] == 0) continue;
          const auto from = static_cast<uint64_t>(rows.base + certain.first[l]);
          clear_bits(row, from, from + static_cast<uint64_t>(certain.count[l]) - 1);
        }
      }
      const auto differs =
          hn::And(is_there, hn::Or(hn::Ne(first_in, first_out), hn::Ne(last_in, last_out)));
      if (hn::AllFalse(d, differs)) continue;
      ends.store(hn::ConvertTo(di, first_out), hn::ConvertTo(di, last_out), possible);
      for (size_t l = 0; l < end; ++l) {
        const auto doubt = [&](int64_t from, int64_t to) {
          if (from < to)
            doubts.push_back({rows.first_row + static_cast<uint32_t>(j + l),
                              rows.first_layer + static_cast<uint32_t>(k),
                              static_cast<uint64_t>(rows.base + from),
                              static_cast<uint32_t>(to - from)});
        };
        const int64_t from = possible.first[l], to = from + possible.count[l];
        const int64_t a = certain.first[l], b = a + certain.count[l];
        if (a == b) {
          doubt(from, to);
        } else {
          doubt(from, a);
          doubt(b, to);
        }
      }
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(clear_void_of);

void clear_void(const std::vector<VoidPlane>& planes, const VoidRows& rows,
                std::vector<DoubtfulSamples>& doubts) {
  HWY_DYNAMIC_DISPATCH(clear_void_of)(planes, rows, doubts);
}

}  // namespace msq
#endif  // HWY_ONCE
