// SPDX-License-Identifier: Apache-2.0
// Areas and centroids of faces from the edges of a cell, against the face cut by the planes of all
// seeds.
#include <algorithm>

#include "msq_test.h"
#include "random.h"
#include "structure/foam/walls/face_areas.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Seeds that enclose the cell, and more at random; of these pairs about `apart` from each other.
std::vector<Vec3> random_seeds(Random& random, double apart) {
  std::vector<Vec3> seeds = {{2.2, 0.1, 0.2}, {-2.2, 0.2, 0.1}, {0.1, 2.2, -0.1},
                             {0.2, -2.2, 0},  {-0.1, 0, 2.2},   {0, 0.1, -2.2}};
  for (uint64_t more = 4 + random.below(24); more > 0; --more) {
    const Vec3 p = random.in_box(Box3{}.grown(2));
    if (dot(p, p) < 0.09) continue;
    seeds.push_back(p);
    if (random.below(2) != 0) seeds.push_back(p + random.direction() * apart);
  }
  return seeds;
}

WallFace cut_face(const std::vector<Vec3>& seeds, Vec3 neighbour) {
  FacePolygon polygon;
  polygon.start({}, neighbour, 4);
  for (const Vec3& other : seeds)
    if (!(other == neighbour)) polygon.cut(other);
  return polygon.is_empty() ? WallFace() : polygon.face();
}

/// Of cells whose areas are known: that they are right. Returns how many these are of 100.
double known_share(double apart) {
  Random random(81);
  VoronoiCell cell;
  FaceAreas areas;
  const size_t count = test_count(4000);
  size_t walked = 0, known = 0;
  for (size_t n = 0; n < count; ++n) {
    const std::vector<Vec3> seeds = random_seeds(random, apart);
    cell.clear();
    for (const Vec3& seed : seeds) cell.add(seed);
    if (!cell.walk()) continue;
    ++walked;
    if (!areas.find(cell)) continue;
    ++known;
    for (size_t i = 0; i < seeds.size(); ++i) {
      const WallFace face = areas.face(i), expected = cut_face(seeds, seeds[i]);
      if (!(std::abs(face.area - expected.area) <= face_area_error))
        fail_msg("an area of %.12g, by cuts %.12g", face.area, expected.area);
      const double off = length(face.middle - expected.middle);
      if (face.area > 1e-5 && !(off <= centroid_error(face.area)))
        fail_msg("the centroid of a face of %.12g is off by %g", face.area, off);
    }
  }
  return 100.0 * static_cast<double>(known) / static_cast<double>(walked);
}

void test_areas(void**) {
  assert_true(known_share(0.3) > 70);
  // With seeds near to each other.
  for (const double apart : {1e-2, 1e-3, 1e-6}) known_share(apart);
}

void test_far_cells(void**) {
  VoronoiCell cell;
  FaceAreas areas;
  for (const double side : {2.3, 2.4}) {  // corners at 1.99 and 2.08
    cell.clear();
    for (const double sign : {-1.0, 1.0})
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 at;
        at[axis] = sign * side;
        cell.add(at);
      }
    assert_true(cell.walk());
    assert_int_equal(areas.find(cell), side < 2.35);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_areas), cmocka_unit_test(test_far_cells)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
