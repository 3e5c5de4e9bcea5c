// SPDX-License-Identifier: Apache-2.0
// Sums of solid angles by products of complex numbers.
//
// A solid angle is twice the argument of a complex number. That number needs no angles, and no
// roots except for the lengths of its corners (Van Oosterom and Strackee, "The solid angle of a
// plane triangle", 1983). The sum of the arguments of many numbers is the argument of their
// product, plus 2 pi for each time that the partial product passed the negative real axis. So the
// integer part of a sum needs no arc tangent, and the rest needs one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/arc_tangent.h"

namespace msq {

class HalfAngles {
 public:
  HalfAngles() = default;
  /// Of a sum that was taken elsewhere: the product, and how often it passed the axis.
  HalfAngles(double re, double im, int64_t turns) : re_(re), im_(im), turns_(turns) {}

  /// Adds the argument of (re, im), from -pi to pi; the sign of an im of 0 distinguishes these two.
  /// Adds nothing if both are 0.
  void add(double re, double im) {
    const double size = std::abs(re) + std::abs(im), room = std::abs(re_) + std::abs(im_);
    if (!(size * room < 0x1p400 && size * room > 0x1p-400)) {
      if (size == 0) return;
      scale(re, im);
      scale(re_, im_);
    }
    const bool was_low = std::signbit(im_), is_low = std::signbit(im);
    const double product_re = re_ * re - im_ * im;
    im_ = re_ * im + im_ * re;
    re_ = product_re;
    // The sum of two arguments from 0 to pi is at most 2 pi, and its sine is negative only if it
    // has passed pi. Signs are exact where that matters, since all terms of the product's im have
    // one sign.
    const bool low = std::signbit(im_);
    if (was_low == is_low && low != is_low) turns_ += low ? 1 : -1;
  }
  void add_turns(int64_t turns) { turns_ += turns; }

  /// The sum is 2 pi turns() + rest(), the rest above -pi and up to pi.
  int64_t turns() const { return is_half_turn_back() ? turns_ - 1 : turns_; }
  double rest() const {
    return is_half_turn_back() ? -arc_tangent(im_, re_) : arc_tangent(im_, re_);
  }

 private:
  /// By a power of two, to about 1.
  static void scale(double& re, double& im) {
    const int exponent = -std::ilogb(std::max(std::abs(re), std::abs(im)));
    re = std::ldexp(re, exponent);
    im = std::ldexp(im, exponent);
  }
  bool is_half_turn_back() const { return im_ == 0 && re_ < 0 && std::signbit(im_); }

  double re_ = 1, im_ = 0;
  int64_t turns_ = 0;
};

}  // namespace msq
