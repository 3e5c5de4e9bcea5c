// SPDX-License-Identifier: Apache-2.0
// The void of a cell, which is convex, cut out of rows of samples: one span in each.
//
// A sample x (from the seed, in foam units) is in the void where n . x < d - t / 2 for all faces, n
// being a face's normal, d its distance from the seed and t the thickness. Spans are found in
// single precision, twice: of the void with all planes moved inwards by a margin, whose samples are
// cleared, and of that with them moved outwards by it. Samples between are in doubt: the predicate
// decides them.
//
// The error in single precision, in units of 2^-24 and as a shift of a plane: x within 4 (spans are
// cut off there), y and z within 2, components of n within 1.25 (a gradient of the thickness tilts
// planes by a quarter at most). Rounding of n, d and the coordinates: 6 + 1 + 3; of the products
// n_y y and n_z z, the quotients by n_x and the sums: 5 + 5 + 10 + 8; of x and of its place among
// the samples, which is a few roundings of x and of one step: 4 * 3 + 4. Together below 64.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "structure/foam/walls/face_brick.h"

namespace msq {

/// In foam units. Half of it for planes on either side of rounding, as said above.
constexpr double void_margin = 64 * 0x1p-24;

/// A plane, foam units along the axes of the samples: n . x <= offset, within `margin`.
struct VoidPlane {
  float n[3];
  float offset, margin;
};

/// The samples that may be in the void of a cell.
struct VoidRows {
  const float *y, *z;  ///< of rows and layers, from the seed; vectors may be read
  size_t rows, layers;
  uint32_t first_row, first_layer;  ///< in the block
  uint64_t* words;                  ///< of the first row
  size_t row_stride, layer_stride;
  float per_unit;      ///< samples along x in a foam unit
  float seed_after;    ///< where the seed is along x, in samples after sample `base`
  int64_t base, last;  ///< the latter of the row
};

/// Samples first ... first + count - 1 of a row of the block.
struct DoubtfulSamples {
  uint32_t row, layer;
  uint64_t first;
  uint32_t count;
};

/// More samples than this in a foam unit have no place in single precision.
constexpr double max_per_unit = 1 << 20;

/// Clears the samples of the void; appends those that are not decided.
void clear_void(const std::vector<VoidPlane>& planes, const VoidRows& rows,
                std::vector<DoubtfulSamples>& doubts);

}  // namespace msq
