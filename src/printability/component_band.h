// SPDX-License-Identifier: Apache-2.0
// A band of rows of a layer, labelled on its own. Components joins the bands of a layer.
#pragma once

#include <algorithm>
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
    low[0] = std::min(low[0], first);
    high[0] = std::max(high[0], last);
    low[1] = std::min(low[1], row);
    high[1] = std::max(high[1], row);
  }
  void merge(const ComponentTotals& other);
};

/// Rows are labelled by twos. Samples of such a strip that have the same x are joined, so a run of
/// a strip is a range of x in which each sample is joined to the next. Of a strip at the end, the
/// second row may be missing.
constexpr uint64_t rows_of_strip = 2;
constexpr uint64_t strips_for(uint64_t rows) {
  return (rows + rows_of_strip - 1) / rows_of_strip;
}

/// Runs of samples that are not known, by strips: those of strip n are [begin[n], begin[n + 1]). At
/// each x from edges[2 r] to edges[2 r + 1] - 1, run r has a sample of either row or both. The next
/// run may begin at edges[2 r + 1]. The arrays may be longer than the runs.
struct ComponentRuns {
  std::vector<uint32_t> edges;
  std::vector<uint32_t> node;     ///< by run: the node of the band that it was given
  std::vector<uint32_t> numbers;  ///< by node: its component, from 1, of the band; 0: the known one
  std::vector<uint32_t> begin;

  size_t strips() const { return begin.size() - 1; }
  uint32_t component(size_t run) const { return numbers[node[run]]; }
  uint32_t first(size_t run) const { return edges[2 * run]; }
  uint32_t end(size_t run) const { return edges[2 * run + 1]; }
};

/// What is known of a component in a band of a layer.
struct ComponentPart {
  /// Maxima: of ~x, x + 1 and y of its samples, and of whether one is above a sample that is not
  /// known. A run changes them by one operation of four numbers.
  uint32_t maxima[4] = {};
  uint64_t samples = 0;
  uint64_t place = 0;  ///< x + 2^32 y of its first sample: lowest y, then x

  uint32_t low_x() const { return ~maxima[0]; }
  uint32_t high_x() const { return maxima[1] - 1; }
  uint32_t high_y() const { return maxima[2]; }
  bool has_below() const { return maxima[3] != 0; }
  void set_has_below() { maxima[3] = 1; }
  void merge(const ComponentPart& other) {
    for (int i = 0; i < 4; ++i) maxima[i] = std::max(maxima[i], other.maxima[i]);
    samples += other.samples;
    place = std::min(place, other.place);
  }
};

/// Two runs that touch.
struct RunPair {
  uint32_t a, b;
};

/// Bits of a layer.
struct ComponentMask {
  std::vector<uint64_t> bits;
  size_t words = 0;  ///< of a row
  uint64_t* row(uint64_t j) { return bits.data() + j * words; }
  const uint64_t* row(uint64_t j) const { return bits.data() + j * words; }
};

struct ComponentMasks {
  bool has_known = false;  ///< otherwise `known` is not used, and the rest is all samples
  ComponentMask known, known_below;
  /// The other samples. Rows that are anchored as a whole are never written, so they stay empty.
  ComponentMask rest, rest_below;
  std::vector<uint64_t> no_row;  ///< a row without samples
};

struct ComponentBand {
  static constexpr uint32_t none = UINT32_MAX;

  uint64_t begin = 0, end = 0;    ///< rows; strips begin there
  ComponentRuns runs, below;      ///< of this layer and of the one before
  std::vector<uint8_t> has_rest;  ///< by row: whether it has samples that are not known
  /// Node 0: the known component. The others are of runs that touch none in the strip before, in
  /// the order of the runs. The smallest node of a component is its root.
  std::vector<uint32_t> parents;
  /// By number below: a node of this layer above the component, or none.
  std::vector<uint32_t> node_below;
  std::vector<ComponentPart> parts;  ///< by node; of a root: of its component
  std::vector<uint32_t> roots;       ///< by number - 1: the band's components in this layer
  uint32_t nodes = 1, count = 0;     ///< how many nodes, and components without the known one
  /// Of a strip, while it is labelled. `counts`: by run, how many samples the strip has before the
  /// run's end, and how many of them are in its second row.
  std::vector<uint32_t> counts;
  std::vector<RunPair> pairs;
  std::vector<uint32_t> fresh;
  std::vector<uint64_t> overlaps;
  /// Where runs start in the strip, the one before and the one below; where those of the strip end.
  std::vector<uint64_t> starts[3], ends;
  /// By number - 1: which of the layer each is part of.
  std::vector<uint32_t> global, global_below;
  /// By number - 1 below: the number in this layer; 0: it has joined the known one; or none.
  std::vector<uint32_t> heirs;
  ComponentTotals known_here;  ///< samples and box of the known component
  uint32_t base = 0;           ///< in Components: component n of the band is node base + n

  uint32_t find(uint32_t node) {
    while (parents[node] != node) {
      parents[node] = parents[parents[node]];
      node = parents[node];
    }
    return node;
  }
  /// Runs whose component is 0 move from the rest to the known samples.
  void drop_known_runs(ComponentMasks& masks);
  /// The same of runs whose component has this number in `global`.
  void make_known(uint32_t number, ComponentMasks& masks);
  uint64_t bytes() const;
};

/// Labels the band's samples of a layer of `ny` rows: those that are known, and the components of
/// the others. What other bands do is not seen.
void scan_band(ComponentBand& band, ComponentMasks& masks, const ComponentRules& rules,
               const uint64_t* rows, uint64_t nx, uint64_t ny, uint64_t layer);

/// Sets known_here.
void measure_known(ComponentBand& band, const ComponentMask& known);

/// Runs of two bands that touch, one above the other.
struct ComponentSeam {
  std::vector<RunPair> pairs;  ///< the first `count`; a: of the higher band, b: of the lower
  size_t count = 0;
  std::vector<uint32_t> low_known, high_known;  ///< that touch known samples of the other band
  std::vector<uint64_t> low_starts, high_starts, ends;
};
void find_seam(const ComponentBand& low, const ComponentBand& high, const ComponentMasks& masks,
               bool joins_corners, ComponentSeam& seam);

}  // namespace msq
