// SPDX-License-Identifier: Apache-2.0
// The struts that rows of samples along an axis of the grid may meet.
#pragma once

#include <array>
#include <vector>

#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/rows/row_parts.h"

namespace msq {

/// A strut and its copies, a whole number of cells apart along the rows. Coordinates: along the
/// rows, across them, across the layers; model units, from a corner of the cell.
struct RowStrut {
  std::array<double, 3> a, ab;
  double factor;

  /// Inverses of smaller squared lengths may overflow.
  static constexpr double least_square = 1e-300;

  friend bool operator==(const RowStrut&, const RowStrut&) = default;
};

struct RowStruts final : RowParts {
  std::vector<RowStrut> struts;

  /// The struts that reach rows through the cell if the radius is at most `most`. axis[i]: the axis
  /// of the grid parallel to coordinate i.
  RowStruts(const std::vector<PeriodicStrut>& periodic, Vec3 cell_size, std::array<int, 3> axis,
            double most);
  void mark_inside(const RowTask& task, std::vector<LeftSample>& left) const override;
  bool draws_as(const RowParts& other) const override;
  std::unique_ptr<const RowParts> copy() const override;
  size_t bytes() const override { return struts.capacity() * sizeof(RowStrut); }
};

}  // namespace msq
