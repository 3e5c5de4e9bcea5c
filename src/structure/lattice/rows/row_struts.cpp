// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/rows/row_struts.h"

#include <cmath>

namespace msq {

RowStruts::RowStruts(const std::vector<PeriodicStrut>& periodic, Vec3 size, std::array<int, 3> axis,
                     double most) {
  for (size_t i = 0; i < 3; ++i) {
    cell_size[i] = size[axis[i]];
    extent = std::max(extent, cell_size[i]);
  }
  max_factor = min_factor = periodic[0].factor;
  for (const PeriodicStrut& s : periodic) {
    max_factor = std::max(max_factor, s.factor);
    min_factor = std::min(min_factor, s.factor);
    RowStrut strut;
    strut.factor = s.factor;
    const double radius = s.factor * most;
    double low[3], high[3];
    int first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
    for (size_t i = 0; i < 3; ++i) {
      strut.a[i] = s.a[axis[i]] * cell_size[i];
      strut.ab[i] = s.b[axis[i]] * cell_size[i] - strut.a[i];
      low[i] = strut.a[i] + std::min(strut.ab[i], 0.0) - radius;
      high[i] = strut.a[i] + std::max(strut.ab[i], 0.0) + radius;
      if (i == 0) continue;
      // Copies whose box meets the cell, or is within rounding of it.
      const double slack = 1e-6 * (cell_size[i] + radius);
      first[i] = static_cast<int>(std::ceil((-slack - high[i]) / cell_size[i]));
      last[i] = static_cast<int>(std::floor((cell_size[i] + slack - low[i]) / cell_size[i]));
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j) {
        RowStrut copy = strut;
        copy.a[1] += j * cell_size[1];
        copy.a[2] += k * cell_size[2];
        struts.push_back(copy);
        for (size_t i = 0; i < 3; ++i)
          extent = std::max(
              {extent, std::abs(copy.a[i]) + radius, std::abs(copy.a[i] + copy.ab[i]) + radius});
      }
  }
}

bool RowStruts::draws_as(const RowParts& other) const {
  const auto* as = dynamic_cast<const RowStruts*>(&other);
  return as && cell_size == as->cell_size && extent == as->extent && struts == as->struts;
}

std::unique_ptr<const RowParts> RowStruts::copy() const {
  return std::make_unique<RowStruts>(*this);
}

}  // namespace msq
