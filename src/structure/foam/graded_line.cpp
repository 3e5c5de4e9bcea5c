// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/graded_line.h"

#include <cmath>

namespace msq {

namespace {

GradedSeeds::Node node_of(CellIndex home, const GradedSeedName& name) {
  GradedSeeds::Node node{{home.x + name.cell[0], home.y + name.cell[1], home.z + name.cell[2]}};
  for (int level = 1; level <= name.level; ++level)
    node = node.child(name.order >> (3 * (GradedSeeds::most_levels - level)) & 7u);
  return node;
}

}  // namespace

GradedSeedName name_of(const LeafSeed& seed, CellIndex offset) {
  const auto from_home = [&](int shift) {
    return static_cast<int32_t>(seed.order >> shift & 0xffff) - 0x8000;
  };
  return {
      {static_cast<int8_t>(from_home(15) - offset.x), static_cast<int8_t>(from_home(31) - offset.y),
       static_cast<int8_t>(from_home(47) - offset.z)},
      static_cast<uint8_t>(seed.level),
      static_cast<uint16_t>(seed.order & 0x7fff)};
}

StrutLine graded_line(const GradedSeeds& seeds, CellIndex home,
                      const std::array<GradedSeedName, 3>& names) {
  const GradedSeeds::Node first = node_of(home, names[0]);
  const auto position = [&](const GradedSeedName& name) {
    const GradedSeeds::Node node = node_of(home, name);
    const Vec3 cell{double(node.cell.x - first.cell.x), double(node.cell.y - first.cell.y),
                    double(node.cell.z - first.cell.z)};
    return (cell + seeds.in_leaf(node)) * seeds.scale();
  };
  // In sizes of the leaf, as EdgeLine's tolerances want it.
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
