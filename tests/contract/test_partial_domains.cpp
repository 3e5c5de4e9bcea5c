// SPDX-License-Identifier: Apache-2.0
// Functional structures whose expressions are no number somewhere, or jump: a point is outside
// where there is no number, and points, sets, grids and rays agree on where that is, and where
// jumps are, whichever way round operands stand.
#include "bit_rows.h"
#include "expression/parser.h"
#include "field/gradient.h"
#include "field/map.h"
#include "random.h"
#include "ray_check.h"
#include "structure/functional/ray_search.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Two expressions of x, y and z that stand for one function. The second has the operands of its
/// sums, products, minima and maxima the other way round.
struct Pair {
  const char *one, *other;
};

constexpr Pair pairs[] = {
    {"min(sqrt(x-4),0.5)-0.8", "min(0.5,sqrt(x-4))-0.8"},
    {"max(sqrt(x-4),0.5)-0.8", "max(0.5,sqrt(x-4))-0.8"},
    {"min(log(x-3),y-3)", "min(y-3,log(x-3))"},
    {"max(log(x-3),y-3)", "max(y-3,log(x-3))"},
    {"max(min(sqrt(x-3),z-3),sin(y))-0.4", "max(sin(y),min(z-3,sqrt(x-3)))-0.4"},
    {"min(max(sqrt(sin(x)),0.3),y-2)", "min(y-2,max(0.3,sqrt(sin(x))))"},
    {"abs(min(sqrt(x-4),0.5))-0.6", "abs(min(0.5,sqrt(x-4)))-0.6"},
    {"-max(-sqrt(x-4),y-4)", "-max(y-4,-sqrt(x-4))"},
    {"min((x-4)^1.5,y-3)-0.5", "min(y-3,pow(x-4,1.5))-0.5"},
    {"max((x-4)^0.5*(y-3),cos(z))", "max(cos(z),(y-3)*(x-4)^0.5)"},
    {"min(0/(x-x),y-3)", "min(y-3,0/(x-x))"},
    {"max(0*log(x-x),y-3)", "max(y-3,log(x-x)*0)"},
    {"min(exp(200*x)-exp(150*y),z-3)", "min(z-3,-exp(150*y)+exp(200*x))"},
    {"max(exp(200*x)*(y-y),z-3)", "max(z-3,(y-y)*exp(200*x))"},
    {"min(1/max(x-4,0)-1/max(y-4,0),z-3)", "min(z-3,1/max(0,x-4)-1/max(0,y-4))"},
    {"max(sin(1/max(x-3,0)),0.2)-0.5", "max(0.2,sin(1/max(0,x-3)))-0.5"},
    {"min(0*(1e9*sin(x))^64,y-3)", "min(y-3,(1e9*sin(x))^64*0)"},
    {"min(0/0,x)", "min(x,0/0)"},
    {"max(0/0,0*x)", "max(x*0,0/0)"},
    {"select(x>4,sqrt(x-4),y-3)-0.5", "select(4<x,sqrt(x-4),y-3)-0.5"},
    {"mod(x,1.5)-floor(y)*0.2-0.5", "mod(x,1.5)-0.2*floor(y)-0.5"},
    {"(x<=4)*(y!=z)-0.5", "(z!=y)*(4>=x)-0.5"},
    {"0.3*atan2(y-3,x-3)+hypot(x-3,z-3)-1", "hypot(z-3,x-3)+atan2(y-3,x-3)*0.3-1"},
};

enum class LevelKind { number, linear, bent };

struct Row {
  std::string name;
  const Pair* pair;
  FunctionalKind kind;
  LevelKind level;
  Neighbourhood grid;
  int clusters;
};

constexpr double level = 0.05;

Parameter make_level(const Row& row) {
  if (row.level == LevelKind::number) return Parameter(level);
  const Vec3 size = row.grid.cell_size;
  Ref<const Field> field = make_ref<GradientField>(row.grid.from_grid(Vec3{} - size), 0.01,
                                                   row.grid.from_grid(size * 2.0), 2 * level);
  if (row.level == LevelKind::bent)
    field = make_ref<MapField>(field, Curve({{0.01, 0.02}, {level, 0.09}, {2 * level, 0.01}}));
  return Parameter(field);
}

Ref<Functional> make(const Row& row, const char* text) {
  return make_ref<Functional>(row.grid, parse_expression(text, {}), row.kind, make_level(row),
                              row.clusters);
}

bool sets_agree(const Functional& solid, const std::vector<Vec3>& points,
                const std::vector<uint8_t>& inside) {
  std::vector<uint8_t> alive(points.size(), 1);
  solid.keep_points(points.data(), alive.data(), points.size());
  return alive == inside;
}

