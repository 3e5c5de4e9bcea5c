// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "printability/component_scan.cpp"
#include <algorithm>
#include <bit>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/compress-inl.h"
#include "base/job.h"
#include "base/simd.h"
#include "printability/bit_row.h"
#include "printability/component_band.h"
#include "printability/component_strips-inl.h"
#include "printability/known_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {

constexpr size_t max_simd_words = 2 * max_simd_doubles;  // of 32 bits

/// Lists the runs that have no node. There is room for a vector more, which is read and written.
HWY_NOINLINE uint32_t list_fresh(const uint32_t* HWY_RESTRICT nodes, size_t count,
                                 uint32_t* HWY_RESTRICT fresh) {
  const hn::ScalableTag<uint32_t> d;
  const size_t lanes = hn::Lanes(d);
  const auto none = hn::Set(d, ComponentBand::none);
  size_t found = 0;
  for (size_t r = 0; r < count; r += lanes) {
    const auto is_fresh =
        hn::And(hn::Eq(hn::LoadU(d, nodes + r), none), hn::FirstN(d, std::min(lanes, count - r)));
    const Compression<decltype(d)> chosen(is_fresh);
    hn::StoreU(chosen(hn::Iota(d, static_cast<uint32_t>(r))), d, fresh + found);
    found += hn::CountTrue(d, is_fresh);
  }
  return static_cast<uint32_t>(found);
}

/// Adds runs of a strip, whose first row is `row`, to the parts of components. `counts`: see
/// ComponentBand. `edges` has one run more.
HWY_NOINLINE void add_runs(const uint32_t* HWY_RESTRICT edges, const uint32_t* HWY_RESTRICT nodes,
                           const uint32_t* HWY_RESTRICT counts, size_t count, uint32_t row,
                           ComponentPart* HWY_RESTRICT parts) {
  uint32_t all = 0, of_high = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::FixedTag<uint32_t, 4> d;
  alignas(16) const uint32_t of_run[4] = {~0u, ~0u, 0, 0}, of_first[4] = {~0u, 0, 0, 0},
                             of_row[2][4] = {{0, 0, row, 0}, {0, 0, row + 1, 0}};
  const auto run_mask = hn::Load(d, of_run), flip = hn::Load(d, of_first);
#endif
  for (size_t r = 0; r < count; ++r) {
    ComponentPart& part = parts[nodes[r]];
    part.samples += counts[2 * r] - all;
    all = counts[2 * r];
    const bool reaches_high = counts[2 * r + 1] != of_high;
    of_high = counts[2 * r + 1];
#if HWY_TARGET == HWY_SCALAR
    part.maxima[0] = std::max(part.maxima[0], ~edges[2 * r]);
    part.maxima[1] = std::max(part.maxima[1], edges[2 * r + 1]);
    part.maxima[2] = std::max(part.maxima[2], row + reaches_high);
#else
    const auto run = hn::Xor(hn::And(hn::LoadU(d, edges + 2 * r), run_mask), flip);
    const auto y = hn::Load(d, of_row[reaches_high]);
    hn::StoreU(hn::Max(hn::LoadU(d, part.maxima), hn::Or(run, y)), d, part.maxima);
#endif
  }
}

