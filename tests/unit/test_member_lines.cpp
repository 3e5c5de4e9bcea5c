// SPDX-License-Identifier: Apache-2.0
// Lines of structures made of others: unions have those of all, intersections and differences the
// part of the first structure's that is within the others or outside of them. Lines of walls with
// holes: interrupted where the walls are.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "expression/parser.h"
#include "field/gradient.h"
#include "images.h"
#include "msq_test.h"
#include "random.h"
#include "structure/combined/blended_structure.h"
#include "structure/combined/boolean_structure.h"
#include "structure/combined/smooth_boolean.h"
#include "structure/foam/foam.h"
#include "structure/foam/walls/foam_walls.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/lattice.h"

using namespace msq;
using namespace msq::test;

namespace {

using Operation = BooleanStructure::Operation;

Ref<Context> context() {
  static const Ref<Context> made = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return made;
}

Ref<const Structure> gyroid(double size = 1) {
  return make_ref<Functional>(Neighbourhood{{0.1, 0.2, 0.3}, {size, size, size}, {}},
                              parse_expression(preset_expressions[0], {}), FunctionalKind::sheet,
                              Parameter(0.2), 1);
}

/// Layers across all axes, each about as thick as the gaps between them.
Ref<const Structure> slabs() {
  return make_ref<Functional>(Neighbourhood{{0.1, 0.2, 0.3}, {2.3, 2.3, 2.3}, skew_rotation()},
                              parse_expression("sin(x)", {}), FunctionalKind::network,
                              Parameter(0.1), 1);
}

Ref<const Structure> struts() {
  return make_ref<Lattice>(Neighbourhood{}, octet_unit_cell(), Parameter(0.05));
}

Ref<const Structure> foam() {
  return make_ref<Foam>(context(), Neighbourhood{}, Parameter(0.05), 1.0, uint64_t{3},
                        FoamMethod::direct);
}

const WallSection section{0.47, {{-1.5, -1.5}, {2.5, 2.5}}, 1e-3};

double length_of(const LineGraph& graph) {
  double sum = 0;
  for (const auto& [a, b] : graph.lines) sum += length(graph.points[b] - graph.points[a]);
  return sum;
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

/// Points on lines are on the part's lines where `stays` says so, and nowhere else. Those near the
/// end of a part do not count.
template <class Stays>
void check_part(const char* name, const LineGraph& whole, const LineGraph& part, Stays&& stays) {
  Random random(8);
  size_t kept = 0, lost = 0;
  for (size_t i = 0; i < test_count(3000); ++i) {
    const auto& [a, b] = whole.lines[random.below(whole.lines.size())];
    const Vec2 from = whole.points[a], way = whole.points[b] - from;
    const double t = random.unit(), span = length(way);
    const Vec2 p = from + way * t;
    const bool is_kept = stays(Vec3{p.x, p.y, section.z});
    bool is_near_end = false;
    for (const double step : {-2e-3, 2e-3}) {
      const Vec2 q = from + way * (t + step / span);
      is_near_end = is_near_end || stays(Vec3{q.x, q.y, section.z}) != is_kept;
    }
    if (is_near_end) continue;
    (is_kept ? kept : lost) += 1;
    const double away = distance_to(part, p);
    if (is_kept != (away < 1e-9))
      fail_msg("%s: the line at %.17g, %.17g is %s, %g away", name, p.x, p.y,
               is_kept ? "lost" : "kept", away);
  }
  print_message("%s: %zu points kept, %zu lost\n", name, kept, lost);
  assert_true(test_scale() < 0.3 || (kept > 20 && lost > 20));
}

void test_unions_have_the_lines_of_all(void**) {
  const BooleanStructure both(Operation::united, {gyroid(), foam()});
  const LineGraph a = gyroid()->wall_lines(section), b = foam()->wall_lines(section);
  const LineGraph graph = both.wall_lines(section);
  assert_int_equal(graph.lines.size(), a.lines.size() + b.lines.size());
  assert_true(std::abs(length_of(graph) - length_of(a) - length_of(b)) < 1e-9);
  // The same structure twice has each line once.
  const BooleanStructure twice(Operation::united, {foam(), foam()});
  assert_int_equal(twice.wall_lines(section).lines.size(), b.lines.size());
  assert_int_equal(both.thin_walls(), ThinWalls::varying);
}

void test_others_bound_the_lines_of_the_first(void**) {
  for (const Ref<const Structure>& first : {gyroid(), foam()}) {
    const LineGraph whole = first->wall_lines(section);
    for (const Ref<const Structure>& second : {slabs(), struts(), gyroid(3)})
      for (const bool is_within : {true, false}) {
        const Operation operation = is_within ? Operation::intersected : Operation::subtracted;
        const BooleanStructure made(operation, {first, second, slabs()});
        const Ref<const Structure> last = slabs();
        check_part(is_within ? "within" : "without", whole, made.wall_lines(section), [&](Vec3 p) {
          return second->inside(p) == is_within && last->inside(p) == is_within;
        });
      }
  }
  const SmoothBoolean smooth(Operation::subtracted, gyroid(), slabs(), Parameter(0.1));
  const BooleanStructure plain(Operation::subtracted, {gyroid(), slabs()});
  assert_true(length_of(smooth.wall_lines(section)) == length_of(plain.wall_lines(section)));
}

void test_holes_interrupt_lines(void**) {
  const Ref<const Field> rising = make_ref<GradientField>(Vec3{-2, 0, 0}, 0.0, Vec3{3, 0, 0}, 0.3);
  struct Case {
    const char* name;
    Neighbourhood grid;
    double density;
    Parameter radius;
    double jitter;
  };
  const Case cases[] = {
      {"holes", {}, 1, Parameter(0.2), 1},
      {"turned", {{0.3, 0.2, -0.7}, {1, 0.8, 0.9}, skew_rotation()}, 1, Parameter(0.15), 1},
      {"dense", {{0, 0, 0}, {2, 2, 2}, {}}, 12, Parameter(0.2), 1},
      {"without jitter", {}, 1, Parameter(0.3), 0},
      {"by a field", {}, 1, Parameter(rising), 1},
  };
  for (const Case& known : cases) {
    const auto make = [&](const Parameter& radius) {
      return make_ref<FoamWalls>(context(), known.grid, Parameter(1e-4), known.jitter, uint64_t{3},
                                 Parameter(known.density), radius);
    };
    const auto whole = make(Parameter(0.0)), vented = make(known.radius);
    check_part(known.name, whole->wall_lines(section), vented->wall_lines(section),
               [&](Vec3 p) { return vented->inside(p); });
    assert_int_equal(vented->thin_walls(), known.density > 1 || !known.radius.is_constant()
                                               ? ThinWalls::varying
                                               : ThinWalls::uniform);
  }
}

void check_refused(const Structure& structure, const WallSection& at, Status status,
                   const char* text) {
  try {
    structure.wall_lines(at);
  } catch (const Error& error) {
    assert_int_equal(error.status, status);
    if (!strstr(error.what(), text)) fail_msg("%s", error.what());
    return;
  }
  fail_msg("not refused: %s", text);
}

void test_what_has_no_lines_is_named(void**) {
  const BooleanStructure united(Operation::united, {gyroid(), struts()});
  const BooleanStructure within(Operation::intersected, {struts(), gyroid()});
  const BlendedStructure blended(gyroid(), foam(), Parameter(0.5));
  for (const Structure* structure :
       std::initializer_list<const Structure*>{&united, &within, &blended})
    assert_int_equal(structure->thin_walls(), ThinWalls::none);
  check_refused(united, section, Status::unsupported, "structure 1 of the union");
  check_refused(within, section, Status::unsupported, "structure 0, the first one");
  check_refused(blended, section, Status::unsupported, "use its contours");
  // The second structure has smaller cells.
  const auto tiny = make_ref<Lattice>(Neighbourhood{{0, 0, 0}, {1e-7, 1e-7, 1e-7}, {}},
                                      cubic_unit_cell(), Parameter(1e-9));
  const BooleanStructure far(Operation::subtracted, {gyroid(), tiny});
  check_refused(far, section, Status::limit, "the limit is 1.67772e+07 cells");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_unions_have_the_lines_of_all),
      cmocka_unit_test(test_others_bound_the_lines_of_the_first),
      cmocka_unit_test(test_holes_interrupt_lines),
      cmocka_unit_test(test_what_has_no_lines_is_named),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
