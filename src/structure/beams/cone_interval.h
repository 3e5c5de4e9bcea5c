// SPDX-License-Identifier: Apache-2.0
// The interval of a line in a cone.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace msq {

/// Cuts [from, to] to where a x^2 + 2 b x + c <= 0, on a line along which the cone's radius grows
/// by `grows`. Only the nappe with a positive radius counts. If the line meets both nappes, the
/// caller's cuts must exclude the other one. Discriminants down to -graze count as 0. Returns false
/// if nothing is left.
inline bool cut_to_cone(double a, double b, double c, double grows, double graze, double& from,
                        double& to) {
  const double under = b * b - a * c;
  if (a > 0) {
    if (under < -graze) return false;
    const double root = std::sqrt(std::max(0.0, under));
    // The form without cancellation.
    const double q = -(b + std::copysign(root, b));
    const double one = q / a, other = q == 0 ? one : c / q;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
    return true;
  }
  if (grows == 0) return c <= 0;  // along the axis of a cylinder
  // In the cone forever, on the side on which the radius grows.
  if (under < 0) return true;
  const double q = -(b + std::copysign(std::sqrt(under), b));
  const double one = q == 0 ? 0 : c / q, other = a == 0 ? one : q / a;
  if (grows > 0)
    from = std::max(from, std::max(one, other));
  else
    to = std::min(to, std::min(one, other));
  return true;
}

}  // namespace msq
