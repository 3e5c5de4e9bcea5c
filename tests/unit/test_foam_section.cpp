// SPDX-License-Identifier: Apache-2.0
// Faces of a foam cut by a plane, against the nearest of all seeds: points on either side of a line
// have different ones, and wherever the nearest seed changes along a row there is a line.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "base/pi.h"
#include "field/gradient.h"
#include "graded_cells.h"
#include "msq_test.h"
#include "random.h"
#include "refused_sections.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeds/period_seeds.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  std::string name;
  Neighbourhood grid;
  double jitter = 1, density = 1;
  double z = 0.37;
  bool is_graded = false;
  Vec3 stretch{1, 1, 1};
  double weight = 0;
  int period_axis = -1;
};

Rotation turned() {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-1.1), t = std::sin(-1.1);
  return {{c, -s * d, s * t, s, c * d, -c * t, 0, t, d}};
}

const Row rows[] = {
    {"cubes", {}},
    {"at a height of nodes", {}, 1, 1, 2},
    {"unlike sides", {{0.3, -0.2, 0.1}, {1, 0.6, 1.7}, {}}},
    {"turned", {{0.3, 0.2, -0.7}, {1, 0.75, 0.5}, turned()}},
    {"little jitter", {}, 0.05, 1, 0.41},
    {"far away", {{-4e6, 3e6, 1e6}, {1, 1, 1}, {}}, 1, 1, 0.1},
    {"dense", {}, 1, 8, 0.3},
    {"graded", {{0, 0, 0}, {2, 2, 2}, turned()}, 1, 20, 0.3, true},
    {"stretched along z", {}, 1, 1, 0.37, false, {1, 1, 2.5}},
    {"stretched", {{0.3, -0.2, 0.1}, {1, 0.6, 1.7}, {}}, 1, 1, 0.37, false, {0.7, 1.6, 1}},
    {"stretched and turned",
     {{0.3, 0.2, -0.7}, {1, 0.75, 0.5}, turned()},
     1,
     1,
     0.37,
     false,
     {1, 0.5, 2}},
    {"weighted", {{0.3, -0.2, 0.1}, {1, 0.9, 1.2}, {}}, 1, 1, 0.37, false, {1, 1, 1}, 0.9},
    {"weighted and turned",
     {{0.3, 0.2, -0.7}, {1, 0.75, 0.5}, turned()},
     0.7,
     1,
     0.2,
     false,
     {1, 1, 1},
     0.45},
    {"a period", {}, 1, 1, 0.3, false, {1, 1, 1}, 0, 0},
    {"a period across, turned",
     {{0.3, 0.2, -0.7}, {1, 0.75, 1}, turned()},
     1,
     1,
     0.37,
     false,
     {1, 1, 1},
     0,
     2},
};

const Box2 window{{-1.5, -2.25}, {2.75, 1.5}};

Parameter density_of(const Row& row) {
  if (!row.is_graded) return Parameter(row.density);
  return Parameter(
      Ref<const Field>(make_ref<GradientField>(Vec3{-2, 0, 0}, 1.0, Vec3{3, 0.5, 0}, row.density)));
}

/// Null without a period. Cells from 1.5 to 0.5.
std::shared_ptr<const PlacedSeeds> placed_of(const Row& row) {
  if (row.period_axis < 0) return nullptr;
  const std::vector<GradedPeriod::Knot> knots{{-1, 1.5}, {1, 0.5}};
  return std::make_shared<const PeriodSeeds>(row.grid, GradedPeriod(row.period_axis, knots),
                                             row.jitter, uint64_t{7});
}

Ref<Foam> make(Context& context, const Row& row) {
  if (const auto placed = placed_of(row))
    return make_ref<Foam>(Ref<Context>(&context), placed->grid(), Parameter(0.05), row.jitter, 7,
                          FoamMethod::automatic, Parameter(1), Vec3{1, 1, 1}, 0.0, placed);
  return make_ref<Foam>(Ref<Context>(&context), row.grid, Parameter(0.05), row.jitter, 7,
                        FoamMethod::automatic, density_of(row), row.stretch, row.weight);
}

/// A seed, and the square of the radius of its sphere.
struct Sphere {
  Vec3 centre;
  double squared = 0;
};

