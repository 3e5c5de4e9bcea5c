// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "printability/component_scan.cpp"
#include <algorithm>
#include <bit>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/job.h"
#include "base/simd.h"
#include "printability/bit_row.h"
#include "printability/component_band.h"
#include "printability/known_rows-inl.h"

// Compiled for each instruction set: counting the bits of a word is one instruction in most.
HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {

inline uint32_t count_ones(uint64_t word) {
  return static_cast<uint32_t>(std::popcount(word));
}

/// Calls take(bit) for each bit of a word that is set.
template <class Take>
inline void for_each_bit(uint64_t word, Take&& take) {
  for (; word; word &= word - 1) take(static_cast<unsigned>(std::countr_zero(word)));
}

/// The bits up to and with one.
inline uint64_t bits_to(unsigned bit) {
  return ~uint64_t{0} >> (bits_per_word - 1 - bit);
}

/// A row of runs, read word by word. Which run a sample belongs to is the number of runs that start
/// up to it.
struct RowReader {
  const uint64_t* row = nullptr;            // null: no samples
  uint32_t before = 0;                      // number of the run that starts first from this word on
  uint64_t word = 0, starts = 0, last = 0;  // last: bit 63 of the word before, as bit 0

  void read(size_t w) {
    last = word >> (bits_per_word - 1);
    before += count_ones(starts);
    word = row ? row[w] : 0;
    starts = word & ~(word << 1 | last);
  }
  /// The run that holds a bit of this word.
  uint32_t run_at(unsigned bit) const { return before + count_ones(starts & bits_to(bit)) - 1; }
};

/// Bits of a word that are looked at together, even if fewer are set: the processor foresees loops
/// of so many better.
constexpr uint32_t at_once = 4;

/// Gives the runs that have none the next nodes. Returns how many, and lists these runs. All is
/// written in any case: the processor does not foresee which runs have none.
HWY_NOINLINE uint32_t take_nodes(uint32_t* HWY_RESTRICT nodes, size_t count, uint32_t next,
                                 uint32_t* HWY_RESTRICT fresh) {
  uint32_t made = 0;
  for (size_t r = 0; r < count; ++r) {
    fresh[made] = static_cast<uint32_t>(r);
    const uint32_t node = nodes[r], is_fresh = node == ComponentBand::none, mask = 0u - is_fresh;
    nodes[r] = (node & ~mask) | ((next + made) & mask);
    made += is_fresh;
  }
  return made;
}

/// Adds runs of a row to the parts of components. `edges` has one run more.
HWY_NOINLINE void add_runs(const uint32_t* HWY_RESTRICT edges, const uint32_t* HWY_RESTRICT nodes,
                           size_t count, uint32_t row, ComponentPart* HWY_RESTRICT parts) {
#if HWY_TARGET == HWY_SCALAR
  for (size_t r = 0; r < count; ++r) {
    const uint32_t first = edges[2 * r], end = edges[2 * r + 1];
    ComponentPart& part = parts[nodes[r]];
    part.maxima[0] = std::max(part.maxima[0], ~first);
    part.maxima[1] = std::max(part.maxima[1], end);
    part.maxima[2] = std::max(part.maxima[2], row);
    part.samples += end - first;
  }
#else
  const hn::FixedTag<uint32_t, 4> d;
  alignas(16) const uint32_t of_run[4] = {~0u, ~0u, 0, 0}, of_first[4] = {~0u, 0, 0, 0},
                             of_row[4] = {0, 0, row, 0};
  const auto run_mask = hn::Load(d, of_run), flip = hn::Load(d, of_first), y = hn::Load(d, of_row);
  for (size_t r = 0; r < count; ++r) {
    ComponentPart& part = parts[nodes[r]];
    const auto run = hn::Xor(hn::And(hn::LoadU(d, edges + 2 * r), run_mask), flip);
    hn::StoreU(hn::Max(hn::LoadU(d, part.maxima), hn::Or(run, y)), d, part.maxima);
    part.samples += edges[2 * r + 1] - edges[2 * r];
  }
#endif
}

class Scan {
 public:
  Scan(ComponentBand& band, ComponentMasks& masks, const ComponentRules& rules,
       const uint64_t* rows, uint64_t nx, uint64_t ny, uint64_t layer)
      : band_(band),
        masks_(masks),
        rules_(rules),
        rows_(rows),
        nx_(nx),
        ny_(ny),
        words_(masks.known.words),
        layer_(layer),
        pairs_(band.pairs),
        fresh_(band.fresh),
        overlaps_(band.overlaps) {
    overlaps_.resize(words_);
  }

  void run() {
    if (masks_.has_known) flood();
    label();
    number();
  }

 private:
  /// Marks the runs of a row that touch the known component below, beside or at a side.
  void flood_row(const uint64_t* row, uint64_t j, const uint64_t* beside) {
    uint64_t *known = masks_.known.row(j), *rest = masks_.rest.row(j);
    uint8_t& has_rest = band_.has_rest[j - band_.begin];
    has_rest = fill_words(row, masks_.known_below.row(j), known, rest, words_);
    if (!has_rest) return;
    if (rules_.anchors_sides) {
      extend_word(row, known, rest, 0, 1);
      extend_word(row, known, rest, (nx_ - 1) / bits_per_word,
                  uint64_t{1} << (nx_ - 1) % bits_per_word);
    }
    has_rest = extend(row, beside, known, rest);
  }

  static void extend_word(const uint64_t* row, uint64_t* known, uint64_t* rest, size_t w,
                          uint64_t seeds) {
    if (!(rest[w] & seeds)) return;
    known[w] = filled_down(row[w], filled_up(row[w], known[w] | (rest[w] & seeds)));
    rest[w] = row[w] & ~known[w];
  }

  bool extend(const uint64_t* row, const uint64_t* beside, uint64_t* known, uint64_t* rest) const {
    return rules_.joins_corners ? extend_row<true>(row, beside, known, rest, words_)
                                : extend_row<false>(row, beside, known, rest, words_);
  }

  /// Samples that are next to those of a row beside them, in word w.
  uint64_t touching(const uint64_t* beside, size_t w) const {
    return rules_.joins_corners ? spread_word(beside, words_, w) : beside[w];
  }

  /// Finds most of what the known component has in this layer: row by row upwards and downwards.
  /// Spirals, and what comes from other bands, are left to unions.
  void flood() {
    ComponentMask& known = masks_.known;
    const uint64_t begin = band_.begin, end = band_.end;
    if (layer_ == 0 && rules_.anchors_first_layer) {
      std::copy_n(rows_ + begin * words_, words_ * (end - begin), known.row(begin));
      std::fill(band_.has_rest.begin(), band_.has_rest.end(), uint8_t{0});
      return;
    }
    CancelPoll poll(current_job());
    for (uint64_t j = begin; j < end; ++j) {
      poll();
      const uint64_t* row = rows_ + j * words_;
      if (rules_.anchors_sides && (j == 0 || j + 1 == ny_)) {
        std::copy_n(row, words_, known.row(j));
        band_.has_rest[j - begin] = 0;
        continue;
      }
      flood_row(row, j, j > begin ? known.row(j - 1) : nullptr);
    }
    for (uint64_t j = end - 1; j-- > begin;) {
      if (!band_.has_rest[j - begin]) continue;
      band_.has_rest[j - begin] =
          extend(rows_ + j * words_, known.row(j + 1), known.row(j), masks_.rest.row(j));
    }
  }

  /// Lists the runs of the rest, row by row, and gives each a node: that of a run which it touches
  /// in the row before, or a new one. Runs that touch join their nodes, and so do components below.
  void label() {
    ComponentRuns& runs = band_.runs;
    const ComponentRuns& below = band_.below;
    band_.node_below.assign(1 + band_.global_below.size(), ComponentBand::none);
    nodes_ = 1;
    reserve_nodes(0);
    band_.parents[0] = 0;
    band_.parts[0] = {};
    CancelPoll poll(current_job());
    uint32_t count = 0;
    for (uint64_t j = band_.begin; j < band_.end; ++j) {
      poll();
      const uint64_t n = j - band_.begin;
      runs.begin[n] = count;
      const bool has_below = below.begin[n] < below.begin[n + 1];
      if (masks_.has_known && has_below) join_known_above(j, n);
      if (masks_.has_known && !band_.has_rest[n]) continue;
      if (!masks_.has_known) std::copy_n(rows_ + j * words_, words_, masks_.rest.row(j));
      count = list(masks_.rest.row(j), count);
      if (runs.begin[n] == count) continue;
      label_row(n, count, static_cast<uint32_t>(j));
      if (!masks_.has_known) continue;
      if (n > 0) join_known_beside(j, n, j - 1);
      if (j + 1 < band_.end) join_known_beside(j, n, j + 1);
    }
    runs.begin[band_.end - band_.begin] = count;
  }

  /// Room for as many nodes more.
  void reserve_nodes(size_t more) {
    const size_t wanted = nodes_ + more;
    if (band_.parents.size() >= wanted) return;
    const size_t size = std::max(wanted, band_.parents.size() * 3 / 2);
    band_.parents.resize(size);
    band_.parts.resize(size);
  }

  /// Adds the runs of a row to the first `before` runs. Returns how many there are then.
  uint32_t list(const uint64_t* row, uint32_t before) {
    ComponentRuns& runs = band_.runs;
    size_t at = 2 * size_t{before};
    uint64_t carry = 0;
    for (size_t w = 0; w < words_; ++w) {
      // A run begins and ends where a sample is unlike the one before it.
      uint64_t edges = row[w] ^ (row[w] << 1 | carry);
      carry = row[w] >> (bits_per_word - 1);
      if (!edges) continue;
      if (runs.edges.size() < at + 2 * bits_per_word)
        runs.edges.resize(std::max(at + 2 * bits_per_word, runs.edges.size() * 3 / 2));
      uint32_t* to = runs.edges.data() + at;
      const auto first = static_cast<uint32_t>(w * bits_per_word);
      const uint32_t found = count_ones(edges);
      for (uint32_t i = 0; i < found; i += 2 * at_once)
        for (uint32_t k = i; k < i + 2 * at_once; ++k) {
          to[k] = first + static_cast<uint32_t>(std::countr_zero(edges));
          edges &= edges - 1;
        }
      at += found;
    }
    if (carry) runs.edges[at++] = static_cast<uint32_t>(words_ * bits_per_word);
    const size_t all = at / 2;
    if (all >= UINT32_MAX)
      fail(Status::limit, "layer %llu has %zu runs of samples to label; the limit is 2^32 - 1",
           static_cast<unsigned long long>(layer_), all);
    if (runs.node.size() < all) runs.node.resize(std::max(all, runs.node.size() * 3 / 2));
    reserve_nodes(all - before);
    return static_cast<uint32_t>(all);
  }

  /// Lists the pairs of runs of two rows that overlap or, with corners, meet at one.
  template <bool corners>
  size_t list_pairs(const uint64_t* a, uint32_t a_begin, uint32_t a_end, const uint64_t* b,
                    uint32_t b_begin, uint32_t b_end) {
    // Each pair is the first for one of its runs.
    const size_t most = size_t{a_end - a_begin} + (b_end - b_begin) + at_once;
    if (pairs_.size() < most) pairs_.resize(most);
    RunPair* to = pairs_.data();
    RowReader of_a{a, a_begin}, of_b{b, b_begin};
    uint64_t carry = 0;
    for (size_t w = 0; w < words_; ++w) {
      of_a.read(w);
      of_b.read(w);
      const uint64_t both = of_a.word & of_b.word;
      // Samples where a run of `a` and one of `b` are met first.
      uint64_t meet = both & ~(both << 1 | carry);
      carry = both >> (bits_per_word - 1);
      if constexpr (corners)
        meet |= (of_a.starts & (of_b.word << 1 | of_b.last) & ~of_b.word) |
                (of_b.starts & (of_a.word << 1 | of_a.last) & ~of_a.word);
      const uint32_t found = count_ones(meet);
      for (uint32_t i = 0; i < found; i += at_once)
        for (uint32_t k = i; k < i + at_once; ++k) {
          // The bits up to and with the lowest of `meet`.
          const uint64_t up_to = meet ^ (meet - 1);
          to[k] = {of_a.before + count_ones(of_a.starts & up_to) - 1,
                   of_b.before + count_ones(of_b.starts & up_to) - 1};
          meet &= meet - 1;
        }
      to += found;
    }
    return static_cast<size_t>(to - pairs_.data());
  }

  /// Lists pairs of runs of a row and of the row below it that overlap. Those are left out that
  /// share samples with such a pair of the row before: its runs belong to the same components.
  size_t list_new_pairs(const uint64_t* a, uint32_t a_begin, uint32_t a_end, const uint64_t* b,
                        uint32_t b_begin, uint32_t b_end, uint64_t row) {
    const size_t most = size_t{a_end - a_begin} + (b_end - b_begin) + at_once;
    if (pairs_.size() < most) pairs_.resize(most);
    if (overlaps_row_ + 1 != row) std::fill_n(overlaps_.begin(), words_, uint64_t{0});
    overlaps_row_ = row;
    RunPair* to = pairs_.data();
    RowReader of_a{a, a_begin}, of_b{b, b_begin};
    uint64_t carry = 0, both = a[0] & b[0];
    for (size_t w = 0; w < words_; ++w) {
      of_a.read(w);
      of_b.read(w);
      const uint64_t next = w + 1 < words_ ? a[w + 1] & b[w + 1] : 0;
      // From samples that they share to the last sample of the overlap.
      const uint64_t shared = filled_up(both, (both & overlaps_[w]) | (carry & both));
      overlaps_[w] = both;
      carry = shared >> (bits_per_word - 1);
      uint64_t ends = both & ~(both >> 1 | next << (bits_per_word - 1)) & ~shared;
      both = next;
      // One is written in any case.
      const uint32_t found = count_ones(ends);
      uint32_t i = 0;
      do {
        const uint64_t up_to = ends ^ (ends - 1);
        to[i] = {of_a.before + count_ones(of_a.starts & up_to) - 1,
                 of_b.before + count_ones(of_b.starts & up_to) - 1};
        ends &= ends - 1;
      } while (++i < found);
      to += found;
    }
    return static_cast<size_t>(to - pairs_.data());
  }

  uint32_t joined(uint32_t a, uint32_t b) {
    if (a == b) return a;
    a = band_.find(a);
    b = band_.find(b);
    const uint32_t low = std::min(a, b);
    band_.parents[std::max(a, b)] = low;
    return low;
  }

  /// Labels the runs of row n of the band, up to the last that are listed.
  void label_row(uint64_t n, uint32_t end, uint32_t row) {
    constexpr uint32_t none = ComponentBand::none;
    const uint64_t* const bits = masks_.rest.row(row);
    const uint32_t* const edges = band_.runs.edges.data();
    uint32_t* const nodes = band_.runs.node.data();
    ComponentPart* const parts = band_.parts.data();
    uint32_t* const parents = band_.parents.data();
    const uint32_t begin = band_.runs.begin[n];
    std::fill(nodes + begin, nodes + end, none);
    const uint32_t before = n > 0 ? band_.runs.begin[n - 1] : begin;
    if (before < begin) {
      const uint64_t* beside = masks_.rest.row(row - 1);
      const size_t count = rules_.joins_corners
                               ? list_pairs<true>(bits, begin, end, beside, before, begin)
                               : list_pairs<false>(bits, begin, end, beside, before, begin);
      for (size_t i = 0; i < count; ++i) {
        const RunPair pair = pairs_[i];
        const uint32_t node = nodes[pair.a], other = nodes[pair.b];
        nodes[pair.a] = node & other;  // none has all bits
        if (node != other && node != none) nodes[pair.a] = joined(node, other);
      }
    }
    // Runs that touch none become nodes of their own.
    if (fresh_.size() < end - begin) fresh_.resize(end - begin);
    uint32_t* const fresh = fresh_.data();
    const uint32_t made = take_nodes(nodes + begin, end - begin, nodes_, fresh);
    for (uint32_t i = 0; i < made; ++i) {
      const uint32_t node = nodes_ + i;
      parents[node] = node;
      parts[node] = {{}, 0, edges[2 * (begin + fresh[i])], row};
    }
    nodes_ += made;
    add_runs(edges + 2 * size_t{begin}, nodes + begin, end - begin, row, parts);
    const ComponentRuns& below = band_.below;
    const uint32_t below_begin = below.begin[n], below_end = below.begin[n + 1];
    if (below_begin == below_end) return;
    const size_t count =
        list_new_pairs(bits, begin, end, masks_.rest_below.row(row), below_begin, below_end, row);
    uint32_t* const node_below = band_.node_below.data();
    for (size_t i = 0; i < count; ++i) {
      const RunPair pair = pairs_[i];
      const uint32_t node = nodes[pair.a];
      uint32_t& other = node_below[below.component(pair.b)];
      parts[node].set_has_below();
      other = other == none ? node : joined(node, other);
    }
  }

  /// Runs of the rest that touch a known sample in the row `other`.
  void join_known_beside(uint64_t j, uint64_t n, uint64_t other) {
    const uint64_t *rest = masks_.rest.row(j), *known = masks_.known.row(other);
    if (!(rules_.joins_corners ? any_next_to(rest, known, words_)
                               : any_common(rest, known, words_)))
      return;
    RowReader here{rest, band_.runs.begin[n]};
    for (size_t w = 0; w < words_; ++w) {
      here.read(w);
      for_each_bit(here.word & touching(known, w),
                   [&](unsigned bit) { joined(0, band_.runs.node[here.run_at(bit)]); });
    }
  }

  /// Components below that known samples lie on.
  void join_known_above(uint64_t j, uint64_t n) {
    const uint64_t *rest = masks_.rest_below.row(j), *known = masks_.known.row(j);
    if (!any_common(rest, known, words_)) return;
    RowReader under{rest, band_.below.begin[n]};
    uint64_t carry = 0;
    for (size_t w = 0; w < words_; ++w) {
      under.read(w);
      const uint64_t both = under.word & known[w];
      for_each_bit(both & ~(both << 1 | carry), [&](unsigned bit) {
        uint32_t& node = band_.node_below[band_.below.component(under.run_at(bit))];
        node = node == ComponentBand::none ? 0 : joined(0, node);
      });
      carry = both >> (bits_per_word - 1);
    }
  }

  /// Numbers the components in the order of their first runs, which is that of the roots.
  void number() {
    ComponentRuns& runs = band_.runs;
    if (runs.numbers.size() <= band_.parents.size()) runs.numbers.resize(band_.parents.size() + 1);
    if (band_.roots.size() < nodes_) band_.roots.resize(band_.parents.size());
    uint32_t *const parents = band_.parents.data(), *const numbers = runs.numbers.data(),
                    *const roots = band_.roots.data();
    ComponentPart* const parts = band_.parts.data();
    numbers[0] = 0;
    uint32_t count = 0;
    bool has_known_runs = parts[0].samples > 0;
    for (uint32_t node = 1; node < nodes_; ++node) {
      const uint32_t root = parents[node] = parents[parents[node]];
      roots[count] = node;
      count += root == node;
      numbers[node] = count;
      numbers[node] = numbers[root];
      if (root == node) continue;
      has_known_runs |= root == 0;
      parts[root].merge(parts[node]);
    }
    band_.nodes = nodes_;
    band_.count = count;
    const size_t below = band_.global_below.size();
    band_.heirs.resize(below);
    numbers[nodes_] = ComponentBand::none;
    for (size_t c = 0; c < below; ++c) {
      const uint32_t node = band_.node_below[c + 1], mask = 0u - (node == ComponentBand::none);
      band_.heirs[c] = numbers[(node & ~mask) | (nodes_ & mask)];
    }
    if (has_known_runs) band_.drop_known_runs(masks_);
  }

  ComponentBand& band_;
  ComponentMasks& masks_;
  const ComponentRules& rules_;
  const uint64_t* const rows_;
  const uint64_t nx_, ny_;
  const size_t words_;
  const uint64_t layer_;
  uint32_t nodes_ = 1;
  std::vector<RunPair>& pairs_;
  std::vector<uint32_t>& fresh_;
  std::vector<uint64_t>& overlaps_;  // of a row and the one below it
  uint64_t overlaps_row_ = UINT64_MAX - 1;
};

void scan_target(ComponentBand& band, ComponentMasks& masks, const ComponentRules& rules,
                 const uint64_t* rows, uint64_t nx, uint64_t ny, uint64_t layer) {
  Scan(band, masks, rules, rows, nx, ny, layer).run();
}

void measure_target(ComponentBand& band, const ComponentMask& known) {
  ComponentTotals here;
  const size_t words = known.words;
  for (uint64_t j = band.begin; j < band.end; ++j) {
    const uint64_t* row = known.row(j);
    size_t first = 0, last = words;
    while (first < words && !row[first]) ++first;
    if (first == words) continue;
    while (!row[last - 1]) --last;
    for (size_t w = first; w < last; ++w) here.samples += count_ones(row[w]);
    const uint64_t low =
        first * bits_per_word + static_cast<uint64_t>(std::countr_zero(row[first]));
    const uint64_t high =
        last * bits_per_word - 1 - static_cast<uint64_t>(std::countl_zero(row[last - 1]));
    here.low[0] = std::min(here.low[0], static_cast<uint32_t>(low));
    here.high[0] = std::max(here.high[0], static_cast<uint32_t>(high));
    here.low[1] = std::min(here.low[1], static_cast<uint32_t>(j));
    here.high[1] = static_cast<uint32_t>(j);
  }
  band.known_here = here;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(scan_target);
HWY_EXPORT(measure_target);

void scan_band(ComponentBand& band, ComponentMasks& masks, const ComponentRules& rules,
               const uint64_t* rows, uint64_t nx, uint64_t ny, uint64_t layer) {
  HWY_DYNAMIC_DISPATCH(scan_target)(band, masks, rules, rows, nx, ny, layer);
}

void measure_known(ComponentBand& band, const ComponentMask& known) {
  HWY_DYNAMIC_DISPATCH(measure_target)(band, known);
}

}  // namespace msq
#endif
