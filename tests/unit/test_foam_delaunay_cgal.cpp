// SPDX-License-Identifier: Apache-2.0
// Foams against a global Delaunay triangulation of 24^3 cells (CGAL): membership is the distance to
// the dual edges of the whole diagram, and the edges of EdgeBrick are those dual edges.
#include "foam_diagram.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/foam.h"
#include "structure/lattice/lattice.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr int half = 12, middle = 4;  // cells: of the triangulation, and of the part that is asked

double squared_distance(const DiagramEdge& edge, Vec3 p) {
  const Vec3 ab = edge.b - edge.a, ap = p - edge.a;
  const double l2 = dot(ab, ab);
  const double t = l2 > 0 ? std::clamp(dot(ap, ab) / l2, 0.0, 1.0) : 0;
  const Vec3 d = ap - ab * t;
  return dot(d, d);
}

/// Edges by the boxes of 1/2 that they come within the greatest radius of.
class EdgeGrid {
 public:
  EdgeGrid(const std::vector<DiagramEdge>& edges, double reach)
      : edges_(edges), bins_(size * size * size) {
    for (uint32_t e = 0; e < edges.size(); ++e) {
      const Vec3 low = min(edges[e].a, edges[e].b), high = max(edges[e].a, edges[e].b);
      int from[3], to[3];
      for (int axis = 0; axis < 3; ++axis) {
        from[axis] = static_cast<int>(std::max(0.0, std::floor(2 * (low[axis] - reach + middle))));
        to[axis] =
            static_cast<int>(std::min(size - 1.0, std::floor(2 * (high[axis] + reach + middle))));
      }
      for (int z = from[2]; z <= to[2]; ++z)
        for (int y = from[1]; y <= to[1]; ++y)
          for (int x = from[0]; x <= to[0]; ++x) bins_[(z * size + y) * size + x].push_back(e);
    }
  }
  double distance(Vec3 p) const {
    const auto bin = [](double v) { return static_cast<int>(2 * (v + middle)); };
    double least = 1e300;
    for (uint32_t e : bins_[(bin(p.z) * size + bin(p.y)) * size + bin(p.x)])
      least = std::min(least, squared_distance(edges_[e], p));
    return std::sqrt(least);
  }

 private:
  static constexpr int size = 4 * middle;
  const std::vector<DiagramEdge>& edges_;
  std::vector<std::vector<uint32_t>> bins_;
};

Ref<Context> context() {
  return make_ref<Context>(1u, uint64_t{0}, uint64_t{0});
}

struct Method {
  const char* name;
  FoamMethod method;
};

/// How many points a method is asked about: the paper's query takes 0.2 ms to some 10 ms a point,
/// and where struts are wide all but METHOD_2 have many triplets of seeds to try.
size_t share(FoamMethod method, double radius, size_t count) {
  if (method == FoamMethod::point)
    return count / (radius < 0.3 ? 2000 : radius < 0.9 ? 8000 : 20000);
  if (method == FoamMethod::method_2) return count / (radius < 0.5 ? 4 : 16);
  if (radius >= 0.9) return count / 200;
  return count / (radius >= 0.5 ? 25 : method == FoamMethod::direct ? 1 : 4);
}

