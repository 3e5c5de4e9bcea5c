// SPDX-License-Identifier: Apache-2.0
// Rays through nested scales hit where membership of the whole model first changes: a sheet within
// struts within a ball, and a host's function in place of either.
#include "cell/context.h"
#include "host_structures.h"
#include "query/membership.h"
#include "random.h"
#include "ray/cast.h"
#include "shape/primitive.h"
#include "structure/functional/presets.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  std::string name;
  Ref<const Structure> coarse, fine;
  bool is_fine_twice = false;  // the same structure on a third scale
};

void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  std::vector<Ref<const Structure>> structures{row.coarse, row.fine};
  if (row.is_fine_twice) structures.push_back(row.fine);
  const Ref<const Model> model = make_ref<Model>(
      shared_context(), make_ref<SphereShape>(Vec3{0.5, 0.5, 0.5}, 0.7), structures);
  const Scales resolved = model->resolved(0);
  Random random(3);
  const size_t count = test_count(150);
  std::vector<RaySearch> rays;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 a = random.in_box({{-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}});
    const Vec3 b = random.in_box({{0, 0, 0}, {1, 1, 1}});
    rays.push_back({{a, (b - a) * (1 / length(b - a))}, 0, 3});
  }
  std::vector<RayHit> hits(count);
  cast_rays(
      *model, resolved, count,
      [&](std::span<const uint64_t> numbers, RaySearch* searches) {
        for (size_t n = 0; n < numbers.size(); ++n) searches[n] = rays[numbers[n]];
      },
      [&](std::span<const uint64_t> numbers, const RayHit* found) {
        for (size_t n = 0; n < numbers.size(); ++n) hits[numbers[n]] = found[n];
      },
      nullptr);
  const double part = std::max(model->shape().ray_tolerance(),
                               std::max(row.coarse->min_ray_step(), row.fine->min_ray_step()));
  size_t by_scale[4] = {};
  for (size_t i = 0; i < count; ++i) {
    const Ray& ray = rays[i].ray;
    const auto inside = [&](double t) { return model->inside(ray.at(t), resolved); };
    const bool is_hit = hits[i].scale >= 0;
    const double end = is_hit ? hits[i].t : rays[i].to;
    const auto fail_at = [&](const char* what, double t) {
      fail_msg("%s: ray %zu, t %.17g, scale %d: %s at %.17g", row.name.c_str(), i, end,
               hits[i].scale, what, t);
    };
    for (int n = 0; n < 600; ++n) {
      const double t = n < 400 ? end * n / 400 : end - 0.01 * (n - 399) / 200;
      if (t < 0 || t > end - 2 * part || !inside(t)) continue;
      if (inside(t - part) && inside(t + part) && inside(t + 0.5 * part))
        fail_at("it is inside before", t);
    }
    if (!is_hit) continue;
    ++by_scale[hits[i].scale];
    if (!inside(end) && !inside(end + 0x1p-36)) fail_at("it is outside", end);
    assert_true(std::abs(length(hits[i].normal) - 1) < 1e-9);
    // Where the coarse structure begins within the fine one, its surface was crossed last.
    const auto is_around = [&](const Structure& of) {
      return of.inside(ray.at(end - 1e-6)) && of.inside(ray.at(end)) &&
             of.inside(ray.at(end + 1e-6));
    };
    if (!hits[i].starts_inside && is_around(*row.fine) && !row.coarse->inside(ray.at(end - 1e-6)) &&
        model->shape().inside(ray.at(end - 1e-6)) && hits[i].scale != 1)
      fail_at("the coarse structure begins", end);
  }
  if (count < 100) return;  // too few to say how many hit which
  assert_true(by_scale[1] > count / 20);
  assert_true(by_scale[2] + by_scale[3] > count / 5);
}

}  // namespace

int main() {
  const Neighbourhood coarse{{0.1, 0.2, 0.3}, {0.5, 0.5, 0.5}, {}};
  Neighbourhood fine{{0.3, 0.2, 0.1}, {0.11, 0.11, 0.11}, {}};
  const double c = std::cos(0.4), s = std::sin(0.4);
  fine.rotation = Rotation{{c, -s, 0, s, c, 0, 0, 0, 1}};
  const auto sheet = functional_factory(preset_expressions[0], FunctionalKind::sheet, 0);
  const auto network = functional_factory(preset_expressions[1], FunctionalKind::network, 0);
  const auto octet = lattice_factory(octet_unit_cell());
  std::vector<Row> rows{
      {"a sheet in struts", octet(coarse, Parameter(0.07)), sheet(fine, Parameter(0.3))},
      {"a sheet in struts that end", lattice_factory(factored_unit_cell())(coarse, Parameter(0.06)),
       sheet(fine, Parameter(0.3))},
      {"struts that end in a network", network(coarse, Parameter(0.2)),
       lattice_factory(factored_unit_cell())(fine, Parameter(0.015))},
      {"struts in a network", network(coarse, Parameter(0.2)), octet(fine, Parameter(0.02))},
      {"a sheet in a foam", foam_factory(FoamMethod::method_1, 1)(coarse, Parameter(0.08)),
       sheet(fine, Parameter(0.6))},
      {"mixed struts in a host's function",
       make_host_gyroid(coarse, Parameter(0.3), false, false, 3.5),
       mixed_factory()(fine, Parameter(0.02))},
      {"a sheet twice in a foam", foam_factory(FoamMethod::method_1, 1)(coarse, Parameter(0.08)),
       sheet(fine, Parameter(0.6)), true},
  };
  return run_for_each("ray_scales", rows, test_row);
}
