// SPDX-License-Identifier: Apache-2.0
// Rays through foams whose seeds lie on common spheres, or nearly: the same bits for each ray alone
// by steps, alone by cells, and among others.
#include <algorithm>
#include <string>
#include <vector>

#include "field/gradient.h"
#include "foam_structures.h"
#include "images.h"
#include "random.h"
#include "structure/foam/rays/packets.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

enum class Seeds { plain, graded, period };

struct Row {
  std::string name;
  Seeds seeds;
  double jitter;
  Neighbourhood grid;
  bool tapers;
};

std::vector<Row> make_rows() {
  const std::pair<const char*, Neighbourhood> grids[] = {
      {"even", {{0.3, -0.2, 0.1}, {1, 1, 1}, {}}},
      {"uneven", {{-0.1, 0.2, 0.05}, {0.6, 0.5, 1}, {}}},
      {"turned", {{0.3, -0.2, 0.1}, {0.7, 0.7, 0.7}, skew_rotation()}}};
  const std::pair<const char*, Seeds> kinds[] = {
      {"plain", Seeds::plain}, {"density", Seeds::graded}, {"period", Seeds::period}};
  std::vector<Row> rows;
  for (const auto& [kind, seeds] : kinds)
    for (const double jitter : {0.0, 1e-9, 1e-6})
      for (const auto& [cells, grid] : grids)
        for (const bool tapers : {false, true}) {
          char name[100];
          std::snprintf(name, sizeof name, "%s, jitter %g, %s cells%s", kind, jitter, cells,
                        tapers ? ", tapered" : "");
          rows.push_back({name, seeds, jitter, grid, tapers});
        }
  return rows;
}

Ref<const Foam> foam_of(const Row& row) {
  const double radius = 0.12 * min_component(row.grid.cell_size);
  Parameter radii(radius);
  if (row.tapers)
    radii = Parameter(Ref<const Field>(
        make_ref<GradientField>(row.grid.from_grid(row.grid.cell_size * -2.0), radius,
                                row.grid.from_grid(row.grid.cell_size * 2.0), 0.5 * radius)));
  const auto context = make_ref<Context>(1u, uint64_t{1} << 26, uint64_t{0});
  const Parameter density = row.seeds == Seeds::graded ? rising_density(row.grid) : Parameter(1);
  const auto placed = row.seeds == Seeds::period ? by_period<1>(row.grid, row.jitter) : nullptr;
  return make_ref<Foam>(context, placed ? placed->grid() : row.grid, radii, row.jitter, uint64_t{7},
                        FoamMethod::direct, density, Vec3{1, 1, 1}, 0.0, placed);
}

/// Near each other, some along an axis of the grid.
std::vector<RaySearch> tile(const Row& row, Random& random) {
  const Vec3 eye = random.in_box({{-2, -2, -2}, {2, 2, 2}});
  Vec3 way{random.normal(), random.normal(), random.normal()};
  if (random.below(3) == 0)
    for (int axis = 0; axis < 3; ++axis)
      if (random.below(2) == 0) way[axis] = 0;
  if (!(dot(way, way) > 0)) way.x = 1;
  way = row.grid.rotation.apply(way);
  const Vec3 across{random.normal(), random.normal(), random.normal()};
  const double spread = random.below(2) == 0 ? 0.02 : 1e-3;
  std::vector<RaySearch> searches(50);
  for (size_t n = 0; n < searches.size(); ++n) {
    RaySearch& s = searches[n];
    s.ray = {
        row.grid.from_grid(eye * row.grid.cell_size) + across * (spread * static_cast<double>(n)),
        way * (1 / length(way))};
    s.to = 3 * max_component(row.grid.cell_size);
  }
  return searches;
}

void check_same(const char* what, const RaySearch& a, const RaySearch& b) {
  if (a.found == b.found && (!a.found || (a.t == b.t && a.normal == b.normal))) return;
  fail_msg(
      "%s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g): %d %.17g (%.17g, %.17g, %.17g), "
      "%d %.17g (%.17g, %.17g, %.17g)",
      what, a.ray.origin.x, a.ray.origin.y, a.ray.origin.z, a.ray.direction.x, a.ray.direction.y,
      a.ray.direction.z, a.found, a.t, a.normal.x, a.normal.y, a.normal.z, b.found, b.t, b.normal.x,
      b.normal.y, b.normal.z);
}

void finds_the_same(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  Random random(5);
  // Of a foam that rays were never cast through, single rays march.
  const Ref<const Foam> foam = foam_of(row), fresh = foam_of(row);
  size_t found = 0;
  // Of plain foams few rays meet ties, and rays are cheap.
  const size_t least = row.seeds == Seeds::plain ? 20 : 1;
  for (size_t n = 0; n < std::max(least, test_count(20)); ++n) {
    std::vector<RaySearch> together = tile(row, random), alone = together, steps = together;
    assert_true(walk_cells(*foam, together.data(), together.size(), nullptr));
    for (size_t i = 0; i < together.size(); ++i) {
      walk_cells(*foam, &alone[i], 1, nullptr);
      check_same("alone by cells", together[i], alone[i]);
      fresh->enter(&steps[i], 1, nullptr);
      check_same("alone by steps", together[i], steps[i]);
      found += steps[i].found;
    }
    foam->enter(alone.data(), alone.size(), nullptr);
    for (size_t i = 0; i < together.size(); ++i) check_same("batch", together[i], alone[i]);
  }
  assert_true(found > 0);
}

}  // namespace

int main() {
  std::vector<Row> rows = make_rows();
  return run_for_each("tied rays", rows, finds_the_same);
}
