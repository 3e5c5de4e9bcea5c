// SPDX-License-Identifier: Apache-2.0
// Distances to structures whose parameter is an expression: safe, since membership is the same all
// over the ball, and of use, where the slope of the expression is known. Rays then meet plates and
// walls however thin, and gaps however narrow.
#include "expression/parser.h"
#include "field/expression.h"
#include "field/map.h"
#include "foam_structures.h"
#include "random.h"
#include "structure/foam/walls/foam_walls.h"
#include "structure/functional/presets.h"
#include "structure/lattice/cell/plate_cell.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  std::string name;
  Factory make;
  std::string expression;
  Interval range;
  double slope;  ///< greatest of the expression; 0: it has none everywhere
  double own;    ///< of the onset; 0: how large distances are is not compared with it
};

Factory walls_factory(double vent_radius) {
  return [=](const Neighbourhood& grid, Parameter thickness) {
    return Ref<const Structure>(make_ref<FoamWalls>(shared_context(), grid, std::move(thickness),
                                                    1.0, uint64_t{7}, Parameter(1),
                                                    Parameter(vent_radius)));
  };
}

std::vector<Row> rows() {
  struct Kind {
    const char* name;
    Factory make;
    double own;
  };
  const Kind kinds[] = {
      {"BCC", lattice_factory(bcc_unit_cell()), 1},
      {"factors", lattice_factory(factored_unit_cell()), 1},
      {"mixed", mixed_factory(), 1},
      {"foam", foam_factory(FoamMethod::direct, 1), 1},
      {"gyroid", functional_factory(preset_expressions[0], FunctionalKind::network, 0), 0},
      {"plates", plates_factory(skew_plate_cell()), 0},
      {"plates with factors", plates_factory(factored_plate_cell()), 0},
      {"walls", walls_factory(0), 0},
      {"walls with holes", walls_factory(0.1), 0},
  };
  struct Expression {
    const char* text;
    double slope;
  };
  const Expression expressions[] = {
      {"0.1 + 0.03*sin(x)*cos(y)", 0.03},
      {"0.05 + 0.1*abs(sin(0.5*x))", 0.05},
      {"max(0.04, min(0.15, 0.02*(x + y*y)))", 0},
      {"0.1 + 0.05*sin(40*x)", 2},
      {"0.03*sqrt(x*x + y*y)", 0},
      {"0.1 + 0.02/(x - 0.3)", 0},
      {"0.02*log(x)", 0},
  };
  std::vector<Row> all;
  for (const Kind& kind : kinds)
    for (const Expression& e : expressions)
      all.push_back({std::string(kind.name) + ", " + e.text,
                     kind.make,
                     e.text,
                     {0.02, 0.16},
                     e.slope,
                     kind.own});
  return all;
}

void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  Random random(7);
  const Ref<const Field> field =
      make_ref<ExpressionField>(parse_expression(row.expression, {}), row.range);
  const Neighbourhood grid{{0.1, -0.2, 0.3}, {1, 1, 1}, {}};
  const Ref<const Structure> structure = row.make(grid, Parameter(field));
  size_t positive = 0, good = 0;
  const size_t count = test_count(1500);
  for (size_t n = 0; n < count; ++n) {
    const Vec3 p = random.in_box({{-3, -3, -3}, {3, 3, 3}});
    const double distance_bound = structure->distance_bound(p);
    assert_true(distance_bound >= 0 && std::isfinite(distance_bound));
    positive += distance_bound > 0;
    const bool is_inside = structure->inside(p);
    for (int k = 0; k < 40 && distance_bound > 0; ++k) {
      Vec3 way{random.normal(), random.normal(), random.normal()};
      way = way * (distance_bound * (1 - 1e-12) * std::cbrt(random.unit()) / length(way));
      if (k % 2) way = way * (distance_bound * (1 - 1e-12) / length(way));
      if (structure->inside(p + way) != is_inside)
        fail_msg("(%.17g, %.17g, %.17g), %g from (%.17g, %.17g, %.17g)", p.x + way.x, p.y + way.y,
                 p.z + way.z, distance_bound, p.x, p.y, p.z);
    }
    if (row.own == 0 || row.slope == 0 || !structure->has_onset() || row.name[0] == 'f') continue;
    // Half of what the greatest slope of all would allow.
    const double gap = std::abs(structure->onset(p) - structure->parameter(p));
    good += distance_bound >= 0.49 * gap / (1 + row.slope) - 1e-9;
  }
  if (row.slope > 0 && positive < count / 2) fail_msg("%zu of %zu are 0", count - positive, count);
  if (row.own > 0 && row.slope > 0 && structure->has_onset() && row.name[0] != 'f' && good < count)
    fail_msg("%zu of %zu are less than they could be", count - good, count);
  print_message("%s: %zu of %zu above 0\n", row.name.c_str(), positive, count);
}