/// All seeds of cells near the window, in model coordinates.
std::vector<Sphere> all_seeds(const Row& row) {
  const auto placed = placed_of(row);
  const Neighbourhood& grid = placed ? placed->grid() : row.grid;
  const double unit = max_component(grid.cell_size);
  const FoamSeeds cells(7, row.jitter, grid.cell_size * (1 / unit), row.weight / unit);
  const GradedSeeds seeds(cells, grid, density_of(row));
  const Box3 near =
      grid.to_grid(Box3{{window.min.x, window.min.y, row.z}, {window.max.x, window.max.y, row.z}});
  int low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double size = grid.cell_size[axis], reach = 2.2 * length(grid.cell_size) *
                                                      max_component(row.stretch) /
                                                      min_component(row.stretch);
    low[axis] = static_cast<int>(std::floor((near.min[axis] - reach) / size));
    high[axis] = static_cast<int>(std::floor((near.max[axis] + reach) / size));
  }
  std::vector<Sphere> all;
  for (int z = low[2]; z <= high[2]; ++z)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int x = low[0]; x <= high[0]; ++x) {
        if (placed) {
          std::vector<PlacedSeed> found;
          placed->find({x, y, z}, found);
          for (const PlacedSeed& seed : found)
            all.push_back({grid.from_grid(
                Vec3{x + seed.in_box.x, y + seed.in_box.y, z + seed.in_box.z} * grid.cell_size)});
          continue;
        }
        std::vector<GradedSeed> leaves;
        append_leaves(seeds, {{x, y, z}}, leaves);
        for (const GradedSeed& leaf : leaves) {
          // In the box of the cell, exact; then as points of the grid.
          const Vec3 in_cell = seeds.in_leaf(leaf.leaf);
          const Vec3 place =
              grid.from_grid(Vec3{x + in_cell.x, y + in_cell.y, z + in_cell.z} * grid.cell_size);
          const double lift = cells.is_weighted() ? cells.lift(cells.bits({x, y, z})) : 0;
          all.push_back({place, row.weight * row.weight - lift * unit * unit});
        }
      }
  return all;
}

struct Nearest {
  size_t seed;
  double distance, second;
};

/// By the power of the spheres where lengths along the grid's axes are divided by the stretch;
/// lifted, so that distances are real.
Nearest nearest(const Row& row, const std::vector<Sphere>& seeds, Vec3 p) {
  Nearest found{0, 1e300, 1e300};
  for (size_t i = 0; i < seeds.size(); ++i) {
    const Vec3 g = row.grid.rotation.apply_inverse(seeds[i].centre - p);
    const Vec3 d{g.x / row.stretch.x, g.y / row.stretch.y, g.z / row.stretch.z};
    const double squared = dot(d, d) + row.weight * row.weight - seeds[i].squared;
    if (squared < found.distance) {
      found = {i, squared, found.distance};
    } else if (squared < found.second) {
      found.second = squared;
    }
  }
  return {found.seed, std::sqrt(found.distance), std::sqrt(found.second)};
}

double distance_to(const LineGraph& graph, Vec2 p) {
  double least = 1e300;
  for (const auto& [a, b] : graph.lines) {
    const Vec2 from = graph.points[a], way = graph.points[b] - from;
    const double t = std::clamp(dot(p - from, way) / dot(way, way), 0.0, 1.0);
    least = std::min(least, length(p - from - way * t));
  }
  return least;
}

void check(const Row& row) {
  Context context(1, 0, 0);
  const Ref<Foam> foam = make(context, row);
  const LineGraph graph = foam->wall_lines({row.z, window, 1});
  const std::vector<Sphere> seeds = all_seeds(row);
  const double cell = min_component(row.grid.cell_size) / std::cbrt(row.density);
  // Corners closer than that are one.
  const double rounding = 4e-7 * max_component(row.grid.cell_size);
  Random random(3);
  print_message("%s: %zu lines, %zu seeds\n", row.name.c_str(), graph.lines.size(), seeds.size());
  assert_true(graph.lines.size() > 20);
  // On a line the two nearest seeds are equally near, and differ on its two sides.
  size_t crossed = 0;
  for (const auto& [a, b] : graph.lines) {
    const Vec2 from = graph.points[a], way = graph.points[b] - from;
    const double t = random.between(0.2, 0.8);
    const Vec2 p = from + way * t;
    const Nearest on = nearest(row, seeds, {p.x, p.y, row.z});
    if (on.second - on.distance > 10 * rounding)
      fail_msg("at %.17g, %.17g the nearest seeds are at %.17g and %.17g", p.x, p.y, on.distance,
               on.second);
    const double off = std::min(0.02 * length(way), 0.01 * cell);
    if (off < 100 * rounding) continue;
    const Vec2 normal = Vec2{-way.y, way.x} * (off / length(way));
    const Vec2 left = p + normal, right = p - normal;
    if (nearest(row, seeds, {left.x, left.y, row.z}).seed ==
        nearest(row, seeds, {right.x, right.y, row.z}).seed)
      fail_msg("the same seed on both sides at %.17g, %.17g", p.x, p.y);
    ++crossed;
  }
  if (row.jitter == 1 && max_magnitude(row.grid.origin) < 1e3)
    assert_true(static_cast<double>(crossed) > 0.8 * static_cast<double>(graph.lines.size()));
  // Wherever the nearest seed changes there is a line.
  size_t changes = 0;
  for (size_t i = 0; i < test_count(12); ++i) {
    const double y = random.between(window.min.y, window.max.y), step = cell / 25;
    size_t last = SIZE_MAX;
    for (double x = window.min.x; x <= window.max.x; x += step) {
      const size_t now = nearest(row, seeds, {x, y, row.z}).seed;
      if (last != SIZE_MAX && now != last) {
        ++changes;
        const double away = distance_to(graph, {x - 0.5 * step, y});
        if (away > 0.5 * step + 2 * rounding)
          fail_msg("a change at %g, %g is %g from the lines", x, y, away);
      }
      last = now;
    }
  }
  assert_true(changes > 0);
}

