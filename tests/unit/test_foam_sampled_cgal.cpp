// SPDX-License-Identifier: Apache-2.0
// Foams in the cells of a sampled map, against a global Delaunay triangulation (CGAL) of their
// seeds: one in each cell whose place is among the samples, and one in each box that has no other.
// The bounds on the distance to a seed, and how many seeds there are.
#include <cmath>
#include <set>
#include <tuple>

#include "sampled_maps.h"
#include "shelled_check.h"
#include "structure/common/box_shell.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeds/sampled_seeds.h"
#include "structure/foam/shell/shelled_foam.h"
#include "structure/foam/walls/foam_walls.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr uint64_t sample_count[3] = {13, 11, 9};
const Vec3 spacing{0.5, 0.55, 0.6};

struct Row {
  const char* name;
  double jitter;
  uint64_t seed;
  bool is_turned;
  /// The coordinates in cells of a place among the samples.
  Vec3 (*cells)(Vec3 g);
};
const Row rows[] = {
    {"cubes", 1, 61, false,
     [](Vec3 g) {
       return Vec3{g.x - 0.3, g.y + 0.2, g.z};
     }},
    {"bent", 1, 62, true,
     [](Vec3 g) {
       return Vec3{g.x + 0.3 * g.y + 0.1 * std::sin(1.5 * g.z),
                   1.1 * g.y + 0.12 * std::sin(1.3 * g.x) + 0.03 * g.x * g.z,
                   0.9 * g.z - 0.1 * g.x + 0.04 * g.y * g.y};
     }},
    {"part of a ring", 1, 63, false,
     [](Vec3 g) {
       const double x = g.x + 4, y = g.y - 2.75;
       return Vec3{std::hypot(x, y) * 1.2, 8 * std::atan2(y, x), g.z};
     }},
    {"larger along x", 0.6, 64, true,
     [](Vec3 g) {
       return Vec3{3 * std::log(g.x + 1.5), g.y, g.z};
     }},
    {"flat", 1, 65, false,
     [](Vec3 g) {
       return Vec3{0.6 * g.x, 0.7 * g.y, 2.1 * g.z};
     }},
    {"reflected", 0.1, 66, true,
     [](Vec3 g) {
       return Vec3{0.9 * g.y, 1.1 * g.x, g.z + 0.2 * g.x};
     }},
    {"few cells", 1, 67, false,
     [](Vec3 g) {
       return Vec3{0.3 * g.x, 0.3 * g.y, 0.3 * g.z};
     }},
};

ImageFrame frame_of(const Row& row) {
  if (!row.is_turned) return {{-1, 2, 0.5}, spacing, {}};
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {{0.25, -0.5, 0.125}, spacing, {{c, 0, s, 0, 1, 0, -s, 0, c}}};
}

std::shared_ptr<const SampledMap> map_of(const Row& row) {
  const auto [nx, ny, nz] = sample_count;
  std::vector<double> values[3];
  for (uint64_t k = 0; k < nz; ++k)
    for (uint64_t j = 0; j < ny; ++j)
      for (uint64_t i = 0; i < nx; ++i) {
        const Vec3 cells = row.cells(
            Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)} * spacing);
        for (int axis = 0; axis < 3; ++axis) values[axis].push_back(cells[axis]);
      }
  return make_map(frame_of(row), {nx, ny, nz}, values);
}

Vec3 half_of() {
  return Vec3{sample_count[0] - 1.0, sample_count[1] - 1.0, sample_count[2] - 1.0} * spacing * 0.5;
}

/// About the middle of the samples.
Diagram diagram_of(const Row& row, const SampledMap& map, double side) {
  const FoamSeeds cells(row.seed, row.jitter, {1, 1, 1}),
      own(row.seed ^ border_stream, 1, {1, 1, 1});
  const Vec3 half = half_of();
  using Box = std::tuple<int, int, int>;
  std::set<Box> filled;
  std::vector<Vec3> points;
  const auto whole = [](double value) { return static_cast<int>(std::floor(value)); };
  const auto range = [&](int axis, bool is_last) {
    return whole(is_last ? map.range(axis).high : map.range(axis).low);
  };
  SampledMap::SearchCost cost(1);
  for (int k = range(2, false); k <= range(2, true); ++k)
    for (int j = range(1, false); j <= range(1, true); ++j)
      for (int i = range(0, false); i <= range(0, true); ++i) {
        Vec3 g;
        if (!map.find(cells.at({}, i, j, k), g, cost)) continue;
        points.push_back(g - half);
        filled.insert({whole(g.x / side), whole(g.y / side), whole(g.z / side)});
      }
  const size_t mapped = points.size();
  constexpr int margin = 5;
  const auto last = [&](int axis) { return whole(2 * half[axis] / side) + margin; };
  for (int z = -margin; z <= last(2); ++z)
    for (int y = -margin; y <= last(1); ++y)
      for (int x = -margin; x <= last(0); ++x)
        if (!filled.count({x, y, z})) points.push_back(own.at({}, x, y, z) * side - half);
  const Vec3 most = half * 1.1 + Vec3{side, side, side} * 1.5;
  const Diagram diagram = diagram_among(points, most);
  print_message("%s: %zu seeds of cells in boxes of %g, %zu others\n", row.name, mapped, side,
                points.size() - mapped);
  return diagram;
}

