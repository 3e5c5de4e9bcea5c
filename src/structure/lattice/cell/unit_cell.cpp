// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/cell/unit_cell.h"

#include <algorithm>
#include <cmath>

namespace msq {

namespace {

bool close(Vec3 a, Vec3 b) {
  return max_magnitude(a - b) <= same_node;
}

Vec3 floor_with_tolerance(Vec3 v) {
  return {std::floor(v.x + same_node), std::floor(v.y + same_node), std::floor(v.z + same_node)};
}

}  // namespace

std::vector<PeriodicStrut> periodic_struts(const UnitCell& cell) {
  std::vector<PeriodicStrut> unique;
  for (size_t strut = 0; strut < cell.struts.size(); ++strut) {
    // Moved by whole cells, once for each end as the first.
    const auto [i, j] = cell.struts[strut];
    const double factor = cell.factor(strut);
    const Vec3 p = cell.nodes[i], q = cell.nodes[j];
    const Vec3 from_p = floor_with_tolerance(p), from_q = floor_with_tolerance(q);
    const PeriodicStrut forward{p - from_p, q - from_p, factor}, backward{q - from_q, p - from_q};
    bool is_known = false;
    for (PeriodicStrut& u : unique) {
      if (!(close(u.a, forward.a) && close(u.b, forward.b)) &&
          !(close(u.a, backward.a) && close(u.b, backward.b)))
        continue;
      is_known = true;
      u.factor = std::max(u.factor, factor);
    }
    if (!is_known) unique.push_back(forward);
  }
  std::stable_sort(
      unique.begin(), unique.end(),
      [](const PeriodicStrut& s, const PeriodicStrut& t) { return s.factor > t.factor; });
  return unique;
}

void UnitCell::describe(HashInput& input) const {
  input.points(nodes);
  input.integer(struts.size());
  for (size_t strut = 0; strut < struts.size(); ++strut) {
    for (uint32_t node : struts[strut]) input.integer(node);
    input.number(factor(strut));
  }
}

}  // namespace msq
