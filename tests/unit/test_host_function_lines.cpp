// SPDX-License-Identifier: Apache-2.0
// Lines of functions of the host against those of functions of msq.
#include <cmath>
#include <limits>
#include <string>

#include "expression/parser.h"
#include "fill/line_density.h"
#include "msq_test.h"
#include "structure/functional/functional.h"
#include "structure/host/host_function.h"

using namespace msq;

namespace {

Rotation turned() {
  const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(-1.1), t = std::sin(-1.1);
  return {{c, -s * d, s * t, s, c * d, -c * t, 0, t, d}};
}

/// A function of the host that computes what msq computes has the same lines, to the last bit.
void test_functions_of_the_host(void**) {
  const std::string text = "sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)+0.2*cos(2*x-1)";
  const Tape tape = parse_expression(text, {});
  HostFunctionCalls calls;
  calls.evaluate = [&tape](const Vec3* angles, size_t count, double* values) {
    for (size_t i = 0; i < count; ++i) values[i] = evaluate(tape, angles[i]);
  };
  for (const Neighbourhood& grid :
       {Neighbourhood{}, Neighbourhood{{0.3, -2, 1}, {2, 1, 3}, turned()}})
    for (const FunctionalKind kind : {FunctionalKind::network, FunctionalKind::sheet}) {
      const bool is_sheet = kind == FunctionalKind::sheet;
      const auto host = make_ref<HostFunction>(grid, calls, is_sheet, Parameter(0.3), 1,
                                               std::numeric_limits<double>::infinity(), true);
      const auto own =
          make_ref<Functional>(grid, parse_expression(text, {}), kind, Parameter(0.3), 1);
      const WallSection section{0.37, {{-1.1, -2.3}, {3.2, 2.9}}, 1e-3};
      const LineGraph found = host->wall_lines(section), expected = own->wall_lines(section);
      assert_true(found.lines.size() > 100);
      assert_true(found.points.size() == expected.points.size() && found.lines == expected.lines);
      assert_memory_equal(found.points.data(), expected.points.data(),
                          found.points.size() * sizeof(Vec2));
      assert_true(host->thin_walls() == own->thin_walls());
    }
  const auto host = make_ref<HostFunction>(Neighbourhood{}, calls, true, Parameter(0.3), 1,
                                           std::numeric_limits<double>::infinity(), true);
  const auto own = make_ref<Functional>(Neighbourhood{}, parse_expression(text, {}),
                                        FunctionalKind::sheet, Parameter(0.3), 1);
  assert_true(mean_line_density(*host) == mean_line_density(*own));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_functions_of_the_host)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
