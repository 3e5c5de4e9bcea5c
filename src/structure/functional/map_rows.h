// SPDX-License-Identifier: Apache-2.0
// Rows of samples through functional structures in cells by a map that the host samples, along an
// axis of its grid. In a voxel of the map the coordinates are then linear along a row. Single
// precision decides all samples, except those within its error of the level. Those are evaluated
// one by one.
#pragma once

#include <vector>

#include "base/simd.h"
#include "structure/functional/functional.h"
#include "structure/functional/level_bounds.h"
#include "structure/functional/map_kernels.h"

namespace msq {

class MapRows {
 public:
  /// `structure` has a sampled map and a trigonometric form, with the axes of the samples.
  MapRows(const Functional& structure, const RowBlock& block);

  /// Whether voxels are at least as long as the samples are apart, and the error is small.
  bool serves() const { return serves_; }
  /// Clears the bits of samples that are outside.
  void keep(const Job* job);

 private:
  /// Voxels and positions in them of samples along an axis of theirs.
  struct Positions {
    std::vector<uint64_t> voxels;
    std::vector<double> fractions;
    std::vector<uint8_t> in_box;
  };
  Positions find_positions(int sample_axis, uint64_t begin, uint64_t count) const;
  void tabulate_columns();
  double slack() const;
  void keep_group(const RowGroup& group);
  bool find_words(uint64_t j, uint64_t k);
  /// Nodes of the voxels along a row.
  void find_row(uint64_t j, uint64_t k);
  /// The nodes of a line of samples of the map, between its layers.
  template <class T>
  void find_nodes(const T* samples, uint64_t y, uint64_t z, double fraction, double* nodes) const;
  void decide(const RowGroup& group, size_t row, size_t first, size_t count);

  const Functional& structure_;
  const SampledMap& map_;
  const TrigonometricForm& form_;
  const RowBlock& block_;
  const SampleGrid& grid_;
  int axes_[3];  // by axis of the samples, that of the map
  bool serves_ = false;
  double slack_ = 0;
  Positions rows_, layers_;
  std::vector<uint32_t> columns_;
  std::vector<float> fractions_;
  std::vector<uint64_t> in_box_;  // of the columns, as bits
  uint64_t first_voxel_ = 0;      // that the columns are in
  size_t voxels_ = 0;
  // By coordinate: nodes of the two lines of samples next to a row, and the row's voxels.
  std::vector<double> nodes_[3][2];
  std::vector<float> starts_[3], rises_[3];
  uint64_t nodes_row_ = UINT64_MAX, nodes_layer_ = UINT64_MAX;
  LevelBounds bounds_;
  BatchOf<float> values_;
  AlignedFloats at_;  // per wave: sines, then cosines, of a batch of words
  std::vector<MapWave> waves_;
  std::vector<uint32_t> words_;
};

}  // namespace msq
