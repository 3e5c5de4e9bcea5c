// SPDX-License-Identifier: Apache-2.0
// The facets that the walk over tetrahedra (facet_walk.h) knows: their buckets, and the queue of
// those whose far side is unknown. Included once for each instruction set.
#if defined(MSQ_STRUCTURE_FOAM_EDGES_FACET_TABLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUCTURE_FOAM_EDGES_FACET_TABLE_INL_H
#undef MSQ_STRUCTURE_FOAM_EDGES_FACET_TABLE_INL_H
#else
#define MSQ_STRUCTURE_FOAM_EDGES_FACET_TABLE_INL_H
#endif

#include <hwy/highway.h>

#include <bit>

#include "base/compress-inl.h"
#include "base/mask_bits-inl.h"
#include "structure/foam/edges/facet_batch-inl.h"
#include "structure/foam/edges/facet_state.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

struct Facets {
  alignas(64) uint32_t low[2 * B], high[2 * B], key[2 * B], tetrahedron[2 * B];
  size_t count;
};

// A facet in the queue, in bits: b 0 to 11, c 12 to 23, a 32 to 43, sign 44, slot 45 to 50, bucket
// 51 to 61.
HWY_INLINE uint64_t queued(uint32_t low, uint32_t high, uint64_t slot) {
  return low | uint64_t{high} << 32 | slot << 45;
}
static_assert(FacetState::buckets <= 1 << 11 && FacetState::bucket_room == 1 << 6);
static_assert(FacetState::max_width * FacetState::stride * FacetState::stride <= 1 << 12);

/// Takes up to B facets whose far side is unknown.
HWY_INLINE void draw(FacetState& s, Batch& batch) {
  size_t n = 0;
  uint64_t drawn[B];
  while (n < B && s.head < s.last) {
    s.random = s.random * 1664525 + 1013904223;
    const uint32_t at =
        s.head + static_cast<uint32_t>(uint64_t{s.random} * (s.last - s.head) >> 32);
    const uint64_t q = s.queue[at];
    s.queue[at] = s.queue[s.head];
    ++s.head;
    drawn[n] = q;
    n += !(s.done[q >> 51] >> (q >> 45 & 63) & 1);
  }
  batch.count = n;
  if (n == 0) return;
  for (size_t i = n; i < B; ++i) drawn[i] = drawn[0];
  for (size_t i = 0; i < B; ++i) {
    const uint64_t q = drawn[i];
    batch.b[i] = q & 0xfff;
    batch.c[i] = q >> 12 & 0xfff;
    batch.a[i] = q >> 32 & 0xfff;
    batch.side[i] = q >> 44 & 1 ? -1.0f : 1.0f;
    batch.slot[i] = q >> 45 & 63;
    batch.bucket[i] = static_cast<uint32_t>(q >> 51);
  }
}

/// Among the owners, by number as in a brick of max_side^3, or else a number with the bit
/// `outside`.
constexpr uint32_t outside = FacetState::seeds_in_brick;
HWY_INLINE VU with_number(const FacetState& s, VU seed) {
  const DU d;
  const auto mask = hn::Set(d, FacetState::stride - 1), halo = hn::Set(d, FacetState::halo);
  const auto x = hn::Sub(hn::And(seed, mask), halo),
             y = hn::Sub(hn::And(hn::ShiftRight<4>(seed), mask), halo),
             z = hn::Sub(hn::ShiftRight<8>(seed), halo);
  static_assert(FacetState::max_side == 8);
  // Differences below 0 have all of the upper bits.
  const auto off = [&](VU at, int k) HWY_ATTR {
    return hn::Or(hn::Sub(at, hn::Set(d, static_cast<uint32_t>(s.owners.low[k]))),
                  hn::Sub(hn::Set(d, static_cast<uint32_t>(s.owners.high[k] - 1)), at));
  };
  const auto is_out = hn::Ne(hn::And(hn::Or(off(x, 0), hn::Or(off(y, 1), off(z, 2))),
                                     hn::Set(d, ~uint32_t{FacetState::max_side - 1})),
                             hn::Zero(d));
  const auto number = hn::Or(x, hn::Or(hn::ShiftLeft<3>(y), hn::ShiftLeft<6>(z)));
  return hn::Or(hn::ShiftLeft<12>(seed), hn::IfThenElse(is_out, hn::Set(d, outside), number));
}
/// Differs for seeds up to three cells apart along each axis, of which the order is known.
HWY_INLINE VU code(VU seed) {
  const DU d;
  return hn::Or(hn::And(seed, hn::Set(d, 7)),
                hn::Or(hn::And(hn::ShiftRight<1>(seed), hn::Set(d, 0x38)),
                       hn::And(hn::ShiftRight<2>(seed), hn::Set(d, 0xc0))));
}

