// SPDX-License-Identifier: Apache-2.0
// Unit cells: each strut of the tiling comes once; the named ones are what they should be, by their
// geometry (derived).
#include <algorithm>
#include <map>
#include <set>

#include "msq_test.h"
#include "structure/lattice/cell/unit_cell.h"

using namespace msq;

namespace {

/// Within whole cells of 0.
bool is_whole(Vec3 v) {
  return max_magnitude(v - Vec3{std::round(v.x), std::round(v.y), std::round(v.z)}) < 1e-9;
}

/// Whether two struts are whole cells apart, either way round.
bool is_same(const PeriodicStrut& s, const PeriodicStrut& t) {
  for (const auto& [a, b] : {std::pair{t.a, t.b}, std::pair{t.b, t.a}})
    if (is_whole(s.a - a) && max_magnitude((s.b - s.a) - (b - a)) < 1e-9) return true;
  return false;
}

/// How many nodes of the tiling a cell has for each number of struts that meet there.
std::map<int, int> degrees(const std::vector<PeriodicStrut>& struts) {
  std::vector<std::pair<Vec3, int>> nodes;
  for (const PeriodicStrut& s : struts)
    for (const Vec3& end : {s.a, s.b}) {
      const auto known = std::find_if(nodes.begin(), nodes.end(),
                                      [&](const auto& node) { return is_whole(node.first - end); });
      if (known == nodes.end())
        nodes.push_back({end, 1});
      else
        ++known->second;
    }
  std::map<int, int> count;
  for (const auto& [node, degree] : nodes) ++count[degree];
  return count;
}

/// An affine map of the cell: coordinates in another order, some turned round, and moved.
struct Symmetry {
  int axes[3];
  Vec3 sign, shift;
  Vec3 operator()(Vec3 p) const { return Vec3{p[axes[0]], p[axes[1]], p[axes[2]]} * sign + shift; }
};
const Symmetry cyclic{{1, 2, 0}, {1, 1, 1}, {}}, swap{{1, 0, 2}, {1, 1, 1}, {}},
    mirror_x{{0, 1, 2}, {-1, 1, 1}, {}}, mirror_z{{0, 1, 2}, {1, 1, -1}, {}},
    half_turn{{0, 1, 2}, {-1, -1, 1}, {}},
    quarter_inversion{{0, 1, 2}, {-1, -1, -1}, {0.25, 0.25, 0.25}};

struct Preset {
  const char* name;
  UnitCell cell;
  size_t struts;
  std::vector<double> lengths;  ///< that occur
  double total;                 ///< length a cell
  std::map<int, int> degrees;
  std::vector<Symmetry> symmetries;  ///< of the tiling, that generate its group about the origin
};

const double root2 = std::sqrt(2.0), root3 = std::sqrt(3.0), root5 = std::sqrt(5.0);
const std::vector<Symmetry> cubic = {cyclic, swap, mirror_x};
const Preset presets[] = {
    {"cubic", cubic_unit_cell(), 3, {1}, 3, {{6, 1}}, cubic},
    {"BCC", bcc_unit_cell(), 8, {root3 / 2}, 4 * root3, {{8, 2}}, cubic},
    {"octet", octet_unit_cell(), 24, {root2 / 2}, 12 * root2, {{12, 4}}, cubic},
    {"FCC", fcc_unit_cell(), 12, {root2 / 2}, 6 * root2, {{12, 1}, {4, 3}}, cubic},
    {"Kelvin", kelvin_unit_cell(), 24, {root2 / 4}, 6 * root2, {{4, 12}}, cubic},
    {"diamond",
     diamond_unit_cell(),
     16,
     {root3 / 4},
     4 * root3,
     {{4, 8}},
     {cyclic, swap, half_turn, quarter_inversion}},
    {"rhombic dodecahedron",
     rhombic_dodecahedron_unit_cell(),
     32,
     {root3 / 4},
     8 * root3,
     {{4, 8}, {8, 4}},
     cubic},
    {"re-entrant",
     reentrant_unit_cell(),
     22,
     {0.75, 0.375, root5 / 4},
     3 + 4 * root5,
     {{5, 8}, {2, 2}},
     {swap, mirror_x, mirror_z, {{0, 1, 2}, {1, 1, 1}, {0.5, 0.5, 0}}}},
};

void test_presets(void**) {
  for (const Preset& preset : presets) {
    print_message("%s\n", preset.name);
    for (const Vec3& node : preset.cell.nodes)
      assert_true((Box3{{0, 0, 0}, {1, 1, 1}}).contains(node));
    const std::vector<PeriodicStrut> struts = periodic_struts(preset.cell);
    assert_int_equal(struts.size(), preset.struts);
    double total = 0;
    std::set<size_t> lengths;
    for (const PeriodicStrut& s : struts) {
      const double l = length(s.b - s.a);
      const auto known = std::find_if(preset.lengths.begin(), preset.lengths.end(),
                                      [&](double wanted) { return std::abs(l - wanted) < 1e-12; });
      assert_true(known != preset.lengths.end());
      lengths.insert(static_cast<size_t>(known - preset.lengths.begin()));
      total += l;
      for (int axis = 0; axis < 3; ++axis) assert_true(s.a[axis] >= -1e-9 && s.a[axis] < 1);
    }
    assert_int_equal(lengths.size(), preset.lengths.size());
    assert_true(std::abs(total - preset.total) < 1e-12);
    assert_true(degrees(struts) == preset.degrees);
    for (size_t i = 0; i < struts.size(); ++i)
      for (size_t j = 0; j < i; ++j) assert_false(is_same(struts[i], struts[j]));
    for (const Symmetry& symmetry : preset.symmetries)
      for (const PeriodicStrut& s : struts) {
        const PeriodicStrut image{symmetry(s.a), symmetry(s.b)};
        assert_true(std::any_of(struts.begin(), struts.end(),
                                [&](const PeriodicStrut& other) { return is_same(image, other); }));
      }
  }
}

void test_custom(void**) {
  UnitCell cell;
  // A strut inside; the same turned round; the same by another pair of equal nodes; one on a face
  // and its copy on the opposite face; one across the whole cell.
  cell.nodes = {{0.25, 0.5, 0.5}, {0.75, 0.5, 0.5}, {0.25, 0.5, 0.5}, {0, 0.2, 0.2}, {0, 0.8, 0.2},
                {1, 0.2, 0.2},    {1, 0.8, 0.2},    {0, 0.5, 0.1},    {1, 0.5, 0.1}};
  cell.struts = {{0, 1}, {1, 0}, {2, 1}, {3, 4}, {6, 5}, {7, 8}};
  assert_int_equal(periodic_struts(cell).size(), 3);
  // Equal except for rounding.
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
  const CMUnitTest tests[] = {cmocka_unit_test(test_presets), cmocka_unit_test(test_custom),
                              cmocka_unit_test(test_factors)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
