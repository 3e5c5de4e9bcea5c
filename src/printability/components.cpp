// SPDX-License-Identifier: Apache-2.0
#include "printability/components.h"

#include <algorithm>
#include <tuple>

#include "base/status.h"
#include "printability/bit_row.h"

namespace msq {

namespace {

template <class T>
uint64_t capacity_bytes(const std::vector<T>& of) {
  return of.capacity() * sizeof(T);
}

uint64_t capacity_bytes(const ComponentRuns& runs) {
  return capacity_bytes(runs.first) + capacity_bytes(runs.last) + capacity_bytes(runs.component) +
         capacity_bytes(runs.begin);
}

}  // namespace

void ComponentTotals::merge(const ComponentTotals& other) {
  if (std::tuple(other.first_layer, other.place[1], other.place[0]) <
      std::tuple(first_layer, place[1], place[0])) {
    first_layer = other.first_layer;
    std::copy_n(other.place, 2, place);
  }
  last_layer = std::max(last_layer, other.last_layer);
  samples += other.samples;
  height_sum += other.height_sum;
  for (int axis = 0; axis < 2; ++axis) {
    low[axis] = std::min(low[axis], other.low[axis]);
    high[axis] = std::max(high[axis], other.high[axis]);
  }
}

void ComponentBand::drop_known_runs(ComponentMasks& masks) {
  uint32_t kept = 0;
  const size_t words = masks.known.words;
  for (uint64_t j = begin; j < end; ++j) {
    const uint64_t n = j - begin;
    const uint32_t from = runs.begin[n], to = runs.begin[n + 1];
    runs.begin[n] = kept;
    if (from == to) continue;
    for (uint32_t r = from; r < to; ++r) {
      if (runs.component[r] == 0) continue;
      runs.first[kept] = runs.first[r];
      runs.last[kept] = runs.last[r];
      runs.component[kept++] = runs.component[r];
    }
    for (size_t w = 0; w < words; ++w) masks.rest.row(j)[w] &= ~masks.known.row(j)[w];
  }
  runs.begin[end - begin] = kept;
  runs.first.resize(kept);
  runs.last.resize(kept);
  runs.component.resize(kept);
}

uint64_t ComponentBand::bytes() const {
  uint64_t all = capacity_bytes(runs) + capacity_bytes(below) + capacity_bytes(has_rest);
  for (const std::vector<uint32_t>* each : {&parents, &numbers, &global, &global_below, &heirs})
    all += capacity_bytes(*each);
  return all + capacity_bytes(totals);
}

void Components::Events::clear() {
  islands.clear();
  cups.clear();
  ended.clear();
}

Components::Components(uint64_t nx, uint64_t ny, Rules rules, unsigned bands)
    : nx_(nx),
      ny_(ny),
      rules_(rules),
      has_anchor_(rules.anchors_sides || rules.anchors_first_layer),
      bands_(bands) {
  const size_t words = words_for(nx);
  for (ComponentMask* mask :
       {&masks_.known, &masks_.known_below, &masks_.rest, &masks_.rest_below}) {
    mask->bits.resize(words * ny);
    mask->words = words;
  }
  for (unsigned b = 0; b < bands; ++b) {
    ComponentBand& band = bands_[b];
    band.begin = ny * b / bands;
    band.end = ny * (b + 1) / bands;
    const size_t rows = static_cast<size_t>(band.end - band.begin);
    band.has_rest.resize(rows);
    band.runs.begin.assign(rows + 1, 0);
    band.below.begin.assign(rows + 1, 0);
  }
}

uint64_t Components::held_bytes() const {
  uint64_t all = capacity_bytes(live_) + capacity_bytes(next_) + capacity_bytes(parents_) +
                 capacity_bytes(numbers_) + capacity_bytes(events_.islands) +
                 capacity_bytes(events_.cups) + capacity_bytes(events_.ended);
  for (const ComponentBand& band : bands_) all += sizeof band + band.bytes();
  return all;
}

uint32_t Components::find(uint32_t node) {
  while (parents_[node] != node) {
    parents_[node] = parents_[parents_[node]];
    node = parents_[node];
  }
  return node;
}

/// The smaller node is the root, so 0 stays one.
void Components::unite(uint32_t a, uint32_t b) {
  a = find(a);
  b = find(b);
  if (a < b) parents_[b] = a;
  if (b < a) parents_[a] = b;
}

void Components::scan(unsigned band, const uint64_t* rows) {
  scan_band(bands_[band], masks_, rules_, rows, nx_, ny_, layer_);
}

void Components::join(double height) {
  events_.clear();
  height_ = height;
  size_t nodes = 1 + live_.size();
  for (ComponentBand& band : bands_) {
    band.base = static_cast<uint32_t>(nodes - 1);
    nodes += band.totals.size();
    if (nodes > UINT32_MAX)
      fail(Status::limit, "layer %llu has more than 2^32 - 1 components",
           static_cast<unsigned long long>(layer_));
  }
  parents_.resize(nodes);
  for (size_t i = 0; i < nodes; ++i) parents_[i] = static_cast<uint32_t>(i);
  for (const ComponentBand& band : bands_)
    for (size_t c = 0; c < band.heirs.size(); ++c) {
      const uint32_t heir = band.heirs[c];
      if (heir) unite(band.global_below[c], heir == ComponentBand::known ? 0 : band.base + heir);
    }
  for (size_t b = 1; b < bands_.size(); ++b) join_seam(bands_[b - 1], bands_[b]);
  number(height);
}

/// Of the last row of a band and the first of the next.
void Components::join_seam(const ComponentBand& low, const ComponentBand& high) {
  const uint64_t rows = low.end - low.begin;
  const uint32_t reach = rules_.joins_corners ? 1 : 0;
  const uint32_t a = low.runs.begin[rows - 1], a_end = low.runs.begin[rows];
  const uint32_t b = high.runs.begin[0], b_end = high.runs.begin[1];
  for_each_overlap(low.runs, a, a_end, high.runs, b, b_end, reach, [&](uint32_t x, uint32_t y) {
    unite(low.base + low.runs.component[x], high.base + high.runs.component[y]);
  });
  const auto join_known = [&](const ComponentBand& band, uint32_t first, uint32_t end,
                              const uint64_t* known) {
    for (uint32_t r = first; r < end; ++r) {
      const uint64_t from = band.runs.first[r] - std::min(band.runs.first[r], reach);
      const uint64_t to = std::min<uint64_t>(uint64_t{band.runs.last[r]} + reach, nx_ - 1);
      if (any_bit(known, from, to)) unite(0, band.base + band.runs.component[r]);
    }
  };
  join_known(low, a, a_end, masks_.known.row(high.begin));
  join_known(high, b, b_end, masks_.known.row(low.end - 1));
}

/// Numbers the components that have runs in this layer, in the order of their first runs.
void Components::number(double height) {
  const auto first_of_bands = static_cast<uint32_t>(1 + live_.size());
  numbers_.assign(parents_.size(), 0);
  next_.clear();
  for (ComponentBand& band : bands_) {
    band.global.resize(band.totals.size());
    for (size_t c = 0; c < band.totals.size(); ++c) {
      const uint32_t root = find(band.base + static_cast<uint32_t>(c) + 1);
      band.global[c] = 0;
      if (root == 0) continue;
      if (numbers_[root] == 0) {
        next_.push_back(band.totals[c]);
        numbers_[root] = static_cast<uint32_t>(next_.size());
      } else {
        next_[numbers_[root] - 1].merge(band.totals[c]);
      }
      band.global[c] = numbers_[root];
    }
  }
  for (ComponentTotals& totals : next_)
    totals.height_sum = static_cast<double>(totals.samples) * height;
  // A root is the smallest node, so a component whose root is of this layer has nothing below.
  if (rules_.finds_islands && layer_ > 0)
    for (size_t root = first_of_bands; root < parents_.size(); ++root)
      if (numbers_[root]) events_.islands.push_back(next_[numbers_[root] - 1]);
  for (uint32_t c = 1; c < first_of_bands; ++c) {
    const ComponentTotals& totals = live_[c - 1];
    const uint32_t root = find(c);
    if (root == 0) {
      if (!has_anchor_) known_totals_.merge(totals);
      if (rules_.finds_cups) events_.cups.push_back(totals);
    } else if (numbers_[root]) {
      next_[numbers_[root] - 1].merge(totals);
    } else {
      events_.ended.push_back(totals);
    }
  }
}

/// Runs that other bands have made known join the mask.
void Components::settle(unsigned n) {
  ComponentBand& band = bands_[n];
  if (std::find(band.global.begin(), band.global.end(), 0u) != band.global.end()) {
    for (uint64_t j = band.begin; j < band.end; ++j)
      for (uint32_t r = band.runs.begin[j - band.begin]; r < band.runs.begin[j - band.begin + 1];
           ++r)
        if (band.global[band.runs.component[r] - 1] == 0) {
          set_bits(masks_.known.row(j), band.runs.first[r], band.runs.last[r]);
          band.runs.component[r] = 0;
        }
    band.drop_known_runs(masks_);
  }
  if (!has_anchor_ && known_totals_.samples) measure_known(band, masks_.known);
}

const Components::Events& Components::finish() {
  if (!has_anchor_ && known_totals_.samples) {
    ComponentTotals here;
    here.first_layer = UINT64_MAX;  // it began below
    here.last_layer = layer_;
    for (const ComponentBand& band : bands_) {
      ComponentTotals part = band.known_here;
      part.first_layer = UINT64_MAX;
      here.merge(part);
    }
    here.height_sum = static_cast<double>(here.samples) * height_;
    if (here.samples) {
      known_totals_.merge(here);
    } else {
      events_.ended.push_back(known_totals_);
      known_totals_ = {};
    }
  }
  if (!has_anchor_) adopt();
  for (ComponentBand& band : bands_) {
    std::swap(band.runs, band.below);
    std::swap(band.global, band.global_below);
  }
  std::swap(live_, next_);
  std::swap(masks_.known, masks_.known_below);
  std::swap(masks_.rest, masks_.rest_below);
  ++layer_;
  return events_;
}

const Components::Events& Components::end() {
  events_.clear();
  events_.ended.swap(live_);
  if (known_totals_.samples) events_.ended.push_back(known_totals_);
  known_totals_ = {};
  return events_;
}

/// If no component is known, makes the largest one known. Results do not depend on which.
void Components::adopt() {
  if (known_totals_.samples || next_.empty()) return;
  const auto largest = std::max_element(
      next_.begin(), next_.end(),
      [](const ComponentTotals& a, const ComponentTotals& b) { return a.samples < b.samples; });
  const auto number = static_cast<uint32_t>(largest - next_.begin()) + 1;
  known_totals_ = *largest;
  const auto moved = static_cast<uint32_t>(next_.size());  // takes the free number
  *largest = next_.back();
  next_.pop_back();
  for (ComponentBand& band : bands_) {
    for (uint64_t j = band.begin; j < band.end; ++j)
      for (uint32_t r = band.runs.begin[j - band.begin]; r < band.runs.begin[j - band.begin + 1];
           ++r)
        if (band.global[band.runs.component[r] - 1] == number) {
          set_bits(masks_.known.row(j), band.runs.first[r], band.runs.last[r]);
          band.runs.component[r] = 0;
        }
    for (uint32_t& global : band.global)
      if (global == number)
        global = 0;
      else if (global == moved)
        global = number;
    band.drop_known_runs(masks_);
  }
}

}  // namespace msq