/// Samples on the borders of cells, of clusters and anywhere.
void check_rows(const Row& row, const Functional& solid, double per_cell, Vec3 shift) {
  SampleGrid grid;
  grid.spacing = row.grid.cell_size * (1 / per_cell);
  grid.origin = row.grid.from_grid(shift * row.grid.cell_size);
  grid.nx = 130;
  grid.ny = grid.nz = test_count(6) + 1;
  BitRows rows(grid);
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j) set_bits(rows.block().row(j, k), 0, grid.nx - 1);
  solid.keep_rows(rows.block(), nullptr);
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) {
        const Vec3 p = grid.at(i, j, k);
        if (rows.get(i, j, k) != solid.inside(p))
          fail_msg("%s: the row has %d at (%.17g, %.17g, %.17g)", row.name.c_str(),
                   rows.get(i, j, k), p.x, p.y, p.z);
      }
}

void check_rays(const Row& row, const Functional& solid, Random& random) {
  const double cell = min_component(row.grid.cell_size);
  // Where the function is no number, parts this long may be lost; bounds of a level that is bent
  // are as long.
  const RayWalk walk{1.5 * FunctionalRays::max_blind_step * cell, 200};
  for (size_t i = 0; i < test_count(20); ++i) {
    const Vec3 a = random.in_box({{-1, -1, -1}, {2, 2, 2}});
    Vec3 b = random.in_box({{-1, -1, -1}, {2, 2, 2}});
    if (i % 4 == 0) {
      b = a;
      b[static_cast<int>(random.below(3))] += 1;
    }
    const Vec3 from = row.grid.from_grid(a * row.grid.cell_size);
    const Vec3 to = row.grid.from_grid(b * row.grid.cell_size);
    const Ray ray{from, (to - from) * (1 / length(to - from))};
    check_ray(
        row.name.c_str(), ray, 0, 2 * cell, walk, [&](Vec3 p) { return solid.inside(p); },
        [&](const Ray& r, double first, double last, double& t) {
          RaySearch search{r, first, last};
          solid.enter(&search, 1, nullptr);
          t = search.t;
          return search.found;
        },
        [&](const Ray& r, double first, double last) {
          return solid.leave(r, first, last, nullptr);
        });
  }
}

void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Ref<Functional> one = make(row, row.pair->one), other = make(row, row.pair->other);
  Random random(17);
  std::vector<Vec3> points;
  std::vector<uint8_t> inside;
  for (size_t i = 0; i < test_count(2000); ++i) {
    Vec3 u = random.in_box({{-1, -1, -1}, {2, 2, 2}});
    if (i % 5 == 0) u[static_cast<int>(random.below(3))] = std::round(16 * u.x) / 16;
    const Vec3 p = row.grid.from_grid(u * row.grid.cell_size);
    points.push_back(p);
    inside.push_back(one->inside(p));
    if (other->inside(p) != one->inside(p))
      fail_msg("%s: %s has (%.17g, %.17g, %.17g) %s, the other order has not", row.name.c_str(),
               row.pair->one, p.x, p.y, p.z, one->inside(p) ? "inside" : "outside");
  }
  assert_true(sets_agree(*one, points, inside));
  assert_true(sets_agree(*other, points, inside));
  for (const Ref<Functional>& solid : {one, other}) {
    check_rows(row, *solid, 64, {-0.5, 0.25, 0.5});
    check_rows(row, *solid, 100, random.in_box({{-1, -1, -1}, {1, 1, 1}}));
    check_rows(row, *solid, 7, random.in_box({{-1, -1, -1}, {1, 1, 1}}));
  }
  check_rays(row, *one, random);
}

}  // namespace

int main() {
  const std::vector<GridVariant> grids = grid_variants(true);
  std::vector<Row> rows;
  for (const Pair& pair : pairs)
    for (const FunctionalKind kind : {FunctionalKind::network, FunctionalKind::sheet}) {
      const auto add = [&](const char* what, LevelKind of_level, const GridVariant& grid,
                           int clusters) {
        rows.push_back({std::string(pair.one) + (kind == FunctionalKind::sheet ? ", sheet" : "") +
                            what + (grid.name.empty() ? "" : ", " + grid.name),
                        &pair, kind, of_level, grid.grid, clusters});
      };
      for (const GridVariant& grid : grids) add("", LevelKind::number, grid, 8);
      add(", no clusters", LevelKind::number, grids[0], 1);
      add(", linear level", LevelKind::linear, grids[2], 8);
      add(", bent level", LevelKind::bent, grids[1], 8);
    }
  return run_for_each("partial_domains", rows, test_row);
}
