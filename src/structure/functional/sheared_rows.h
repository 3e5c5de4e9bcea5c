// SPDX-License-Identifier: Apache-2.0
// Rows of samples through functional structures in sheared cells around an axis that is parallel to
// an axis of the samples. The angle of a cell's second coordinate is then a sum of one that depends
// on the position across the axis and one that depends on that along it. One of the two is
// tabulated for many rows, as are the waves of the other coordinate that goes with it; the addition
// theorems give the waves of the sum. Single precision decides all samples, except those within its
// error of the level. Those are evaluated one by one.
#pragma once

#include <vector>

#include "base/simd.h"
#include "structure/functional/functional.h"
#include "structure/functional/level_bounds.h"

namespace msq {

class ShearedRows {
 public:
  /// `structure` has sheared cells and a trigonometric form, with the axes of the samples.
  ShearedRows(const Functional& structure, const RowBlock& block);

  /// Whether the error is small.
  bool serves() const { return slack_ < 1e-2; }
  /// Clears the bits of samples that are outside.
  void keep(const Job* job);

 private:
  using Wave = TrigonometricForm::Wave;
  /// Sine and cosine of each wave at a row: of the part of its angle that is not tabulated.
  using RowWaves = std::vector<float>;

  double slack() const;
  bool is_along() const { return axis_ == 0; }
  /// Whether a wave has a part that depends on the position in the row, and one on the row.
  bool has_table(const Wave& wave) const {
    return wave.axis == 1 || (wave.axis == 2) == is_along();
  }
  bool has_row(const Wave& wave) const { return wave.axis == 1 || (wave.axis == 2) != is_along(); }
  Program wave_program() const;
  /// The angles along the axis at a coordinate: of the cell's third coordinate, and of the shear.
  void find_along(Vec3 p, double& own, double& shear) const;
  /// The angles across it: of the first coordinate, and of the second without the shear along.
  void find_across(Vec3 p, double& own, double& around) const;
  void set_row(const double (&angles)[3], RowWaves& to) const;
  void tabulate(double y, double z);
  bool is_empty(const RowGroup& group) const;
  void keep_group(const RowGroup& group);
  void decide(const RowGroup& group, size_t row, const RowWaves& waves, uint32_t first,
              uint32_t count);

  const Functional& structure_;
  const Warp& warp_;
  const Warp straight_;  // the same without a shear
  const TrigonometricForm& form_;
  const RowBlock& block_;
  const SampleGrid& grid_;
  const int axis_;  // of the samples, that the structure's is parallel to
  double slack_ = 0;
  LevelBounds bounds_;
  Program program_;
  Batch tables_program_;
  BatchOf<float> values_;
  std::vector<double> x_, angles_[3], radii_;
  std::vector<AlignedFloats> tables_;  // by wave: sines, then cosines, by sample
  AlignedFloats turned_;               // by wave: those of the sums, of a batch of words
  std::vector<RowWaves> along_;        // if rows lie across the axis: by position along it
  RowWaves of_row_;
  std::vector<uint64_t> shell_, scratch_;
  std::vector<uint32_t> all_words_;
};

}  // namespace msq
