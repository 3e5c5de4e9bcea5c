// SPDX-License-Identifier: Apache-2.0
// Stretched foams against a global Delaunay triangulation (CGAL) of seeds whose coordinates are
// divided by the stretch: edges and faces are its dual, multiplied by the stretch again. Distances
// from edges and from the polygons of faces are taken in model space.
#include <limits>

#include "foam_diagram.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/foam.h"
#include "structure/foam/walls/foam_walls.h"
#include "strut/segment.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  Vec3 stretch, cell_size;
  double jitter;
  uint64_t seed;
  bool is_turned;
};
const Row rows[] = {
    {{1, 1, 3}, {1, 1, 1}, 1, 21, false},        {{2, 0.5, 1}, {1, 1, 1}, 1, 22, true},
    {{1, 3, 1}, {1, 0.5, 0.75}, 0.5, 23, false}, {{1, 1, 16}, {1, 1, 1}, 1, 24, false},
    {{0.0625, 1, 1}, {1, 1, 1}, 1, 25, false},   {{5, 1, 0.4}, {2.5, 2.5, 2.5}, 1, 26, true},
    {{0.5, 1, 1}, {0.25, 1, 1}, 1, 27, false},
};

Neighbourhood grid_of(const Row& row) {
  if (!row.is_turned) return {{}, row.cell_size, {}};
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {{0.25, -0.5, 0.125}, row.cell_size, {{c, -s, 0, s, c, 0, 0, 0, 1}}};
}

Vec3 over(Vec3 a, Vec3 b) {
  return {a.x / b.x, a.y / b.y, a.z / b.z};
}

/// Half the cells of the box that is asked, along each axis.
constexpr double asked_half = 1;

double distance_squared(const Segment& edge, Vec3 p) {
  return edge.distance_squared(p);
}
Box3 box_of(const Segment& edge) {
  const Vec3 b = edge.a + edge.ab;
  return {min(edge.a, b), max(edge.a, b)};
}

/// Of a convex polygon.
double distance_squared(const std::vector<Vec3>& corners, Vec3 p) {
  const size_t count = corners.size();
  Vec3 normal;
  for (size_t i = 0; i < count; ++i)
    normal = normal + cross(corners[i] - corners[0], corners[(i + 1) % count] - corners[0]);
  bool is_above = dot(normal, normal) > 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < count; ++i) {
    const Vec3 a = corners[i], b = corners[(i + 1) % count];
    is_above = is_above && dot(cross(b - a, p - a), normal) >= 0;
    least = std::min(least, Segment(a, b).distance_squared(p));
  }
  if (!is_above) return least;
  const double along = dot(p - corners[0], normal);
  return along * along / dot(normal, normal);
}

Box3 box_of(const std::vector<Vec3>& corners) {
  Box3 box{corners[0], corners[0]};
  for (const Vec3& c : corners) box = {min(box.min, c), max(box.max, c)};
  return box;
}

/// The diagram about the origin of the grid, in model units along its axes.
struct Diagram {
  std::vector<Segment> edges;
  std::vector<std::vector<Vec3>> faces;
};

Diagram diagram_of(const Row& row) {
  // The sphere about a vertex reaches at most the diagonal of a cell, in the space of the diagram.
  const Vec3 sides = over(row.cell_size, row.stretch);
  const FoamSeeds seeds(row.seed, row.jitter, {1, 1, 1});
  int half[3];
  for (int axis = 0; axis < 3; ++axis)
    half[axis] = static_cast<int>(std::ceil(asked_half + 2 + 2.5 * length(sides) / sides[axis]));
  std::vector<Vec3> points;
  for (int z = -half[2]; z < half[2]; ++z)
    for (int y = -half[1]; y < half[1]; ++y)
      for (int x = -half[0]; x < half[0]; ++x)
        points.push_back(over(seeds.at({}, x, y, z) * row.cell_size, row.stretch));
  // Of what comes within two cells of the box that is asked.
  const Vec3 most = row.cell_size * (asked_half + 2);
  const auto is_near = [&](const auto& part) {
    return box_of(part).overlaps(Box3{most * -1.0, most});
  };
  Diagram diagram;
  for (const DualEdge& e : dual_edges(points)) {
    const Segment edge(e.a * row.stretch, e.b * row.stretch);
    if (is_near(edge)) diagram.edges.push_back(edge);
  }
  for (std::vector<Vec3>& face : dual_faces(points)) {
    for (Vec3& corner : face) corner = corner * row.stretch;
    if (is_near(face)) diagram.faces.push_back(face);
  }
  return diagram;
}

/// Edges or faces, by boxes of the space that is asked.
template <class Part>
class Parts {
 public:
  Parts(const std::vector<Part>& parts, Vec3 half)
      : parts_(parts),
        reach_(0.5 * max_component(half)),
        half_(half),
        bins_(static_cast<size_t>(side * side * side)) {
    for (uint32_t i = 0; i < parts.size(); ++i) {
      const Box3 box = box_of(parts[i]).grown(reach_);
      int from[3], to[3];
      for (int axis = 0; axis < 3; ++axis) {
        from[axis] = std::max(0, bin(box.min[axis], axis));
        to[axis] = std::min(side - 1, bin(box.max[axis], axis));
      }
      for (int z = from[2]; z <= to[2]; ++z)
        for (int y = from[1]; y <= to[1]; ++y)
          for (int x = from[0]; x <= to[0]; ++x) at(x, y, z).push_back(i);
    }
  }

