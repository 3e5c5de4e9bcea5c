// SPDX-License-Identifier: Apache-2.0
// A facet of three seeds is an edge of the cells of all three: each two of them are neighbours, and
// both of its ends are vertices of all three cells. The walk keeps each facet with a seed in the
// brick once, so one pass over them tells all that is to know of the cells of the brick.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/edges/facet_cells.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "structure/foam/edges/facet_cells.h"

#ifndef MSQ_FACET_CELLS_ONCE
#define MSQ_FACET_CELLS_ONCE
namespace msq {

/// Where a pass over facets writes.
struct CellsOfFacets {
  uint64_t (*neighbours)[8];
  float (*low)[4], (*high)[4];
};

}  // namespace msq
#endif

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

constexpr int side = FacetState::max_side, halo = FacetState::halo;
constexpr uint32_t none = FacetState::seeds_in_brick;

using DI = hn::CappedTag<int32_t, FacetState::batch>;
using VI = hn::Vec<DI>;

/// Seeds of the facets of a bucket other than the owner: their numbers in the brick (`none` if they
/// are outside), and their words and bits among neighbours.
struct Others {
  alignas(64) int32_t number[FacetState::bucket_room], word[FacetState::bucket_room],
      bit[FacetState::bucket_room];
};

struct Owner {
  int x, y, z;
  uint32_t number() const { return static_cast<uint32_t>((z * side + y) * side + x); }
  int word() const { return (z + halo) & 7; }
  uint64_t bit() const { return uint64_t{1} << (((y + halo) & 7) << 3 | ((x + halo) & 7)); }
};

/// `code`: as in keys (facet_table-inl.h): the last bits of a cell, three of x and y and two of z.
/// `is_after`: whether the seed comes after the owner.
HWY_INLINE void read(const Owner& owner, VI code, bool is_after, Others& others, size_t at) {
  const DI d;
  const auto set = [&](int value) { return hn::Set(d, value); };
  const VI seven = set(7);
  const auto from_owner = [&](VI last, int own) {
    // Within three cells of it.
    return hn::Add(hn::And(hn::Sub(last, set(own + halo - 3)), seven), set(own - 3));
  };
  const VI x = from_owner(code, owner.x), y = from_owner(hn::ShiftRight<3>(code), owner.y);
  const VI last = hn::ShiftRight<6>(code), own = set(owner.z + halo), three = set(3);
  const VI z = is_after ? hn::Add(set(owner.z), hn::And(hn::Sub(last, own), three))
                        : hn::Sub(set(owner.z), hn::And(hn::Sub(own, last), three));
  static_assert(side == 8);
  const auto is_in = hn::Eq(hn::AndNot(seven, hn::Or(x, hn::Or(y, z))), hn::Zero(d));
  const VI number = hn::Or(x, hn::Or(hn::ShiftLeft<3>(y), hn::ShiftLeft<6>(z)));
  hn::Store(hn::IfThenElse(is_in, number, set(static_cast<int32_t>(none))), d, others.number + at);
  hn::Store(hn::And(hn::Add(z, set(halo)), seven), d, others.word + at);
  hn::Store(hn::And(code, set(63)), d, others.bit + at);
}

