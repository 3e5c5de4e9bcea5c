// SPDX-License-Identifier: Apache-2.0
// Foams in a shell against the diagram of their seeds.
#pragma once

#include "diagram_check.h"
#include "foam_diagram.h"

namespace msq::test {

/// The edges and faces among seeds that overlap the box from -half to half.
inline Diagram diagram_among(const std::vector<Vec3>& seeds, Vec3 half) {
  const auto is_near = [&](const auto& part) {
    return box_of(part).overlaps(Box3{half * -1.0, half});
  };
  Diagram diagram;
  for (const DualEdge& e : dual_edges(seeds)) {
    const Segment edge(e.a, e.b);
    if (is_near(edge)) diagram.edges.push_back(edge);
  }
  for (const std::vector<Vec3>& face : dual_faces(seeds))
    if (is_near(face)) diagram.faces.push_back(face);
  return diagram;
}

/// In the shell as check_diagram() says; nothing is outside of it. beyond(p): the distance of a
/// point from the shell; in it below 0.
template <class Beyond>
void check_shelled(const char* name, const char* what, const Structure& solid, const Asked& asked,
                   Beyond&& beyond, double reach, double onsets, double near) {
  Asked within;
  size_t outside = 0;
  std::vector<uint8_t> alive(asked.points.size(), 1);
  solid.keep_points(asked.points.data(), alive.data(), asked.points.size());
  for (size_t i = 0; i < asked.points.size(); ++i) {
    const Vec3 p = asked.points[i];
    const double away = beyond(p);
    if (std::abs(away) <= near) continue;
    if (away < 0) {
      within.points.push_back(p);
      within.distances.push_back(asked.distances[i]);
      continue;
    }
    ++outside;
    assert_false(alive[i] || solid.inside(p));
    assert_true(std::isinf(solid.onset(p)));
    assert_true(solid.distance(p) >= away - near);
  }
  assert_true(outside > 0);
  check_diagram(name, what, solid, within, reach, onsets, near);
}

}  // namespace msq::test
