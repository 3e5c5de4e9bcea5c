// SPDX-License-Identifier: Apache-2.0
// Bounds of slopes hold for pairs of points, near and far, and are near the greatest slope that
// samples find; bounds of rounding hold against extended precision; functions that repeat are
// known.
#include <cmath>

#include "expression/parser.h"
#include "expression/period.h"
#include "expression/slope.h"
#include "random.h"
#include "structure/functional/presets.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr Interval cell[3] = {{0, two_pi}, {0, two_pi}, {0, two_pi}};

using Real = long double;

/// The tape in extended precision, which stands for exact arithmetic.
Real exact(const Tape& tape, const Real (&at)[3]) {
  std::vector<Real> v;
  for (const Node& node : tape.nodes) {
    const Real a = node.op >= Op::add ? v[node.a] : 0,
               b = has_two_operands(node.op) ? v[node.b] : 0;
    switch (node.op) {
      case Op::constant:
        v.push_back(node.value);
        break;
      case Op::x:
      case Op::y:
      case Op::z:
        v.push_back(at[static_cast<int>(node.op) - static_cast<int>(Op::x)]);
        break;
      case Op::add:
        v.push_back(a + b);
        break;
      case Op::subtract:
        v.push_back(a - b);
        break;
      case Op::multiply:
        v.push_back(a * b);
        break;
      case Op::divide:
        v.push_back(a / b);
        break;
      case Op::minimum:
        v.push_back(std::min(a, b));
        break;
      case Op::maximum:
        v.push_back(std::max(a, b));
        break;
      case Op::negate:
        v.push_back(-a);
        break;
      case Op::absolute:
        v.push_back(std::abs(a));
        break;
      case Op::square_root:
        v.push_back(std::sqrt(a));
        break;
      case Op::sine:
        v.push_back(std::sin(a));
        break;
      case Op::cosine:
        v.push_back(std::cos(a));
        break;
      case Op::exponential:
        v.push_back(std::exp(a));
        break;
      case Op::logarithm:
        v.push_back(std::log(a));
        break;
      case Op::tangent_hyperbolic:
        v.push_back(std::tanh(a));
        break;
      case Op::floor:
        v.push_back(std::floor(a));
        break;
      case Op::arctangent:
        v.push_back(std::atan2(a, b));
        break;
      case Op::hypotenuse:
        v.push_back(std::hypot(a, b));
        break;
      case Op::less:
        v.push_back(a < b);
        break;
      case Op::keep:
        v.push_back(a > 0.5L ? b : 0);
        break;
      case Op::drop:
        v.push_back(a > 0.5L ? 0 : b);
        break;
    }
  }
  return v.back();
}

std::vector<std::string> texts() {
  std::vector<std::string> all(std::begin(preset_expressions), std::end(preset_expressions));
  for (const char* text : {"x",
                           "x*y*z",
                           "x/(y+1)",
                           "min(sin(x), cos(y)*z)",
                           "max(x*x, abs(y-3))",
                           "abs(sin(3*x))-y",
                           "sqrt(1+x*y)",
                           "exp(sin(x)*y/4)",
                           "log(1.5+cos(x)*cos(y))",
                           "1/(2+sin(x+2*y-z))^3",
                           "exp(-x*x-y*y)*cos(20*z)",
                           "(1e6+x)-1e6",
                           "sin(1e4*x)",
                           "tanh(3*sin(x))*y",
                           "hypot(x-3,y-3)-z",
                           "hypot(sin(x),hypot(cos(y),z))",
                           "atan2(y+1,x-3)",
                           "atan2(sin(z),1.5+cos(x))",
                           "floor(x/7+0.05)+y",
                           "mod(x+1,8)*z",
                           "select(x<7,y*z,z)",
                           "select(x>7,y*z,sin(z))",
                           "round(0.1*sin(x))+z",
                           "(x<=9)*y+(x==9)"})
    all.push_back(text);
  return all;
}

void slopes_hold(void**) {
  const Vec3 scale{1, 0.5, 2};
  for (const std::string& text : texts()) {
    const Tape tape = parse_expression(text, {});
    const Slope slope = bound_slope(tape, cell, scale, 0);
    assert_true(std::isfinite(slope.most));
    Random random(5);
    Real steepest = 0;
    for (size_t i = test_count(40000); i > 0; --i) {
      const Vec3 p = random.in_box({{0, 0, 0}, {two_pi, two_pi, two_pi}});
      const Vec3 to = random.in_box({{0, 0, 0}, {two_pi, two_pi, two_pi}});
      // Near ones for the slope, far ones for what lies between.
      const Real step = i % 4 ? Real(1e-4) : Real(random.unit());
      Real a[3], b[3], squared = 0;
      for (int k = 0; k < 3; ++k) {
        a[k] = p[k];
        b[k] = a[k] + step * (to[k] - p[k]);
        const Real d = (b[k] - a[k]) / Real(scale[k]);
        squared += d * d;
      }
      const Real rate = std::abs(exact(tape, a) - exact(tape, b)) / std::sqrt(squared);
      steepest = std::max(steepest, rate);
    }
    if (steepest > Real(slope.most) * (1 + 1e-12L))
      fail_msg("%s: slope %.12Lg, bound %.12g", text.c_str(), steepest, slope.most);
  }
}

