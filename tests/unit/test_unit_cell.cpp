// SPDX-License-Identifier: Apache-2.0
// Unit cells: each strut of the tiling comes once.
#include "msq_test.h"
#include "structure/lattice/unit_cell.h"

using namespace msq;

namespace {

void check(UnitCell cell, size_t struts, double length_each) {
  const std::vector<PeriodicStrut> periodic = periodic_struts(cell);
  assert_int_equal(periodic.size(), struts);
  for (const PeriodicStrut& s : periodic) {
    assert_true(std::abs(length(s.b - s.a) - length_each) < 1e-12);
    for (int axis = 0; axis < 3; ++axis) assert_true(s.a[axis] >= -1e-9 && s.a[axis] < 1);
  }
  // No two are whole cells apart, either way round.
  for (size_t i = 0; i < periodic.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      for (bool is_turned : {false, true}) {
        const Vec3 a = is_turned ? periodic[j].b : periodic[j].a,
                   b = is_turned ? periodic[j].a : periodic[j].b;
        const Vec3 shift = periodic[i].a - a;
        const Vec3 whole{std::round(shift.x), std::round(shift.y), std::round(shift.z)};
        assert_false(max_magnitude(shift - whole) < 1e-9 &&
                     max_magnitude(periodic[i].b - b - whole) < 1e-9);
      }
}

void test_cubic(void**) {
  check(cubic_unit_cell(), 3, 1);
}
void test_bcc(void**) {
  check(bcc_unit_cell(), 8, std::sqrt(0.75));
}
void test_octet(void**) {
  check(octet_unit_cell(), 24, std::sqrt(0.5));
}

void test_custom(void**) {
  UnitCell cell;
  // A strut inside; the same turned round; the same by another pair of equal nodes; one on a face
  // and its copy on the opposite face; one across the whole cell.
  cell.nodes = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}, {0.25, 0.5, 0.5}, {0, 0.2, 0.2}, {0, 0.8, 0.2},
                {1, 0.2, 0.2},    {1, 0.8, 0.2},    {0, 0.5, 0.1},    {1, 0.5, 0.1}};
  cell.struts = {{0, 1}, {1, 0}, {2, 1}, {3, 4}, {6, 5}, {7, 8}};
  assert_int_equal(periodic_struts(cell).size(), 3);
  // Equal but for rounding.
  cell.nodes = {{0.1, 0, 0}, {0.1 + 1e-12, 1, 0}, {0.1, 0, 1}, {0.1, 1, 1 - 1e-12}};
  cell.struts = {{0, 1}, {3, 2}};
  assert_int_equal(periodic_struts(cell).size(), 1);
}

void test_factors(void**) {
  UnitCell cell;
  // Two copies of one strut, the second thicker and turned round; and one that is thicker still.
  cell.nodes = {{0, 0.2, 0.2}, {0, 0.8, 0.2}, {1, 0.2, 0.2}, {1, 0.8, 0.2}, {0.5, 0.5, 0.5}};
  cell.struts = {{0, 1}, {3, 2}, {0, 4}};
  cell.factors = {0.5, 2, 3};
  const std::vector<PeriodicStrut> struts = periodic_struts(cell);
  assert_int_equal(struts.size(), 2);
  assert_true(struts[0].factor == 3 && struts[1].factor == 2);
  cell.factors.clear();
  for (const PeriodicStrut& s : periodic_struts(cell)) assert_true(s.factor == 1);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_cubic), cmocka_unit_test(test_bcc),
                              cmocka_unit_test(test_octet), cmocka_unit_test(test_custom),
                              cmocka_unit_test(test_factors)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
