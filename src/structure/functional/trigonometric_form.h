// SPDX-License-Identifier: Apache-2.0
// Tapes that are made, by sums, products, minima, maxima and magnitudes, of sines and cosines of
// whole multiples of the coordinates, as all presets are. Along any straight row of samples these
// follow from their values at one sample, by the sums of angles.
#pragma once

#include <optional>
#include <vector>

#include "expression/enclosure.h"
#include "expression/program.h"

namespace msq {

class TrigonometricForm {
 public:
  /// The sine and the cosine of `frequency` times an angle.
  struct Wave {
    int axis;  ///< of the grid
    int frequency;
  };
  /// None for other tapes.
  static std::optional<TrigonometricForm> of(const Tape& tape);

  const std::vector<Wave>& waves() const { return waves_; }
  /// Inputs: sine and cosine of each wave. Output: the tape's value; rational operations only.
  const Program& values() const { return values_; }
  /// Bound of the error of the value in single precision, where the angles of the samples that the
  /// tape sees and those of the sums differ by no more than angle_error, and each sine and cosine
  /// is a sum of two products in single precision.
  double slack(double angle_error) const;

 private:
  Tape tape_;
  std::vector<int> frequency_;  // of each node that is a wave; else 0
  std::vector<double> most_;    // magnitude of each node
  std::vector<Wave> waves_;
  Program values_;
};

}  // namespace msq
