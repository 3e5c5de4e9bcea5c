// SPDX-License-Identifier: Apache-2.0
// A power diagram (Laguerre tessellation), from one global regular triangulation by CGAL.
#pragma once

#include <vector>

#include "diagram_check.h"

namespace msq::test {

/// All edges that have both ends and all faces that are bounded, among weighted seeds. The power of
/// a point p is |p - seeds[i]|^2 - weights[i].
Diagram power_diagram(const std::vector<Vec3>& seeds, const std::vector<double>& weights,
                      size_t& hidden);

}  // namespace msq::test
