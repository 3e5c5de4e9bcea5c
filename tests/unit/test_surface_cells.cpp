// SPDX-License-Identifier: Apache-2.0
// Cells of preview meshes: loops of crossings, for every case, and the point nearest to planes.
#include <bit>
#include <cmath>

#include "msq_test.h"
#include "surface/cell_loops.h"
#include "surface/quadric.h"

namespace {

using namespace msq;

bool is_inside(unsigned corners, unsigned corner) {
  return corners >> corner & 1;
}

void faces_have_their_edges(void**) {
  for (const CellFace& face : cell_faces)
    for (size_t q = 0; q < 4; ++q) {
      const unsigned a = face.corners[q], b = face.corners[(q + 1) % 4], e = face.edges[q];
      assert_true((first_corner(e) == a && second_corner(e) == b) ||
                  (first_corner(e) == b && second_corner(e) == a));
    }
}

void check_loops(unsigned corners, unsigned centres) {
  const CellLoops loops = find_loops(corners, centres);
  unsigned sizes[12] = {}, ends[12] = {};
  for (unsigned e = 0; e < 12; ++e) {
    const bool crosses =
        is_inside(corners, first_corner(e)) != is_inside(corners, second_corner(e));
    assert_true(crosses == (loops.of_edge[e] != CellLoops::none));
    if (!crosses) continue;
    assert_true(loops.of_edge[e] < loops.count);
    ++sizes[loops.of_edge[e]];
  }
  for (unsigned n = 0; n < loops.count; ++n) assert_true(sizes[n] >= 3);
  // Each arc has two ends in one loop.
  for (unsigned f = 0; f < 6; ++f) {
    const CellFace& face = cell_faces[f];
    const auto loop_at = [&](size_t q) { return loops.of_edge[face.edges[q % 4]]; };
    if (is_ambiguous(corners, face)) {
      for (size_t q = 0; q < 4; ++q)
        if (is_inside(corners, face.corners[q]) != is_inside(centres, f))
          assert_true(loop_at(q + 3) == loop_at(q));
      for (size_t q = 0; q < 4; ++q) ++ends[face.edges[q]];
      continue;
    }
    uint8_t first = CellLoops::none;
    for (size_t q = 0; q < 4; ++q) {
      if (loop_at(q) == CellLoops::none) continue;
      ++ends[face.edges[q]];
      if (first == CellLoops::none) first = loop_at(q);
      assert_true(loop_at(q) == first);
    }
  }
  for (unsigned e = 0; e < 12; ++e)
    assert_true(ends[e] == (loops.of_edge[e] == CellLoops::none ? 0u : 2u));
  // The solid and the void have the same boundary.
  const CellLoops others = find_loops(~corners & 255u, ~centres & ambiguous_faces(corners));
  assert_true(others.count == loops.count && others.of_edge == loops.of_edge);
}

void loops_are_closed(void**) {
  unsigned cases = 0;
  for (unsigned corners = 0; corners < 256; ++corners) {
    const unsigned all = ambiguous_faces(corners);
    for (unsigned centres = 0; centres < 64; ++centres) {
      if (centres & ~all) continue;
      check_loops(corners, centres);
      ++cases;
    }
  }
  assert_true(cases > 256);
  assert_true(cell_table().loops[0].count == 0 && cell_table().loops[1].count == 1);
  assert_true(find_loops(0x81, 0).count == 2);        // opposite corners of a cell
  assert_true(find_loops(0x09, 0).count == 2);        // opposite corners of a face
  assert_true(find_loops(0x09, 1u << 4).count == 1);  // joined at its centre
}

void assert_at(Vec3 got, Vec3 wanted, double tolerance) {
  if (length(got - wanted) > tolerance)
    fail_msg("(%g, %g, %g) is not at (%g, %g, %g)", got.x, got.y, got.z, wanted.x, wanted.y,
             wanted.z);
}

void planes_meet(void**) {
  const Box3 box{{0, 0, 0}, {1, 1, 1}};
  const double h = std::sqrt(0.5);
  // A corner.
  const Vec3 corner_points[] = {{0.3, 0, 0}, {0, 0.6, 1}, {1, 1, 0.2}};
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  assert_at(nearest_to_planes(corner_points, axes, 3, box), {0.3, 0.6, 0.2}, 1e-12);
  // One plane: the mean of the points.
  const Vec3 flat[] = {{0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 0.5}};
  const Vec3 up[] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  assert_at(nearest_to_planes(flat, up, 3, box), {1.0 / 3, 1.0 / 3, 0.5}, 1e-12);
  // A slanted edge: the point of it nearest to the mean is beyond the box, another is within.
  const Vec3 slanted_points[] = {{0, 0, 0.1}, {0.1, 0, 0.2}, {0.05, 0, 0.05}, {0, 0.9, 0}};
  const Vec3 normals[] = {{h, 0, -h}, {h, 0, -h}, {0, 1, 0}, {0, 1, 0}};
  const Vec3 found = nearest_to_planes(slanted_points, normals, 4, box);
  assert_true(box.contains(found));
  // Planes that meet beyond the box.
  const Vec3 far_points[] = {{0.1, 0, 0}, {0, 0.1, 0}, {0.1, 0, 1}, {0, 0.1, 1}};
  const Vec3 n = Vec3{1, 0.2, 0} * (1 / std::sqrt(1.04)),
             m = Vec3{1, -0.2, 0} * (1 / std::sqrt(1.04));
  const Vec3 far_normals[] = {n, m, n, m};
  assert_true(box.contains(nearest_to_planes(far_points, far_normals, 4, box)));
}

/// An edge of two planes through a box, from points on its edges: found wherever it runs through.
void edges_are_found(void**) {
  const Box3 box{{0, 0, 0}, {1, 1, 1}};
  for (int i = 1; i < 20; ++i)
    for (int j = 1; j < 20; ++j) {
      const double angle = 0.3 * i, c = std::cos(angle), s = std::sin(angle);
      const double x = 0.05 * j;
      const Vec3 at{x, 0.5, 0.5};
      const Vec3 normals[] = {{c, s, 0.2}, {c, s, 0.2}, {-s, c, 0.1}, {-s, c, 0.1}};
      Vec3 points[4], units[4];
      for (size_t k = 0; k < 4; ++k) {
        units[k] = normals[k] * (1 / length(normals[k]));
        const Vec3 along = k % 2 ? Vec3{0, 0, 0.4} : Vec3{0, 0, -0.4};
        points[k] = at + (along - units[k] * dot(along, units[k]));
      }
      bool fits = true;
      for (const Vec3& p : points) fits = fits && box.contains(p);
      if (!fits) continue;
      const Vec3 found = nearest_to_planes(points, units, 4, box);
      for (size_t k = 0; k < 4; ++k) assert_true(std::abs(dot(units[k], found - at)) < 1e-9);
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(faces_have_their_edges),
                              cmocka_unit_test(loops_are_closed), cmocka_unit_test(planes_meet),
                              cmocka_unit_test(edges_are_found)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
