// SPDX-License-Identifier: Apache-2.0
// Kernels of the batched point query (point_batch.h): finding the seeds of a block near a point,
// and the definition itself for many points at once.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/simd.h"
#include "structure/foam/seeds/seed_tile.h"

namespace msq {

/// Seeds around one cell in single precision, foam units from the cell's corner; padded to whole
/// vectors by seeds far away.
struct SeedBlockView {
  const float *x, *y, *z;
  size_t count;       ///< number of seeds
  size_t mask_words;  ///< words for one bit per seed
  Vec3 room;          ///< from the cell to the block's border
  float slack;        ///< of distances in single precision
};
/// Points of that cell. Whole vectors of them may be read.
struct PlacesView {
  const double *x, *y, *z, *radius;
  size_t count;
  static constexpr size_t most = 64;
};
/// Maximum number of seeds of a block.
constexpr size_t max_block_seeds = 1024;

/// Fills x, y and z with the seeds of the cells up to half[axis] away from the tile's cell `home`,
/// in the order of their cells, and a vector of seeds far away. There is room for max_block_seeds
/// + block_padding.
void fill_block(const SeedTile& tile, size_t home, const int (&half)[3], Vec3 scale, float* x,
                float* y, float* z);
constexpr size_t block_padding = 2 * max_simd_doubles + 4;

/// For each point, sets bit s of masks[i * mask_words ...] for the seeds s that may be within
/// nearest distance + 2 radius + near_slack of it; near[i] is their number. If some of them may lie
/// beyond the block, near[i] = beyond_block. `scale`: cell size in foam units.
void find_near_seeds(const SeedBlockView& block, Vec3 scale, const PlacesView& places,
                     uint16_t* near, uint64_t* masks);
constexpr uint16_t beyond_block = UINT16_MAX;

/// Points that have the same number of candidates. These are the seeds, in the order of their
/// cells, that may be within nearest + 2 radius + near_slack. Foam units, relative to any cell's
/// corner, one for each point.
struct TripleBatch {
  static constexpr size_t capacity = max_simd_doubles;
  static constexpr size_t max_seeds = 6;

  size_t count = 0;
  double seed[max_seeds][3][capacity] = {};
  double point[3][capacity] = {};
  double radius[capacity] = {};
  uint32_t index[capacity];
};

/// Sets held[i] to 1 or 0, the result of foam_point_inside() for point i, whose candidates are the
/// first `seeds` of the batch.
void decide_triples(const TripleBatch& batch, size_t seeds, uint8_t* held);

}  // namespace msq
