// SPDX-License-Identifier: Apache-2.0
// Fields of the distance to a shape, at every point and sampled.
#include "field/shape_distance.h"

#include "field/grid.h"
#include "field/map.h"
#include "field_checks.h"
#include "images.h"
#include "meshes.h"
#include "shape/host.h"
#include "shape/mesh.h"
#include "shape/primitive.h"
#include "shape/voxels.h"

using namespace msq;
using namespace msq::test;

namespace {

const auto no_limit = std::make_shared<MemoryBudget>(uint64_t{0});

std::vector<Ref<const Shape>> shapes() {
  std::vector<Ref<const Shape>> all;
  all.push_back(make_ref<BoxShape>(Box3{{-1, -0.5, 0}, {1, 1, 0.75}}));
  all.push_back(make_ref<SphereShape>(Vec3{0.5, 0, -0.25}, 0.8));
  all.push_back(make_ref<CylinderShape>(Vec3{-1, 0.2, 0}, Vec3{0.7, 0.5, 0.5}, 0.4));
  all.push_back(make_ref<Mesh>(torus_mesh(0.7, 0.3, 24, 12), WindingRule::nonzero, no_limit));
  TriangleSoup open = icosphere(0.9, 2);
  open.triangles.resize(open.triangles.size() - 7);
  all.push_back(make_ref<Mesh>(open, WindingRule::even_odd, no_limit));
  const ImageSize size{20, 20, 20};
  const auto ball = sampled<uint8_t>(size, [](Vec3 u) {
    return std::clamp(128 + 30 * (7 - length(u - Vec3{9, 9, 9})), 0.0, 255.0);
  });
  all.push_back(
      make_ref<Voxels>(make_image(ball, size, {{0, -1, 0}, {0.1, 0.1, 0.1}, skew_rotation()}), 128,
                       Voxels::Solid::above));
  return all;
}

/// Through a curve from the depth of the inside to beyond the outside.
MapField mapped(Ref<const Field> distance) {
  return MapField(std::move(distance), Curve({{-0.3, 1}, {-0.1, 0.25}, {0.2, 0.5}, {0.6, 0}}));
}

void test_promises(void**) {
  Random random(21);
  for (const Ref<const Shape>& shape : shapes()) {
    const auto distance = make_ref<ShapeDistanceField>(shape);
    for (int n = 0; n < 200; ++n) {
      const Vec3 p = random.in_box(Box3{}.grown(2));
      assert_true(distance->at(p) == shape->distance(p));
    }
    const MapField field = mapped(distance);
    const FieldOutcome outcome =
        check_field(field, Box3{}.grown(1.5), 1e-4, 1, test_count(600), random);
    assert_true(outcome.linear > 0);  // far from the shape
    assert_true(outcome.width < 20);
    assert_true(distance->range().low <= -0.2 && distance->range().low >= -2);
  }
}

/// Bounds that jump are no ground for anything, but answers stay right.
void test_distances_that_jump(void**) {
  HostShapeCalls calls;
  calls.inside = [](const Vec3* points, size_t count, uint8_t* inside) {
    for (size_t i = 0; i < count; ++i) inside[i] = length(points[i]) <= 0.6;
  };
  calls.distance = [](const Vec3* points, size_t count, double* bounds) {
    for (size_t i = 0; i < count; ++i)
      bounds[i] = std::floor(20 * points[i].x) == 3 ? 0 : std::abs(length(points[i]) - 0.6);
  };
  const Ref<const Shape> shape = make_ref<HostShape>(calls, Box3{}.grown(0.7), true);
  const MapField field = mapped(make_ref<ShapeDistanceField>(shape));
  Random random(5);
  check_field(field, Box3{}.grown(1), 1e-4, 1, test_count(500), random);
  assert_true(std::isinf(field.lipschitz()));
}

void test_samples(void**) {
  const Executor executor(2, true);
  Random random(8);
  for (const Ref<const Shape>& shape : shapes()) {
    const double step = 0.06;
    const GridField field(sample_distance(*shape, step, executor, no_limit));
    const Box3 box = shape->bounds();
    double mean = 0;
    const size_t count = test_count(2000);
    for (size_t n = 0; n < count; ++n) {
      const Vec3 p = random.in_box(box.grown(0.5 * step));
      const double off = std::abs(field.at(p) - shape->distance(p));
      assert_true(off <= step * 1.7321);
      mean += off / static_cast<double>(count);
    }
    assert_true(mean < 0.15 * step);
    // Beyond the box that of its border.
    const Vec3 far = box.max + Vec3{3, 3, 3};
    assert_true(std::abs(field.at(far) - shape->distance(box.max)) < 4 * step);
  }
}

void test_samples_have_limits(void**) {
  const Executor executor(1);
  const SphereShape ball({0, 0, 0}, 1);
  const auto status_of = [&](double step, const std::shared_ptr<MemoryBudget>& budget) {
    try {
      sample_distance(ball, step, executor, budget);
    } catch (const Error& error) {
      return error.status;
    }
    return Status::internal;
  };
  assert_true(status_of(1e-9, no_limit) == Status::argument);
  const auto little = std::make_shared<MemoryBudget>(uint64_t{1000});
  assert_true(status_of(0.1, little) == Status::limit);
  assert_true(little->held() == 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_promises), cmocka_unit_test(test_distances_that_jump),
      cmocka_unit_test(test_samples), cmocka_unit_test(test_samples_have_limits)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