void test_lines_are_where_the_nearest_seed_changes(void**) {
  for (const Row& row : rows) check(row);
}

/// Seeds at the centres of cubes: squares, and four lines at each point.
void test_seeds_without_jitter_give_squares(void**) {
  Context context(1, 0, 0);
  for (const double z : {0.25, 0.5, 1.0}) {
    Row row{"squares", {}};
    row.jitter = 0;
    const Ref<Foam> foam = make(context, row);
    const LineGraph graph = foam->wall_lines({z, {{0.25, 0.25}, {3.75, 2.75}}, 1});
    std::vector<int> meets(graph.points.size(), 0);
    size_t fours = 0;
    for (const auto& [a, b] : graph.lines) {
      ++meets[a];
      ++meets[b];
      assert_true(std::abs(length(graph.points[a] - graph.points[b]) - 1) < 1e-6);
    }
    for (size_t i = 0; i < meets.size(); ++i) {
      const Vec2 p = graph.points[i];
      assert_true(std::abs(p.x - std::round(p.x)) < 1e-6 && std::abs(p.y - std::round(p.y)) < 1e-6);
      if (!(p.x > 0.5 && p.x < 3.5 && p.y > 0.5 && p.y < 2.5)) continue;
      assert_int_equal(meets[i], 4);
      ++fours;
    }
    assert_int_equal(fours, 6);
  }
}

/// In the plane of faces, up to rounding, cells above and below are equally near. The same squares
/// are there as beside it, also in turned cells and far from the origin.
void test_planes_of_faces_show_each_wall_once(void**) {
  Context context(1, 0, 0);
  // x to z, z to -x by a rotation whose zeros are rounded.
  const double zero = std::cos(0.5 * pi);
  const Rotation quarter{{zero, 0, 1, 0, 1, 0, -1, 0, zero}};
  for (const Rotation& rotation : {Rotation{}, quarter})
    for (const Vec2 far : {Vec2{0, 0}, Vec2{20000.3, -10000.7}})
      for (const double size : {0.8, 1.2, 0.3, 2.5})
        for (int k = 0; k < 30; ++k) {
          Row row{"faces", {{far.x, far.y, 0.1}, {size, size, size}, rotation}};
          row.jitter = 0;
          const Ref<Foam> foam = make(context, row);
          const Vec2 middle = far + Vec2{0.5 * size, 0.5 * size}, half{4 * size, 3 * size};
          const Box2 box{middle - half, middle + half};
          const LineGraph graph = foam->wall_lines({0.1 + size * k, box, 1});
          const LineGraph beside = foam->wall_lines({0.1 + size * (k + 0.25), box, 1});
          if (graph.lines.size() != beside.lines.size() ||
              graph.points.size() != beside.points.size())
            fail_msg("cells of %g, face %d: %zu lines between %zu points, beside it %zu, %zu", size,
                     k, graph.lines.size(), graph.points.size(), beside.lines.size(),
                     beside.points.size());
          assert_true(graph.lines.size() > 90);
          for (const auto& [a, b] : graph.lines)
            if (std::abs(length(graph.points[a] - graph.points[b]) - size) > 1e-6 * size)
              fail_msg("cells of %g, face %d: a line is %g long", size, k,
                       length(graph.points[a] - graph.points[b]));
        }
}

/// Inside the window three lines meet at each point, and the plane falls apart into cells of points
/// with one nearest seed: Euler's formula.
void test_three_lines_meet(void**) {
  Context context(1, 0, 0);
  const Ref<Foam> foam = make(context, rows[0]);
  const Box2 wide{{-10, -10}, {10, 10}};
  const LineGraph graph = foam->wall_lines({0.1, wide, 1});
  std::vector<int> meets(graph.points.size(), 0);
  for (const auto& [a, b] : graph.lines) {
    ++meets[a];
    ++meets[b];
  }
  for (size_t i = 0; i < meets.size(); ++i)
    if (wide.contains(graph.points[i])) assert_int_equal(meets[i], 3);
}

