// SPDX-License-Identifier: Apache-2.0
// Voronoi cells and edges against voro++ 0.4.6, in a fixed box and in boxes at random places with
// random seeds, jitters and cell sizes. Built only where voro++ is found.
//
// voro++ is given the seeds of the box and of all cells within twice the empty radius of it, so
// that the cells of the box are those of the unbounded foam.
#include <algorithm>
#include <array>
#include <map>
#include <vector>
#include <voro++/voro++.hh>

#include "msq_test.h"
#include "random.h"
#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/edges/voronoi_cell.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr int box_cells = EdgeBrick::side;

struct Segment {
  Vec3 a, b;
};

double apart(const Segment& l, const Segment& r) {
  return std::min(std::max(max_magnitude(l.a - r.a), max_magnitude(l.b - r.b)),
                  std::max(max_magnitude(l.a - r.b), max_magnitude(l.b - r.a)));
}

/// What voro++ says of a box: the edges of each seed's cell, and of the whole, once.
struct Expected {
  std::vector<Vec3> seeds;                    // of the box and around it
  std::vector<std::vector<Segment>> cells;    // of the box, in the order of cells
  std::vector<int> numbers;                   // of their seeds
  std::map<std::array<int, 3>, Segment> all;  // by seeds, ascending; the first is the box's
};

Expected ask_voropp(const FoamSeeds& foam, CellIndex corner) {
  Expected expected;
  const Vec3 scale = foam.scale();
  int halo[3];
  Vec3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    halo[axis] = static_cast<int>(std::ceil(2 * foam.empty_radius() / scale[axis]));
    low[axis] = -halo[axis] * scale[axis];
    high[axis] = (box_cells + halo[axis]) * scale[axis];
  }
  voro::container box(low.x, high.x, low.y, high.y, low.z, high.z, 6, 6, 6, false, false, false, 8);
  std::vector<bool> is_ours;
  for (int z = -halo[2]; z < box_cells + halo[2]; ++z)
    for (int y = -halo[1]; y < box_cells + halo[1]; ++y)
      for (int x = -halo[0]; x < box_cells + halo[0]; ++x) {
        const Vec3 p = foam.at(corner, x, y, z);
        const int number = static_cast<int>(expected.seeds.size());
        expected.seeds.push_back(p);
        is_ours.push_back(std::min({x, y, z}) >= 0 && std::max({x, y, z}) < box_cells);
        if (is_ours.back()) expected.numbers.push_back(number);
        box.put(number, p.x, p.y, p.z);
      }
  std::map<int, std::vector<Segment>> cells;
  voro::voronoicell_neighbor cell;
  voro::c_loop_all loop(box);
  if (loop.start()) do {
      const int number = loop.pid();
      if (!is_ours[static_cast<size_t>(number)] || !box.compute_cell(cell, loop)) continue;
      const Vec3 seed = expected.seeds[static_cast<size_t>(number)];
      std::vector<int> neighbours, corners;
      std::vector<double> vertices;
      cell.neighbors(neighbours);
      cell.face_vertices(corners);
      cell.vertices(vertices);
      const auto vertex = [&](int i) {
        const size_t v = 3 * static_cast<size_t>(i);
        return seed + Vec3{vertices[v], vertices[v + 1], vertices[v + 2]};
      };
      // Each edge of the cell is in two of its faces, once each way.
      std::map<std::pair<int, int>, std::vector<int>> faces_of;
      size_t at = 0;
      for (int neighbour : neighbours) {
        const int count = corners[at++];
        for (int i = 0; i < count; ++i) {
          const int from = corners[at + static_cast<size_t>(i)],
                    to = corners[at + static_cast<size_t>((i + 1) % count)];
          faces_of[std::minmax(from, to)].push_back(neighbour);
        }
        at += static_cast<size_t>(count);
      }
      for (const auto& [ends, faces] : faces_of) {
        assert_int_equal(faces.size(), 2);
        const Segment segment{vertex(ends.first), vertex(ends.second)};
        cells[number].push_back(segment);
        std::array<int, 3> triple = {number, faces[0], faces[1]};
        std::sort(triple.begin(), triple.end());
        if (triple[0] == number) expected.all.insert({triple, segment});
      }
    } while (loop.inc());
  for (int number : expected.numbers) expected.cells.push_back(cells[number]);
  return expected;
}

struct Outcome {
  size_t cells = 0, edges = 0, wrong = 0;
  double worst_cell = 0, worst_brick = 0;
};

