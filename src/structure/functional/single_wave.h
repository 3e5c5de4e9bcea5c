// SPDX-License-Identifier: Apache-2.0
// Rows along which a function is a single wave: constant + sine * sin(a) + cosine * cos(a) for the
// angle a of a sample, as along the axes of gyroids, primitives and diamonds. The samples with a
// value of at most a threshold then lie in one interval of the cell, the same for all cells, as
// those of a strut do: they are the difference of two sets of columns.
#pragma once

#include <cstdint>

#include "base/simd.h"
#include "expression/batch.h"
#include "structure/common/column_sets.h"

namespace msq {

/// The ends of samples with a value of at most a threshold, in buckets, row by row.
struct WaveEnds {
  int32_t low[batch_points + max_simd_doubles], high[batch_points + max_simd_doubles];
};

/// Ends for four thresholds. Samples with values up to `least` are inside, those above `most` are
/// not. A sheet has a hole, where its function is below minus the level: samples up to `hole_least`
/// are in the hole, those above `hole_most` are not.
struct WaveLevels {
  enum { least, most, hole_least, hole_most, count };
  WaveEnds ends[count];
  bool has_hole;
};

/// The functions of some rows. Arrays are padded for batches.
struct SingleWaves {
  const double *sine, *cosine;
  Values constant;
  size_t count;
};

/// Finds ends for values of at most the row's threshold. Their error is less than 2^-24 of the
/// amplitude of the row, in terms of the value.
void find_wave_ends(const SingleWaves& rows, const double* thresholds, WaveEnds& ends);

/// Overwrites the words of a row's parts with the samples that are certainly inside; `doubt` with
/// those that may be. False if there are none.
bool mark_wave(const ColumnSets& columns, const WaveLevels& levels, size_t row, uint64_t* inside,
               uint64_t* doubt);

}  // namespace msq