/// Total length per area against the area of faces per volume, by the mean over random directions:
/// pi / 4 of it. The area is found by counting: a random short line of length l crosses a face with
/// probability l / 2 times the area per volume (Buffon).
void test_length_by_stereology(void**) {
  Context context(1, 0, 0);
  const Ref<Foam> foam = make(context, rows[0]);
  double sum = 0;
  const int heights = 40, side = 30;
  for (int i = 0; i < heights; ++i) {
    const Box2 box{{0, 0}, {side, side}};
    const LineGraph graph = foam->wall_lines({0.83 * i + 0.01, box, 1});
    for (const auto& [a, b] : graph.lines) {
      const Vec2 p = graph.points[a], q = graph.points[b], m = (p + q) * 0.5;
      if (box.contains(m)) sum += length(p - q);
    }
  }
  const double density = sum / (heights * side * side);
  const FoamSeeds seeds(7, 1, {1, 1, 1});
  Random random(5);
  const auto cell_of = [&](Vec3 p) {
    const CellIndex home = Neighbourhood{}.locate(p).cell;
    const Vec3 q = p - Vec3{double(home.x), double(home.y), double(home.z)};
    double least = 1e300;
    std::array<int, 3> best{};
    for (int z = -2; z <= 2; ++z)
      for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
          const Vec3 d = seeds.at(home, x, y, z) - q;
          if (dot(d, d) < least) {
            least = dot(d, d);
            best = {home.x + x, home.y + y, home.z + z};
          }
        }
    return best;
  };
  const size_t count = test_count(200000);
  const double span = 0.05;
  size_t hits = 0;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p = random.in_box({{0, 0, 0}, {30, 30, 30}});
    Vec3 way{random.normal(), random.normal(), random.normal()};
    way = way * (span / length(way));
    hits += cell_of(p) != cell_of(p + way);
  }
  const double area = 2 * static_cast<double>(hits) / static_cast<double>(count) / span;
  const double error = area / std::sqrt(static_cast<double>(hits));
  print_message("length per area %.4f, pi / 4 of the area of faces %.4f +- %.4f\n", density,
                pi / 4 * area, pi / 4 * error);
  // Lines shorter than an eighth of an edge see two faces at once, or none, near edges: 1 %.
  assert_true(std::abs(density - pi / 4 * area) < 4 * pi / 4 * error + 0.012 * density);
}

using Line = std::array<double, 4>;

std::set<Line> lines_within(const LineGraph& graph, const Box2& box) {
  std::set<Line> found;
  for (const auto& [a, b] : graph.lines) {
    Vec2 p = graph.points[a], q = graph.points[b];
    if (!box.contains(p) || !box.contains(q)) continue;
    if (p.x > q.x || (p.x == q.x && p.y > q.y)) std::swap(p, q);
    found.insert({p.x, p.y, q.x, q.y});
  }
  return found;
}

void test_windows_have_the_same_lines(void**) {
  Context context(1, 0, 0);
  for (const Row& row : {rows[0], rows[3], rows[7], rows[10], rows[12]}) {
    const Ref<Foam> foam = make(context, row);
    const LineGraph whole = foam->wall_lines({row.z, window, 1});
    const Box2 small{{-1.4, -2.1}, {2.5, 1.1}};
    const LineGraph part = foam->wall_lines({row.z, small, 1});
    const std::set<Line> a = lines_within(whole, small), b = lines_within(part, small);
    assert_true(a.size() > 5);
    assert_true(a == b);
  }
}

void test_what_is_too_far_or_too_much_is_refused(void**) {
  Context context(1, 0, 1 << 20);
  const Ref<Foam> foam = make(context, rows[0]);
  check_limits_of_sections(*foam, "seeds of the foam");
  {
    const WorkingMemory working(*context.budget, "a section");
    check_section_is_refused(*foam, {0, {{0, 0}, {1e3, 1e3}}, 1}, "a section of");
  }
  assert_int_equal(context.budget->held(), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_lines_are_where_the_nearest_seed_changes),
      cmocka_unit_test(test_seeds_without_jitter_give_squares),
      cmocka_unit_test(test_planes_of_faces_show_each_wall_once),
      cmocka_unit_test(test_three_lines_meet),
      cmocka_unit_test(test_length_by_stereology),
      cmocka_unit_test(test_windows_have_the_same_lines),
      cmocka_unit_test(test_what_is_too_far_or_too_much_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
