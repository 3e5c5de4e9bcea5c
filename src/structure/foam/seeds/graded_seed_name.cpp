// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/seeds/graded_seed_name.h"

#include <cmath>

namespace msq {

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

NamedLeafSeed seed_of(const GradedSeeds& seeds, CellIndex home, const GradedSeedName& name) {
  const CellIndex cell{home.x + name.cell[0], home.y + name.cell[1], home.z + name.cell[2]};
  if (const PlacedSeeds* const placed = seeds.placed())
    return {cell, placed->seed(cell, name.order).in_box, std::ldexp(1.0, -name.level)};
  GradedSeeds::Node node{cell};
  for (int level = 1; level <= name.level; ++level)
    node = node.child(name.order >> (3 * (GradedSeeds::max_levels - level)) & 7u);
  return {cell, seeds.in_leaf(node), node.size()};
}

}  // namespace msq
