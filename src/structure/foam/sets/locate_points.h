// SPDX-License-Identifier: Apache-2.0
// Neighbourhood::locate() for many points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cell/neighbourhood.h"

namespace msq {

/// Cells of points, and positions in them in foam units.
struct LocatedPoints {
  std::vector<int32_t> cell[3];
  std::vector<double> place[3];

  /// `scale`: cell size in foam units. The same bits as locate(p) and its fraction * scale, for
  /// points whose cell has a valid index; for other points the cell is arbitrary.
  void locate(const Neighbourhood& grid, Vec3 scale, const Vec3* points, size_t count);

  size_t bytes() const {
    return 3 * (cell[0].capacity() * sizeof(int32_t) + place[0].capacity() * sizeof(double));
  }
};

}  // namespace msq
