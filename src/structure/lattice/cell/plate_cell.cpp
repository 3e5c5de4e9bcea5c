// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/cell/plate_cell.h"

#include <algorithm>
#include <cmath>

namespace msq {

namespace {

bool is_same_node(Vec3 a, Vec3 b) {
  return max_magnitude(a - b) <= same_node;
}

bool is_same_plate(const PeriodicPlate& s, const PeriodicPlate& t) {
  const Vec3 corners[] = {t.a, t.b, t.c};
  const auto has = [&](Vec3 p) {
    return std::any_of(std::begin(corners), std::end(corners),
                       [&](Vec3 q) { return is_same_node(p, q); });
  };
  return has(s.a) && has(s.b) && has(s.c);
}

/// Moved by whole cells so that its lowest coordinates are in [0, 1).
PeriodicPlate moved(PeriodicPlate plate) {
  const Vec3 low = plate.low();
  const Vec3 by{std::floor(low.x + same_node), std::floor(low.y + same_node),
                std::floor(low.z + same_node)};
  return {plate.a - by, plate.b - by, plate.c - by, plate.factor};
}

}  // namespace

std::vector<PeriodicPlate> periodic_plates(const PlateCell& cell) {
  std::vector<PeriodicPlate> unique;
  for (size_t face = 0; face < cell.faces.size(); ++face) {
    const auto [i, j, k] = cell.faces[face];
    const PeriodicPlate plate =
        moved({cell.nodes[i], cell.nodes[j], cell.nodes[k], cell.factor(face)});
    const auto known = std::find_if(unique.begin(), unique.end(), [&](const PeriodicPlate& other) {
      return is_same_plate(plate, other);
    });
    if (known == unique.end())
      unique.push_back(plate);
    else
      known->factor = std::max(known->factor, plate.factor);
  }
  std::stable_sort(
      unique.begin(), unique.end(),
      [](const PeriodicPlate& s, const PeriodicPlate& t) { return s.factor > t.factor; });
  return unique;
}

void PlateCell::describe(HashInput& input) const {
  input.points(nodes);
  input.integer(faces.size());
  for (size_t face = 0; face < faces.size(); ++face) {
    for (uint32_t node : faces[face]) input.integer(node);
    input.number(factor(face));
  }
}

}  // namespace msq
