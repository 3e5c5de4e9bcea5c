// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/graded_line.h"

#include <cmath>

namespace msq {

StrutLine graded_line(const GradedSeeds& seeds, CellIndex home,
                      const std::array<GradedSeedName, 3>& names) {
  const NamedLeafSeed first = seed_of(seeds, home, names[0]);
  const auto position = [&](const NamedLeafSeed& leaf) {
    const Vec3 cell{double(leaf.cell.x - first.cell.x), double(leaf.cell.y - first.cell.y),
                    double(leaf.cell.z - first.cell.z)};
    return (cell + leaf.in_cell) * seeds.scale();
  };
  // In sizes of the leaf, as EdgeLine's tolerances require.
  const double size = first.size;
  const Vec3 seed = position(first);
  const Vec3 u = (position(seed_of(seeds, home, names[1])) - seed) * (1 / size),
             v = (position(seed_of(seeds, home, names[2])) - seed) * (1 / size);
  StrutLine strut;
  strut.line = EdgeLine({}, u, v);
  strut.has_line = strut.line.exists();
  const double inverse_size = std::sqrt(strut.line.inverse_squared);
  strut.along = strut.line.direction * inverse_size;
  strut.line.seed = seed;
  strut.line.offset = strut.line.offset * size;
  strut.home =
      Vec3{double(first.cell.x), double(first.cell.y), double(first.cell.z)} * seeds.scale();
  const double a = length(u), b = length(v);
  strut.error = size * 0x1p-50 * (a * b * (a + b + 4) * inverse_size + 4);
  return strut;
}

}  // namespace msq
