// SPDX-License-Identifier: Apache-2.0
// Sines, cosines, exponentials and logarithms of tapes: near the true values, in extended
// precision, and the same bits from vectors of every instruction set as from the scalar evaluator.
#include <hwy/highway.h>

#include <cstring>
#include <limits>

#include "random.h"
#include "structure/functional/row_kernels.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

constexpr Op all_ops[] = {Op::add,
                          Op::subtract,
                          Op::multiply,
                          Op::divide,
                          Op::minimum,
                          Op::maximum,
                          Op::negate,
                          Op::absolute,
                          Op::square_root,
                          Op::sine,
                          Op::cosine,
                          Op::exponential,
                          Op::logarithm,
                          Op::arctangent,
                          Op::hypotenuse,
                          Op::less,
                          Op::keep,
                          Op::drop,
                          Op::tangent_hyperbolic,
                          Op::floor};

using Real = long double;

/// The greatest error of an operation over random numbers: of the result's magnitude, or of 1 if
/// that is less and `is_absolute`.
double worst_error(Op op, Real (*truth)(Real), double low, double high, bool is_absolute) {
  Random random(static_cast<uint64_t>(op));
  double worst = 0;
  for (size_t i = test_count(300000); i > 0; --i) {
    const double x = random.between(low, high), got = apply(op, x, 0);
    const Real wanted = truth(x);
    const Real unit = is_absolute ? 1 : std::abs(wanted);
    worst = std::max(worst, static_cast<double>(std::abs(got - wanted) / unit));
  }
  return worst;
}

void values_are_near_the_true_ones(void**) {
  struct Case {
    Op op;
    Real (*truth)(Real);
    double low, high;
    bool is_absolute;
  };
  const Case cases[] = {
      {Op::sine, std::sin, 0, two_pi, true},
      {Op::sine, std::sin, -1e-3, 1e-3, false},
      {Op::sine, std::sin, -0x1p19, 0x1p19, true},
      {Op::cosine, std::cos, 0, two_pi, true},
      {Op::cosine, std::cos, -100, 100, true},
      {Op::cosine, std::cos, -0x1p19, 0x1p19, true},
      {Op::exponential, std::exp, -1, 1, false},
      {Op::exponential, std::exp, -700, 700, false},
      {Op::logarithm, std::log, 1e-10, 2, true},
      {Op::logarithm, std::log, 0.9, 1.1, false},
      {Op::logarithm, std::log, 2, 1e300, false},
      {Op::tangent_hyperbolic, std::tanh, -3, 3, true},
      {Op::tangent_hyperbolic, std::tanh, -40, 40, true},
  };
  for (const Case& c : cases) {
    const double worst = worst_error(c.op, c.truth, c.low, c.high, c.is_absolute);
    print_message("operation %d from %g to %g: error up to %.3g\n", static_cast<int>(c.op), c.low,
                  c.high, worst);
    assert_true(worst < 0x1p-50);
  }
}

void angles_are_near_the_true_ones(void**) {
  Random random(17);
  double worst = 0;
  for (size_t i = test_count(600000); i > 0; --i) {
    const double scale = std::exp2(random.between(-60, 60));
    const double y = random.between(-1, 1) * (i % 2 ? scale : 1), x = random.between(-1, 1);
    const Real wanted = std::atan2(Real(y), Real(x));
    const double got = apply(Op::arctangent, y, x);
    worst = std::max(worst, static_cast<double>(std::abs(got - wanted)));
    if (std::abs(y) < std::abs(x) && x > 0)  // relative to small angles
      assert_true(std::abs(got - wanted) <= 0x1p-50L * std::abs(wanted));
  }
  print_message("angles: error up to %.3g\n", worst);
  assert_true(worst < 0x1p-49);
}

