// SPDX-License-Identifier: Apache-2.0
// Bits of layers, slab by slab in ascending order. While the caller uses the layers of a slab,
// workers fill the next one. Source: paper, section "Slicing".
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "model/model.h"

namespace msq {

class SlabsAhead {
 public:
  /// How many layers a slab has. The first one may have fewer: the caller waits for it.
  struct Depth {
    uint64_t first, others;
  };

  /// Memory for a run of so many layers: two slabs and what filling them takes. The caller reserves
  /// it.
  static uint64_t bytes(const Model& model, const Scales& resolved,
                        const std::vector<SampleGrid>& grids, Depth depth, uint64_t layers);

  /// Of layers [first, last) of grids with the same layers, of which there may be none. No slab has
  /// more layers than there are. Fills the first slab.
  SlabsAhead(const Model& model, const Scales& resolved, const std::vector<SampleGrid>& grids,
             Depth depth, uint64_t first, uint64_t last, Job* job);
  /// Stops the slab ahead.
  ~SlabsAhead();

  /// Makes a layer current: the first one, then each next one.
  void go_to(uint64_t layer);
  /// Rows of the current layer of a grid, in words_for(nx) words each. Valid until go_to().
  const uint64_t* words(size_t grid) const {
    return current_[grid].data() + (layer_ - begin_) * layer_words_[grid];
  }

 private:
  using Slab = std::vector<std::vector<uint64_t>>;  ///< of each grid

  void fill(uint64_t begin, uint64_t end, Slab& slab, const Job* job) const;
  void start_next();

  const Model& model_;
  const Scales& resolved_;
  const std::vector<SampleGrid>& grids_;
  const uint64_t first_, last_;
  const Depth depth_;
  std::vector<uint64_t> layer_words_;
  Slab current_, next_;
  uint64_t begin_, end_, layer_;  // of the current slab
  Job ahead_job_;                 // stops the slab ahead when the caller ends early
  std::optional<Executor::Task> ahead_;
};

}  // namespace msq