/// `kind`: how many of a facet's seeds come before the owner, all of them outside of the brick.
HWY_INLINE void take(const FacetState& s, const Owner& owner, uint32_t kind,
                     const CellsOfFacets& to) {
  const uint32_t own = owner.number(), bucket = own + kind * none, count = s.count[bucket];
  Others one, two;
  const DI d;
  const hn::Rebind<uint16_t, DI> d16;
  for (size_t i = 0; i < count; i += hn::Lanes(d)) {
    const VI key = hn::PromoteTo(d, hn::Load(d16, s.keys[bucket] + i));
    read(owner, hn::And(key, hn::Set(d, 0xff)), kind == 0, one, i);
    read(owner, hn::ShiftRight<8>(key), kind < 2, two, i);
  }
  const int own_word = owner.word();
  const uint64_t own_bit = owner.bit();
  uint64_t* const own_words = to.neighbours[own];
#if HWY_TARGET != HWY_SCALAR
  const hn::FixedTag<float, 4> d4;
  auto low = hn::Load(d4, to.low[own]), high = hn::Load(d4, to.high[own]);
#endif
  for (size_t i = 0; i < count; ++i) {
    const int32_t a = one.number[i], b = two.number[i];
    const int32_t word_a = one.word[i], word_b = two.word[i];
    const uint64_t bit_a = uint64_t{1} << one.bit[i], bit_b = uint64_t{1} << two.bit[i];
    own_words[word_a] |= bit_a;
    own_words[word_b] |= bit_b;
    to.neighbours[a][own_word] |= own_bit;
    to.neighbours[a][word_b] |= bit_b;
    to.neighbours[b][own_word] |= own_bit;
    to.neighbours[b][word_a] |= bit_a;
    const float *p = s.centres[s.ends[bucket][i][0]], *q = s.centres[s.ends[bucket][i][1]];
#if HWY_TARGET == HWY_SCALAR
    for (int k = 0; k < 3; ++k)
      for (const uint32_t seed : {own, static_cast<uint32_t>(a), static_cast<uint32_t>(b)}) {
        to.low[seed][k] = std::min(to.low[seed][k], std::min(p[k], q[k]));
        to.high[seed][k] = std::max(to.high[seed][k], std::max(p[k], q[k]));
      }
#else
    const auto first = hn::Load(d4, p), second = hn::Load(d4, q);
    const auto least = hn::Min(first, second), most = hn::Max(first, second);
    low = hn::Min(low, least);
    high = hn::Max(high, most);
    for (const int32_t seed : {a, b}) {
      hn::Store(hn::Min(hn::Load(d4, to.low[seed]), least), d4, to.low[seed]);
      hn::Store(hn::Max(hn::Load(d4, to.high[seed]), most), d4, to.high[seed]);
    }
#endif
  }
#if HWY_TARGET != HWY_SCALAR
  hn::Store(low, d4, to.low[own]);
  hn::Store(high, d4, to.high[own]);
#endif
}

void take_all(const FacetState& s, const CellsOfFacets& to) {
  for (uint32_t kind = 0; kind < 3; ++kind)
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) take(s, {x, y, z}, kind, to);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(take_all);

void FacetCells::find(const FacetState& state) {
  constexpr float far = 1e30f;
  std::memset(neighbours_, 0, sizeof neighbours_);
  std::fill_n(low_[0], 4 * seeds, far);
  std::fill_n(high_[0], 4 * seeds, -far);
  HWY_DYNAMIC_DISPATCH(take_all)(state, {neighbours_, low_, high_});
}

void FacetCells::read(const FacetState& state, int x, int y, int z, Cell& cell) const {
  constexpr int side = FacetState::max_side, halo = FacetState::halo, stride = FacetState::stride;
  const auto number = static_cast<size_t>((z * side + y) * side + x);
  std::copy_n(low_[number], 3, cell.low);
  std::copy_n(high_[number], 3, cell.high);
  const auto place = [](int px, int py, int pz) { return (pz * stride + py) * stride + px; };
  const float* const own = state.points[place(x + halo, y + halo, z + halo)];
  std::copy_n(own, 3, cell.own);
  size_t count = 0;
  for (int dz = -3; dz <= 3; ++dz) {
    const int layer = z + halo + dz;
    for (uint64_t rest = neighbours_[number][layer & 7]; rest; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      // Within three cells of the seed's.
      const int column = x + (((bit & 7) - x) & 7), row = y + (((bit >> 3) - y) & 7);
      const float* const other = state.points[place(column, row, layer)];
      cell.x[count] = other[0] - own[0];
      cell.y[count] = other[1] - own[1];
      cell.z[count] = other[2] - own[2];
      ++count;
    }
  }
  cell.count = count;
}

}  // namespace msq
#endif  // HWY_ONCE
