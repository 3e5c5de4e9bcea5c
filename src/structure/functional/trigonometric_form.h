// SPDX-License-Identifier: Apache-2.0
// Tapes made, by sums, products, minima, maxima and magnitudes, of sines and cosines of integer
// multiples of the coordinates, as all presets are. Along any straight row of samples these follow
// from their values at one sample, by the addition theorems.
#pragma once

#include <optional>
#include <vector>

#include "expression/enclosure.h"
#include "expression/program.h"
#include "structure/functional/wave_products.h"

namespace msq {

class TrigonometricForm {
 public:
  /// The sine and the cosine of `frequency` times an angle.
  struct Wave {
    int axis;  ///< of the grid
    int frequency;
  };
  /// Returns nothing for other tapes.
  static std::optional<TrigonometricForm> of(const Tape& tape);

  const std::vector<Wave>& waves() const { return waves_; }
  /// Inputs: sine and cosine of each wave. Output: the tape's value; rational operations only.
  const Program& values() const { return values_; }
  /// The error, besides that of the angle, of a sine or cosine that is a sum of two products in
  /// single precision.
  static constexpr double wave_error = 0x1p-21;
  /// Null if the tape is no sum of products of waves, or one of many.
  const WaveProducts* products() const { return products_ ? &*products_ : nullptr; }
  /// Bound of the error of the value in single precision. The angles of the tape's samples and
  /// those of the sines and cosines must differ by at most angle_error, times the frequency.
  double slack(double angle_error, double of_waves = wave_error) const;

 private:
  Tape tape_;
  std::vector<int> frequency_;  // of each node that is a wave; otherwise 0
  std::vector<double> most_;    // magnitude of each node
  std::vector<Wave> waves_;
  Program values_;
  std::optional<WaveProducts> products_;
};

}  // namespace msq
