// SPDX-License-Identifier: Apache-2.0
// Contours in random windows: rings are simple and nested and stay in the window; two windows that
// tile a third have the same points on their seam, and its area.
//
// usage: unit_test_contour_windows [WINDOWS [SEED]]; scripts/test_windows asks for a million.
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

#include "expression/parser.h"
#include "field/gradient.h"
#include "meshes.h"
#include "random.h"
#include "rings.h"
#include "shape/boolean.h"
#include "shape/mesh.h"
#include "shape/primitive.h"
#include "slice/contours.h"
#include "structure/foam/foam.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/lattice.h"
#include "suite.h"

namespace msq::test {

namespace {

uint64_t windows_wanted = 0, seed = 61;

Ref<Context> context() {
  static const Ref<Context> shared = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return shared;
}

Ref<const Shape> box() {
  return make_ref<BoxShape>(Box3{{0, 0, 0}, {6, 5, 4}});
}
Ref<const Shape> mesh() {
  TriangleSoup soup = box_mesh({-3, -2, -1.5}, {3, 2, 1.5});
  for (Vec3& v : soup.vertices) v = turned_twice().apply(v) + Vec3{4, 3, 2};
  return make_ref<Mesh>(soup, WindingRule::nonzero, context()->budget);
}
Ref<const Structure> foam(Parameter radius) {
  return make_ref<Foam>(context(), Neighbourhood{{0.1, 0.2, 0.3}, {1, 1, 1}, {}}, std::move(radius),
                        1.0, uint64_t{5}, FoamMethod::direct);
}
Ref<const Structure> gyroid(FunctionalKind kind, double level) {
  return make_ref<Functional>(Neighbourhood{{}, {2, 2, 2}, {}},
                              parse_expression(preset_expressions[0], {}), kind, Parameter(level),
                              8);
}
Ref<const Structure> lattice(double radius, Rotation rotation) {
  return make_ref<Lattice>(Neighbourhood{{0.3, 0, 0.1}, {2, 2, 2}, rotation}, bcc_unit_cell(),
                           Parameter(radius));
}

struct Kind {
  std::string name;
  std::function<Ref<Model>()> model;
};

std::vector<Kind> kinds() {
  const auto filled = [](auto make, Ref<const Shape> (*shape)() = box, double skin = 0) {
    return [=] {
      return make_ref<Model>(
          context(), shape(),
          std::vector<Model::ScaleParts>{Model::ScaleParts(make(), Parameter(skin))});
    };
  };
  const auto alone = [](Ref<const Shape> shape) {
    return [shape] { return make_ref<Model>(context(), shape, std::vector<Model::ScaleParts>{}); };
  };
  return {
      {"foam", filled([] { return foam(Parameter(0.1)); })},
      {"foam of graded radius", filled([] {
         return foam(Parameter(
             Ref<const Field>(make_ref<GradientField>(Vec3{0, 0, 0}, 0.03, Vec3{6, 0, 0}, 0.25))));
       })},
      {"foam with narrow gaps", filled([] { return foam(Parameter(0.27)); })},
      {"foam with narrow gaps and a skin, in a mesh",
       filled([] { return foam(Parameter(0.25)); }, mesh, 0.2)},
      {"foam with a skin, in a mesh", filled([] { return foam(Parameter(0.1)); }, mesh, 0.2)},
      {"lattice", filled([] { return lattice(0.2, {}); })},
      {"lattice, turned", filled([] { return lattice(0.15, turned_twice()); })},
      {"gyroid network", filled([] { return gyroid(FunctionalKind::network, 0.2); })},
      {"gyroid sheet, in a mesh", filled([] { return gyroid(FunctionalKind::sheet, 0.3); }, mesh)},
      {"mesh", [=] { return alone(mesh())(); }},
      {"ball without a box", [=] {
         return alone(
             make_ref<BooleanShape>(BooleanShape::Operation::subtracted,
                                    std::vector<Ref<const Shape>>{
                                        make_ref<SphereShape>(Vec3{3, 2.5, 2}, 2.2),
                                        make_ref<BoxShape>(Box3{{2.1, 1.3, -1}, {2.9, 9, 9}})}))();
       }}};
}

void test_windows(void** state) {
  const Kind& kind = *static_cast<const Kind*>(*state);
  const Ref<Model> model = kind.model();
  const Box3& bounds = model->bounds();
  Random random(seed);
  uint64_t windows = 0, rings = 0, on_seams = 0;
  while (windows < windows_wanted) {
    ContourPlan plan;
    plan.plane.axis = static_cast<int>(random.below(3));
    const int w = plan.plane.axis;
    plan.plane.height = random.between(bounds.min[w] + 0.05, bounds.max[w] - 0.05);
    plan.pitch = random.between(0.02, 0.15);
    plan.tolerance = plan.pitch * (random.below(2) == 0 ? random.between(0.05, 0.125)
                                                        : random.between(0.125, 1));
    plan.format = static_cast<ContourFormat>(1 + random.below(3));
    // Some as coarse as units may be.
    plan.units = plan.format == ContourFormat::float64 ? 1
                 : random.below(2) == 0
                     ? 1e6
                     : std::max(64 / plan.pitch, 4 / plan.tolerance) * random.between(1.3, 3);
    plan.has_window = true;
    double low[2], high[2];
    const int axes[2] = {plan.plane.u_axis(), plan.plane.v_axis()};
    for (int i = 0; i < 2; ++i) {
      const double side = plan.pitch * random.between(0.6, 12);
      low[i] = random.between(bounds.min[axes[i]] - 0.1, bounds.max[axes[i]] + 0.1 - side);
      high[i] = low[i] + side;
    }
    const auto make = [&](const double(&min)[2], const double(&max)[2]) {
      for (int i = 0; i < 2; ++i) {
        plan.window_min[i] = min[i];
        plan.window_max[i] = max[i];
      }
      const Ref<Contours> made = layer_contours(*model, plan, nullptr);
      const Rings all = rings_of(reinterpret_cast<const msq_contours*>(made.get()));
      check_rings(all);
      for (const auto& ring : all.rings)
        for (const RingPoint p : ring) {
          const double at[2] = {p.u, p.v};
          for (int i = 0; i < 2; ++i)
            if (!(at[i] >= std::floor(min[i] * plan.units) - 1 &&
                  at[i] <= std::ceil(max[i] * plan.units) + 1))
              fail_msg("a point lies beyond its window");
        }
      rings += all.rings.size();
      ++windows;
      return all;
    };
    const Rings whole = make(low, high);
    // Two windows in its place.
    const int across = static_cast<int>(random.below(2));
    const double cut = low[across] + (high[across] - low[across]) * random.between(0.2, 0.8);
    double first_high[2] = {high[0], high[1]}, second_low[2] = {low[0], low[1]};
    first_high[across] = second_low[across] = cut;
    const Rings parts[2] = {make(low, first_high), make(second_low, high)};
    const double seam =
        plan.format == ContourFormat::float64 ? cut : std::nearbyint(cut * plan.units);
    std::map<RingPoint, int> seen;
    for (int side = 0; side < 2; ++side)
      for (const auto& ring : parts[side].rings)
        for (const RingPoint p : ring)
          if ((across == 0 ? p.u : p.v) == seam) {
            seen[p] += side == 0 ? 1 : -1;
            ++on_seams;
          }
    for (const auto& [p, count] : seen)
      if (count != 0) fail_msg("(%.17g, %.17g) is on one side of a seam", p.u, p.v);
    const double tolerance = plan.tolerance * plan.units;
    const double lengths = whole.length() + parts[0].length() + parts[1].length();
    const double off = std::abs(parts[0].area() + parts[1].area() - whole.area());
    // Parts that are thinner than the pitch may show in one of the windows alone.
    const double narrow =
        static_cast<double>(1 + whole.unresolved + parts[0].unresolved + parts[1].unresolved);
    if (!(off <= tolerance * lengths + 2 * narrow * std::pow(plan.pitch * plan.units, 2)))
      fail_msg("the area of two windows is off by %g", off);
  }
  print_message("%s: %llu windows, %llu rings, %llu points on seams\n", kind.name.c_str(),
                static_cast<unsigned long long>(windows), static_cast<unsigned long long>(rings),
                static_cast<unsigned long long>(on_seams));
  assert_true(rings > 0 && on_seams > 0);
}

}  // namespace

}  // namespace msq::test

int main(int count, char** arguments) {
  using namespace msq::test;
  std::vector<Kind> all = kinds();
  const double wanted = count > 1 ? std::strtod(arguments[1], nullptr) : 200 + 4000 * test_scale();
  if (!(wanted >= 1)) {
    std::fprintf(stderr, "usage: %s [WINDOWS [SEED]]\n", arguments[0]);
    return 2;
  }
  windows_wanted = 1 + static_cast<uint64_t>(wanted / static_cast<double>(all.size()));
  if (count > 2) seed = std::strtoull(arguments[2], nullptr, 10);
  return run_for_each("windows", all, test_windows);
}
