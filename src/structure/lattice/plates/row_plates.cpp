// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/plates/row_plates.h"

#include <algorithm>
#include <cmath>

namespace msq {

RowPlates::RowPlates(const std::vector<PeriodicPlate>& periodic, Vec3 size, std::array<int, 3> axis,
                     double most, double distance_error) {
  error = distance_error;
  Vec3 sizes;  // along the coordinates of rows
  for (int i = 0; i < 3; ++i) {
    const auto of = static_cast<size_t>(i);
    cell_size[of] = sizes[i] = size[axis[of]];
    extent = std::max(extent, sizes[i]);
  }
  const auto turned = [&](Vec3 p) { return Vec3{p[axis[0]], p[axis[1]], p[axis[2]]} * sizes; };
  max_factor = min_factor = 0.5 * periodic[0].factor;
  for (const PeriodicPlate& plate : periodic) {
    const double factor = 0.5 * plate.factor, radius = factor * most;
    max_factor = std::max(max_factor, factor);
    min_factor = std::min(min_factor, factor);
    const Box3 bounds{turned(plate.low()), turned(plate.high())};
    // Copies whose box meets the cell, or is within rounding of it.
    int first[3] = {0, 0, 0}, last[3] = {0, 0, 0};
    for (int i = 1; i < 3; ++i) {
      const double slack = 1e-6 * (sizes[i] + radius) + radius;
      first[i] = static_cast<int>(std::ceil((-slack - bounds.max[i]) / sizes[i]));
      last[i] = static_cast<int>(std::floor((sizes[i] + slack - bounds.min[i]) / sizes[i]));
    }
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j) {
        const Vec3 by = Vec3{0, double(j), double(k)} * sizes;
        const PlateTriangle triangle(turned(plate.a) + by, turned(plate.b) + by,
                                     turned(plate.c) + by);
        plates.push_back({triangle, bounds_of(triangle), factor});
        extent = std::max({extent, max_magnitude(plates.back().bounds.min) + radius,
                           max_magnitude(plates.back().bounds.max) + radius});
      }
  }
}

bool RowPlates::draws_as(const RowParts& other) const {
  const auto* as = dynamic_cast<const RowPlates*>(&other);
  return as && cell_size == as->cell_size && extent == as->extent && error == as->error &&
         plates == as->plates;
}

std::unique_ptr<const RowParts> RowPlates::copy() const {
  return std::make_unique<RowPlates>(*this);
}

}  // namespace msq
