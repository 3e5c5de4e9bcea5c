// SPDX-License-Identifier: Apache-2.0
// Rays that begin up to 1e300 away: along an axis they hit what a ray from near does, all of them
// end, and what they hit is where membership changes.
#include <functional>
#include <limits>

#include "query/membership.h"
#include "random.h"
#include "ray/cast.h"
#include "shape/primitive.h"
#include "shapes.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double distances[] = {1e3, 1e6, 1e9, 1e15, 1e18, 1e22, 1e30, 1e40, 1e100, 1e200, 1e300};

struct Row {
  std::string name;
  std::function<Ref<const Model>()> make;
  size_t count;
  bool has_thick_parts;  ///< not only such as rounding makes or breaks
};

std::vector<RayHit> cast(const Model& model, const std::vector<RaySearch>& rays) {
  std::vector<RayHit> hits(rays.size());
  cast_rays(
      model, model.resolved(0), rays.size(),
      [&](std::span<const uint64_t> numbers, RaySearch* searches) {
        for (size_t n = 0; n < numbers.size(); ++n) searches[n] = rays[numbers[n]];
      },
      [&](std::span<const uint64_t> numbers, const RayHit* found) {
        for (size_t n = 0; n < numbers.size(); ++n) hits[numbers[n]] = found[n];
      },
      nullptr);
  return hits;
}

Ray along_axis(int axis, double sign, Vec3 through, double distance) {
  Ray ray{through, {}};
  ray.direction[axis] = sign;
  ray.origin[axis] -= sign * distance;
  return ray;
}

void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Ref<const Model> model = row.make();
  const Scales resolved = model->resolved(0);
  const Box3 box = model->bounds();
  const double size = max_component(box.extent());
  const Box3 around = box.grown(1e-9 * size);
  Random random(23);
  std::vector<RaySearch> near, far, any;
  for (size_t i = 0; i < row.count; ++i) {
    const Vec3 through = random.in_box(box.grown(0.1 * size));
    const int axis = static_cast<int>(random.below(3));
    const double sign = random.below(2) ? 1 : -1;
    near.push_back({along_axis(axis, sign, through, 3 * size), 0, infinity});
    far.push_back({along_axis(axis, sign, through, distances[i % std::size(distances)] * size), 0,
                   i % 3 ? infinity : 4 * distances[i % std::size(distances)] * size});
    // Aimed at the model, and from and to anywhere.
    const double distance = distances[random.below(std::size(distances))] * size;
    Vec3 d = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    if (i % 5 == 0) d[axis] = 0;
    if (i % 7 == 0) d = {sign, sign, sign};
    d = d * (1 / length(d));
    any.push_back({{through - d * distance, d}, i % 3 ? 0.0 : distance * random.unit(), infinity});
    any.push_back({{through + d * distance, d}, -2 * distance, distance});
    any.push_back({{random.in_box({{-distance, -1, -1}, {distance, 1, 1}}), d}, -infinity, 1e300});
    any.push_back({{through, d}, 0, distance});
    any.push_back({{{distance, -distance, 0.5 * distance}, d}, 0, infinity});
  }
  const std::vector<RayHit> of_near = cast(*model, near), of_far = cast(*model, far);
  size_t hits = 0;
  // Shapes of shapes enter in the frame of the original, where the ray from afar is another to
  // rounding: each of the two hits keeps the documented tolerance. All others find the same point.
  const double room =
      model->shape().nesting() > 0 ? 2 * model->shape().ray_tolerance() : 1e-9 * size;
  for (size_t i = 0; row.has_thick_parts && i < near.size(); ++i) {
    if ((of_near[i].scale >= 0) != (of_far[i].scale >= 0) ||
        (of_near[i].scale >= 0 && length(of_near[i].point - of_far[i].point) > room)) {
      const Ray& r = near[i].ray;
      fail_msg(
          "%s: ray %zu along (%g, %g, %g) by (%.17g, %.17g, %.17g): scale %d at (%.17g, %.17g, "
          "%.17g) from near, %d at (%.17g, %.17g, %.17g) from %g",
          row.name.c_str(), i, r.direction.x, r.direction.y, r.direction.z, r.origin.x, r.origin.y,
          r.origin.z, of_near[i].scale, of_near[i].point.x, of_near[i].point.y, of_near[i].point.z,
          of_far[i].scale, of_far[i].point.x, of_far[i].point.y, of_far[i].point.z,
          max_magnitude(far[i].ray.origin));
    }
    hits += of_near[i].scale >= 0;
  }
  const std::vector<RayHit> of_any = cast(*model, any);
  for (size_t i = 0; i < any.size(); ++i) {
    const RayHit& hit = of_any[i];
    if (hit.scale < 0) continue;
    ++hits;
    assert_true(std::isfinite(hit.t) && around.contains(hit.point));
    assert_true(std::abs(length(hit.normal) - 1) < 1e-9);
    const auto inside = [&](double way) {
      return model->inside(hit.point + any[i].ray.direction * way, resolved);
    };
    if (!inside(0) && !inside(1e-10 * size))
      fail_msg("%s: ray %zu hits outside, at (%.17g, %.17g, %.17g)", row.name.c_str(), i,
               hit.point.x, hit.point.y, hit.point.z);
  }
  size_t inside = 0;
  for (int i = 0; i < 1000; ++i) inside += model->inside(random.in_box(box), resolved);
  assert_true(row.count < 40 || hits > 0 || inside < 10);
}

}  // namespace

int main() {
  std::vector<Row> rows;
  for (const StructureRow& row : structures_by_point()) {
    if (row.is_graded && !row.is_lattice() && row.kind.radius != 0.1) continue;
    rows.push_back({row.name,
                    [=]() -> Ref<const Model> {
                      const Neighbourhood& grid = row.variant.grid;
                      const Vec3 centre = grid.from_grid(Vec3{0.5, 0.5, 0.5} * grid.cell_size);
                      return make_ref<Model>(shared_context(),
                                             make_ref<SphereShape>(centre, 1.3 * row.unit()),
                                             std::vector<Ref<const Structure>>{row.make(centre)});
                    },
                    row.samples(row.is_lattice() ? 600 : 300), true});
  }
  for (const ShapeRow& row : shape_rows())
    rows.push_back({row.name,
                    [=]() -> Ref<const Model> {
                      return make_ref<Model>(shared_context(), row.make(),
                                             std::vector<Ref<const Structure>>{});
                    },
                    test_count(200) + 2, row.name.find("bits") == std::string::npos});
  return run_for_each("far_rays", rows, test_row);
}
