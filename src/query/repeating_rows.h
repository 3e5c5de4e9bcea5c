// SPDX-License-Identifier: Apache-2.0
// Rows of a grid that repeat along y, in a shape whose rows are alike: all of the shape alone, or
// those of cells that are a whole number of pitches high. One period of rows is computed. The
// others are copies of it, or an output takes them as such.
#pragma once

#include <vector>

#include "query/membership.h"
#include "structure/common/repeating_structure.h"

namespace msq {

/// Row j has the bits of row j - period, for j from first + period to end - 1, except for flips.
struct RowRepeats {
  uint64_t first = 0, end = 0, period = 0;  ///< period 0: no rows repeat

  bool any() const { return period > 0; }
  /// The row that is computed for a row.
  uint64_t source(uint64_t row) const {
    return row < first || row >= end ? row : first + (row - first) % period;
  }
  /// Of rows [from, to) of the grid, as a grid of their own.
  RowRepeats of_rows(uint64_t from, uint64_t to) const;
};

/// Those of all layers.
RowRepeats find_row_repeats(const Model& model, const Scales& resolved, const SampleGrid& grid);

/// As fill_slab(). `flips`: null, or one list for each layer, by rows; then rows that repeat others
/// are not written, except in layers whose list is full: these have all rows.
void fill_repeating_slab(const Model& model, const Scales& resolved, const SampleGrid& grid,
                         const RowRepeats& repeats, uint64_t z0, uint64_t z1, uint64_t* words,
                         const Job* job, const FinishRows& finish, std::vector<RowFlips>* flips);

}  // namespace msq