/// Membership by every method is the distance to the edges of the whole diagram. The seeds that a
/// cell asks for follow from the radius: 2 cells about it up to 0.268, 3 beyond, if cells are
/// cubes.
void check_membership(double jitter, uint64_t seed, Vec3 cell_size,
                      const std::vector<double>& radii, double extent, size_t count) {
  const FoamSeeds seeds(seed, jitter, cell_size);  // the largest is 1
  const std::array<int, 3> cells = {static_cast<int>(half / cell_size.x),
                                    static_cast<int>(half / cell_size.y),
                                    static_cast<int>(half / cell_size.z)};
  const std::vector<DiagramEdge> edges = foam_diagram(seeds, cells);
  Neighbourhood neighbourhood;
  neighbourhood.cell_size = cell_size;
  Random random(seed);
  for (double radius : radii) {
    const EdgeGrid grid(edges, radius + 0.1);
    // Half of the points close to the boundary, if it is easily found; by wide struts that is where
    // seeds are.
    std::vector<Vec3> points;
    std::vector<double> distances;
    const size_t wanted = std::max(share(FoamMethod::direct, radius, count), count / 16);
    while (points.size() < wanted) {
      Vec3 p;
      double distance = 0;
      for (int tries = points.size() % 2 ? 5 : 1; tries > 0; --tries) {
        p = random.in_box(Box3{}.grown(extent));
        if (tries > 1 && radius >= 0.5) {
          const Neighbourhood::Located located = neighbourhood.locate(p);
          const Vec3 from_seed = (located.fraction * cell_size - seeds.at(located.cell, 0, 0, 0));
          p = p - from_seed * random.between(0.7, 1);
        }
        p = max(min(p, Vec3{1, 1, 1} * (extent - 1e-9)), Vec3{1, 1, 1} * -extent);
        distance = grid.distance(p);
        if (std::abs(distance - radius) <= 0.1) break;
      }
      points.push_back(p);
      distances.push_back(distance);
    }
    std::vector<Method> methods = {{"DIRECT", FoamMethod::direct},
                                   {"METHOD_1", FoamMethod::method_1},
                                   {"METHOD_2", FoamMethod::method_2},
                                   {"POINT", FoamMethod::point}};
    for (const auto& [name, method] : methods) {
      const Ref<Foam> foam =
          make_ref<Foam>(context(), neighbourhood, Parameter(radius), jitter, seed, method);
      const size_t asked =
          std::min(points.size(), std::max<size_t>(2, share(method, radius, count)));
      std::vector<uint8_t> alive(asked, 1);
      foam->keep_points(points.data(), alive.data(), asked);
      size_t held = 0, near = 0, differ = 0;
      for (size_t i = 0; i < asked; ++i) {
        held += alive[i];
        if (alive[i] == (distances[i] <= radius)) continue;
        if (std::abs(distances[i] - radius) <= 1e-9) {
          ++near;
          continue;
        }
        if (!differ++)
          print_error("(%.17g, %.17g, %.17g) is %.17g from an edge; %s: %d at radius %g\n",
                      points[i].x, points[i].y, points[i].z, distances[i], name, alive[i], radius);
      }
      print_message(
          "jitter %g, r %g, %s: %zu points, %zu inside, %zu differ within 1e-9, %zu elsewhere\n",
          jitter, radius, name, asked, held, near, differ);
      assert_int_equal(differ, 0);
    }
  }
}

void test_membership(void**) {
  check_membership(1, 2024, {1, 1, 1}, {0.1, 0.26, 0.3, 0.5, 0.9}, middle, test_count(120000));
}
void test_membership_half(void**) {
  check_membership(0.5, 31, {1, 1, 1}, {0.1, 0.3, 0.5}, 2, test_count(30000));
}
void test_membership_uneven(void**) {
  check_membership(1, 5, {1, 0.75, 0.5}, {0.1, 0.26, 0.3, 0.5}, 2, test_count(20000));
  check_membership(1, 6, {0.5, 1, 1}, {0.1, 0.5}, 2, test_count(30000));
}

/// Edges of the triangulation and of the bricks, by brick.
struct BuiltEdge {
  Vec3 a, b;
};
struct BrickEdges {
  std::vector<BuiltEdge> built;       // by the library, moved to the corner of cell 0
  std::vector<DiagramEdge> expected;  // dual to the triangulation
};

std::vector<BrickEdges> edges_by_brick(const FoamSeeds& seeds) {
  constexpr int bricks = 2 * 2 * middle / EdgeBrick::side;
  std::vector<BrickEdges> all(bricks * bricks * bricks);
  for (int z = 0; z < bricks; ++z)
    for (int y = 0; y < bricks; ++y)
      for (int x = 0; x < bricks; ++x) {
        const auto corner = [](int i) { return i * EdgeBrick::side - 2 * middle; };
        const CellIndex cell{corner(x), corner(y), corner(z)};
        const Vec3 shift{double(cell.x), double(cell.y), double(cell.z)};
        const EdgeBrick brick(seeds, cell);
        for (const FoamEdge& e : brick.edges())
          all[(z * bricks + y) * bricks + x].built.push_back(
              {shift + Vec3{e.a[0], e.a[1], e.a[2]}, shift + Vec3{e.b[0], e.b[1], e.b[2]}});
      }
  for (const DiagramEdge& e : foam_diagram(seeds, half)) {
    const int at[3] = {e.owner.x + 2 * middle, e.owner.y + 2 * middle, e.owner.z + 2 * middle};
    if (std::min({at[0], at[1], at[2]}) < 0 || std::max({at[0], at[1], at[2]}) >= 4 * middle)
      continue;
    all[(at[2] / EdgeBrick::side * bricks + at[1] / EdgeBrick::side) * bricks +
        at[0] / EdgeBrick::side]
        .expected.push_back(e);
  }
  return all;
}

