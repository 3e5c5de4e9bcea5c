// SPDX-License-Identifier: Apache-2.0
// A model of all space answers as one of a box that is so large that nothing depends on it: points,
// grids and their windows, and distances bit for bit, rays within their tolerance.
#include "query/array_points.h"
#include "query/grid_points.h"
#include "query/membership.h"
#include "random.h"
#include "ray/cast.h"
#include "shape/all_space.h"
#include "shape/primitive.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  Random random(row.index + 1);
  const double unit = row.unit();
  const Vec3 middle = row.variant.grid.origin;
  const Ref<const Structure> structure = row.make(middle);
  const auto model_in = [&](Ref<const Shape> shape) {
    return make_ref<Model>(shared_context(), shape, std::vector<Ref<const Structure>>{structure});
  };
  const Vec3 far = Vec3{1, 1, 1} * (1000 * unit), near = Vec3{1, 1, 1} * (2.5 * unit);
  const Ref<const Model> all(model_in(make_ref<AllSpace>()).get());
  const Ref<const Model> boxed(
      model_in(make_ref<BoxShape>(Box3{middle - far, middle + far})).get());
  const Scales of_all = all->resolved(0), of_boxed = boxed->resolved(0);

  const size_t count = row.samples(50000);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = random.in_box({middle - near, middle + near});
  const ArrayPoints array(PointArray{reinterpret_cast<const unsigned char*>(points.data()), count,
                                     sizeof(Vec3), false});
  std::vector<uint8_t> one(count), other(count);
  set_membership(*all, of_all, array, {}, one.data(), nullptr);
  set_membership(*boxed, of_boxed, array, {}, other.data(), nullptr);
  assert_memory_equal(one.data(), other.data(), count);
  for (size_t i = 0; i < count; i += 7) {
    assert_int_equal(all->inside(points[i], of_all), one[i]);
    const double distance = all->distance(points[i], of_all);
    assert_true(distance == boxed->distance(points[i], of_boxed));
  }

  SampleGrid grid;
  const auto side = static_cast<uint64_t>(std::max(3.0, std::cbrt(static_cast<double>(count))));
  grid.nx = 3 * side;
  grid.ny = grid.nz = side;
  grid.origin = middle - near;
  grid.spacing = near * Vec3{2.0 / double(grid.nx), 2.0 / double(side), 2.0 / double(side)};
  grid = window_of(grid, {{1, 0, 1}, {grid.nx - 1, grid.ny, grid.nz - 1}});
  const uint64_t samples = grid.nx * grid.ny * grid.nz;
  one.assign(samples, 7);
  other.assign(samples, 7);
  grid_membership(*all, of_all, grid, one.data(), nullptr);
  grid_membership(*boxed, of_boxed, grid, other.data(), nullptr);
  assert_memory_equal(one.data(), other.data(), samples);

  const size_t rays = std::max<size_t>(4, count / 64);
  const FillRays fill = [&](std::span<const uint64_t> numbers, RaySearch* searches) {
    for (size_t n = 0; n < numbers.size(); ++n) {
      Random of_ray(numbers[n] + 1);
      const Vec3 direction{of_ray.normal(), of_ray.normal(), of_ray.normal()};
      searches[n] = {};
      searches[n].ray = {of_ray.in_box({middle - near, middle + near}),
                         direction * (1 / length(direction))};
      searches[n].to = 3 * unit * of_ray.unit();
    }
  };
  std::vector<RayHit> hits[2] = {std::vector<RayHit>(rays), std::vector<RayHit>(rays)};
  for (size_t m = 0; m < 2; ++m)
    cast_rays(
        m ? *boxed : *all, m ? of_boxed : of_all, rays, fill,
        [&](std::span<const uint64_t> numbers, const RayHit* found) {
          for (size_t n = 0; n < numbers.size(); ++n) hits[m][numbers[n]] = found[n];
        },
        nullptr);
  for (size_t i = 0; i < rays; ++i) {
    const RayHit &a = hits[0][i], &b = hits[1][i];
    if (a.scale != b.scale || a.starts_inside != b.starts_inside)
      fail_msg("ray %d: scale %d and %d, inside %d and %d", int(i), a.scale, b.scale,
               a.starts_inside, b.starts_inside);
    // What is followed past the end of a ray depends on the model's size, and where steps end on
    // it.
    const double tolerance = 2 * structure->ray_tolerance() + 0x1p-40 * max_magnitude(middle);
    if (a.scale >= 0 && !(std::abs(a.t - b.t) <= tolerance))
      fail_msg("ray %d: t %.17g and %.17g", int(i), a.t, b.t);
  }
}

}  // namespace

int main() {
  std::vector<StructureRow> rows;
  for (const StructureRow& row : structures())
    if (test_scale() == 1 || row.index % 4 == 1) rows.push_back(row);  // in slow builds, fewer
  return run_for_each("models of all space", rows, test_row);
}
