// SPDX-License-Identifier: Apache-2.0
// One ray against lists of capsules, in vectors of capsules and in double precision. For lists that
// many rays meet one after the other, each ray at its own place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "strut/segment.h"

namespace msq {

/// Axes, and the factors of the radius.
class CapsuleList {
 public:
  void add(const Segment& axis, double factor);
  /// Call after the last capsule was added.
  void finish();

  size_t size() const { return count_; }
  /// a, ab, 1 / |ab|^2 and the factor of each, with room for a vector past the last.
  struct Arrays {
    const double* of[8];
  };
  Arrays arrays() const {
    Arrays arrays;
    for (size_t i = 0; i < 8; ++i) arrays.of[i] = arrays_[i].data();
    return arrays;
  }
  double factor(size_t i) const { return arrays_[factors][i]; }
  /// The axis as it was added, to the last bit.
  Segment axis(size_t i) const {
    Segment s;
    s.a = {arrays_[0][i], arrays_[1][i], arrays_[2][i]};
    s.ab = {arrays_[3][i], arrays_[4][i], arrays_[5][i]};
    s.inverse_length_squared = arrays_[inverses][i];
    return s;
  }

  struct Ray {
    Vec3 origin, direction;  ///< of length 1, in the coordinates of the axes
    double to;               ///< begins at 0
    double radius;           ///< for a factor of 1
  };
  /// The part of the ray within capsule `capsule`.
  struct Met {
    uint32_t capsule;
    double enter, leave;
  };
  /// Writes those of capsules [begin, end) that the ray meets in [0, to] and returns their number,
  /// at most end - begin. If the ray runs along an axis within 1e-6, the parts may be too long, but
  /// not too short. Otherwise their error is rounding, which grows as parts get shorter.
  size_t meet(size_t begin, size_t end, const Ray& ray, Met* met) const;

 private:
  enum : size_t { inverses = 6, factors = 7 };

  size_t count_ = 0;
  std::vector<double> arrays_[8];  // a, ab, 1 / |ab|^2, factor
};

}  // namespace msq