void test_edges(void**) {
  size_t count = 0, missing = 0, extra = 0;
  double worst = 0;
  for (BrickEdges& brick : edges_by_brick(FoamSeeds(5, 1, {1, 1, 1}))) {
    count += brick.expected.size();
    std::vector<bool> used(brick.built.size());
    for (const DiagramEdge& e : brick.expected) {
      double best = 1e300;
      size_t at = 0;
      for (size_t i = 0; i < brick.built.size(); ++i) {
        if (used[i]) continue;
        const BuiltEdge& b = brick.built[i];
        const double d = std::min(std::max(max_magnitude(b.a - e.a), max_magnitude(b.b - e.b)),
                                  std::max(max_magnitude(b.a - e.b), max_magnitude(b.b - e.a)));
        if (d < best) best = d, at = i;
      }
      if (best > edge_error) {  // ends are single precision
        if (!missing++)
          print_error(
              "no edge from (%.12g, %.12g, %.12g) to (%.12g, %.12g, %.12g); nearest is %g off\n",
              e.a.x, e.a.y, e.a.z, e.b.x, e.b.y, e.b.z, best);
        continue;
      }
      worst = std::max(worst, best);
      used[at] = true;
    }
    for (bool is_used : used) extra += !is_used;
  }
  print_message("%zu edges, %zu missing, %zu extra, ends within %g\n", count, missing, extra,
                worst);
  assert_int_equal(missing, 0);
  assert_int_equal(extra, 0);
  assert_in_range(count, 50000, 60000);  // 13.5 a seed
}

void test_length(void**) {
  double built = 0, expected = 0;
  for (const BrickEdges& brick : edges_by_brick(FoamSeeds(5, 0.01, {1, 1, 1}))) {
    for (const BuiltEdge& e : brick.built) built += length(e.b - e.a);
    for (const DiagramEdge& e : brick.expected) expected += length(e.b - e.a);
  }
  print_message("jitter 0.01: length %.9f built, %.9f expected\n", built, expected);
  assert_true(std::abs(built - expected) <= 1e-6 * expected);
}

/// Without jitter the seeds are a cubic lattice's cell centres and the edges its struts.
void test_no_jitter(void**) {
  size_t near = 0, differ = 0;
  Random random(4);
  const size_t count = test_count(20000);
  for (double radius : {0.05, 0.25, 0.45}) {
    const Ref<Foam> foam = make_ref<Foam>(context(), Neighbourhood{}, Parameter(radius), 0.0,
                                          uint64_t{1}, FoamMethod::direct);
    const auto cubic = [&](double r) {
      return make_ref<Lattice>(Neighbourhood{}, cubic_unit_cell(), Parameter(r));
    };
    const auto lattice = cubic(radius), thinner = cubic(radius - 1e-9),
               thicker = cubic(radius + 1e-9);
    for (size_t i = 0; i < count; ++i) {
      Vec3 p = random.in_box(Box3{}.grown(5));
      if (i % 2)
        for (int axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * 20) / 20;
      if (foam->inside(p) == lattice->inside(p)) continue;
      if (!thinner->inside(p) && thicker->inside(p))
        ++near;
      else if (!differ++)
        print_error("(%.17g, %.17g, %.17g) differs at radius %g\n", p.x, p.y, p.z, radius);
    }
  }
  print_message("jitter 0: %zu points, %zu differ within 1e-9, %zu elsewhere\n", 3 * count, near,
                differ);
  assert_int_equal(differ, 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_membership),
                              cmocka_unit_test(test_membership_half),
                              cmocka_unit_test(test_membership_uneven),
                              cmocka_unit_test(test_edges),
                              cmocka_unit_test(test_length),
                              cmocka_unit_test(test_no_jitter)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
