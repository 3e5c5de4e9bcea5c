// SPDX-License-Identifier: Apache-2.0
// How a tape is evaluated on rows of samples along an axis of its grid. Values that depend only on
// the position in the row are tabulated once for many rows. Values that do not depend on it are
// computed once per row. Only the rest is computed for each sample.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "expression/program.h"

namespace msq {

struct RowPlan {
  /// sample_axis[a]: the axis of the samples parallel to the grid's axis a. Rows run along axis 0
  /// of the samples.
  RowPlan(const Tape& tape, const std::array<int, 3>& sample_axis);

  /// Inputs: the angles along the three axes of the grid. `tables` has one output value for each
  /// position in a row, `rows` one for each row.
  Program tables, rows;

  /// Whether the tape's value is the sum of the rows' first outputs times the tables, plus the
  /// rows' last output; or the magnitude of such a sum. Then there is no program for samples.
  bool is_linear = false, is_absolute = false;
  /// Bound of the error of that sum in single precision, relative to the tape; with further terms,
  /// whose magnitudes sum to at most `magnitude`.
  double slack(size_t terms = 0, double magnitude = 0) const;

  /// If is_linear and each table is a factor times the sine or the cosine of the angle along the
  /// rows: of each table which of them, and the factor.
  struct WaveTable {
    bool is_sine;
    double factor;
  };
  std::optional<std::vector<WaveTable>> wave;

  /// Inputs: the tables, then the rows' outputs. Output: the tape's value.
  Program samples;

 private:
  double most_ = 0;  // of the sum of the magnitudes of all products
  double operations_ = 0;
};

}  // namespace msq
