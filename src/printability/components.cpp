// SPDX-License-Identifier: Apache-2.0
#include "printability/components.h"

#include <algorithm>
#include <span>
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
  return capacity_bytes(runs.edges) + capacity_bytes(runs.node) + capacity_bytes(runs.numbers) +
         capacity_bytes(runs.begin);
}

ComponentTotals totals_of(const ComponentPart& part, uint64_t layer, double height) {
  return {part.samples,
          static_cast<double>(part.samples) * height,
          layer,
          layer,
          {part.low_x(), static_cast<uint32_t>(part.place >> 32)},
          {part.high_x(), part.high_y()},
          {static_cast<uint32_t>(part.place), static_cast<uint32_t>(part.place >> 32)}};
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
  for (size_t n = 0; n < runs.strips(); ++n) {
    const uint64_t first_row = begin + rows_of_strip * n;
    const uint64_t end_row = std::min(first_row + rows_of_strip, end);
    const uint32_t from = runs.begin[n], to = runs.begin[n + 1];
    runs.begin[n] = kept;
    bool has_dropped = false;
    for (uint32_t r = from; r < to; ++r) {
      if (runs.component(r) == 0) {
        for (uint64_t j = first_row; j < end_row; ++j)
          add_bits(masks.known.row(j), masks.rest.row(j), runs.first(r), runs.end(r) - 1);
        has_dropped = true;
        continue;
      }
      runs.edges[2 * size_t{kept}] = runs.first(r);
      runs.edges[2 * size_t{kept} + 1] = runs.end(r);
      runs.node[kept++] = runs.node[r];
    }
    if (!has_dropped) continue;
    for (uint64_t j = first_row; j < end_row; ++j)
      for (size_t w = 0; w < words; ++w) masks.rest.row(j)[w] &= ~masks.known.row(j)[w];
  }
  runs.begin.back() = kept;
}

void ComponentBand::make_known(uint32_t number, ComponentMasks& masks) {
  for (uint32_t node = 1; node < nodes; ++node)
    if (runs.numbers[node] && global[runs.numbers[node] - 1] == number) runs.numbers[node] = 0;
  drop_known_runs(masks);
}

uint64_t ComponentBand::bytes() const {
  uint64_t all = capacity_bytes(runs) + capacity_bytes(below) + capacity_bytes(has_rest);
  for (const std::vector<uint32_t>* each :
       {&parents, &node_below, &roots, &counts, &fresh, &global, &global_below, &heirs})
    all += capacity_bytes(*each);
  for (const std::vector<uint64_t>& each : starts) all += capacity_bytes(each);
  return all + capacity_bytes(parts) + capacity_bytes(pairs) + capacity_bytes(overlaps) +
         capacity_bytes(ends);
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
  masks_.has_known = has_anchor_;
  const size_t words = words_for(nx);
  for (ComponentMask* mask :
       {&masks_.known, &masks_.known_below, &masks_.rest, &masks_.rest_below}) {
    mask->bits.resize(words * ny);
    mask->words = words;
  }
  masks_.no_row.resize(words);
  const uint64_t strips = strips_for(ny);
  for (unsigned b = 0; b < bands; ++b) {
    ComponentBand& band = bands_[b];
    const uint64_t first = strips * b / bands, end = strips * (b + 1) / bands;
    band.begin = rows_of_strip * first;
    band.end = std::min(rows_of_strip * end, ny);
    band.has_rest.resize(static_cast<size_t>(band.end - band.begin));
    band.runs.begin.assign(static_cast<size_t>(end - first) + 1, 0);
    band.below.begin = band.runs.begin;
  }
}

uint64_t Components::held_bytes() const {
  uint64_t all = capacity_bytes(seam_.pairs) + capacity_bytes(seam_.low_known) +
                 capacity_bytes(seam_.high_known) + capacity_bytes(seam_.low_starts) +
                 capacity_bytes(seam_.high_starts) + capacity_bytes(seam_.ends) +
                 capacity_bytes(masks_.no_row) + capacity_bytes(live_) + capacity_bytes(next_) +
                 capacity_bytes(parents_) + capacity_bytes(numbers_) + capacity_bytes(heirs_) +
                 capacity_bytes(has_below_) + capacity_bytes(events_.islands) +
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
  size_t nodes = 1;
  for (ComponentBand& band : bands_) {
    band.base = static_cast<uint32_t>(nodes - 1);
    nodes += band.count;
    if (nodes > UINT32_MAX)
      fail(Status::limit, "layer %llu has more than 2^32 - 1 components",
           static_cast<unsigned long long>(layer_));
  }
  parents_.resize(nodes);
  for (size_t i = 0; i < nodes; ++i) parents_[i] = static_cast<uint32_t>(i);
  heirs_.assign(live_.size() + 1, ComponentBand::none);
  for (const ComponentBand& band : bands_)
    for (size_t c = 0; c < band.heirs.size(); ++c) {
      const uint32_t number = band.heirs[c];
      if (number == ComponentBand::none) continue;
      uint32_t& heir = heirs_[band.global_below[c]];
      const uint32_t node = number == 0 ? 0 : band.base + number;
      if (heir == ComponentBand::none)
        heir = node;
      else
        unite(heir, node);
    }
  for (size_t b = 1; b < bands_.size(); ++b) join_seam(bands_[b - 1], bands_[b]);
  number(height);
}

void Components::join_seam(const ComponentBand& low, const ComponentBand& high) {
  find_seam(low, high, masks_, rules_.joins_corners, seam_);
  for (const RunPair pair : std::span(seam_.pairs).first(seam_.count))
    unite(high.base + high.runs.component(pair.a), low.base + low.runs.component(pair.b));
  for (const uint32_t run : seam_.low_known) unite(0, low.base + low.runs.component(run));
  for (const uint32_t run : seam_.high_known) unite(0, high.base + high.runs.component(run));
}

