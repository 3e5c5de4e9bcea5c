// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/graded_line.h"

#include <cmath>

namespace msq {

StrutLine graded_line(const GradedSeeds& seeds, CellIndex home,
                      const std::array<GradedSeedName, 3>& names) {
  const GradedSeeds::Node first = node_of(home, names[0]);
  const auto position = [&](const GradedSeedName& name) {
    const GradedSeeds::Node node = node_of(home, name);
    const Vec3 cell{double(node.cell.x - first.cell.x), double(node.cell.y - first.cell.y),
                    double(node.cell.z - first.cell.z)};
    return (cell + seeds.in_leaf(node)) * seeds.scale();
  };
  // In sizes of the leaf, as EdgeLine's tolerances require.
  const double size = first.size();
  const Vec3 seed = position(names[0]);
  const Vec3 u = (position(names[1]) - seed) * (1 / size),
             v = (position(names[2]) - seed) * (1 / size);
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
