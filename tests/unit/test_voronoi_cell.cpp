// SPDX-License-Identifier: Apache-2.0
// The walk over a Voronoi cell against brute force: every triple of planes is a vertex if no other
// plane cuts it off, every pair with two vertices an edge.
#include <map>
#include <utility>

#include "msq_test.h"
#include "random.h"
#include "structure/foam/edges/voronoi_cell.h"

using namespace msq;
using namespace msq::test;

namespace {

struct BruteCell {
  std::vector<std::pair<Vec3, Vec3>> edges;
  double radius_squared = 0;
  bool is_simple = true;
};

/// Edges between planes numbered `first` or later.
BruteCell brute_force(const std::vector<Vec3>& seeds, size_t first) {
  BruteCell cell;
  std::map<std::pair<size_t, size_t>, std::vector<Vec3>> ends;
  const auto offset = [&](size_t i) { return 0.5 * dot(seeds[i], seeds[i]); };
  for (size_t a = 0; a < seeds.size(); ++a)
    for (size_t b = a + 1; b < seeds.size(); ++b)
      for (size_t c = b + 1; c < seeds.size(); ++c) {
        const Vec3 bc = cross(seeds[b], seeds[c]);
        const double det = dot(seeds[a], bc);
        if (std::abs(det) < 1e-12) continue;
        const Vec3 p = (bc * offset(a) + cross(seeds[c], seeds[a]) * offset(b) +
                        cross(seeds[a], seeds[b]) * offset(c)) *
                       (1 / det);
        bool is_vertex = true;
        for (size_t i = 0; i < seeds.size() && is_vertex; ++i) {
          const double room = offset(i) - dot(seeds[i], p);
          is_vertex = i == a || i == b || i == c || room >= 0;
          if (i != a && i != b && i != c && std::abs(room) < 1e-9) cell.is_simple = false;
        }
        if (!is_vertex) continue;
        cell.radius_squared = std::max(cell.radius_squared, dot(p, p));
        ends[{a, b}].push_back(p);
        ends[{b, c}].push_back(p);
        ends[{a, c}].push_back(p);
      }
  for (const auto& [pair, points] : ends) {
    if (points.size() != 2) cell.is_simple = false;
    if (points.size() == 2 && pair.first >= first) cell.edges.push_back({points[0], points[1]});
  }
  return cell;
}

double apart(const std::pair<Vec3, Vec3>& l, const std::pair<Vec3, Vec3>& r) {
  return std::min(std::max(max_magnitude(l.first - r.first), max_magnitude(l.second - r.second)),
                  std::max(max_magnitude(l.first - r.second), max_magnitude(l.second - r.first)));
}

void test_random_cells(void**) {
  Random random(9);
  VoronoiCell cell;
  size_t edges = 0, walked = 0, skipped = 0, resumed = 0, anew = 0;
  const size_t count = test_count(1500);
  for (size_t n = 0; n < count; ++n) {
    // Seeds that enclose the cell, and more at random.
    std::vector<Vec3> seeds = {{3, 0.1, 0.2}, {-3, 0.2, 0.1}, {0.1, 3, -0.1},
                               {0.2, -3, 0},  {-0.1, 0, 3},   {0, 0.1, -3}};
    for (size_t more = random.below(n % 10 ? 20 : 60); more > 0; --more) {
      const Vec3 p = random.in_box(Box3{}.grown(2));
      if (dot(p, p) > 0.09) seeds.push_back(p);
    }
    const size_t first = n % 2 ? 0 : random.below(seeds.size());
    const BruteCell expected = brute_force(seeds, first);
    if (!expected.is_simple) {
      ++skipped;
      continue;
    }
    cell.clear();
    for (Vec3 seed : seeds) cell.add(seed);
    assert_int_equal(cell.count(), seeds.size());
    assert_true(cell.walk());
    ++walked;
    assert_true(std::abs(cell.radius_squared() - expected.radius_squared) <=
                1e-5 * expected.radius_squared);
    std::vector<std::pair<Vec3, Vec3>> got;
    cell.for_each_edge(static_cast<uint32_t>(first),
                       [&](size_t from, size_t to, uint32_t, uint32_t) {
                         got.push_back({cell.vertex(from), cell.vertex(to)});
                       });
    assert_int_equal(got.size(), expected.edges.size());
    for (const auto& e : expected.edges) {
      double best = 1e300;
      for (const auto& g : got) best = std::min(best, apart(e, g));
      if (!(best <= 1e-6))
        fail_msg("cell %d of %d seeds: an edge is %g off", int(n), int(seeds.size()), best);
    }
    edges += got.size();

    // The same cell from some of its vertices.
    struct Known {
      uint8_t plane[3];
      Vec3 position;
    };
    std::vector<Known> known;
    const size_t vertices = cell.vertex_count();
    cell.for_each_new_vertex([&](const uint8_t* plane, Vec3 p) {
      if (random.below(3) == 0) known.push_back({{plane[0], plane[1], plane[2]}, p});
    });
    cell.clear();
    for (Vec3 seed : seeds) cell.add(seed);
    for (const Known& k : known)
      assert_true(cell.add_vertex(k.plane[0], k.plane[1], k.plane[2], k.position));
    assert_true(cell.walk());
    assert_int_equal(cell.vertex_count(), vertices);
    anew += cell.found_anew();
    for (size_t v = 0; v < known.size() && !cell.found_anew(); ++v)
      assert_true(cell.vertex(v) == known[v].position);
    size_t found = 0, again = 0;
    cell.for_each_new_vertex([&](const uint8_t*, Vec3) { ++found; });
    if (found > 0) resumed += known.size();  // 0: found anew in double precision
    cell.for_each_edge(static_cast<uint32_t>(first),
                       [&](size_t from, size_t to, uint32_t, uint32_t) {
                         const std::pair<Vec3, Vec3> edge{cell.vertex(from), cell.vertex(to)};
                         double best = 1e300;
                         for (const auto& g : got) best = std::min(best, apart(edge, g));
                         again += best <= 1e-9;
                       });
    assert_int_equal(again, got.size());
  }
  assert_true(resumed > edges / 9);
  assert_true(anew <= walked / 100);
  print_message("%zu cells, %zu edges; %zu degenerate cells left out\n", walked, edges, skipped);
  assert_true(walked > count * 9 / 10);
}

void test_failures(void**) {
  VoronoiCell cell;
  cell.clear();
  assert_false(cell.walk());  // no planes
  for (Vec3 v : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) cell.add(v);
  assert_false(cell.walk());
  cell.add({1, 1, 1});
  assert_false(cell.walk());  // not bounded
  // A cube's neighbours and those over its edges and corners: many planes in a vertex.
  cell.clear();
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (x || y || z) cell.add({double(x), double(y), double(z)});
  cell.walk();  // may fail, must end
  // It works on after failures.
  cell.clear();
  for (Vec3 v : {Vec3{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}) cell.add(v);
  assert_true(cell.walk());
  size_t edges = 0;
  cell.for_each_edge(0, [&](size_t, size_t, uint32_t, uint32_t) { ++edges; });
  assert_int_equal(edges, 6);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_random_cells), cmocka_unit_test(test_failures)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
