// SPDX-License-Identifier: Apache-2.0
// Connected components of the set samples of a stack of layers, layer by layer.
// Source: Hoshen and Kopelman, "Percolation and cluster distribution", 1976: labels of two layers,
// joined by union-find, and totals of the components that can still grow.
//
// One component is known as a mask of bits: the anchored one, or one that is large. Almost all
// samples of a structure belong to it, and they are found by words of 64 samples, without labels:
// the samples above it, and what these reach within the layer. Only the runs that are left get
// labels. A run that turns out to belong to the known component joins its mask.
//
// Bands of rows are labelled at the same time. Then their components are joined at the seams.
// Nothing that is found depends on the bands.
#pragma once

#include <cstdint>
#include <vector>

#include "printability/component_band.h"

namespace msq {

class Components {
 public:
  using Rules = ComponentRules;

  /// What a layer has found.
  struct Events {
    std::vector<ComponentTotals> islands;  ///< components of the layer, taken alone, none of whose
                                           ///< samples is above a set sample; never in the first
    std::vector<ComponentTotals> cups;     ///< as they were in the layer before
    std::vector<ComponentTotals> ended;    ///< in the layer before
    void clear();
  };

  /// bands: at least 1, at most strips_for(ny).
  Components(uint64_t nx, uint64_t ny, Rules rules, unsigned bands);

  /// A layer is added in four steps: scan() for each band, join(), settle() for each band,
  /// finish(). The bands of a step may run at the same time. rows: ny rows of words_for(nx) words.
  void scan(unsigned band, const uint64_t* rows);
  void join(double height);
  void settle(unsigned band);
  /// Returns what was found. Valid until the next join() or end().
  const Events& finish();
  /// After the last layer: the components that reach it, as `ended`.
  const Events& end();

  unsigned bands() const { return static_cast<unsigned>(bands_.size()); }
  uint64_t first_row(unsigned band) const { return bands_[band].begin; }
  uint64_t end_row(unsigned band) const { return bands_[band].end; }

  /// Bytes of the masks.
  static uint64_t bytes(uint64_t nx, uint64_t ny) {
    return 4 * words_for(nx) * ny * sizeof(uint64_t);
  }
  /// Bytes of all else, as of now.
  uint64_t held_bytes() const;

 private:
  uint32_t find(uint32_t node);
  void unite(uint32_t a, uint32_t b);
  void join_seam(const ComponentBand& low, const ComponentBand& high);
  void number(double height);
  void follow_kept();
  void keep_largest();
  void make_kept_known();

  const uint64_t nx_, ny_;
  const Rules rules_;
  /// Whether the known component is the anchored one. Otherwise it is the kept one, if that is
  /// large.
  const bool has_anchor_;
  ComponentMasks masks_;
  std::vector<ComponentBand> bands_;
  ComponentSeam seam_;
  std::vector<ComponentTotals> live_, next_;  ///< by component - 1
  /// Without an anchor, one component is kept until it ends: the largest of a layer when none was.
  /// No samples: there is none. It is known, or `kept_` is its number.
  ComponentTotals kept_totals_;
  uint32_t kept_ = 0, next_kept_ = 0;
  bool is_kept_anew_ = false;  ///< kept since this layer
  /// Node 0: the known component; then those of the bands.
  std::vector<uint32_t> parents_;
  std::vector<uint32_t> numbers_;   ///< by node: new number of its component
  std::vector<uint8_t> has_below_;  ///< by number - 1: for islands
  std::vector<uint32_t> heirs_;     ///< by component: a node; or none, it has ended
  Events events_;
  double height_ = 0;
  uint64_t layer_samples_ = 0;  ///< of components with a number
  uint64_t layer_ = 0;
};

}  // namespace msq