template <bool corners>
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
    const size_t most = words_ * bits_per_word + at_once;
    pairs_.resize(most);
    band_.counts.resize(2 * most);
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
    has_rest = fill_words<corners>(row, masks_.known_below.row(j), beside, known, rest, words_);
    if (!has_rest) return;
    if (rules_.anchors_sides) {
      extend_word(row, known, rest, 0, 1);
      extend_word(row, known, rest, (nx_ - 1) / bits_per_word,
                  uint64_t{1} << (nx_ - 1) % bits_per_word);
    }
    has_rest = extend_row<corners>(row, nullptr, known, rest, words_);
  }

  static void extend_word(const uint64_t* row, uint64_t* known, uint64_t* rest, size_t w,
                          uint64_t seeds) {
    if (!(rest[w] & seeds)) return;
    known[w] = filled_down(row[w], filled_up(row[w], known[w] | (rest[w] & seeds)));
    rest[w] = row[w] & ~known[w];
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
      flood_row(row, j, j > begin ? known.row(j - 1) : masks_.no_row.data());
    }
    for (uint64_t j = end - 1; j-- > begin;) {
      if (!band_.has_rest[j - begin]) continue;
      band_.has_rest[j - begin] = extend_row<corners>(rows_ + j * words_, known.row(j + 1),
                                                      known.row(j), masks_.rest.row(j), words_);
    }
  }

  /// Lists the runs of the rest, strip by strip, and gives each a node: that of a run which it
  /// touches in the strip before, or a new one. Runs that touch join their nodes, and so do
  /// components below.
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
    Strip last{};  // of those that have runs
    for (uint64_t n = 0; n < runs.strips(); ++n) {
      poll();
      runs.begin[n] = count;
      const uint64_t first = band_.begin + rows_of_strip * n;
      const uint64_t end = std::min(first + rows_of_strip, band_.end);
      const bool has_below = below.begin[n] < below.begin[n + 1];
      const Strip strip_below = has_below ? strip_here(masks_.rest_below, below, n, 2) : Strip{};
      bool has_rest = false;
      for (uint64_t j = first; j < end; ++j) {
        if (!masks_.has_known) {
          has_rest |= copy_row(rows_ + j * words_, words_, masks_.rest.row(j));
          continue;
        }
        if (has_below) join_known_above(strip_below, j);
        has_rest = has_rest || band_.has_rest[j - band_.begin];
      }
      if (!has_rest) continue;
      const Strip strip = strip_here(masks_.rest, runs, n, n % 2);
      count = list(strip);
      if (strip.begin == count) continue;
      const bool has_before = n > 0 && runs.begin[n - 1] < strip.begin;
      label_strip(strip, has_before ? &last : nullptr, has_below ? &strip_below : nullptr, n, count,
                  static_cast<uint32_t>(first));
      last = strip;
      if (!masks_.has_known) continue;
      for (uint64_t j = first; j < end; ++j) {
        if (j > band_.begin) join_known_beside(strip, j, j - 1);
        if (j + 1 < band_.end) join_known_beside(strip, j, j + 1);
      }
    }
    runs.begin.back() = count;
  }

  /// Room for as many nodes more.
  void reserve_nodes(size_t more) {
    const size_t wanted = nodes_ + more;
    if (band_.parents.size() >= wanted) return;
    const size_t size = std::max(wanted, band_.parents.size() * 3 / 2);
    band_.parents.resize(size);
    band_.parts.resize(size);
  }

  Strip strip_here(const ComponentMask& rows, const ComponentRuns& runs, uint64_t n, size_t at) {
    return strip_of<corners>(band_, masks_, rows, runs, n, band_.starts[at], band_.ends);
  }

  /// Adds the runs of a strip, of which the ends have been found last, to those before it. Returns
  /// how many there are then.
  uint32_t list(const Strip& strip) {
    ComponentRuns& runs = band_.runs;
    const uint32_t before = strip.begin;
    uint32_t* const counts = band_.counts.data();
    // No sample is in two runs.
    const size_t wanted = 2 * (before + words_ * bits_per_word + at_once);
    if (runs.edges.size() < wanted) runs.edges.resize(std::max(wanted, runs.edges.size() * 3 / 2));
    size_t started = before, ended = before;
    uint32_t all = 0, of_high = 0;  // samples before the word
    for (size_t w = 0; w < words_; ++w) {
      const uint64_t low = strip.low[w], high = strip.high[w];
      uint64_t starts = strip.starts[w], ends = band_.ends[w];
      const auto first = static_cast<uint32_t>(w * bits_per_word);
      uint32_t* to = runs.edges.data() + 2 * started;
      const uint32_t more = count_ones(starts), done = count_ones(ends);
      for (uint32_t i = 0; i < more; i += at_once)
        for (uint32_t k = i; k < i + at_once; ++k) {
          to[2 * k] = first + static_cast<uint32_t>(std::countr_zero(starts));
          starts &= starts - 1;
        }
      started += more;
      to = runs.edges.data() + 2 * ended;
      uint32_t* const to_counts = counts + 2 * (ended - before);
      for (uint32_t i = 0; i < done; i += at_once)
        for (uint32_t k = i; k < i + at_once; ++k) {
          const uint64_t up_to = ends ^ (ends - 1), inside = up_to >> 1;
          to[2 * k + 1] = first + count_ones(inside);
          const uint32_t high_inside = count_ones(high & inside);
          to_counts[2 * k] = all + high_inside + count_ones(low & inside);
          to_counts[2 * k + 1] = of_high + high_inside;
          ends &= ends - 1;
        }
      ended += done;
      all += count_ones(low) + count_ones(high);
      of_high += count_ones(high);
    }
    if (ended < started) {
      runs.edges[2 * ended + 1] = static_cast<uint32_t>(words_ * bits_per_word);
      counts[2 * (ended - before)] = all;
      counts[2 * (ended - before) + 1] = of_high;
    }
    if (started >= UINT32_MAX)
      fail(Status::limit, "layer %llu has %zu runs of samples to label; the limit is 2^32 - 1",
           static_cast<unsigned long long>(layer_), started);
    const size_t nodes = started + max_simd_words;
    if (runs.node.size() < nodes) runs.node.resize(std::max(nodes, runs.node.size() * 3 / 2));
    reserve_nodes(started - before);
    return static_cast<uint32_t>(started);
  }

  /// Lists pairs of runs of a strip and of the strip below it that overlap. Those are left out that
  /// share samples with such a pair of the strip before: its runs belong to the same components.
  size_t list_new_pairs(const Strip& a, const Strip& b, uint64_t n) {
    if (overlaps_strip_ + 1 != n) std::fill_n(overlaps_.begin(), words_, uint64_t{0});
    overlaps_strip_ = n;
    RunPair* to = pairs_.data();
    RunReader of_a(a), of_b(b);
    uint64_t carry = 0;
    uint64_t low = a.low[0] & b.low[0], high = a.high[0] & b.high[0];
    uint64_t follow = (low | high) & ~(a.starts[0] | b.starts[0]);
    for (size_t w = 0; w < words_; ++w) {
      of_a.read(w);
      of_b.read(w);
      const uint64_t both = low | high, here = follow;
      // From samples that they share to the last sample of the overlap.
      const uint64_t seeds = (low & overlaps_[w]) | (carry & here);
      const uint64_t shared = filled_up(here, (seeds & here) | (seeds << 1 & here)) | seeds;
      overlaps_[w] = high;
      carry = shared >> (bits_per_word - 1);
      follow = 0;
      if (w + 1 < words_) {
        low = a.low[w + 1] & b.low[w + 1];
        high = a.high[w + 1] & b.high[w + 1];
        follow = (low | high) & ~(a.starts[w + 1] | b.starts[w + 1]);
      }
      uint64_t ends = both & ~(here >> 1 | follow << (bits_per_word - 1)) & ~shared;
      // One is written in any case.
      const uint32_t found = count_ones(ends);
      uint32_t i = 0;
      do {
        const uint64_t up_to = ends ^ (ends - 1);
        to[i] = {of_a.run_at(up_to), of_b.run_at(up_to)};
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

  /// Labels the runs of strip n of the band, up to the last that are listed. `before`, `below`: the
  /// strips there, if they have runs. `row`: the strip's first one.
  void label_strip(const Strip& strip, const Strip* before, const Strip* below, uint64_t n,
                   uint32_t end, uint32_t row) {
    constexpr uint32_t none = ComponentBand::none;
    const uint32_t* const edges = band_.runs.edges.data();
    uint32_t* const nodes = band_.runs.node.data();
    ComponentPart* const parts = band_.parts.data();
    uint32_t* const parents = band_.parents.data();
    const uint32_t begin = strip.begin;
    std::fill(nodes + begin, nodes + end, none);
    if (before) {
      const size_t count = list_pairs<corners>(strip, *before, words_, pairs_.data());
      for (size_t i = 0; i < count; ++i) {
        const RunPair pair = pairs_[i];
        const uint32_t node = nodes[pair.a], other = nodes[pair.b];
        nodes[pair.a] = node & other;  // none has all bits
        if (node != other && node != none) nodes[pair.a] = joined(node, other);
      }
    }
    // Found here, not at the end: list_fresh() would wait for the nodes that have just been stored.
    const size_t new_count = below ? list_new_pairs(strip, *below, n) : 0;
    // Runs that touch none become nodes of their own.
    if (fresh_.size() < end - begin + max_simd_words) fresh_.resize(end - begin + max_simd_words);
    uint32_t* const fresh = fresh_.data();
    const uint32_t made = list_fresh(nodes + begin, end - begin, fresh);
    for (uint32_t i = 0; i < made; ++i) {
      const uint32_t node = nodes_ + i, run = begin + fresh[i];
      nodes[run] = node;
      parents[node] = node;
      parts[node] = {
          {}, 0, place_of(strip, edges[2 * size_t{run}], edges[2 * size_t{run} + 1], row)};
    }
    nodes_ += made;
    add_runs(edges + 2 * size_t{begin}, nodes + begin, band_.counts.data(), end - begin, row,
             parts);
    uint32_t* const node_below = band_.node_below.data();
    for (size_t i = 0; i < new_count; ++i) {
      const RunPair pair = pairs_[i];
      const uint32_t node = nodes[pair.a];
      uint32_t& other = node_below[band_.below.component(pair.b)];
      parts[node].set_has_below();
      other = other == none ? node : joined(node, other);
    }
  }

  /// Runs of the rest, in row j, that touch a known sample in the row `other`.
  void join_known_beside(const Strip& strip, uint64_t j, uint64_t other) {
    for_each_run_beside<corners>(strip, masks_.rest.row(j), masks_.known.row(other), words_,
                                 [&](uint32_t run) { joined(0, band_.runs.node[run]); });
  }

  /// Components of the strip below that known samples of row j lie on.
  void join_known_above(const Strip& below, uint64_t j) {
    const uint64_t *rest = masks_.rest_below.row(j), *known = masks_.known.row(j);
    if (!any_common(rest, known, words_)) return;
    RunReader under(below);
    uint64_t carry = 0;
    for (size_t w = 0; w < words_; ++w) {
      under.read(w);
      const uint64_t both = rest[w] & known[w];
      for_each_bit(both & ~(both << 1 | carry), [&](unsigned bit) {
        uint32_t& node = band_.node_below[band_.below.component(under.run_at(bits_to(bit)))];
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
  std::vector<uint64_t>& overlaps_;  // of the second row of a strip and the one below it
  uint64_t overlaps_strip_ = UINT64_MAX - 1;
};

void scan_target(ComponentBand& band, ComponentMasks& masks, const ComponentRules& rules,
                 const uint64_t* rows, uint64_t nx, uint64_t ny, uint64_t layer) {
  if (rules.joins_corners)
    Scan<true>(band, masks, rules, rows, nx, ny, layer).run();
  else
    Scan<false>(band, masks, rules, rows, nx, ny, layer).run();
}

template <bool corners>
void find_seam_of(const ComponentBand& low, const ComponentBand& high, const ComponentMasks& masks,
                  ComponentSeam& seam) {
  const size_t words = masks.rest.words;
  const Strip of_low = strip_of<corners>(low, masks, masks.rest, low.runs, low.runs.strips() - 1,
                                         seam.low_starts, seam.ends);
  const Strip of_high =
      strip_of<corners>(high, masks, masks.rest, high.runs, 0, seam.high_starts, seam.ends);
  if (seam.pairs.empty()) seam.pairs.resize(words * bits_per_word + at_once);
  seam.count = list_pairs<corners>(of_high, of_low, words, seam.pairs.data());
  seam.low_known.clear();
  seam.high_known.clear();
  if (!masks.has_known) return;
  for_each_run_beside<corners>(of_low, of_low.high, masks.known.row(high.begin), words,
                               [&](uint32_t run) { seam.low_known.push_back(run); });
  for_each_run_beside<corners>(of_high, of_high.low, masks.known.row(low.end - 1), words,
                               [&](uint32_t run) { seam.high_known.push_back(run); });
}

void seam_target(const ComponentBand& low, const ComponentBand& high, const ComponentMasks& masks,
                 bool joins_corners, ComponentSeam& seam) {
  if (joins_corners)
    find_seam_of<true>(low, high, masks, seam);
  else
    find_seam_of<false>(low, high, masks, seam);
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
HWY_EXPORT(seam_target);

void scan_band(ComponentBand& band, ComponentMasks& masks, const ComponentRules& rules,
               const uint64_t* rows, uint64_t nx, uint64_t ny, uint64_t layer) {
  HWY_DYNAMIC_DISPATCH(scan_target)(band, masks, rules, rows, nx, ny, layer);
}

void find_seam(const ComponentBand& low, const ComponentBand& high, const ComponentMasks& masks,
               bool joins_corners, ComponentSeam& seam) {
  HWY_DYNAMIC_DISPATCH(seam_target)(low, high, masks, joins_corners, seam);
}

void measure_known(ComponentBand& band, const ComponentMask& known) {
  HWY_DYNAMIC_DISPATCH(measure_target)(band, known);
}

}  // namespace msq
#endif
