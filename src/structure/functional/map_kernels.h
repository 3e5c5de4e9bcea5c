// SPDX-License-Identifier: Apache-2.0
// Vector kernels for rows of samples in cells by a map that the host samples.
#pragma once

#include <cstddef>
#include <cstdint>

namespace msq {

/// Bound of the error of the sines and cosines of find_map_waves(), besides that of the angle.
constexpr double map_wave_error = 0x1p-17;

/// What a row of samples has in common with the rows of its voxels.
struct MapRow {
  const uint32_t* voxels;  ///< by sample: number along the row; neighbours differ by 1 at most
  const float* fractions;  ///< by sample: the position in its voxel
  const float* starts[3];  ///< by voxel: the coordinates at its beginning, less whole cells
  const float* rises[3];   ///< by voxel: the differences to those at its end
};
/// Voxels that can be read beyond the last.
constexpr size_t map_padding = 16;

/// The sine and the cosine of 2 pi times a multiple of a coordinate.
struct MapWave {
  int axis;
  float frequency;
  float *sines, *cosines;
};

/// The coordinates at the beginnings of `count` voxels, less whole cells, and their differences,
/// between two rows of `count` + 1 nodes. Nodes, and results, are readable and writable up to
/// map_padding beyond.
void blend_nodes(const double* low, const double* high, double fraction, size_t count,
                 float* starts, float* rises);

/// For each listed word of 64 samples, one after the other, the waves at its samples.
void find_map_waves(const MapRow& row, const uint32_t* words, size_t count, const MapWave* waves,
                    size_t wave_count);

}  // namespace msq