std::vector<Row> rows_of_thin_walls() {
  std::vector<Row> all;
  // Thinner than 1/64 of a cell. The last one has kinks.
  for (const char* text :
       {"0.006 + 0.003*sin(x)*cos(y)", "0.006 + 0*x", "0.004 + 0.002*abs(sin(3*x))"}) {
    const std::string thickness = text;
    all.push_back({"plates, " + thickness, plates_factory(skew_plate_cell()), text, {}, 0, 0});
    all.push_back({"walls, " + thickness, walls_factory(0), text, {}, 0, 0});
    all.push_back({"walls with holes, " + thickness, walls_factory(0.1), text, {}, 0, 0});
  }
  return all;
}

void test_thin_walls(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  constexpr double range = 4, rounding = 1e-9;
  constexpr int samples = 1000;
  Random random(3);
  const Ref<const Field> field =
      make_ref<ExpressionField>(parse_expression(row.expression, {}), Interval{0.001, 0.01});
  const Ref<const Structure> structure =
      row.make({{0.1, -0.2, 0.3}, {1, 1, 1}, {}}, Parameter(field));
  size_t hits = 0;
  const size_t count = test_count(400) + 40;
  for (size_t n = 0; n < count; ++n) {
    RaySearch search{{random.in_box({{-3, -3, -3}, {3, 3, 3}}), random.direction()}, 0, range};
    structure->enter(&search, 1, nullptr);
    hits += search.found;
    const double end = search.found ? search.t : range;
    for (int i = 0; i < samples; ++i) {
      const double t = range * (i + 0.5) / samples;
      if (t + rounding >= end) break;
      // More than a graze.
      if (structure->inside(search.ray.at(t)) && structure->inside(search.ray.at(t + rounding)) &&
          structure->inside(search.ray.at(std::max(0.0, t - rounding))))
        fail_msg("ray %zu passes what it meets at %g, and ends at %g", n, t, end);
    }
  }
  assert_true(hits > count / 4);
}

std::vector<Row> rows_of_narrow_gaps() {
  const std::pair<const char*, Factory> kinds[] = {
      {"BCC", lattice_factory(bcc_unit_cell())},
      {"octet", lattice_factory(octet_unit_cell())},
      {"mixed", mixed_factory()},
      {"foam", foam_factory(FoamMethod::direct, 1)},
      {"stretched foam", stretched_factory(1, {1, 1, 2})},
      {"weighted foam", weighted_factory(1, 0.5)},
      {"foam of rising density", graded_foam_factory(1)},
      {"walls", walls_factory(0)},
  };
  std::vector<Row> all;
  for (const auto& [name, make] : kinds) {
    // Between thick struts there is little.
    const bool are_near = name == std::string("octet") || std::string(name).ends_with("density");
    const std::string size = are_near ? "0.16 + 0.03*sin(x)*cos(y)" : "0.3 + 0.03*sin(x)*cos(y)";
    all.push_back({name + (", " + size), make, size, {}, 0, 0});
  }
  return all;
}

/// A ray that starts in the solid leaves it at the first gap.
void test_narrow_gaps(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  constexpr double range = 1, rounding = 1e-9, sample = 1.0 / 512;
  Random random(5);
  const Ref<const Field> field =
      make_ref<ExpressionField>(parse_expression(row.expression, {}), Interval{0.1, 0.4});
  const Ref<const Structure> structure =
      row.make({{0.1, -0.2, 0.3}, {1, 1, 1}, {}}, Parameter(field));
  size_t starts = 0;
  for (size_t n = 0; n < test_count(6000); ++n) {
    const Ray ray{random.in_box({{-3, -3, -3}, {3, 3, 3}}), random.direction()};
    if (!structure->inside(ray.origin)) continue;
    ++starts;
    const double end = structure->leave(ray, 0, range, nullptr);
    for (double t = sample * random.unit(); t < end - rounding; t += sample)
      if (!structure->inside(ray.at(t)) && !structure->inside(ray.at(t + rounding)) &&
          !structure->inside(ray.at(std::max(0.0, t - rounding))))
        fail_msg("ray %zu is in a gap at %g, and leaves at %g", n, t, end);
  }
  assert_true(starts > 0);
}

}  // namespace

int main() {
  std::vector<Row> all = rows(), thin = rows_of_thin_walls(), narrow = rows_of_narrow_gaps();
  return run_for_each("distances by expressions", all, test_row) +
         run_for_each("rays to thin walls", thin, test_thin_walls) +
         run_for_each("rays to narrow gaps", narrow, test_narrow_gaps);
}