/// Numbers the components that have runs in this layer, in the order of their first runs.
void Components::number(double height) {
  if (numbers_.size() < parents_.size()) numbers_.resize(parents_.size());
  numbers_[0] = 0;
  next_.clear();
  has_below_.clear();
  layer_samples_ = 0;
  const bool finds_islands = rules_.finds_islands && layer_ > 0;
  bool has_merged = false;
  for (ComponentBand& band : bands_) {
    band.global.resize(band.count);
    for (uint32_t c = 0; c < band.count; ++c) {
      const ComponentPart& part = band.parts[band.roots[c]];
      const uint32_t node = band.base + c + 1, root = parents_[node] = parents_[parents_[node]];
      layer_samples_ += part.samples;
      if (root == node) {
        next_.push_back(totals_of(part, layer_, height));
        if (finds_islands) has_below_.push_back(part.has_below());
        numbers_[node] = static_cast<uint32_t>(next_.size());
      } else {
        numbers_[node] = numbers_[root];
        if (root != 0) {
          next_[numbers_[root] - 1].merge(totals_of(part, layer_, height));
          if (finds_islands) has_below_[numbers_[root] - 1] |= part.has_below();
          has_merged = true;
        }
      }
      band.global[c] = numbers_[node];
    }
  }
  if (has_merged)  // not the sum of rounded heights
    for (ComponentTotals& totals : next_)
      totals.height_sum = static_cast<double>(totals.samples) * height;
  for (size_t c = 0; c < has_below_.size(); ++c)
    if (!has_below_[c]) events_.islands.push_back(next_[c]);
  next_kept_ = kept_ && heirs_[kept_] != ComponentBand::none ? numbers_[heirs_[kept_]] : 0;
  const auto take_below = [&](size_t c) {
    const ComponentTotals& totals = live_[c];
    const uint32_t heir = heirs_[c + 1];
    if (heir == ComponentBand::none) {
      events_.ended.push_back(totals);
      return;
    }
    const uint32_t number = numbers_[heir];
    if (number && number != next_kept_) {
      next_[number - 1].merge(totals);
      return;
    }
    if (!has_anchor_) kept_totals_.merge(totals);
    if (number == 0 && rules_.finds_cups) events_.cups.push_back(totals);
  };
  // The kept component is not among the others. When it is chosen, the last one takes its place.
  const size_t last = live_.size() - (is_kept_anew_ ? 1 : 0);
  for (size_t c = 0; c < last; ++c) {
    if (c + 1 != kept_)
      take_below(c);
    else if (is_kept_anew_)
      take_below(last);
  }
}

/// Runs that other bands have made known join the mask.
void Components::settle(unsigned n) {
  ComponentBand& band = bands_[n];
  if (!masks_.has_known) return;
  if (std::find(band.global.begin(), band.global.end(), 0u) != band.global.end())
    band.make_known(0, masks_);
  if (!has_anchor_) measure_known(band, masks_.known);
}

const Components::Events& Components::finish() {
  if (!has_anchor_) {
    follow_kept();
    keep_largest();
    make_kept_known();
  }
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

/// Adds what the kept component has in this layer. If that is nothing, it has ended.
void Components::follow_kept() {
  is_kept_anew_ = false;
  kept_ = next_kept_;
  if (!kept_totals_.samples) return;
  ComponentTotals here;
  if (masks_.has_known)
    for (const ComponentBand& band : bands_) here.merge(band.known_here);
  else if (kept_)
    here = next_[kept_ - 1];
  if (!here.samples) {
    events_.ended.push_back(kept_totals_);
    kept_totals_ = {};
    masks_.has_known = false;
    return;
  }
  here.first_layer = UINT64_MAX;  // it began below
  here.last_layer = layer_;
  here.height_sum = static_cast<double>(here.samples) * height_;
  kept_totals_.merge(here);
}

/// If no component is kept, keeps the largest one. What is found does not depend on which, except
/// for the order: where the kept one ends, it comes last.
void Components::keep_largest() {
  if (kept_totals_.samples || next_.empty()) return;
  const auto largest = std::max_element(
      next_.begin(), next_.end(),
      [](const ComponentTotals& a, const ComponentTotals& b) { return a.samples < b.samples; });
  kept_ = static_cast<uint32_t>(largest - next_.begin()) + 1;
  kept_totals_ = *largest;
  is_kept_anew_ = true;
}

/// If the kept component has a good part of the layer, it becomes the known one.
void Components::make_kept_known() {
  if (masks_.has_known || kept_ == 0 || is_kept_anew_) return;
  constexpr uint64_t part = 8;
  if (next_[kept_ - 1].samples < layer_samples_ / part) return;
  masks_.has_known = true;
  std::fill(masks_.known.bits.begin(), masks_.known.bits.end(), uint64_t{0});
  for (ComponentBand& band : bands_) band.make_known(kept_, masks_);
}

const Components::Events& Components::end() {
  events_.clear();
  const size_t last = live_.size() - (is_kept_anew_ ? 1 : 0);
  for (size_t c = 0; c < last; ++c) {
    if (c + 1 != kept_)
      events_.ended.push_back(live_[c]);
    else if (is_kept_anew_)
      events_.ended.push_back(live_[last]);
  }
  live_.clear();
  if (kept_totals_.samples) events_.ended.push_back(kept_totals_);
  kept_totals_ = {};
  return events_;
}

}  // namespace msq
