// SPDX-License-Identifier: Apache-2.0
// Contours of sections that have closed forms of area and perimeter.
#include <cmath>
#include <string>

#include "base/pi.h"
#include "rings.h"
#include "shape/boolean.h"
#include "shape/primitive.h"
#include "slice/contours.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/lattice.h"
#include "suite.h"

namespace msq::test {

namespace {

Ref<Context> context() {
  static const Ref<Context> shared = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return shared;
}

Ref<Model> model_of(Ref<const Shape> shape, std::vector<Model::ScaleParts> scales) {
  return make_ref<Model>(context(), std::move(shape), std::move(scales));
}

/// Area and perimeter of sections that have closed forms.
void test_closed_forms(void**) {
  struct Form {
    std::string name;
    Ref<Model> model;
    double height, area, perimeter;
    uint64_t rings;
    /// How far a perimeter turns in all, and how many corners it has.
    double turns, corners;
    double low[2] = {-0.5, -0.5}, high[2] = {3.5, 2.5};
  };
  const auto ball = [](double x, double y, double r) -> Ref<const Shape> {
    return make_ref<SphereShape>(Vec3{x, y, 0}, r);
  };
  const auto joined = [](BooleanShape::Operation operation, std::vector<Ref<const Shape>> members) {
    return model_of(make_ref<BooleanShape>(operation, std::move(members)), {});
  };
  const auto strut_along_z = [](double tilt, double r) {
    UnitCell cell{{{0.5, 0.5, 0}, {0.5, 0.5, 1}}, {{0, 1}}, {}};
    Rotation about_x;
    about_x.m = {1, 0, 0, 0, std::cos(tilt), -std::sin(tilt), 0, std::sin(tilt), std::cos(tilt)};
    return model_of(make_ref<BoxShape>(Box3{{-20, -20, -20}, {20, 20, 20}}),
                    {Ref<const Structure>(make_ref<Lattice>(Neighbourhood{{}, {1, 1, 1}, about_x},
                                                            cell, Parameter(r)))});
  };
  std::vector<Form> forms;
  // Between the layers of a cubic lattice: discs in a window of 4 x 3 cells.
  const double r = 0.23;
  forms.push_back({"discs",
                   strut_along_z(0, r),
                   0.5,
                   12 * pi * r * r,
                   24 * pi * r,
                   12,
                   12 * 2 * pi,
                   0,
                   {0.1, 0.1},
                   {4.1, 3.1}});
  // An edge of the window through their middles.
  forms.push_back({"halves of discs",
                   strut_along_z(0, r),
                   0.5,
                   2 * pi * r * r,
                   4 * (pi * r + 2 * r),
                   4,
                   8 * pi,
                   8,
                   {0.5, 0.1},
                   {0.9, 4.1}});
  // A tilted strut: an ellipse of the half axes r and r / cos.
  const double tilt = 0.9, wide = r / std::cos(tilt), e = std::sqrt(1 - r * r / (wide * wide));
  const double spacing = 1 / std::cos(tilt);
  forms.push_back({"ellipses",
                   strut_along_z(tilt, r),
                   0.0,
                   6 * pi * r * wide,
                   6 * 4 * wide * std::comp_ellint_2(e),
                   6,
                   6 * 2 * pi,
                   0,
                   {0.02, -spacing},
                   {3.02, spacing}});
  // Two discs of radius 1 whose middles are 1.2 apart, together and one less the other.
  const double half = std::acos(0.6), lens = 2 * half - 0.6 * std::sqrt(4 - 1.44);
  const std::vector<Ref<const Shape>> two = {ball(0.8, 1, 1), ball(2, 1, 1)};
  forms.push_back({"two discs", joined(BooleanShape::Operation::united, two), 0.0, 2 * pi - lens,
                   4 * (pi - half), 1, 4 * pi, 2});
  forms.push_back({"a lens", joined(BooleanShape::Operation::intersected, two), 0.0, lens, 4 * half,
                   1, 2 * pi, 2});
  forms.push_back({"a moon", joined(BooleanShape::Operation::subtracted, two), 0.0, pi - lens,
                   2 * pi, 1, 4 * pi, 2});
  forms.push_back(
      {"an annulus",
       joined(BooleanShape::Operation::subtracted, {ball(1, 1, 1.3), ball(1.2, 1, 0.7)}), 0.0,
       pi * (1.69 - 0.49), pi * 4, 2, 4 * pi, 0});
  for (const Form& form : forms)
    for (const double tolerance : {0.0003, 0.003, 0.012}) {
      ContourPlan plan;
      plan.plane.height = form.height;
      plan.pitch = 0.03;
      plan.tolerance = tolerance;
      plan.topology_samples = 4;
      plan.has_window = true;
      for (int i = 0; i < 2; ++i) {
        plan.window_min[i] = form.low[i];
        plan.window_max[i] = form.high[i];
      }
      const Ref<Contours> made = layer_contours(*form.model, plan, nullptr);
      const Rings all = rings_of(reinterpret_cast<const msq_contours*>(made.get()));
      check_rings(all);
      if (all.rings.size() != form.rings || all.topology != 0)
        fail_msg("%s: %zu rings, not %llu; the count is %llu", form.name.c_str(), all.rings.size(),
                 static_cast<unsigned long long>(form.rings),
                 static_cast<unsigned long long>(all.topology));
      if (!(std::abs(all.area() - form.area) <= tolerance * form.perimeter))
        fail_msg("%s: the area is %.9g, exactly %.9g", form.name.c_str(), all.area(), form.area);
      // A line that is off by the tolerance is longer or shorter by so much a turn; a corner by
      // less than four times.
      if (!(std::abs(all.length() - form.perimeter) <=
            tolerance * (2 * form.turns + 4 * form.corners)))
        fail_msg("%s: the perimeter is %.9g, exactly %.9g", form.name.c_str(), all.length(),
                 form.perimeter);
    }
}

}  // namespace

}  // namespace msq::test

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(msq::test::test_closed_forms)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