void slopes_are_near(void**) {
  const auto is = [](const char* text, double wanted) {
    const double got = bound_slope(parse_expression(text, {}), cell, {1, 1, 1}, 0).most;
    if (!(got >= wanted * (1 - 1e-12) && got <= 1.05 * wanted))
      fail_msg("%s: slope %.9g, not %.9g", text, got, wanted);
  };
  is("2*x-3", 2);
  is("cos(x)+cos(y)+cos(z)", std::sqrt(3));
  is("sin(x)*sin(y)*sin(z)", 1);
  is("abs(3*x-4*z)", 5);
  is("min(x, 2*y)", std::sqrt(5));  // the least box about both gradients
  is("sqrt(x+1)", 0.5);
  is("log(x+0.5)", 2);
  is("exp(x)", std::exp(two_pi));
  is("1/(1+x)", 1);
  is("tanh(x)", 1);
  is("atan2(y-8,x-8)", 1 / std::hypot(8 - two_pi, 8 - two_pi));
  is("select(x<9,2*x,5*y)", 2);
}

void what_is_not_bounded(void**) {
  for (const char* text : {"1/x",
                           "sqrt(x)",
                           "log(x)",
                           "sqrt(sin(x))",
                           "1/sin(x+0.1)",
                           "sqrt(x-1)",
                           "0/x",
                           "exp(1000*x)",
                           "min(1, 1/(x-y))",
                           "min(sqrt(x-4), 0.5)",
                           "min(0.5, sqrt(x-4))",
                           "max(log(y-1), x)",
                           "max(x, log(y-1))",
                           "0/(x-x)",
                           "min(0/0, x)",
                           "log(-1-x)",
                           "floor(x)",
                           "round(sin(x))",
                           "mod(x,3)",
                           "x<3",
                           "x==3",
                           "select(x<3,1,2)",
                           "atan2(y-3,x-3)",
                           "atan2(y-3,-1-x)",
                           "atan2(x,y)",
                           "select(x<9,y,sqrt(-x))",
                           "x^0.5",
                           "sin(1e7*x)"})
    if (std::isfinite(bound_slope(parse_expression(text, {}), cell, {1, 1, 1}, 0).most))
      fail_msg("%s has a bound", text);
}

void errors_hold(void**) {
  for (const std::string& text : texts())
    for (double coordinate_error : {0.0, 1e-9}) {
      const Tape tape = parse_expression(text, {});
      const Slope slope = bound_slope(tape, cell, {1, 1, 1}, coordinate_error);
      Random random(9);
      Real worst = 0;
      for (size_t i = test_count(10000); i > 0; --i) {
        const Vec3 p = random.in_box({{0, 0, 0}, {two_pi, two_pi, two_pi}});
        const Real at[3] = {p.x + coordinate_error * random.between(-1, 1),
                            p.y + coordinate_error * random.between(-1, 1),
                            p.z + coordinate_error * random.between(-1, 1)};
        worst = std::max(worst, std::abs(exact(tape, at) - Real(evaluate(tape, p))));
      }
      if (!(worst <= Real(slope.error)))
        fail_msg("%s: error %.3Lg, bound %.3g", text.c_str(), worst, slope.error);
    }
}

void functions_repeat(void**) {
  const auto is = [](const char* text, bool x, bool y, bool z) {
    const std::array<bool, 3> got = repeats(parse_expression(text, {}));
    if (got[0] != x || got[1] != y || got[2] != z)
      fail_msg("%s: %d %d %d", text, got[0], got[1], got[2]);
  };
  for (const char* preset : preset_expressions) is(preset, true, true, true);
  is("1", true, true, true);
  is("x", false, true, true);
  is("x-x", true, true, true);
  is("x-y", false, false, true);
  is("sin(2*x-3*y)+cos(z*4)", true, true, true);
  is("sin(x/2)", false, true, true);
  is("sin(0.5*x*2)", true, true, true);
  is("sin(0.1*x)", false, true, true);
  is("sin(0.1*x*10)", false, true, true);
  is("abs(sin(-x))*exp(cos(y))/min(z, 2)", true, true, false);
  is("sin(x*y)", false, false, true);
  is("cos(x+0.3)^3", true, true, true);
  is("sin(x+sin(y))", true, true, true);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(slopes_hold), cmocka_unit_test(slopes_are_near),
                              cmocka_unit_test(what_is_not_bounded), cmocka_unit_test(errors_hold),
                              cmocka_unit_test(functions_repeat)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