void test_diagram(void**) {
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  for (const Row& row : rows) {
    const std::shared_ptr<const SampledMap> map = map_of(row);
    const std::shared_ptr<const PlacedSeeds> placed =
        std::make_shared<const SampledSeeds>(*context, map, row.jitter, row.seed);
    const auto shell = std::make_shared<const BoxShell>(map);
    const Neighbourhood grid = placed->grid();
    const Diagram diagram = diagram_of(row, *map, grid.cell_size.x);
    Neighbourhood frame = grid;
    frame.origin = grid.from_grid(half_of());
    const double size = min_component(placed->smallest().cell_size);
    const size_t count = test_count(4000);
    const Vec3 half = half_of() * 1.1;
    const double near = 3e-8 * max_component(grid.cell_size);
    const auto beyond = [&](Vec3 p) {
      const Vec3 g = frame.to_grid(p);
      return max_component(max(g, g * -1.0) - half_of());
    };
    for (const double part : {0.15, 0.45}) {
      const double radius = part * size;
      const Ref<const Structure> foam =
          make_ref<Foam>(context, grid, Parameter(radius), row.jitter, row.seed, FoamMethod::direct,
                         Parameter(1), Vec3{1, 1, 1}, 0.0, placed);
      check_shelled(row.name, "edges", *make_ref<ShelledFoam>(foam, shell),
                    ask(diagram.edges, frame, half, radius, count, row.seed), beyond, radius, 1,
                    near);
    }
    const double thickness = 0.2 * size;
    const Ref<const Structure> walls =
        make_ref<FoamWalls>(context, grid, Parameter(thickness), row.jitter, row.seed, Parameter(1),
                            Parameter(0), Vec3{1, 1, 1}, 0.0, placed);
    check_shelled(row.name, "faces", *make_ref<ShelledFoam>(walls, shell),
                  ask(diagram.faces, frame, half, 0.5 * thickness, count, row.seed), beyond,
                  0.5 * thickness, 2, near);
  }
}

/// max_distance() of boxes in the samples, at their border and beyond: no point of a box is farther
/// from its nearest seed.
void test_bounds(void**) {
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  for (const Row& row : rows) {
    const SampledSeeds seeds(*context, map_of(row), row.jitter, row.seed);
    const double side = seeds.grid().cell_size.x;
    Random random(row.seed + 100);
    std::vector<PlacedSeed> found;
    double tightest = 0;
    for (size_t n = 0; n < test_count(400); ++n) {
      const Vec3 corner = random.in_box(Box3{half_of() * -0.4, half_of() * 2.4});
      const Box3 box{corner, corner + Vec3{1, 1, 1} * (0.3 * side * random.unit())};
      const double most = seeds.max_distance(box);
      for (int i = 0; i < 10; ++i) {
        const Vec3 g = random.in_box(box), in_boxes = g * (1 / side);
        const CellIndex at{static_cast<int32_t>(std::floor(in_boxes.x)),
                           static_cast<int32_t>(std::floor(in_boxes.y)),
                           static_cast<int32_t>(std::floor(in_boxes.z))};
        found.clear();
        for (int z = -2; z <= 2; ++z)
          for (int y = -2; y <= 2; ++y)
            for (int x = -2; x <= 2; ++x) seeds.find({at.x + x, at.y + y, at.z + z}, found);
        double nearest = 1e300;
        for (const PlacedSeed& seed : found) {
          const Vec3 of_box{double(seed.box.x), double(seed.box.y), double(seed.box.z)};
          nearest = std::min(nearest, length((of_box + seed.in_box) * side - g));
        }
        if (!(nearest <= most))
          fail_msg("%s: (%.17g, %.17g, %.17g) is %g from a seed; the bound is %g", row.name, g.x,
                   g.y, g.z, nearest, most);
        tightest = std::max(tightest, nearest / most);
      }
    }
    print_message("%s: at most %.2f of the bound\n", row.name, tightest);
    assert_true(tightest > 0.4);
  }
}

/// A plate that is few cells thick has hardly more seeds than cells, wherever its cells begin.
void test_plate(void**) {
  constexpr uint64_t side = 31;
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  for (const double thick : {1.0, 2.0, 2.5, 3.0, 4.0})
    for (const double offset : {0.0, 0.3, 0.5}) {
      std::vector<double> values[3];
      for (uint64_t i = 0; i < side * side * 2; ++i) {
        values[0].push_back(static_cast<double>(i % side) + offset);
        values[1].push_back(static_cast<double>(i / side % side) + offset);
        values[2].push_back(static_cast<double>(i / side / side) * thick + offset);
      }
      const auto map = make_map({{}, {1, 1, thick}, {}}, {side, side, 2}, values);
      const SampledSeeds seeds(*context, map, 1, 9);
      const int across = static_cast<int>(30 / seeds.grid().cell_size.x) - 1,
                up = static_cast<int>(thick / seeds.grid().cell_size.z);
      size_t cells = 0, others = 0;
      std::vector<PlacedSeed> found;
      const FoamSeeds own(9 ^ border_stream, 1, {1, 1, 1});
      for (int z = 0; z <= up; ++z)
        for (int y = 1; y < across; ++y)
          for (int x = 1; x < across; ++x) {
            found.clear();
            seeds.find({x, y, z}, found);
            const Vec3 at = own.fractions(own.bits({x, y, z}));
            const bool is_own = found.size() == 1 && length(found[0].in_box - at) < 1e-9;
            const double height = (z + at.z) * seeds.grid().cell_size.z;
            if (!is_own) cells += found.size();
            others += is_own && height < thick;
          }
      print_message("%g cells thick, from %g on: %zu seeds of cells, %zu others\n", thick, offset,
                    cells, others);
      assert_true(cells > 500 * thick && others * 50 < cells);
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_diagram), cmocka_unit_test(test_bounds),
                              cmocka_unit_test(test_plate)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
