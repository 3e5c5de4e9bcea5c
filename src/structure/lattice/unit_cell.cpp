// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/unit_cell.h"

#include <algorithm>
#include <cmath>

namespace msq {

namespace {

// Nodes closer than this, in cell units, are one node of the tiling.
constexpr double same_node = 1e-9;

bool close(Vec3 a, Vec3 b) {
  return max_magnitude(a - b) <= same_node;
}

std::vector<Vec3> cube_corners() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  return corners;
}

/// Struts between all pairs of nodes at this squared distance.
UnitCell connect(std::vector<Vec3> nodes, double distance_squared) {
  UnitCell cell;
  cell.nodes = std::move(nodes);
  for (uint32_t i = 0; i < cell.nodes.size(); ++i)
    for (uint32_t j = i + 1; j < cell.nodes.size(); ++j) {
      const Vec3 d = cell.nodes[j] - cell.nodes[i];
      if (std::abs(dot(d, d) - distance_squared) < same_node) cell.struts.push_back({i, j});
    }
  return cell;
}

Vec3 floor_with_tolerance(Vec3 v) {
  return {std::floor(v.x + same_node), std::floor(v.y + same_node), std::floor(v.z + same_node)};
}

}  // namespace

UnitCell cubic_unit_cell() {
  return connect(cube_corners(), 1);
}

UnitCell bcc_unit_cell() {
  std::vector<Vec3> nodes = cube_corners();
  nodes.push_back({0.5, 0.5, 0.5});
  return connect(std::move(nodes), 0.75);
}

UnitCell octet_unit_cell() {
  std::vector<Vec3> nodes = cube_corners();
  for (double side : {0.0, 1.0}) {
    nodes.push_back({side, 0.5, 0.5});
    nodes.push_back({0.5, side, 0.5});
    nodes.push_back({0.5, 0.5, side});
  }
  return connect(std::move(nodes), 0.5);
}

std::vector<PeriodicStrut> periodic_struts(const UnitCell& cell) {
  std::vector<PeriodicStrut> unique;
  for (size_t strut = 0; strut < cell.struts.size(); ++strut) {
    // Moved by whole cells until either end may serve as the first.
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

}  // namespace msq