void special_values(void**) {
  const auto is = [](double got, double wanted) {
    assert_true(got == wanted || (std::isnan(got) && std::isnan(wanted)));
  };
  is(apply(Op::sine, 0, 0), 0);
  is(apply(Op::cosine, 0, 0), 1);
  is(apply(Op::sine, infinity, 0), nan);
  is(apply(Op::cosine, nan, 0), nan);
  is(apply(Op::exponential, 0, 0), 1);
  is(apply(Op::exponential, 1e300, 0), infinity);
  is(apply(Op::exponential, infinity, 0), infinity);
  is(apply(Op::exponential, -infinity, 0), 0);
  is(apply(Op::exponential, -1e4, 0), 0);
  is(apply(Op::exponential, nan, 0), nan);
  is(apply(Op::logarithm, 1, 0), 0);
  is(apply(Op::logarithm, 0, 0), -infinity);
  is(apply(Op::logarithm, -1, 0), nan);
  is(apply(Op::logarithm, -infinity, 0), nan);
  is(apply(Op::logarithm, infinity, 0), infinity);
  is(apply(Op::logarithm, nan, 0), nan);
  is(apply(Op::arctangent, 0, 0), 0);
  is(apply(Op::arctangent, 1, infinity), 0);
  is(apply(Op::arctangent, nan, 1), nan);
  is(apply(Op::hypotenuse, infinity, 1), infinity);
  is(apply(Op::tangent_hyperbolic, infinity, 0), 1);
  is(apply(Op::tangent_hyperbolic, -infinity, 0), -1);
  is(apply(Op::floor, -infinity, 0), -infinity);
  is(apply(Op::less, 1, infinity), 1);
  assert_true(std::abs(apply(Op::logarithm, 0x1p-1074, 0) - std::log(0x1p-1074)) < 1e-12);
  assert_true(std::abs(apply(Op::exponential, -744, 0) / 0x1p-1074 - 2) < 1);
  // Huge arguments have no accuracy left, but a sine they have.
  for (double x : {1e9, 1e17, 1e100, 1e300})
    for (Op op : {Op::sine, Op::cosine}) assert_true(std::abs(apply(op, x, 0)) <= 1 + 0x1p-50);
}

/// Numbers of all kinds.
double odd_number(Random& random) {
  const double special[] = {0.0, -0.0, 1, -1, infinity, -infinity, nan, 0x1p-1074, 1e308, 0.5};
  switch (random.below(5)) {
    case 0:
      return special[random.below(std::size(special))];
    case 1:
      return random.between(-10, 10);
    case 2:
      return random.between(-1e5, 1e5);
    case 3:
      return two_pi / 8 * static_cast<double>(random.below(17));
    default: {
      const uint64_t bits = random.bits();
      double v;
      std::memcpy(&v, &bits, sizeof v);
      return v;
    }
  }
}

bool same_bits(double a, double b) {
  return std::isnan(a) ? std::isnan(b) : std::memcmp(&a, &b, sizeof a) == 0;
}

void all_instruction_sets_give_the_scalar_bits(void**) {
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    const int64_t target = all & -all;
    hwy::SetSupportedTargetsForTest(target);
    Random random(5);
    for (Op op : all_ops)
      for (size_t round = test_count(200); round > 0; --round) {
        double a[batch_points + batch_padding] = {}, b[batch_points + batch_padding] = {};
        for (size_t i = 0; i < batch_points; ++i) {
          a[i] = odd_number(random);
          b[i] = odd_number(random);
        }
        const bool a_uniform = round % 4 == 0, b_uniform = round % 3 == 0;
        const std::vector<Node> nodes = {{Op::x, 0, 0, 0}, {Op::y, 0, 0, 0}, {op, 0, 1, 0}};
        const Program program = compile(nodes, {0, 1}, {2});
        Batch batch(program);
        batch.set_input(0, {a, a_uniform});
        batch.set_input(1, {b, b_uniform});
        const size_t count = 1 + random.below(batch_points);
        batch.run(count);
        const Values got = batch.output(0);
        for (size_t i = 0; i < count; ++i) {
          const double p = a[a_uniform ? 0 : i], q = b[b_uniform ? 0 : i];
          if (!same_bits(got.data[i], apply(op, p, q)))
            fail_msg("%s, operation %d of %.17g and %.17g: %.17g, scalar %.17g",
                     hwy::TargetName(target), static_cast<int>(op), p, q, got.data[i],
                     apply(op, p, q));
        }
      }
    hwy::SetSupportedTargetsForTest(0);
    print_message("%s ", hwy::TargetName(target));
  }
  print_message("give the scalar bits\n");
}

void all_instruction_sets_find_the_same_angles(void**) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Neighbourhood grid{{0.3, -0.2, 1e3}, {0.7, 1.1, 0.01}, {{c, -s, 0, s, c, 0, 0, 0, 1}}};
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    Random random(6);
    double p[3][batch_points + batch_padding] = {}, angles[3][batch_points + batch_padding];
    for (auto& axis : p)
      for (size_t i = 0; i < batch_points; ++i) axis[i] = random.between(-50, 50);
    find_angles(grid, {p[0], false}, {p[1], true}, {p[2], false}, batch_points,
                {angles[0], angles[1], angles[2]});
    for (size_t i = 0; i < batch_points; ++i) {
      const Vec3 fraction = grid.locate({p[0][i], p[1][0], p[2][i]}).fraction;
      for (int axis = 0; axis < 3; ++axis)
        assert_true(same_bits(angles[axis][i], angle_of(fraction[axis])));
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(values_are_near_the_true_ones),
      cmocka_unit_test(angles_are_near_the_true_ones),
      cmocka_unit_test(special_values),
      cmocka_unit_test(all_instruction_sets_give_the_scalar_bits),
      cmocka_unit_test(all_instruction_sets_find_the_same_angles),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
