// SPDX-License-Identifier: Apache-2.0
// A band of rows of a layer, labelled on its own. Components joins the bands of a layer.
#pragma once

#include <cstdint>
#include <vector>

#include "base/sample_grid.h"

namespace msq {

/// How samples are joined, and what of it is known beforehand.
struct ComponentRules {
  /// Samples of a layer are also joined across corners. Samples of two layers are joined only if
  /// one is above the other.
  bool joins_corners = false;
  /// Samples at the sides of the grid are anchored, and what is joined to them. Anchored
  /// components are not reported.
  bool anchors_sides = false;
  /// The same of samples of the first layer.
  bool anchors_first_layer = false;
  bool finds_islands = false;
  /// Components of the layers so far that the layer being added joins to what is anchored.
  bool finds_cups = false;
};

/// What is known of a component.
struct ComponentTotals {
  uint64_t samples = 0;
  double height_sum = 0;  ///< of each sample's layer height
  uint64_t first_layer = 0, last_layer = 0;
  uint32_t low[2] = {UINT32_MAX, UINT32_MAX}, high[2] = {0, 0};  ///< of the indices along x and y
  uint32_t place[2] = {0, 0};  ///< x, y of the first sample of the first layer: lowest y, then x

  void add_run(uint32_t first, uint32_t last, uint32_t row) {
    samples += last - first + 1;
    low[0] = first < low[0] ? first : low[0];
    high[0] = last > high[0] ? last : high[0];
    low[1] = row < low[1] ? row : low[1];
    high[1] = row > high[1] ? row : high[1];
  }
  void merge(const ComponentTotals& other);
};

/// Runs of samples that are not known, by rows: those of row j are [begin[j], begin[j + 1]).
struct ComponentRuns {
  std::vector<uint32_t> first, last;
  std::vector<uint32_t> component;  ///< from 1, of the band; 0 is the known one
  std::vector<uint32_t> begin;
  size_t size() const { return first.size(); }
};

/// Bits of a layer.
struct ComponentMask {
  std::vector<uint64_t> bits;
  size_t words = 0;  ///< of a row
  uint64_t* row(uint64_t j) { return bits.data() + j * words; }
  const uint64_t* row(uint64_t j) const { return bits.data() + j * words; }
};

struct ComponentMasks {
  ComponentMask known, known_below;
  ComponentMask rest, rest_below;  ///< the other samples, in rows that have some
};

struct ComponentBand {
  /// Value of heirs: the component has joined the known one.
  static constexpr uint32_t known = UINT32_MAX;

  uint64_t begin = 0, end = 0;    ///< rows
  ComponentRuns runs, below;      ///< of this layer and of the one before; rows count from `begin`
  std::vector<uint8_t> has_rest;  ///< by row: whether it has samples that are not known
  /// Node 0: the known component; then those of the band below; then the runs.
  std::vector<uint32_t> parents, numbers;
  /// By number - 1: the band's components in this layer, and which of the layer each is part of.
  std::vector<ComponentTotals> totals;
  std::vector<uint32_t> global, global_below;
  std::vector<uint32_t> heirs;  ///< by number - 1 below: the number in this layer; 0: none
  ComponentTotals known_here;   ///< samples and box of the known component
  uint32_t base = 0;            ///< in Components: component n of the band is node base + n

  uint32_t find(uint32_t node) {
    while (parents[node] != node) {
      parents[node] = parents[parents[node]];
      node = parents[node];
    }
    return node;
  }
  /// The smaller node is the root, so 0 stays one.
  void unite(uint32_t a, uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) parents[b] = a;
    if (b < a) parents[a] = b;
  }
  /// Drops runs whose component is 0, and their samples from the rest.
  void drop_known_runs(ComponentMasks& masks);
  uint64_t bytes() const;
};

/// Labels the band's samples of a layer of `ny` rows: those that are known, and the components of
/// the others. What other bands do is not seen.
void scan_band(ComponentBand& band, ComponentMasks& masks, const ComponentRules& rules,
               const uint64_t* rows, uint64_t nx, uint64_t ny, uint64_t layer);

/// Sets known_here.
void measure_known(ComponentBand& band, const ComponentMask& known);

/// Calls join(a, b) for the pairs of runs of two rows, in [a, a_end) and [b, b_end), that overlap
/// or, with a reach of 1, are next to each other.
template <class Join>
void for_each_overlap(const ComponentRuns& of_a, uint32_t a, uint32_t a_end,
                      const ComponentRuns& of_b, uint32_t b, uint32_t b_end, uint32_t reach,
                      Join&& join) {
  while (a < a_end && b < b_end) {
    if (of_a.first[a] <= of_b.last[b] + reach && of_b.first[b] <= of_a.last[a] + reach) join(a, b);
    if (of_a.last[a] < of_b.last[b])
      ++a;
    else
      ++b;
  }
}

}  // namespace msq
