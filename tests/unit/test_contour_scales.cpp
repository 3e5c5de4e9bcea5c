// SPDX-License-Identifier: Apache-2.0
// Contours of a model that is larger or smaller by a power of two have the same rings, to the last
// bit: no product of lengths overflows or underflows.
#include <cmath>

#include "expression/parser.h"
#include "rings.h"
#include "sampled_maps.h"
#include "shape/primitive.h"
#include "slice/contours.h"
#include "structure/foam/foam.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/warped/sampled_places.h"
#include "structure/lattice/warped/warped_lattice.h"
#include "suite.h"

namespace msq::test {

namespace {

Ref<Context> context() {
  static const Ref<Context> shared = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return shared;
}

Neighbourhood cells(double unit) {
  return {Vec3{0.1, 0.2, 0.3} * unit, {unit, unit, unit}, {}};
}

Ref<const Structure> foam(double unit) {
  return make_ref<Foam>(context(), cells(unit), Parameter(0.08 * unit), 1.0, uint64_t{5},
                        FoamMethod::direct);
}

Ref<const Structure> lattice(double unit) {
  return make_ref<Lattice>(cells(unit), bcc_unit_cell(), Parameter(0.08 * unit));
}

Ref<const Structure> lattice_in_map(double unit) {
  constexpr int count = 5;
  constexpr double spacing = 1.5;
  std::vector<double> values[3];
  for (int k = 0; k < count; ++k)
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < count; ++i) {
        const Vec3 p{i * spacing - 1, j * spacing - 1, k * spacing - 1};
        values[0].push_back(p.x + 0.1 * std::sin(p.y));
        values[1].push_back(p.y + 0.1 * std::sin(p.z));
        values[2].push_back(p.z + 0.1 * std::sin(p.x));
      }
  const ImageFrame frame{Vec3{-1, -1, -1} * unit, Vec3{spacing, spacing, spacing} * unit, {}};
  const UnitCell cell = bcc_unit_cell();
  return make_ref<WarpedLattice>(
      context(),
      std::make_unique<const SampledPlaces>(make_map(frame, {count, count, count}, values), cell,
                                            context()->budget),
      cell, Parameter(0.08 * unit));
}

Ref<const Structure> gyroid(double unit) {
  return make_ref<Functional>(cells(unit), parse_expression(preset_expressions[0], {}),
                              FunctionalKind::network, Parameter(0.2), 8);
}

struct Row {
  std::string name;
  Ref<const Structure> (*structure)(double unit);
};

/// Coordinates in units.
Rings contours(const Row& row, int axis, double tolerance, double unit) {
  const Vec3 size = Vec3{4, 4, 4} * unit;
  const Ref<Model> model =
      make_ref<Model>(context(), make_ref<BoxShape>(Box3{{0, 0, 0}, size}),
                      std::vector<Model::ScaleParts>{Model::ScaleParts(row.structure(unit))});
  ContourPlan plan;
  plan.plane = {axis, 1.3 * unit};
  plan.tolerance = tolerance * unit;
  plan.pitch = 0.03125 * unit;
  plan.topology_samples = 2;
  Rings all =
      rings_of(reinterpret_cast<const msq_contours*>(layer_contours(*model, plan, nullptr).get()));
  all.pitch /= unit;
  for (auto& ring : all.rings)
    for (RingPoint& p : ring) p = {p.u / unit, p.v / unit};
  return all;
}

void test_scales(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  // At the finer one, gaps are divided.
  for (const double tolerance : {0.015625, 0.00234375})
    for (int axis = 0; axis < 3; ++axis) {
      const Rings wanted = contours(row, axis, tolerance, 1);
      check_rings(wanted);
      assert_true(wanted.rings.size() > 3);
      for (const int exponent : {-240, -200, 200, 240}) {
        const Rings all = contours(row, axis, tolerance, std::ldexp(1, exponent));
        if (all.rings.size() != wanted.rings.size())
          fail_msg("axis %d: %zu rings at 2^%d, %zu at 1", axis, all.rings.size(), exponent,
                   wanted.rings.size());
        if (!(all.rings == wanted.rings))
          fail_msg("axis %d: rings at 2^%d have other points than at 1", axis, exponent);
        assert_true(all.parents == wanted.parents && all.holes == wanted.holes);
        assert_int_equal(all.unresolved, wanted.unresolved);
        assert_int_equal(all.topology, wanted.topology);
        assert_true(all.pitch == wanted.pitch);
      }
    }
}

}  // namespace

}  // namespace msq::test

int main() {
  using namespace msq::test;
  std::vector<Row> rows = {{"foam", foam},
                           {"lattice", lattice},
                           {"lattice in a sampled map", lattice_in_map},
                           {"gyroid", gyroid}};
  return run_for_each("scales of contours", rows, test_scales);
}
