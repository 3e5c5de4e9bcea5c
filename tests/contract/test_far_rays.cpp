// SPDX-License-Identifier: Apache-2.0
// Rays through structures far from the origin, where coordinates are rounded: hits are right within
// that (ray_checker.h), and the same bits whatever was cast before, alone and with others.
//
// Many rays of some rows: contract_test_far_rays "foam DIRECT*" 10000.
#include <cmath>
#include <limits>
#include <vector>

#include "random.h"
#include "ray_checker.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

size_t asked_rays = 0;  // of each row, on the command line

/// Where along a ray the onset comes next to the radius, in [0, to].
double deepest(const Structure& structure, const Parameter& radius, const Ray& ray, double to) {
  const auto gap = [&](double t) { return structure.onset(ray.at(t)) - radius.at(ray.at(t)); };
  constexpr int steps = 24;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int i = 1; i < steps; ++i)
    if (const double g = gap(to * i / steps); g < least) {
      least = g;
      best = to * i / steps;
    }
  double low = best - to / steps, high = best + to / steps;
  for (int i = 0; i < 60; ++i) {
    const double one = low + 0.382 * (high - low), other = high - 0.382 * (high - low);
    (gap(one) < gap(other) ? high : low) = gap(one) < gap(other) ? other : one;
  }
  return 0.5 * (low + high);
}

/// Moves a ray until it comes no deeper than `depth` into what it comes next to: negative past it.
Ray grazing(const Structure& structure, const Parameter& radius, Ray ray, double to, double depth) {
  const double cell = min_component(structure.neighbourhood().cell_size), step = 1e-5 * cell;
  for (int i = 0; i < 6; ++i) {
    const double t = deepest(structure, radius, ray, to);
    const Vec3 p = ray.at(t);
    const auto gap = [&](Vec3 q) { return structure.onset(q) - radius.at(q); };
    Vec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 by;
      by[axis] = step;
      slope[axis] = (gap(p + by) - gap(p - by)) / (2 * step);
    }
    slope = slope - ray.direction * dot(slope, ray.direction);
    const double squared = dot(slope, slope);
    if (!(squared > 1e-6)) break;
    const Vec3 move = slope * (-(gap(p) + depth * std::sqrt(squared)) / squared);
    if (!(length(move) < 0.5 * cell)) break;
    ray.origin = ray.origin + move;
  }
  return ray;
}

/// A third along an axis of the grid or of the model, a third that graze, and others; four beside
/// each other at a time.
std::vector<RaySearch> rays(const StructureRow& row, const Structure& structure,
                            const Parameter& radius, size_t count, Random& random) {
  const Neighbourhood& grid = row.variant.grid;
  const double to = 2.5 * row.unit();
  std::vector<RaySearch> searches;
  while (searches.size() < count) {
    const auto point = [&] {
      return grid.from_grid(random.in_box({{-1, -1, -1}, {2, 2, 2}}) * grid.cell_size);
    };
    const Vec3 from = point(), target = point();
    Ray ray{from, (target - from) * (1 / length(target - from))};
    const uint64_t kind = random.below(6);
    if (kind < 2) {
      Vec3 along;
      along[static_cast<int>(random.below(3))] = random.below(2) ? 1 : -1;
      ray.direction = kind ? grid.rotation.apply(along) : along;
    } else if (kind < 4 && structure.has_onset()) {
      const double depth = std::exp2(-random.between(6, 44)) * (random.below(3) ? 1 : -1);
      ray = grazing(structure, radius, ray, to, depth * row.unit());
    }
    const double spread = std::exp2(-random.between(2, 40)) * row.unit();
    for (int n = 0; n < 4; ++n) {
      searches.push_back({ray, 0, to});
      ray.origin = ray.origin + Vec3{random.normal(), random.normal(), random.normal()} * spread;
    }
  }
  return searches;
}

void check_same(const char* name, const char* what, const RaySearch& a, const RaySearch& b) {
  if (a.found == b.found && (!a.found || (a.t == b.t && a.normal == b.normal))) return;
  print_error("%s: %s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g): %d %.17g, %d %.17g\n",
              name, what, a.ray.origin.x, a.ray.origin.y, a.ray.origin.z, a.ray.direction.x,
              a.ray.direction.y, a.ray.direction.z, a.found, a.t, b.found, b.t);
  if (asked_rays) throw RayFailure{};
  _fail(__FILE__, __LINE__);
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const char* const name = row.name.c_str();
  const Neighbourhood& grid = row.variant.grid;
  const Vec3 centre = grid.from_grid(grid.cell_size * 0.5);
  const Parameter radius = row.parameter(centre);
  // Nothing is known of what is cast through for the first time.
  const Ref<const Structure> structure = row.make(centre), other = row.make(centre);
  RayChecker checker(row, *structure, radius, row.cells_away > 0 ? row.max_coordinate() : 0,
                     asked_rays > 0);
  Random random(row.index + 29);
  const size_t count = asked_rays ? asked_rays : row.samples(24 * row.family_rows);
  const std::vector<RaySearch> searches = rays(row, *structure, radius, count, random);
  std::vector<RaySearch> cold = searches, warm = searches, alone = searches;
  size_t unlike = 0, failures = 0;
  const auto count_failure = [](size_t& failures, auto&& test) {
    try {
      test();
    } catch (const RayFailure&) {
      ++failures;
    }
  };
  for (RaySearch& search : alone) other->enter(&search, 1, nullptr);
  structure->enter(cold.data(), cold.size(), nullptr);
  // What is asked often is found another way.
  for (int n = 0; n < 3; ++n) structure->enter(warm.data(), warm.size(), nullptr);
  for (size_t i = 0; i < searches.size(); ++i) {
    count_failure(unlike, [&] { check_same(name, "alone", cold[i], alone[i]); });
    count_failure(unlike, [&] { check_same(name, "warm", cold[i], warm[i]); });
    RaySearch again = searches[i];
    structure->enter(&again, 1, nullptr);
    count_failure(unlike, [&] { check_same(name, "warm, alone", cold[i], again); });
    count_failure(failures, [&] { checker.check(cold[i]); });
    count_failure(failures, [&] { checker.check(warm[i]); });
  }
  if (asked_rays) {
    print_message("%s: rays %zu hits %zu normals %zu failures %zu unlike %zu\n", name,
                  searches.size(), checker.hits / 2, checker.normals / 2, failures, unlike);
    assert_int_equal(failures + unlike, 0);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<StructureRow> rows;
  for (const StructureRow& row : structures_by_point())
    for (const double cells : {0.0, 1.0, 1e3, 1e5, 1e7})
      if (test_scale() == 1 || cells == 1e3 || cells == 1e7) rows.push_back(row.moved(cells));
  if (argc > 2) asked_rays = std::strtoull(argv[2], nullptr, 10);
  if (argc > 1)
    cmocka_set_test_filter(argv[1]);
  else  // the others by name only: their edges are dear
    std::erase_if(rows, [](const StructureRow& row) {
      const std::string tried = "density 1 to 30, jitter 1 r 0.06";
      return row.kind.name.find("density") != std::string::npos && row.kind.name != tried;
    });
  return run_for_each("far rays", rows, test_row);
}
