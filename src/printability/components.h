// SPDX-License-Identifier: Apache-2.0
// Connected components of the set samples of a stack of layers, layer by layer.
// Source: Hoshen and Kopelman, "Percolation and cluster distribution", 1976: labels of two layers,
// joined by union-find, and totals of the components that can still grow.
//
// One component is known as a mask of bits: the anchored one, or one that is large. Almost all
// samples of a structure belong to it, and they are found by words of 64 samples, without labels:
// the samples above it, and what these reach within the layer. Only the runs that are left get
// labels. A run that turns out to belong to the known component joins its mask.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/sample_grid.h"

namespace msq {

/// What is known of a component.
struct ComponentTotals {
  uint64_t samples = 0;
  double height_sum = 0;  ///< of each sample's layer height
  uint64_t first_layer = 0, last_layer = 0;
  uint32_t low[2] = {UINT32_MAX, UINT32_MAX}, high[2] = {0, 0};  ///< of the indices along x and y
  uint32_t place[2] = {0, 0};  ///< x, y of the first sample of the first layer: lowest y, then x

  void add_run(uint32_t first, uint32_t last, uint32_t row);
  void merge(const ComponentTotals& other);
};

class Components {
 public:
  struct Rules {
    /// Samples of a layer are also joined across corners. Samples of two layers are joined only if
    /// one is above the other.
    bool joins_corners = false;
    /// Samples at the sides of the grid are anchored, and what is joined to them. Anchored
    /// components are not reported.
    bool anchors_sides = false;
    /// The same of samples of the first layer.
    bool anchors_first_layer = false;
    bool finds_islands = false;
  };
  using Take = std::function<void(const ComponentTotals&)>;

  /// Components end in the layer before the one being added. Islands are components of the layer
  /// being added, taken alone, none of whose samples is above a set sample; never in the first
  /// layer. In other words, components that begin.
  Components(uint64_t nx, uint64_t ny, Rules rules, Take take_ended, Take take_island = nullptr);

  /// rows: ny rows of words_for(nx) words. Components that do not reach this layer are taken.
  void add_layer(const uint64_t* rows, double height);
  /// Takes the components that reach the last layer.
  void end();

  /// Bytes of the masks.
  static uint64_t bytes(uint64_t nx, uint64_t ny) {
    return 4 * words_for(nx) * ny * sizeof(uint64_t);
  }

 private:
  struct Run {
    uint32_t first, last;
    uint32_t component;  ///< of the layer before: from 1; 0 is the known one
  };
  /// Runs by rows: those of row j are [begin[j], begin[j + 1]).
  struct Runs {
    std::vector<Run> runs;
    std::vector<size_t> begin;
  };

  /// Bits of a layer.
  struct Mask {
    std::vector<uint64_t> bits;
    size_t words = 0;  ///< of a row
    uint64_t* row(uint64_t j) { return bits.data() + j * words; }
    const uint64_t* row(uint64_t j) const { return bits.data() + j * words; }
  };

  uint32_t find(uint32_t node);
  void unite(uint32_t a, uint32_t b);
  void flood(const uint64_t* rows);
  void flood_row(const uint64_t* row, uint64_t j, const uint64_t* beside);
  void list_runs();
  void join_layers();
  void join_in_layer();
  bool touches_known(uint64_t j) const;
  void remove_known_runs();
  void resolve(double height);
  void measure_known(double height);
  void adopt();

  const uint64_t nx_, ny_;
  const size_t words_;
  const Rules rules_;
  const Take take_ended_, take_island_;
  /// Whether the known component is the anchored one. Otherwise one that is large.
  const bool has_anchor_;
  Mask known_, known_below_;
  Mask rest_, rest_below_;         ///< the other samples, in rows that have some
  std::vector<uint8_t> has_rest_;  ///< by row
  Runs runs_, below_;
  std::vector<ComponentTotals> live_, next_;  ///< by component - 1
  ComponentTotals known_totals_;              ///< without an anchor; no samples: there is none
  /// Node 0: the known component; then the live ones; then the runs of the layer.
  std::vector<uint32_t> parents_;
  std::vector<uint32_t> numbers_;  ///< by node: new number of a root's component
  uint64_t layer_ = 0;
};

}  // namespace msq