/// Appends those of the `which` facets that have a seed in the brick. Seeds are sorted and come
/// with their numbers; `away`: whether the unknown side is not that of the cross product.
HWY_INLINE void name(VU low, VU middle, VU high, hn::Mask<DU> away, hn::Mask<DU> which,
                     VU tetrahedron, Facets& to) {
  const DU d;
  const auto out = hn::Set(d, outside), number = hn::Set(d, 0xfff);
  const auto low_out = hn::Ne(hn::And(low, out), hn::Zero(d));
  const auto middle_out = hn::Ne(hn::And(middle, out), hn::Zero(d));
  const auto high_out = hn::Ne(hn::And(high, out), hn::Zero(d));
  const auto two_out = hn::And(low_out, middle_out);
  which = hn::AndNot(hn::And(two_out, high_out), which);
  const VU first = hn::IfThenElse(two_out, high, hn::IfThenElse(low_out, middle, low));
  const VU kind = hn::Add(hn::IfThenElseZero(low_out, out), hn::IfThenElseZero(two_out, out));
  const VU bucket = hn::Add(hn::And(first, number), kind);
  low = hn::ShiftRight<12>(low);
  middle = hn::ShiftRight<12>(middle);
  high = hn::ShiftRight<12>(high);
  const VU one = hn::IfThenElse(low_out, low, middle), two = hn::IfThenElse(two_out, middle, high);
  const VU key = hn::Or(code(one), hn::ShiftLeft<8>(code(two)));
  const VU head = hn::Or(low, hn::IfThenElseZero(away, hn::Set(d, 1 << 12)));
  const Compression<DU> chosen(which);
  hn::StoreU(chosen(hn::Or(middle, hn::ShiftLeft<12>(high))), d, to.low + to.count);
  hn::StoreU(chosen(hn::Or(head, hn::ShiftLeft<19>(bucket))), d, to.high + to.count);
  hn::StoreU(chosen(key), d, to.key + to.count);
  hn::StoreU(chosen(tetrahedron), d, to.tetrahedron + to.count);
  to.count += hn::CountTrue(d, which);
}

/// The slot of a facet in its bucket as a bit, or none.
HWY_INLINE uint64_t slots_of(const uint16_t* keys, uint32_t key, uint32_t count) {
  const hn::CappedTag<uint16_t, FacetState::bucket_room / 2> d;
  constexpr size_t half = FacetState::bucket_room / 2;
  const auto wanted = hn::Set(d, static_cast<uint16_t>(key));
  uint64_t found = 0;
  for (size_t i = 0; i < half; i += hn::Lanes(d))
    found |= bits_of(d, hn::Eq(hn::Load(d, keys + i), wanted)) << i;
  if (HWY_UNLIKELY(count > half))
    for (size_t i = half; i < 2 * half; i += hn::Lanes(d))
      found |= bits_of(d, hn::Eq(hn::Load(d, keys + i), wanted)) << i;
  return found & ((uint64_t{1} << count) - 1);
}

/// Puts a facet down and queues it if it is new. Without a branch: whether it is new is
/// unpredictable.
HWY_INLINE void put(FacetState& s, const Facets& f, size_t i, uint32_t slot, uint32_t is_known) {
  const uint32_t bucket = f.high[i] >> 19;
  s.keys[bucket][slot] = static_cast<uint16_t>(f.key[i]);
  s.ends[bucket][slot][is_known] = static_cast<uint16_t>(f.tetrahedron[i]);
  s.done[bucket] |= uint64_t{is_known} << slot;
  const uint32_t is_new = (is_known ^ 1) & (s.count[bucket] < FacetState::bucket_room - 1);
  s.count[bucket] = static_cast<uint8_t>(s.count[bucket] + is_new);
  s.queue[s.last] = queued(f.low[i], f.high[i], slot);
  s.last += is_new;
}
HWY_INLINE void find_slot(const FacetState& s, const Facets& f, size_t i, uint32_t& slot,
                          uint32_t& is_known) {
  const uint32_t bucket = f.high[i] >> 19, count = s.count[bucket];
  const uint64_t found = slots_of(s.keys[bucket], f.key[i], count);
  slot = static_cast<uint32_t>(std::countr_zero(found | uint64_t{1} << count));
  is_known = found != 0;
}

/// Most are in different buckets: all are looked up before any is put down, so that no look-up
/// waits for a store. The others are looked up again.
HWY_INLINE void take(FacetState& s, const Facets& f) {
  uint32_t slots[B], known[B];
  ++s.stamp;
  for (size_t i = 0; i < f.count; ++i) find_slot(s, f, i, slots[i], known[i]);
  for (size_t i = 0; i < f.count; ++i) {
    const uint32_t bucket = f.high[i] >> 19;
    if (HWY_UNLIKELY(s.bucket_used[bucket] == s.stamp)) find_slot(s, f, i, slots[i], known[i]);
    s.bucket_used[bucket] = s.stamp;
    put(s, f, i, slots[i], known[i]);
  }
}

/// The tetrahedra of a batch, without those that come twice.
HWY_INLINE uint32_t without_copies(FacetState& s, const Batch& batch) {
  const DU d;
  alignas(64) uint32_t first[B], last[B], hash[B];
  for (size_t i = 0; i < B; i += hn::Lanes(d)) {
    const VU a = hn::Load(d, batch.a + i), b = hn::Load(d, batch.b + i),
             c = hn::Load(d, batch.c + i), e = hn::Load(d, batch.found + i);
    const VU one = hn::Or(hn::Min(a, e), hn::ShiftLeft<16>(hn::Max(a, hn::Min(b, e))));
    const VU two = hn::Or(hn::Max(b, hn::Min(c, e)), hn::ShiftLeft<16>(hn::Max(c, e)));
    hn::Store(one, d, first + i);
    hn::Store(two, d, last + i);
    const VU mixed =
        hn::Mul(hn::Xor(one, hn::Mul(two, hn::Set(d, 0x9e3779b1u))), hn::Set(d, 0x85ebca6bu));
    hn::Store(hn::ShiftRight<21>(mixed), d, hash + i);
  }
  static_assert(sizeof s.hash_used / sizeof s.hash_used[0] == 1 << 11);
  ++s.stamp;
  uint32_t kept = 0;
  for (size_t i = 0; i < batch.count; ++i) {
    uint32_t is_copy = 0;
    if (HWY_UNLIKELY(s.hash_used[hash[i]] == s.stamp))
      for (size_t j = 0; j < i; ++j) is_copy |= first[j] == first[i] && last[j] == last[i];
    s.hash_used[hash[i]] = s.stamp;
    kept |= (is_copy ^ 1) << i;
  }
  return kept;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
