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
#include "structure/foam/walls/rows_met-inl.h"
#include "structure/foam/walls/solved_planes-inl.h"
#include "structure/foam/walls/void_spans.h"
#include "structure/foam/walls/void_work.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

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
constexpr int32_t short_span = 57;

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

  /// Cut off at the ends of the row; returns the counts, 0 but in the lanes `which`.
  HWY_INLINE I store(I first, I last, hn::Mask<DI> which, Spans& spans) const {
    const DI di;
    first = hn::Max(first, low_);
    last = hn::Min(last, high_);
    const I count = hn::IfThenElseZero(
        which, hn::Max(hn::Zero(di), hn::Add(hn::Sub(last, first), hn::Set(di, 1))));
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

/// Clears spans of at most short_span samples in a vector of rows.
class ShortSpans {
 public:
  explicit ShortSpans(const VoidRows& rows)
      : base_(hn::Set(DW(), rows.base)),
        last_byte_(hn::Set(DW(), rows.last / static_cast<int64_t>(bits_per_word) * 8)) {}

  HWY_INLINE void clear(uint64_t* const* rows, const Spans& spans) const {
    const DW dw;
    const DU du;
    const hn::Rebind<int32_t, DW> di;
    // Of each row: where a word begins, and which of its bits are kept.
    alignas(64) int64_t byte[2 * max_simd_doubles];
    alignas(64) uint64_t kept[2 * max_simd_doubles];
    const size_t lanes = hn::Lanes(D());
    const auto one = hn::Set(du, 1);
    for (size_t l = 0; l < lanes; l += hn::Lanes(dw)) {
      const auto first = hn::Add(hn::PromoteTo(dw, hn::LoadU(di, spans.first + l)), base_);
      const auto count = hn::BitCast(du, hn::PromoteTo(dw, hn::LoadU(di, spans.count + l)));
      const auto begin = hn::Min(hn::ShiftRight<3>(first), last_byte_);
      const auto shift = hn::BitCast(du, hn::Sub(first, hn::ShiftLeft<3>(begin)));
      hn::Store(begin, dw, byte + l);
      hn::Store(hn::Not(hn::Shl(hn::Sub(hn::Shl(one, count), one), shift)), du, kept + l);
    }
    for (size_t l = 0; l < lanes; ++l) {
      char* const at = reinterpret_cast<char*>(rows[l]) + byte[l];
      uint64_t word;
      std::memcpy(&word, at, sizeof word);
      word &= kept[l];
      std::memcpy(at, &word, sizeof word);
    }
  }

 private:
  using DW = hn::ScalableTag<int64_t>;
  using DU = hn::RebindToUnsigned<DW>;

  const hn::Vec<DW> base_, last_byte_;
};

/// The spans of a vector of rows, before they are rounded to samples.
struct Ends {
  V low, high;
};

/// Of the void with all planes moved inwards: `low` and `high` of the rows at hand. Two vectors at
/// a time share what is loaded of a plane.
HWY_INLINE void find_inner_ends(VoidWork& work, size_t rows, float reach) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  for (size_t j = 0; j < rows; j += 2 * lanes) {
    const V y0 = hn::Load(d, work.y + j), y1 = hn::Load(d, work.y + j + lanes);
    const V z0 = hn::Load(d, work.z + j), z1 = hn::Load(d, work.z + j + lanes);
    V low0 = hn::Set(d, -reach), low1 = low0, high0 = hn::Set(d, reach), high1 = high0;
    for (size_t i = 0; i < work.right.count; ++i) {
      const V by_y = hn::Set(d, work.right.y_slope[i]), by_z = hn::Set(d, work.right.z_slope[i]),
              inner = hn::Set(d, work.right.inner[i]);
      high0 = hn::Min(high0, hn::NegMulAdd(by_y, y0, hn::NegMulAdd(by_z, z0, inner)));
      high1 = hn::Min(high1, hn::NegMulAdd(by_y, y1, hn::NegMulAdd(by_z, z1, inner)));
    }
    for (size_t i = 0; i < work.left.count; ++i) {
      const V by_y = hn::Set(d, work.left.y_slope[i]), by_z = hn::Set(d, work.left.z_slope[i]),
              inner = hn::Set(d, work.left.inner[i]);
      low0 = hn::Max(low0, hn::NegMulAdd(by_y, y0, hn::NegMulAdd(by_z, z0, inner)));
      low1 = hn::Max(low1, hn::NegMulAdd(by_y, y1, hn::NegMulAdd(by_z, z1, inner)));
    }
    hn::Store(low0, d, work.low + j);
    hn::Store(low1, d, work.low + j + lanes);
    hn::Store(high0, d, work.high + j);
    hn::Store(high1, d, work.high + j + lanes);
  }
}