/// The largest distance from an edge to the like one; edges that have none within `most` are wrong.
double match(const std::vector<Segment>& wanted, const std::vector<Segment>& got, double most,
             size_t& wrong) {
  double worst = 0;
  std::vector<bool> used(got.size());
  for (const Segment& w : wanted) {
    double best = 1e300;
    size_t at = 0;
    for (size_t i = 0; i < got.size(); ++i)
      if (!used[i] && apart(w, got[i]) < best) best = apart(w, got[i]), at = i;
    if (best > most) {
      if (!wrong++) print_error("an edge is %g off\n", best);
      continue;
    }
    used[at] = true;
    worst = std::max(worst, best);
  }
  return worst;
}

void compare(const FoamSeeds& foam, CellIndex corner, Outcome& outcome) {
  const Expected expected = ask_voropp(foam, corner);
  // Cells in double precision, each from the seeds within twice its farthest vertex.
  VoronoiCell cell;
  for (size_t n = 0; n < expected.numbers.size(); ++n) {
    const Vec3 own = expected.seeds[static_cast<size_t>(expected.numbers[n])];
    bool is_whole = false;
    for (double reach = 1; !is_whole; reach *= 1.3) {
      cell.clear();
      for (const Vec3& seed : expected.seeds) {
        const Vec3 d = seed - own;
        if (d == Vec3{} || dot(d, d) > reach) continue;
        assert_true(cell.count() < VoronoiCell::max_planes);
        cell.add(d);
      }
      is_whole = cell.walk() && 4 * cell.radius_squared() * (1 + 1e-9) <= reach;
    }
    std::vector<Segment> got;
    cell.for_each_edge(0, [&](size_t a, size_t b, uint32_t, uint32_t) {
      got.push_back({own + cell.vertex(a), own + cell.vertex(b)});
    });
    if (got.size() != expected.cells[n].size() && !outcome.wrong++)
      print_error("a cell has %zu edges, %zu by voro++\n", got.size(), expected.cells[n].size());
    outcome.worst_cell =
        std::max(outcome.worst_cell, match(expected.cells[n], got, 1e-9, outcome.wrong));
    ++outcome.cells;
  }
  // Edges of the brick.
  std::vector<Segment> wanted, got;
  for (const auto& [seeds, segment] : expected.all) wanted.push_back(segment);
  const EdgeBrick brick(foam, corner);
  for (const FoamEdge& e : brick.edges())
    got.push_back({{e.a[0], e.a[1], e.a[2]}, {e.b[0], e.b[1], e.b[2]}});
  if (wanted.size() != got.size() && !outcome.wrong++)
    print_error("a brick has %zu edges, %zu by voro++\n", got.size(), wanted.size());
  outcome.worst_brick =
      std::max(outcome.worst_brick, match(wanted, got, edge_error, outcome.wrong));
  outcome.edges += got.size();
}

void report(const char* name, const Outcome& outcome) {
  print_message(
      "%s: %zu cells, %zu edges, %zu wrong; ends of cells within %g, of bricks within %g\n", name,
      outcome.cells, outcome.edges, outcome.wrong, outcome.worst_cell, outcome.worst_brick);
  assert_int_equal(outcome.wrong, 0);
}

void test_fixed_box(void**) {
  Outcome outcome;
  const FoamSeeds foam(1, 1, {1, 1, 1});
  const int bricks = test_scale() < 0.5 ? 1 : 3;
  for (int z = 0; z < bricks; ++z)
    for (int y = 0; y < bricks; ++y)
      for (int x = 0; x < bricks; ++x)
        compare(foam, {(x - 1) * box_cells, (y - 1) * box_cells, (z - 1) * box_cells}, outcome);
  report("fixed box", outcome);
}

void test_random_boxes(void**) {
  Outcome outcome;
  Random random(11);
  for (size_t n = test_count(40); n > 0; --n) {
    Vec3 scale{random.between(0.25, 1), random.between(0.25, 1), random.between(0.25, 1)};
    scale[static_cast<int>(random.below(3))] = 1;
    if (n % 3 == 0) scale = {1, 1, 1};
    const FoamSeeds foam(random.bits(), random.between(0.1, 1), scale);
    const auto place = [&] { return static_cast<int32_t>(random.below(2000000)) - 1000000; };
    compare(foam, {place(), place(), place()}, outcome);
  }
  report("random boxes", outcome);
}

/// More seeds about a cell than VoronoiCell has room for.
void test_flat_cells(void**) {
  Outcome outcome;
  Random random(12);
  for (const Vec3 scale : {Vec3{1, 1, 0.25}, Vec3{1, 0.25, 0.25}, Vec3{0.25, 1, 0.5}})
    for (double jitter : {1.0, 0.1}) compare({random.bits(), jitter, scale}, {7, -3, 1}, outcome);
  report("flat cells", outcome);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_fixed_box), cmocka_unit_test(test_random_boxes),
                              cmocka_unit_test(test_flat_cells)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
