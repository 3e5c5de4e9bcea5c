// SPDX-License-Identifier: Apache-2.0
// Functions as sums of products of waves: the sum in single precision is within its bound of the
// tape. Rows of turned grids have the bits of the definition, for all named functions and on every
// instruction set.
#include "structure/functional/wave_products.h"

#include <hwy/highway.h>

#include "bit_rows.h"
#include "expression/parser.h"
#include "field/gradient.h"
#include "msq_test.h"
#include "random.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "structure/functional/trigonometric_form.h"

using namespace msq;
using namespace msq::test;

namespace {

Rotation any_rotation(Random& random) {
  const double a = random.between(0, 7), b = random.between(0, 7), c = std::cos(a), s = std::sin(a),
               d = std::cos(b), t = std::sin(b);
  return {{c, -s * d, s * t, s, c * d, -c * t, 0, t, d}};
}

/// The sum at angles `step` from `start`, in single precision where the kernels are.
float sum_at(const TrigonometricForm& form, Vec3 start, Vec3 step) {
  const WaveProducts& products = *form.products();
  const auto part_of = [&](WaveProducts::Part part, Vec3 angles) {
    const TrigonometricForm::Wave& wave = form.waves()[part / 2];
    const double angle = wave.frequency * angles[wave.axis];
    return part % 2 ? std::cos(angle) : std::sin(angle);
  };
  auto value = static_cast<float>(products.constant());
  for (const WaveProducts::Function& function : products.functions()) {
    double distance = 1;
    for (const WaveProducts::Part part : function.parts) distance *= part_of(part, step);
    float coefficient = 0;
    for (const WaveProducts::Product& product : function.coefficient) {
      auto term = static_cast<float>(product.factor);
      for (const WaveProducts::Part part : product.parts)
        term *= static_cast<float>(part_of(part, start));
      coefficient += term;
    }
    value += coefficient * static_cast<float>(distance);
  }
  return products.is_absolute() ? std::abs(value) : value;
}

void sums_are_within_their_bound(void**) {
  Random random(1);
  size_t with_products = 0;
  for (const char* expression : preset_expressions)
    for (const bool is_sheet : {false, true}) {
      const std::string text = expression;
      const Tape tape = parse_expression(is_sheet ? "abs(" + text + ")" : text, {});
      const std::optional<TrigonometricForm> form = TrigonometricForm::of(tape);
      if (!form || !form->products()) continue;
      ++with_products;
      const double slack = form->products()->slack(0x1p-45);
      assert_true(slack < 1e-3);
      double most = 0;
      for (size_t n = test_count(3000); n > 0; --n) {
        const Vec3 start = random.in_box({{0, 0, 0}, {6.3, 6.3, 6.3}}),
                   step = random.in_box({{-7, -7, -7}, {7, 7, 7}});
        most = std::max(most, std::abs(sum_at(*form, start, step) - evaluate(tape, start + step)));
      }
      if (most > slack) fail_msg("%s: %g, not %g", expression, most, slack);
      assert_true(most > slack / 200);
    }
  assert_in_range(with_products, 20, 40);
}

void others_are_no_such_sums(void**) {
  for (const char* expression : {"min(sin(x),cos(y))", "sin(x)*cos(x)", "sin(x)*x", "sin(x)^2",
                                 "abs(sin(x))+cos(y)", "sqrt(2+sin(x))"}) {
    const std::optional<TrigonometricForm> form =
        TrigonometricForm::of(parse_expression(expression, {}));
    if (form && form->products()) fail_msg("%s is one", expression);
  }
  const auto gyroid = TrigonometricForm::of(parse_expression(preset_expressions[0], {}));
  assert_int_equal(gyroid->products()->functions().size(), 12);
}

/// Returns the number of samples inside.
size_t check_rows(const char* name, const Functional& structure, const SampleGrid& grid) {
  BitRows rows(grid);
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      if (j + k > 0) set_bits(rows.block().row(j, k), 5 * j, grid.nx - 1);
  structure.keep_rows(rows.block(), nullptr);
  assert_int_equal(rows.damage(), 0);
  size_t held = 0;
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) {
        const bool expected = j + k > 0 && i >= 5 * j && structure.inside(grid.at(i, j, k));
        held += expected;
        if (rows.get(i, j, k) != expected)
          fail_msg("%s: sample %d, %d, %d is %d", name, int(i), int(j), int(k), !expected);
      }
  return held;
}

void rows_have_the_bits_of_points(void**) {
  Random random(2);
  size_t held = 0, all_samples = 0;
  const auto gradient = make_ref<GradientField>(Vec3{0, 0, 0}, -0.3, Vec3{1, 1, 1}, 0.3);
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    for (const char* expression : preset_expressions)
      for (const FunctionalKind kind : {FunctionalKind::network, FunctionalKind::sheet})
        for (const bool is_graded : {false, true}) {
          const double size = random.between(0.05, 0.4);
          const Parameter level = is_graded ? Parameter(Ref<const Field>(gradient))
                                            : Parameter(random.between(0.05, 0.3));
          const Functional structure(Neighbourhood{random.in_box({{-1, -1, -1}, {1, 1, 1}}),
                                                   {size, size, 1.1 * size},
                                                   any_rotation(random)},
                                     parse_expression(expression, {}), kind, level, 0);
          SampleGrid grid;
          grid.origin = random.in_box({{-1, -1, -1}, {1, 1, 1}});
          grid.spacing = {random.between(0.002, 0.02), 0.017, 0.013};
          grid.nx = 100 + random.below(200);
          grid.ny = 19;
          grid.nz = 5;
          held += check_rows(expression, structure, grid);
          all_samples += grid.nx * grid.ny * grid.nz;
        }
    hwy::SetSupportedTargetsForTest(0);
  }
  assert_in_range(held, all_samples / 10, all_samples * 9 / 10);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(sums_are_within_their_bound),
      cmocka_unit_test(others_are_no_such_sums),
      cmocka_unit_test(rows_have_the_bits_of_points),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
