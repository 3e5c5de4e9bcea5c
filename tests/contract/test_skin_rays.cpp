// SPDX-License-Identifier: Apache-2.0
// Rays that end on the inner face of a skin, near the origin and up to 1e7 cells away with their
// grids: membership changes within the tolerance of the scale, which is finer than the shape's, and
// nothing thicker is passed, also where a ray grazes. Single rays and many find the same bits.
#include <array>
#include <functional>

#include "field/gradient.h"
#include "meshes.h"
#include "random.h"
#include "ray/cast.h"
#include "shape/mesh.h"
#include "shape/placed.h"
#include "shape/primitive.h"
#include "structure/lattice/lattice.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr double size = 4;  // of the shapes, in cells

Ref<const Shape> mesh(TriangleSoup soup, Vec3 by) {
  for (Vec3& v : soup.vertices) v = v + by;
  return make_ref<Mesh>(std::move(soup), WindingRule::automatic,
                        std::make_shared<MemoryBudget>(uint64_t{0}));
}

/// A box about a cavity, whose skin bulges into the box.
TriangleSoup hollow_box() {
  TriangleSoup soup = box_mesh({0, 0, 0}, {size, size, size});
  append(soup, inside_out(icosphere(0.6, 2)), {0.5 * size, 0.45 * size, 0.55 * size});
  return soup;
}

Ref<const Shape> turned(const Ref<const Shape>& original, double scale, Vec3 by) {
  const double c = scale * std::cos(0.4), s = scale * std::sin(0.4);
  return make_ref<PlacedShape>(original, Placement(std::array<double, 12>{
                                             c, -s, 0, by.x, s, c, 0, by.y, 0, 0, scale, by.z}));
}

struct Row {
  std::string name;
  std::function<Ref<const Shape>(Vec3 by)> make;
  double away = 0;  ///< in cells
};

std::vector<Row> all_rows() {
  const Vec3 middle{0.5 * size, 0.5 * size, 0.5 * size};
  const auto cavity = [](Vec3 by) { return mesh(hollow_box(), by); };
  const std::vector<Row> shapes{
      {"box",
       [](Vec3 by) {
         return make_ref<BoxShape>(Box3{by, by + Vec3{size, size, size}});
       }},
      {"ball", [=](Vec3 by) { return make_ref<SphereShape>(by + middle, 0.5 * size); }},
      {"cylinder",
       [](Vec3 by) {
         return make_ref<CylinderShape>(by + Vec3{1, 1, 1}, by + Vec3{3, 2.5, 3.5}, 1.3);
       }},
      {"hollow mesh", cavity},
      {"placed ball",
       [](Vec3 by) {
         return turned(make_ref<SphereShape>(Vec3{0.5, 0.5, 0.5}, 0.5), size, by);
       }},
      {"placed mesh", [=](Vec3 by) { return turned(cavity({}), 1, by); }},
      {"distant mesh, placed back",
       [=](Vec3 by) {
         return turned(cavity({70, -90, 30}), 1, by);
       }},
  };
  std::vector<Row> rows;
  for (const Row& shape : shapes)
    for (const double away : {0.0, 1.0, 1e3, 1e5, 1e7}) {
      rows.push_back(shape);
      rows.back().away = away;
      char text[64];
      snprintf(text, sizeof text, ", %g cells away", away);
      rows.back().name += text;
    }
  return rows;
}

std::vector<RayHit> cast(const Model& model, const std::vector<RaySearch>& rays, size_t at_once) {
  std::vector<RayHit> hits(rays.size());
  for (size_t first = 0; first < rays.size(); first += at_once)
    cast_rays(
        model, model.resolved(0), std::min(at_once, rays.size() - first),
        [&](std::span<const uint64_t> numbers, RaySearch* searches) {
          for (size_t n = 0; n < numbers.size(); ++n) searches[n] = rays[first + numbers[n]];
        },
        [&](std::span<const uint64_t> numbers, const RayHit* found) {
          for (size_t n = 0; n < numbers.size(); ++n) hits[first + numbers[n]] = found[n];
        },
        nullptr);
  return hits;
}

Vec3 unit_vector(Random& random) {
  for (;;) {
    const Vec3 d = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    if (const double l = length(d); l > 0.1 && l < 1) return d * (1 / l);
  }
}

