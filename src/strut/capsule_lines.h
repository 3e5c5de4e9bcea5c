// SPDX-License-Identifier: Apache-2.0
// Where parallel lines of a plane meet a capsule. A line meets the infinite cylinder about the axis
// in an interval; where an end of it lies beyond an end of the axis, the sphere about that end
// makes the end instead.
#pragma once

#include <algorithm>
#include <cmath>

namespace msq {

/// A capsule, in coordinates along lines (s), across them (t) and off the plane (w), from its end
/// a.
struct CapsuleLines {
  double a_s, a_t, d_s, d_t, d_w, w, squared, rest, inverse, radius2;

  CapsuleLines(double a_s, double a_t, double w, double d_s, double d_t, double d_w, double radius)
      : a_s(a_s),
        a_t(a_t),
        d_s(d_s),
        d_t(d_t),
        d_w(d_w),
        w(w),
        squared(d_s * d_s + d_t * d_t + d_w * d_w),
        rest(d_t * d_t + d_w * d_w),
        inverse(rest > 1e-12 * squared ? 1 / rest : 0),
        radius2(radius * radius) {}

  /// Where the line at t begins and ends in it; false where it does not meet it.
  bool meet(double at, double& low, double& high) const {
    const double t = at - a_t, off2 = t * t + w * w;
    const double at_b = (t - d_t) * (t - d_t) + (w - d_w) * (w - d_w);
    const double m = t * d_t + w * d_w;
    const double c = (off2 - radius2) * squared - m * m;
    if (inverse == 0) {  // along the line, or a point
      if (!(radius2 >= off2)) return false;
      const double q = std::sqrt(radius2 - off2);
      low = a_s + std::min(d_s, 0.0) - q;
      high = a_s + std::max(d_s, 0.0) + q;
      return true;
    }
    const double b = m * d_s, under = b * b - rest * c;
    if (!(under >= 0)) return false;
    const double root = std::sqrt(under);
    return end((b - root) * inverse, m, off2, at_b, -1, low) &&
           end((b + root) * inverse, m, off2, at_b, 1, high);
  }

 private:
  bool end(double s, double m, double off2, double at_b, double sign, double& out) const {
    const double along = m + s * d_s;  // times the length
    if (along >= 0 && along <= squared) {
      out = a_s + s;
      return true;
    }
    const double q2 = radius2 - (along < 0 ? off2 : at_b);
    if (!(q2 >= 0)) return false;
    out = a_s + (along < 0 ? 0 : d_s) + sign * std::sqrt(q2);
    return true;
  }
};

}  // namespace msq
