// SPDX-License-Identifier: Apache-2.0
// Voronoi cells cut from a cube, against all triples of planes: the same vertices, and of each the
// three planes that it lies on. Seeds at random, close together on a sphere, and on a lattice,
// where more than three planes meet in a vertex.
#include "structure/foam/edges/clipped_cell.h"

#include <cmath>

#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Neighbour {
  Vec3 position;
  double distance_squared;
};

std::vector<Neighbour> sorted(const std::vector<Vec3>& positions) {
  std::vector<Neighbour> neighbours;
  for (const Vec3 p : positions) neighbours.push_back({p, dot(p, p)});
  std::sort(neighbours.begin(), neighbours.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.distance_squared < b.distance_squared;
  });
  return neighbours;
}

struct HalfSpace {
  Vec3 normal;
  double offset;
  double beyond(Vec3 p) const { return (dot(normal, p) - offset) / length(normal); }
};

std::vector<HalfSpace> half_spaces(const std::vector<Neighbour>& neighbours, double half_width) {
  std::vector<HalfSpace> all;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      Vec3 normal;
      normal[axis] = sign;
      all.push_back({normal, half_width});
    }
  for (const Neighbour& n : neighbours) all.push_back({n.position, 0.5 * n.distance_squared});
  return all;
}

/// Corners of the intersection of all half spaces.
std::vector<Vec3> corners(const std::vector<HalfSpace>& all, double slack) {
  std::vector<Vec3> found;
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t j = i + 1; j < all.size(); ++j)
      for (size_t k = j + 1; k < all.size(); ++k) {
        const Vec3 jk = cross(all[j].normal, all[k].normal);
        const double det = dot(all[i].normal, jk);
        if (std::abs(det) < 1e-9) continue;
        const Vec3 p = (jk * all[i].offset + cross(all[k].normal, all[i].normal) * all[j].offset +
                        cross(all[i].normal, all[j].normal) * all[k].offset) *
                       (1 / det);
        bool is_in = true;
        for (const HalfSpace& h : all) is_in = is_in && h.beyond(p) < slack;
        if (is_in) found.push_back(p);
      }
  return found;
}

double distance_to(const std::vector<Vec3>& points, Vec3 p) {
  double least = 1e300;
  for (const Vec3 q : points) least = std::min(least, length(q - p));
  return least;
}

void check(const std::vector<Vec3>& positions, double half_width, double within) {
  const std::vector<Neighbour> neighbours = sorted(positions);
  ClippedCell cell;
  if (!cell.cut_by(neighbours, half_width, 3 * half_width * half_width))
    fail_msg("no cell of %zu neighbours", positions.size());
  const std::vector<HalfSpace> all = half_spaces(neighbours, half_width);
  const std::vector<Vec3> wanted = corners(all, within);
  std::vector<Vec3> found;
  for (const ClippedCell::Vertex& v : cell.vertices()) {
    if (!v.is_there) continue;
    found.push_back(v.position);
    for (int i = 0; i < 3; ++i) {
      assert_true(std::abs(all[v.plane[i]].beyond(v.position)) < within);
      // The way to a neighbouring vertex and back, along the same two planes.
      const ClippedCell::Vertex& next = cell.vertices()[v.next[i]];
      assert_true(next.is_there);
      bool is_joined = false;
      for (int k = 0; k < 3; ++k)
        is_joined = is_joined ||
                    (next.plane[k] == v.plane[(i + 1) % 3] &&
                     next.plane[(k + 1) % 3] == v.plane[i] && &cell.vertices()[next.next[k]] == &v);
      assert_true(is_joined);
    }
    assert_true(distance_to(wanted, v.position) < 100 * within);
  }
  for (const Vec3 p : wanted) assert_true(distance_to(found, p) < 100 * within);
  // Each edge between planes of neighbours once.
  size_t edges = 0;
  cell.for_each_edge([](uint32_t) { return true; }, [&](Vec3, Vec3) { ++edges; });
  assert_int_equal(2 * edges, 3 * found.size());
}

Vec3 on_sphere(Random& random) {
  for (;;) {
    const Vec3 p = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    if (const double l = length(p); l > 0.1 && l < 1) return p * (1 / l);
  }
}

void test_random_seeds(void**) {
  Random random(9);
  for (size_t n = test_count(60) + 4; n > 0; --n) {
    std::vector<Vec3> seeds;
    for (uint64_t i = 1 + random.below(40); i > 0; --i)
      seeds.push_back(random.in_box({{-2, -2, -2}, {2, 2, 2}}));
    check(seeds, 1, 1e-10);
  }
}

void test_seeds_on_a_sphere(void**) {
  Random random(10);
  for (size_t n = test_count(12) + 2; n > 0; --n) {
    std::vector<Vec3> seeds;
    for (int i = 0; i < 50; ++i) seeds.push_back(on_sphere(random));
    check(seeds, 1, 1e-9);
  }
}

void test_seeds_on_a_lattice(void**) {
  // Vertices where four planes meet and more: the polytope stays simple.
  for (const bool is_centred : {false, true}) {
    std::vector<Vec3> seeds;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        for (int k = -2; k <= 2; ++k) {
          if (is_centred && (i + j + k) % 2 != 0) continue;
          const Vec3 p{0.5 * i, 0.5 * j, 0.5 * k};
          if (dot(p, p) > 0 && dot(p, p) < 0.8) seeds.push_back(p);
        }
    check(seeds, 1, 1e-9);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_random_seeds),
                              cmocka_unit_test(test_seeds_on_a_sphere),
                              cmocka_unit_test(test_seeds_on_a_lattice)};
  return cmocka_run_group_tests_name("clipped_cell", tests, nullptr, nullptr);
}
