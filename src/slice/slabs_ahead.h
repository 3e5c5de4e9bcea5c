// SPDX-License-Identifier: Apache-2.0
// Bits of layers, or rows of pixels made of them, slab by slab in ascending order. While the caller
// uses the layers of a slab, workers fill the next one; a single thread fills each when it is
// needed. Where a slab of one layer is still too large, bands of its rows follow each other in the
// same way. Source: paper, section "Slicing".
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "model/model.h"
#include "query/repeating_rows.h"
#include "slice/layer_output.h"

namespace msq {

class SlabsAhead {
 public:
  /// How many layers a slab has. The first one may have fewer: the caller waits for it.
  struct Depth {
    uint64_t first, others;
  };

  /// Rows of the pixels that samples divide.
  struct Bands {
    uint64_t rows;       ///< of a layer
    uint64_t band_rows;  ///< filled at once; fewer than `rows` only in slabs of one layer

    uint64_t count() const { return (rows + band_rows - 1) / band_rows; }
    uint64_t begin(uint64_t band) const { return band * band_rows; }
    uint64_t end(uint64_t band) const { return std::min(rows, (band + 1) * band_rows); }
  };

  /// What becomes of the rows of a grid.
  struct GridUse {
    RowRepeats repeats;          ///< of all its rows
    bool takes_repeats = false;  ///< rows that repeat others need not be there
    /// Null, or what its rows become when they are filled, in place of samples.
    const RowOutput* output = nullptr;
  };

  /// Bytes of rows of samples, or of the rows of `output` that they become. `across`: samples of a
  /// pixel.
  static uint64_t bytes_of_rows(const SampleGrid& rows, uint64_t across, const RowOutput* output);

  /// Memory for a run of so many layers: two slabs or bands, of a single thread one, and what
  /// filling them takes. The caller reserves it.
  static uint64_t bytes(const Model& model, const Scales& resolved,
                        const std::vector<SampleGrid>& grids, const std::vector<GridUse>& uses,
                        Depth depth, Bands bands, uint64_t layers);

  /// Of layers [first, last) of grids with the same layers, of which there may be none. No slab has
  /// more layers than there are. Fills the first slab or band.
  SlabsAhead(const Model& model, const Scales& resolved, const std::vector<SampleGrid>& grids,
             std::vector<GridUse> uses, Depth depth, Bands bands, uint64_t first, uint64_t last,
             Job* job);
  /// Stops the slab ahead.
  ~SlabsAhead();

  /// Makes a band of a layer current: the first one, then each next one.
  void go_to(uint64_t layer, uint64_t band);
  /// Rows of the current band of a grid: samples in words_for(nx) words each, or the bytes of its
  /// output. Valid until go_to().
  const uint64_t* words(size_t grid) const {
    return current_[grid].words.get() + (layer_ - piece_.begin) * layer_words_[grid];
  }
  /// Of the current band of a grid: rows that are not there.
  RowRepeats repeats(size_t grid) const {
    const RowRepeats& repeats = current_[grid].repeats;
    return repeats.any() && flips(grid).is_full() ? RowRepeats{} : repeats;
  }
  const RowFlips& flips(size_t grid) const { return current_[grid].flips[layer_ - piece_.begin]; }
  /// Samples inside of the current band of a grid that has an output.
  uint64_t inside_count(size_t grid) const {
    return current_[grid].inside[layer_ - piece_.begin].load(std::memory_order_relaxed);
  }

 private:
  struct GridSlab {
    /// Of samples or pixels. Pages are touched as layers are filled: a shallow first slab needs
    /// few.
    std::unique_ptr<uint64_t[]> words;
    std::unique_ptr<std::atomic<uint64_t>[]> inside;  ///< of each layer
    RowRepeats repeats;                               ///< rows that are not there
    std::vector<RowFlips> flips;                      ///< of each layer
  };
  using Slab = std::vector<GridSlab>;  ///< of each grid
  /// Layers that are filled at once, or a band of one.
  struct Piece {
    uint64_t begin, end, band = 0;
  };

  void fill(const Piece& piece, Slab& slab, const Job* job) const;
  void fill_grid(size_t g, const Piece& piece, GridSlab& slab, const Job* job) const;
  Piece after(const Piece& piece) const;
  void start_next();

  const Model& model_;
  const Scales& resolved_;
  const std::vector<SampleGrid>& grids_;
  const std::vector<GridUse> uses_;
  const uint64_t first_, last_;
  const Depth depth_;
  const Bands bands_;
  std::vector<uint64_t> layer_words_;  // of a layer or a band
  Slab current_, next_;
  Piece piece_;  // the current one
  uint64_t layer_;
  const Job* const job_;
  const bool is_ahead_;
  Job ahead_job_;  // stops the slab ahead when the caller ends early
  std::optional<Executor::Task> ahead_;
};

}  // namespace msq