/// From the void within the skin. Every other one passes close by where another hits, across the
/// normal there.
std::vector<RaySearch> rays_from_void(const Model& model, size_t count, Random& random) {
  const Scales resolved = model.resolved(0);
  std::vector<RaySearch> rays;
  while (rays.size() < count) {
    const Vec3 p = random.in_box(model.bounds());
    if (!model.shape().inside(p) || model.inside(p, resolved)) continue;
    rays.push_back({{p, unit_vector(random)}, 0, 2 * size});
    const RayHit hit = cast(model, {rays.back()}, 1)[0];
    if (hit.scale < 0 || rays.size() >= count) continue;
    Vec3 along = unit_vector(random);
    along = along - hit.normal * dot(along, hit.normal);
    along = along * (1 / length(along));
    const double deep = std::exp2(-random.between(6, 40));
    const Vec3 from = hit.point - hit.normal * (random.below(4) ? deep : -deep) - along * 0.3;
    if (model.shape().inside(from) && !model.inside(from, resolved))
      rays.push_back({{from, along}, 0, 2 * size});
  }
  return rays;
}

void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Vec3 by = Vec3{1, -0.9, 0.8} * row.away;
  const Ref<const Shape> shape = row.make(by);
  Neighbourhood grid;
  grid.origin = by;
  const Ref<const Structure> lattice = make_ref<Lattice>(grid, cubic_unit_cell(), Parameter(0.02));
  const Parameter thicknesses[] = {
      Parameter(0.25), Parameter(Ref<const Field>(
                           make_ref<GradientField>(by, 0.1, by + Vec3{size, size, size}, 0.4)))};
  Random random(17);
  for (const Parameter& thickness : thicknesses) {
    const Ref<const Model> model = make_ref<Model>(
        shared_context(), shape, std::vector<Model::ScaleParts>{{lattice, thickness}});
    const Scales resolved = model->resolved(0);
    const std::vector<RaySearch> rays = rays_from_void(*model, test_count(120) + 16, random);
    const std::vector<RayHit> hits = cast(*model, rays, rays.size()), alone = cast(*model, rays, 1);
    size_t on_skin = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      const Ray& ray = rays[i].ray;
      const RayHit& hit = hits[i];
      const auto inside = [&](double t) { return model->inside(ray.at(t), resolved); };
      const double end = hit.scale < 0 ? rays[i].to : hit.t;
      const auto fail_at = [&](const char* what, double t) {
        fail_msg("%s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g), t %.17g: %s at %.17g",
                 row.name.c_str(), ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
                 ray.direction.y, ray.direction.z, end, what, t);
      };
      if (hit.t != alone[i].t || hit.scale != alone[i].scale || !(hit.normal == alone[i].normal))
        fail_at("alone it differs", alone[i].t);
      // What docs/accuracy.md states of hits on a scale.
      const double coordinate = std::max(max_coordinate(ray, end), max_coordinate(ray, end, by));
      const double e = std::max(0x1p-36 * lattice->cell_length(), 0x1p-50 * coordinate);
      // Skins are followed by steps of the shape's tolerance.
      const double part = std::max(e, shape->ray_tolerance()), deep = 0x1p-50 * coordinate;
      const auto is_deep = [&](double t) {
        const Vec3 p = ray.at(t);
        for (int axis = 0; axis < 3; ++axis)
          for (const double side : {-deep, deep}) {
            Vec3 q = p;
            q[axis] += side;
            if (!model->inside(q, resolved)) return false;
          }
        return inside(t);
      };
      if (hit.scale == 1 && !hit.starts_inside && end > 2 * e) {
        on_skin += !lattice->inside(ray.at(end)) && !lattice->inside(ray.at(end + e));
        // A ray that grazes changes sides over a long way: points before are outside, or so by what
        // points of a ray are rounded.
        bool was_in = true, is_in = false;
        for (int n = 0; n <= 64; ++n) {
          was_in = was_in && is_deep(end - e * n / 64);
          is_in = is_in || inside(end + e * n / 64);
        }
        if (was_in || !is_in) fail_at("membership does not change", end);
      }
      for (int n = 0; n < 160; ++n) {
        const double t = n < 80 ? end * n / 80 : end - std::exp2(-0.4 * (n - 80));
        if (t > part && t < end - 2 * part && is_deep(t) && is_deep(t - part) &&
            is_deep(t + part) && is_deep(t + 0.5 * part) && is_deep(t - 0.5 * part))
          fail_at("it is inside before", t);
      }
    }
    if (rays.size() > 100) assert_true(on_skin > rays.size() / 4);
  }
}

}  // namespace

int main() {
  std::vector<Row> rows = all_rows();
  return run_for_each("skin_rays", rows, test_row);
}