  double distance(Vec3 p) const {
    double least = std::numeric_limits<double>::infinity();
    const auto bin_of = [&](int axis) { return std::clamp(bin(p[axis], axis), 0, side - 1); };
    for (const uint32_t i :
         bins_[static_cast<size_t>((bin_of(2) * side + bin_of(1)) * side + bin_of(0))])
      least = std::min(least, distance_squared(parts_[i], p));
    if (least > reach_ * reach_)
      for (const Part& part : parts_) least = std::min(least, distance_squared(part, p));
    return std::sqrt(least);
  }

 private:
  static constexpr int side = 8;
  int bin(double x, int axis) const {
    const double place = std::floor((x + half_[axis]) / (2 * half_[axis]) * side);
    return static_cast<int>(std::clamp(place, -1.0, double(side)));
  }
  std::vector<uint32_t>& at(int x, int y, int z) {
    return bins_[static_cast<size_t>((z * side + y) * side + x)];
  }

  const std::vector<Part>& parts_;
  const double reach_;
  const Vec3 half_;
  std::vector<std::vector<uint32_t>> bins_;
};

/// Points, and their distances from the diagram.
struct Asked {
  std::vector<Vec3> points;
  std::vector<double> distances;
  size_t near = 0, held = 0;
};

/// Membership, onset and distance of a structure that holds the points within `reach` of the
/// diagram; an onset is `onsets` distances.
void check(const Row& row, const char* what, const Structure& structure, const Asked& asked,
           double reach, double onsets, size_t& points) {
  const double near = 3e-8 * max_component(row.cell_size);
  std::vector<uint8_t> alive(asked.points.size(), 1);
  structure.keep_points(asked.points.data(), alive.data(), asked.points.size());
  size_t held = 0, differ = 0, close = 0;
  for (size_t i = 0; i < asked.points.size(); ++i) {
    const Vec3 p = asked.points[i];
    const double wanted = asked.distances[i];
    held += alive[i];
    close += std::abs(wanted - reach) <= near;
    if ((alive[i] != (wanted <= reach) && std::abs(wanted - reach) > near) ||
        (i % 16 == 0 && structure.inside(p) != (alive[i] != 0)))
      if (!differ++)
        print_error("(%.17g, %.17g, %.17g) is %.17g from %s: %d\n", p.x, p.y, p.z, wanted, what,
                    alive[i]);
    if (i % 16) continue;
    const double onset = structure.onset(p);
    if (!(std::abs(onset - onsets * wanted) <= near))
      fail_msg("onset %.17g at (%.17g, %.17g, %.17g), not %.17g", onset, p.x, p.y, p.z,
               onsets * wanted);
    // Inside, it is a bound.
    const double d = structure.distance(p);
    if (wanted > reach ? std::abs(d - (wanted - reach)) > 2 * near : d > 2 * near)
      fail_msg("distance %.17g at (%.17g, %.17g, %.17g), not %.17g", d, p.x, p.y, p.z,
               wanted - reach);
  }
  points += asked.points.size();
  print_message("stretch %g %g %g, %s: %zu points, %zu inside, %zu close, %zu wrong\n",
                row.stretch.x, row.stretch.y, row.stretch.z, what, asked.points.size(), held, close,
                differ);
  assert_int_equal(differ, 0);
  assert_true(held > 0 && held < asked.points.size());
  assert_true(close * 100 < asked.points.size());
}

template <class Part>
Asked ask(const Row& row, const std::vector<Part>& of, double reach, size_t count) {
  const Parts<Part> parts(of, row.cell_size * asked_half);
  const Neighbourhood grid = grid_of(row);
  Random random(row.seed);
  Asked asked;
  while (asked.points.size() < count) {
    Vec3 g;
    double distance = 0;
    // Half of them near the boundary.
    for (int tries = asked.points.size() % 2 ? 4 : 1; tries > 0; --tries) {
      g = random.in_box(Box3{row.cell_size * -asked_half, row.cell_size * asked_half});
      distance = parts.distance(g);
      if (std::abs(distance - reach) <= 0.3 * reach) break;
    }
    asked.points.push_back(grid.from_grid(g));
    asked.distances.push_back(distance);
  }
  return asked;
}

void test_diagram(void**) {
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  size_t points = 0;
  for (const Row& row : rows) {
    const Diagram diagram = diagram_of(row);
    const Neighbourhood grid = grid_of(row);
    const double size = min_component(row.cell_size);
    const size_t count = test_count(5500);
    for (const double part : {0.05, 0.2}) {
      const double radius = part * size;
      const Ref<const Structure> foam =
          make_ref<Foam>(context, grid, Parameter(radius), row.jitter, row.seed, FoamMethod::direct,
                         Parameter(1), row.stretch);
      check(row, "edges", *foam, ask(row, diagram.edges, radius, count), radius, 1, points);
    }
    const double thickness = 0.1 * size;
    const Ref<const Structure> walls =
        make_ref<FoamWalls>(context, grid, Parameter(thickness), row.jitter, row.seed, Parameter(1),
                            Parameter(0), row.stretch);
    check(row, "faces", *walls, ask(row, diagram.faces, 0.5 * thickness, count), 0.5 * thickness, 2,
          points);
  }
  print_message("%zu points\n", points);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_diagram)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