/// Both, plane by plane.
HWY_INLINE void both_ends(const VoidWork& work, V y, V z, float reach, Ends& inner, Ends& outer) {
  const D d;
  inner = outer = {hn::Set(d, -reach), hn::Set(d, reach)};
  const auto at = [&](const SidePlanes& side, size_t i) {
    return hn::NegMulAdd(hn::Set(d, side.y_slope[i]), y,
                         hn::NegMulAdd(hn::Set(d, side.z_slope[i]), z, hn::Set(d, side.base[i])));
  };
  for (size_t i = 0; i < work.right.count; ++i) {
    const V x = at(work.right, i), shift = hn::Set(d, work.right.shift[i]);
    inner.high = hn::Min(inner.high, hn::Sub(x, shift));
    outer.high = hn::Min(outer.high, hn::Add(x, shift));
  }
  for (size_t i = 0; i < work.left.count; ++i) {
    const V x = at(work.left, i), shift = hn::Set(d, work.left.shift[i]);
    inner.low = hn::Max(inner.low, hn::Sub(x, shift));
    outer.low = hn::Max(outer.low, hn::Add(x, shift));
  }
  const V none = hn::Set(d, 2 * reach);
  for (const VoidPlane& plane : work.along) {
    const V room =
        hn::NegMulAdd(hn::Set(d, plane.n[1]), y,
                      hn::NegMulAdd(hn::Set(d, plane.n[2]), z, hn::Set(d, plane.offset)));
    const float margin = plane.margin + reach * min_part;
    inner.low = hn::IfThenElse(hn::Lt(room, hn::Set(d, margin)), none, inner.low);
    outer.low = hn::IfThenElse(hn::Lt(room, hn::Set(d, -margin)), none, outer.low);
  }
}

/// The rows that may meet the void, one after the other, layer after layer: up to VoidWork::rows.
class RowsAtHand {
 public:
  RowsAtHand(const VoidRows& rows, VoidWork& work) : rows_(rows), work_(work) {
    // Of layers that vectors read beyond the last one as well.
    const size_t room = rows.layers + VoidWork::padding;
    if (work.first.size() < room) {
      work.first.resize(room);
      work.count.resize(room);
    }
    if (work.along.empty() && rows.rows * rows.layers > few_vectors * hn::Lanes(D()) &&
        find_rows_met(rows, work))
      return;
    std::fill_n(work.first.begin(), rows.layers, 0);
    std::fill_n(work.count.begin(), rows.layers, static_cast<int32_t>(rows.rows));
  }

  /// Goes on; returns how many are at hand, 0 after the last.
  size_t next() {
    const D d;
    first_layer_ = layer_;
    first_row_ = row_;
    size_t count = 0;
    for (; layer_ < rows_.layers; ++layer_, row_ = 0) {
      const auto in_layer = static_cast<size_t>(work_.count[layer_]);
      const size_t taken = std::min(in_layer - row_, VoidWork::rows - count);
      const size_t from = static_cast<size_t>(work_.first[layer_]) + row_;
      const V z = hn::Set(d, rows_.z[layer_]);
      for (size_t i = 0; i < taken; i += hn::Lanes(d)) {
        hn::StoreU(hn::LoadU(d, rows_.y + from + i), d, work_.y + count + i);
        hn::StoreU(z, d, work_.z + count + i);
      }
      uint64_t* word = rows_.words + layer_ * rows_.layer_stride + from * rows_.row_stride;
      for (size_t i = 0; i < taken; ++i, word += rows_.row_stride) work_.row[count + i] = word;
      count += taken;
      row_ += taken;
      if (row_ < in_layer) break;
    }
    // For the rest of a vector: nothing is cleared there.
    std::fill_n(work_.row + count, hn::Lanes(d), rows_.words);
    return count;
  }

  /// Calls visit(row, layer), in the block, for a row at hand.
  template <class Visit>
  void locate(size_t i, const Visit& visit) const {
    size_t layer = first_layer_, row = first_row_ + i;
    for (; row >= static_cast<size_t>(work_.count[layer]); ++layer)
      row -= static_cast<size_t>(work_.count[layer]);
    visit(rows_.first_row + static_cast<uint32_t>(work_.first[layer]) + static_cast<uint32_t>(row),
          rows_.first_layer + static_cast<uint32_t>(layer));
  }

 private:
  /// Fewer than so many vectors of rows cost less than finding those that meet the void.
  static constexpr size_t few_vectors = 6;

  const VoidRows& rows_;
  VoidWork& work_;
  size_t first_layer_ = 0, first_row_ = 0, layer_ = 0, row_ = 0;
};

