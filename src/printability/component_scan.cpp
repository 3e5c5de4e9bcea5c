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
  /// The run that holds the last bit of the word before.
  uint32_t run_before() const { return before - 1; }
};

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
        base_(static_cast<uint32_t>(1 + band.global_below.size())) {}

  void run() {
    flood();
    join();
    resolve();
  }

 private:
  /// Marks the runs of a row that touch the known component below, beside or at a side.
  void flood_row(const uint64_t* row, uint64_t j, const uint64_t* beside) {
    uint64_t *known = masks_.known.row(j), *rest = masks_.rest.row(j);
    uint8_t& has_rest = band_.has_rest[j - band_.begin];
    has_rest = 0;
    if (!split_row(row, masks_.known_below.row(j), known, rest, words_)) return;
    if (rules_.anchors_sides) {
      const uint64_t last = (nx_ - 1) / bits_per_word;
      known[0] |= row[0] & 1;
      known[last] |= row[last] & (uint64_t{1} << (nx_ - 1) % bits_per_word);
    }
    if (beside && rules_.joins_corners) {
      for (size_t w = 0; w < words_; ++w)
        if (rest[w]) known[w] |= rest[w] & spread_word(beside, words_, w);
    } else if (beside) {
      for (size_t w = 0; w < words_; ++w) known[w] |= rest[w] & beside[w];
    }
    has_rest = fill_runs(row, words_, known, rest);
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
      const uint64_t* beside = known.row(j + 1);
      uint64_t *here = known.row(j), *rest = masks_.rest.row(j);
      uint64_t found = 0;
      for (size_t w = 0; w < words_; ++w) {
        const uint64_t more =
            rest[w] & (rules_.joins_corners ? spread_word(beside, words_, w) : beside[w]);
        here[w] |= more;
        found |= more;
      }
      if (found) band_.has_rest[j - begin] = fill_runs(rows_ + j * words_, words_, here, rest);
    }
  }

  /// Lists the runs of the rest, row by row, and joins each with those below and in the row before.
  void join() {
    ComponentRuns& runs = band_.runs;
    const ComponentRuns& below = band_.below;
    runs.first.clear();
    runs.last.clear();
    band_.parents.resize(base_);
    for (uint32_t i = 0; i < base_; ++i) band_.parents[i] = i;
    CancelPoll poll(current_job());
    for (uint64_t j = band_.begin; j < band_.end; ++j) {
      poll();
      const uint64_t n = j - band_.begin;
      runs.begin[n] = static_cast<uint32_t>(runs.size());
      const bool has_below = below.begin[n] < below.begin[n + 1];
      if (has_below) join_known_above(j, n);
      if (!band_.has_rest[n]) continue;
      list(j);
      if (has_below) join_below(j, n);
      if (n > 0 && band_.has_rest[n - 1]) join_beside(j, n);
      if (n > 0) join_known_beside(j, n, j - 1);
      if (j + 1 < band_.end) join_known_beside(j, n, j + 1);
    }
    runs.begin[band_.end - band_.begin] = static_cast<uint32_t>(runs.size());
    runs.component.resize(runs.size());
  }

  void list(uint64_t j) {
    const uint64_t* row = masks_.rest.row(j);
    std::vector<uint32_t>&firsts = band_.runs.first, &lasts = band_.runs.last;
    const size_t before = firsts.size();
    uint64_t carry = 0;
    size_t count = 0;
    for (size_t w = 0; w < words_; ++w) {
      count += count_ones(row[w] & ~(row[w] << 1 | carry));
      carry = row[w] >> (bits_per_word - 1);
    }
    const size_t nodes = base_ + before + count;
    if (nodes > UINT32_MAX)
      fail(Status::limit, "layer %llu has %zu runs of samples to label; the limit is 2^32 - 1",
           static_cast<unsigned long long>(layer_), nodes);
    firsts.resize(before + count);
    lasts.resize(before + count);
    band_.parents.resize(nodes);
    uint32_t *first = firsts.data() + before, *last = lasts.data() + before;
    carry = 0;
    for (size_t w = 0; w < words_; ++w) {
      const uint64_t word = row[w];
      const auto at = static_cast<uint32_t>(w * bits_per_word);
      const uint64_t next = w + 1 < words_ ? row[w + 1] << (bits_per_word - 1) : 0;
      for_each_bit(word & ~(word << 1 | carry), [&](unsigned bit) { *first++ = at + bit; });
      for_each_bit(word & ~(word >> 1 | next), [&](unsigned bit) { *last++ = at + bit; });
      carry = word >> (bits_per_word - 1);
    }
    for (size_t node = base_ + before; node < nodes; ++node)
      band_.parents[node] = static_cast<uint32_t>(node);
  }

  uint32_t node_of(uint32_t run) const { return base_ + run; }

  /// A run's first neighbour becomes its parent at once. So runs of one component mostly have the
  /// same parent, and few unions are left.
  void join_node(uint32_t node, uint32_t other) {
    uint32_t* parents = band_.parents.data();
    if (parents[node] == parents[other]) return;
    if (parents[node] == node && node > other)
      parents[node] = band_.find(other);
    else
      band_.unite(node, other);
  }

  /// Each run of samples that two rows have in common belongs to one run of either.
  void join_below(uint64_t j, uint64_t n) {
    RowReader here{masks_.rest.row(j), band_.runs.begin[n]},
        under{masks_.rest_below.row(j), band_.below.begin[n]};
    const uint32_t* component = band_.below.component.data();
    uint64_t carry = 0;
    for (size_t w = 0; w < words_; ++w) {
      here.read(w);
      under.read(w);
      const uint64_t both = here.word & under.word;
      for_each_bit(both & ~(both << 1 | carry), [&](unsigned bit) {
        join_node(node_of(here.run_at(bit)), component[under.run_at(bit)]);
      });
      carry = both >> (bits_per_word - 1);
    }
  }

  void join_beside(uint64_t j, uint64_t n) {
    RowReader here{masks_.rest.row(j), band_.runs.begin[n]},
        beside{masks_.rest.row(j - 1), band_.runs.begin[n - 1]};
    uint64_t carry = 0;
    for (size_t w = 0; w < words_; ++w) {
      here.read(w);
      beside.read(w);
      if (!here.word && !beside.word) {
        carry = 0;
        continue;
      }
      const uint64_t both = here.word & beside.word;
      for_each_bit(both & ~(both << 1 | carry), [&](unsigned bit) {
        join_node(node_of(here.run_at(bit)), node_of(beside.run_at(bit)));
      });
      carry = both >> (bits_per_word - 1);
      if (!rules_.joins_corners) continue;
      // Runs that meet at a corner: one starts where the other has just ended.
      const auto corners = [&](const RowReader& starts, const RowReader& ended) {
        uint64_t at = starts.starts & (ended.word << 1 | ended.last) & ~ended.word;
        for_each_bit(at, [&](unsigned bit) {
          const uint32_t a = starts.run_at(bit),
                         b = bit ? ended.run_at(bit - 1) : ended.run_before();
          join_node(node_of(std::max(a, b)), node_of(std::min(a, b)));
        });
      };
      corners(here, beside);
      corners(beside, here);
    }
  }

  /// Runs of the rest that touch a known sample in the row `other`.
  void join_known_beside(uint64_t j, uint64_t n, uint64_t other) {
    const uint64_t *rest = masks_.rest.row(j), *known = masks_.known.row(other);
    uint64_t any = 0;
    if (rules_.joins_corners)
      for (size_t w = 0; w < words_; ++w) any |= rest[w] & spread_word(known, words_, w);
    else
      for (size_t w = 0; w < words_; ++w) any |= rest[w] & known[w];
    if (!any) return;
    RowReader here{rest, band_.runs.begin[n]};
    for (size_t w = 0; w < words_; ++w) {
      here.read(w);
      for_each_bit(here.word & (rules_.joins_corners ? spread_word(known, words_, w) : known[w]),
                   [&](unsigned bit) { band_.unite(0, node_of(here.run_at(bit))); });
    }
  }

  /// Components below that known samples lie on.
  void join_known_above(uint64_t j, uint64_t n) {
    const uint64_t *rest = masks_.rest_below.row(j), *known = masks_.known.row(j);
    uint64_t any = 0;
    for (size_t w = 0; w < words_; ++w) any |= rest[w] & known[w];
    if (!any) return;
    RowReader under{rest, band_.below.begin[n]};
    uint64_t carry = 0;
    for (size_t w = 0; w < words_; ++w) {
      under.read(w);
      const uint64_t both = under.word & known[w];
      for_each_bit(both & ~(both << 1 | carry),
                   [&](unsigned bit) { band_.unite(0, band_.below.component[under.run_at(bit)]); });
      carry = both >> (bits_per_word - 1);
    }
  }

  /// Numbers the components in the order of their first runs.
  void resolve() {
    ComponentRuns& runs = band_.runs;
    std::vector<uint32_t>& numbers = band_.numbers;
    numbers.assign(band_.parents.size(), 0);
    band_.totals.clear();
    bool has_known_runs = false;
    for (uint64_t j = band_.begin; j < band_.end; ++j) {
      const uint64_t n = j - band_.begin;
      for (uint32_t r = runs.begin[n]; r < runs.begin[n + 1]; ++r) {
        const uint32_t root = band_.find(node_of(r));
        const uint32_t first = runs.first[r], last = runs.last[r];
        if (root == 0) {
          set_bits(masks_.known.row(j), first, last);
          runs.component[r] = 0;
          has_known_runs = true;
          continue;
        }
        const auto row = static_cast<uint32_t>(j);
        if (numbers[root] == 0) {
          ComponentTotals& totals = band_.totals.emplace_back();
          totals.first_layer = totals.last_layer = layer_;
          totals.place[0] = first;
          totals.place[1] = row;
          numbers[root] = static_cast<uint32_t>(band_.totals.size());
        }
        runs.component[r] = numbers[root];
        band_.totals[numbers[root] - 1].add_run(first, last, row);
      }
    }
    band_.heirs.resize(base_ - 1);
    for (uint32_t c = 1; c < base_; ++c) {
      const uint32_t root = band_.find(c);
      band_.heirs[c - 1] = root == 0 ? ComponentBand::known : numbers[root];
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
  const uint32_t base_;  // node of the first run
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
