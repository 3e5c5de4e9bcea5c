// SPDX-License-Identifier: Apache-2.0
// The struts of foams against the dual of a global Delaunay triangulation, and joints that are the
// same whichever brick leads to them.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "foam_diagram.h"
#include "msq_test.h"
#include "structure/common/struts.h"
#include "structure/foam/foam.h"
#include "structure/foam/joints/joint.h"

using namespace msq;
using namespace msq::test;

namespace {

std::vector<Strut> struts_of(const Structure& foam, const Box3& box) {
  const std::unique_ptr<StrutParts> parts = foam.struts({box, true});
  StrutList list;
  for (uint64_t i = 0; i < parts->count(); ++i) parts->append(i, list);
  return list.struts;
}

Ref<const Structure> make_foam(uint64_t seed, double jitter, Vec3 scale,
                               Parameter density = Parameter(1)) {
  static const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return make_ref<Foam>(context, Neighbourhood{{}, scale, {}}, Parameter(0.05), jitter, seed,
                        FoamMethod::automatic, std::move(density));
}

void check(uint64_t seed, double jitter, Vec3 scale, double tolerance) {
  const FoamSeeds seeds(seed, jitter, scale);
  const Box3 box{{-1, -1.1, -0.9}, {1.2, 1, 1.1}};
  const std::vector<Strut> struts = struts_of(*make_foam(seed, jitter, scale), box);
  size_t wanted = 0;
  // The edges of the box do not depend on seeds beyond this.
  std::array<int, 3> half;
  for (int axis = 0; axis < 3; ++axis)
    half[static_cast<size_t>(axis)] =
        static_cast<int>(std::ceil((1.2 + 2 * seeds.empty_radius()) / scale[axis])) + 1;
  for (const DiagramEdge& e : foam_diagram(seeds, half)) {
    const Vec3 middle = (e.a + e.b) * 0.5;
    if (!box.contains(middle)) continue;
    // At the border, rounding decides.
    bool is_at_border = false;
    for (int axis = 0; axis < 3; ++axis)
      is_at_border = is_at_border || std::min(std::abs(middle[axis] - box.min[axis]),
                                              std::abs(middle[axis] - box.max[axis])) < 1e-6;
    assert_false(is_at_border);
    ++wanted;
    const bool is_found = std::any_of(struts.begin(), struts.end(), [&](const Strut& s) {
      const double same = std::max(max_magnitude(s.a - e.a), max_magnitude(s.b - e.b));
      const double turned = std::max(max_magnitude(s.a - e.b), max_magnitude(s.b - e.a));
      return std::min(same, turned) <= tolerance && s.cell == e.owner;
    });
    if (!is_found)
      fail_msg("the edge from (%.17g, %.17g, %.17g) to (%.17g, %.17g, %.17g) is missing", e.a.x,
               e.a.y, e.a.z, e.b.x, e.b.y, e.b.z);
  }
  assert_int_equal(struts.size(), wanted);
  assert_true(wanted > 20);
}

void struts_are_those_of_a_global_diagram(void**) {
  for (uint64_t seed = 1; seed <= 4; ++seed) check(seed, 1, {1, 1, 1}, 1e-10);
  check(5, 0.5, {1, 1, 1}, 1e-10);
  check(6, 1, {1, 0.5, 0.75}, 1e-10);
  check(7, 0.7, {0.25, 1, 1}, 1e-9);
  check(8, 0.01, {1, 1, 1}, 1e-8);
  check(9, 1e-4, {0.9, 0.7, 1}, 1e-6);
  check(10, 1e-5, {0.9, 0.7, 1}, 1e-5);
}

/// Four struts meet in each joint, in the foam's interior.
void check_degrees(const Structure& foam, double half, size_t degree, size_t min_nodes) {
  struct Node {
    Vec3 at;
    size_t struts = 0;
  };
  std::map<Id, Node> nodes;
  for (const Strut& s : struts_of(foam, Box3{{-half, -half, -half}, {half, half, half}}))
    for (int end = 0; end < 2; ++end) {
      Node& node = nodes[s.nodes[end]];
      node.at = end ? s.b : s.a;
      ++node.struts;
    }
  size_t inner = 0;
  for (const auto& [id, node] : nodes) {
    if (max_magnitude(node.at) > half - 1.8) continue;  // edges are shorter than 3.5
    ++inner;
    if (node.struts != degree)
      fail_msg("%zu struts meet at (%.17g, %.17g, %.17g)", node.struts, node.at.x, node.at.y,
               node.at.z);
  }
  assert_true(inner >= min_nodes);
}

void four_struts_meet(void**) {
  const double half = test_scale() < 0.5 ? 4 : 5;
  for (const double jitter : {1.0, 0.3, 0.001})
    check_degrees(*make_foam(11, jitter, {1, 1, 1}), half, 4, 200);
  check_degrees(*make_foam(12, 1, {1, 0.3, 0.6}), 4, 4, 200);
  check_degrees(*make_foam(13, 1, {1, 1, 1}, Parameter(20)), 3, 4, 500);
}

void seeds_at_centres_make_a_cubic_lattice(void**) {
  check_degrees(*make_foam(1, 0, {1, 1, 1}), 5, 6, 200);
  check_degrees(*make_foam(1, 0, {1, 0.3, 0.7}), 4, 6, 200);
  // Cells of 2^3 leaves with seeds at their centres.
  check_degrees(*make_foam(1, 0, {1, 1, 1}, Parameter(8)), 4, 6, 200);
}

void circumcentres_are_equally_far(void**) {
  Vec3 centre;
  assert_true(find_circumcentre({{{0, 0, 0}, 0}, {{2, 0, 0}, 0}, {{0, 4, 0}, 0}, {{0, 0, 6}, 0}},
                                centre) == 1);
  assert_true(max_magnitude(centre - Vec3{1, 2, 3}) < 1e-15);
  assert_true(find_circumcentre({{{0, 0, 0}, 0}, {{1, 0, 0}, 0}, {{0, 1, 0}, 0}, {{1, 1, 0}, 0}},
                                centre) == 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(circumcentres_are_equally_far),
      cmocka_unit_test(struts_are_those_of_a_global_diagram),
      cmocka_unit_test(four_struts_meet),
      cmocka_unit_test(seeds_at_centres_make_a_cubic_lattice),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