void clear_void_of(const VoidFaces& faces, const VoidRows& rows,
                   std::vector<DoubtfulSamples>& doubts) {
  const D d;
  const RowSpans::DI di;
  const size_t lanes = hn::Lanes(d);
  const Borrowed<VoidWork> borrowed;
  VoidWork& work = *borrowed;
  solve(faces, work);
  const V per_unit = hn::Set(d, rows.per_unit), after = hn::Set(d, rows.seed_after);
  const V none = hn::Set(d, 2 * faces.reach);
  // In samples after sample `base`. Ends beyond the reach are of empty spans.
  const auto placed = [&](const Ends& x) {
    return Ends{hn::MulAdd(hn::Min(x.low, none), per_unit, after),
                hn::MulAdd(hn::Max(x.high, hn::Neg(none)), per_unit, after)};
  };
  // Moving the planes outwards moves ends by less than this, roundings included.
  const float rounding = 0x1p-20f * faces.reach;
  const V low_room = hn::Set(d, (2 * work.left.most + rounding) * rows.per_unit),
          high_room = hn::Set(d, (2 * work.right.most + rounding) * rows.per_unit);
  const V one = hn::Set(d, 1), low_rest = hn::Sub(one, low_room),
          high_rest = hn::Sub(one, high_room);
  const RowSpans ends(rows);
  const ShortSpans short_spans(rows);
  constexpr bool has_bytes_in_order = std::endian::native == std::endian::little;
  Spans certain, possible;
  RowsAtHand at_hand(rows, work);
  while (const size_t n = at_hand.next()) {
    if (HWY_LIKELY(work.along.empty())) find_inner_ends(work, n, faces.reach);
    for (size_t j = 0; j < n; j += lanes) {
      Ends inner{none, none}, outer = inner;
      V first, last;
      bool has_doubts;
      if (HWY_LIKELY(work.along.empty())) {
        inner = placed({hn::Load(d, work.low + j), hn::Load(d, work.high + j)});
        first = hn::Ceil(inner.low);
        last = hn::Floor(inner.high);
        const auto may_differ = hn::Or(hn::Ge(hn::Sub(first, inner.low), low_rest),
                                       hn::Ge(hn::Sub(inner.high, last), high_rest));
        const auto may_exist = hn::Le(hn::Sub(inner.low, low_room), hn::Add(inner.high, high_room));
        has_doubts = !hn::AllFalse(d, hn::And(may_differ, may_exist));
      } else {
        has_doubts = true;
      }
      if (HWY_UNLIKELY(has_doubts)) {
        both_ends(work, hn::Load(d, work.y + j), hn::Load(d, work.z + j), faces.reach, inner,
                  outer);
        inner = placed(inner);
        outer = placed(outer);
        first = hn::Ceil(inner.low);
        last = hn::Floor(inner.high);
        outer = {hn::Ceil(outer.low), hn::Floor(outer.high)};
        has_doubts = !hn::AllFalse(d, hn::Or(hn::Ne(first, outer.low), hn::Ne(last, outer.high)));
      }
      const size_t end = std::min(lanes, n - j);
      const auto which = hn::FirstN(di, end);
      const RowSpans::I count =
          ends.store(hn::ConvertTo(di, first), hn::ConvertTo(di, last), which, certain);
      uint64_t* const* const row = work.row + j;
      if (has_bytes_in_order &&
          HWY_LIKELY(hn::AllTrue(di, hn::Lt(count, hn::Set(di, short_span + 1))))) {
        short_spans.clear(row, certain);
      } else {
        for (size_t l = 0; l < end; ++l) {
          if (certain.count[l] == 0) continue;
          const auto from = static_cast<uint64_t>(rows.base + certain.first[l]);
          clear_bits(row[l], from, from + static_cast<uint64_t>(certain.count[l]) - 1);
        }
      }
      if (HWY_LIKELY(!has_doubts)) continue;
      ends.store(hn::ConvertTo(di, outer.low), hn::ConvertTo(di, outer.high), which, possible);
      for (size_t l = 0; l < end; ++l) {
        const auto doubt = [&](int64_t from, int64_t to) {
          if (from < to)
            at_hand.locate(j + l, [&](uint32_t row_of_block, uint32_t layer) {
              doubts.push_back({row_of_block, layer, static_cast<uint64_t>(rows.base + from),
                                static_cast<uint32_t>(to - from)});
            });
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

void clear_void(const VoidFaces& faces, const VoidRows& rows,
                std::vector<DoubtfulSamples>& doubts) {
  HWY_DYNAMIC_DISPATCH(clear_void_of)(faces, rows, doubts);
}

}  // namespace msq
#endif  // HWY_ONCE
