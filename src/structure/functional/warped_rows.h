// SPDX-License-Identifier: Apache-2.0
// Rows of samples through functional structures in cells around an axis that is parallel to an axis
// of the samples. Then two of a cell's coordinates depend on the position across the axis alone,
// and one on that along it, to the last bit. So values of the tape that depend on the former are
// tabulated once for all rows that lie along the axis from each other.
#pragma once

#include <vector>

#include "structure/functional/functional.h"
#include "structure/functional/level_bounds.h"

namespace msq {

class WarpedRows {
 public:
  /// Whether the structure's axis is parallel to one of the samples, and cells are not sheared.
  static bool serves(const Functional& structure);

  WarpedRows(const Functional& structure, const RowBlock& block);

  /// Clears the bits of samples that are outside.
  void keep(const Job* job);

 private:
  /// Angles and radii along x, for a y and a z.
  void find_places(double y, double z);
  void tabulate();
  void keep_along(const Job* job);
  void keep_across(const Job* job);
  /// Decides a group's rows; those of `rows_` from number `first` on.
  void keep_group(const RowGroup& group, size_t first);
  void decide_linear(const RowGroup& group, size_t row, size_t number);
  void decide_samples(const RowGroup& group, size_t row, size_t number);
  void find_words(uint64_t j, uint64_t k);

  const Functional& structure_;
  const Warp& warp_;
  const RowBlock& block_;
  const SampleGrid& grid_;
  const int axis_;  // of the samples, that the structure's is parallel to
  const RowPlan& plan_;
  Batch tables_program_, rows_program_, samples_program_;
  std::vector<double> x_, angles_[3], radii_;
  std::vector<double> row_positions_, row_angles_[3], row_radii_;
  std::vector<std::vector<double>> tables_;
  std::vector<std::vector<float>> float_tables_;
  std::vector<const float*> float_pointers_;
  std::vector<uint64_t> shell_, result_, doubt_, scratch_;
  std::vector<uint32_t> words_, all_words_;
  std::vector<double> levels_;
  LevelBounds bounds_;
  double slack_ = 0;
};

/// The coverage of a box in warped or sampled cells, from the image of the box and enclosures of
/// the onset there.
BoxClass classify_warped(const Functional& structure, const Box3& box);

}  // namespace msq
