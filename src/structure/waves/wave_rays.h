// SPDX-License-Identifier: Apache-2.0
// Where a ray enters and leaves a sum of waves.
//
// Along a ray the sum is a sum of cosines of one variable. At a point its value and three
// derivatives are computed; the fourth is at most the sum of amplitudes times fourth powers of the
// rates. So a polynomial bounds the gap to the level from below. The ray advances up to the
// polynomial's first zero, found by steps that its own second derivative allows, and begins anew.
// Towards a surface that it will cross, steps shrink as those of a method of fourth order; past one
// that it misses, they are as long as the gap allows. Where steps are shorter than the tolerance,
// the ray advances by that, or by more if it creeps (LeastStep).
#pragma once

#include "structure/waves/waves.h"

namespace msq {

class WaveRay {
 public:
  WaveRay(const Waves& solid, const Ray& ray);

  /// The first t in [from, to] at which membership is `wanted`; false if there is none.
  bool find(bool wanted, double from, double to, double& t, const Job* job) const;

 private:
  /// A length of way, at most `most`, on which gap + first s + second s^2 / 2 + third s^3 / 6 -
  /// fourth_ s^4 is positive; 0 if there is none.
  double positive_until(double gap, double first, double second, double third, double most) const;

  const Waves& solid_;
  Ray ray_;
  Vec3 rate_;      // of the position in cells
  double fourth_;  // bound of the fourth derivative over 24
};

}  // namespace msq
