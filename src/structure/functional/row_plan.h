// SPDX-License-Identifier: Apache-2.0
// How a tape is evaluated on rows of samples along an axis of its grid: what depends on the
// position in the row alone is tabulated once for many rows, what does not depend on it is computed
// once a row, and only the rest for each sample.
#pragma once

#include <array>

#include "expression/program.h"

namespace msq {

struct RowPlan {
  /// sample_axis[a]: the axis of the samples along which the grid's axis a runs. Rows run along
  /// axis 0 of the samples.
  RowPlan(const Tape& tape, const std::array<int, 3>& sample_axis);

  /// Inputs: the angles along the three axes of the grid. The outputs of `tables` are one for each
  /// position in a row, those of `rows` one for each row.
  Program tables, rows;

  /// Whether the tape's value is a sum of the rows' first outputs times the tables, plus the rows'
  /// last output; or the magnitude of such a sum. Then there is no program for samples.
  bool is_linear = false, is_absolute = false;
  /// Bound of the error of that sum in single precision against the tape; with further terms, their
  /// magnitudes at most `magnitude` together.
  double slack(size_t terms = 0, double magnitude = 0) const;

  /// Inputs: the tables, then the rows' outputs. Output: the tape's value.
  Program samples;

 private:
  double most_ = 0;  // of the sum of the magnitudes of all products
  double operations_ = 0;
};

}  // namespace msq
