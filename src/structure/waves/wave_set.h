// SPDX-License-Identifier: Apache-2.0
// A sum of cosines with random directions and phases: a Gaussian random field, of which each wave
// has the same length. Source: Cahn, "Phase separation by spinodal decomposition in isotropic
// systems", 1965; directions in cones about the axes: Kumar, Tan, Zheng and Kochmann,
// "Inverse-designed spinodoid metamaterials", 2020.
//
// With u the position in grid coordinates over the cell sizes, which are the wavelengths,
//   g = sum of a cos(2 pi f),  f = t - floor(t),  t = ((n.x u.x + n.y u.y) + n.z u.z) + phase,
// where a = sqrt(2 / count), so that the variance of g is 1. Wave i is added to partial sum i mod
// 16; the partial sums are then added in pairs: i and i + 8, i and i + 4, i and i + 2, 0 and 1.
// That is the definition, in double precision. So each instruction set can have its lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace msq {

struct WaveDirections {
  uint64_t seed = 0;
  uint32_t count = 1;
  /// Directions are uniform in the cones about the axes of the grid with these half-angles, in
  /// radians, up to pi / 2; 0: no cone. At least one cone.
  Vec3 half_angles;
  /// Cells along each axis after which the waves repeat; 0: they need not.
  uint32_t tile[3] = {};
};

/// The waves, padded by waves of amplitude 0 to a multiple of 16.
class WaveSet {
 public:
  static constexpr size_t sums = 16;

  explicit WaveSet(const WaveDirections& directions);

  size_t count() const { return count_; }
  size_t padded() const { return x_.size(); }
  /// In cycles per cell along each axis; phases in cycles, 0 to 1.
  const double* x() const { return x_.data(); }
  const double* y() const { return y_.data(); }
  const double* z() const { return z_.data(); }
  const double* phases() const { return phases_.data(); }
  const double* amplitudes() const { return amplitudes_.data(); }
  Vec3 wave(size_t i) const { return {x_[i], y_[i], z_[i]}; }
  double amplitude() const { return amplitudes_[0]; }
  /// The sum of the amplitudes.
  double most() const { return amplitude() * static_cast<double>(count_); }

 private:
  size_t count_;
  std::vector<double> x_, y_, z_, phases_, amplitudes_;
};

/// The level at which a Gaussian random field of variance 1 is at most the level in that part of
/// the volume; of sheets, its magnitude is. Source: Wichura, "Algorithm AS 241: the percentage
/// points of the normal distribution", 1988.
double gaussian_level(double volume_fraction, bool is_sheet);

}  // namespace msq
