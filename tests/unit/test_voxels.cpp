// SPDX-License-Identifier: Apache-2.0
// Voxel images as shapes: what is solid, how near their distances are, what is known of them.
#include "shape/voxels.h"

#include "images.h"
#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr double radius = 12.3;
const ImageSize size{31, 32, 33};
const Vec3 middle{15, 15.5, 16};

double ball(Vec3 u) {
  return 128 + 20 * (radius - length(u - middle));
}

Ref<const Voxels> make_ball(const ImageFrame& frame, Voxels::Solid solid = Voxels::Solid::above) {
  return make_ref<Voxels>(make_image(sampled<float>(size, ball), size, frame), 128, solid);
}

ImageFrame turned_frame() {
  return {{5, -2, 9}, {0.5, 0.5, 0.5}, skew_rotation()};
}

/// The samples are those of a ball, and so is what is between them, nearly.
void test_a_ball(void**) {
  const ImageFrame frame = turned_frame();
  const auto above = make_ball(frame), below = make_ball(frame, Voxels::Solid::below);
  Random random(2);
  for (size_t n = 0; n < test_count(20000); ++n) {
    const Vec3 u = random.in_box({{-2, -2, -2}, {34, 34, 34}});
    const Vec3 p = frame.rotation.apply(u * frame.spacing) + frame.origin;
    const bool is_within = u.x >= 0 && u.x <= 30 && u.y >= 0 && u.y <= 31 && u.z >= 0 && u.z <= 32;
    const double off = length(u - middle) - radius;
    if (std::abs(off) < 0.05) continue;
    assert_true(above->inside(p) == (off < 0));
    assert_true(below->inside(p) == (off > 0 && is_within));
  }
}

/// The threshold is solid on either side, and so is the image's border.
void test_boundary_is_inside(void**) {
  std::vector<uint8_t> values(27);
  for (size_t i = 0; i < 27; ++i) values[i] = static_cast<uint8_t>(i % 3 * 10);
  const ImageFrame frame{{0.1, 0.2, 0.3}, {0.7, 0.7, 0.7}, {}};
  const Voxels above(make_image(values, {3, 3, 3}, frame), 10, Voxels::Solid::above);
  const Voxels below(make_image(values, {3, 3, 3}, frame), 10, Voxels::Solid::below);
  for (double y : {0.2, 0.5, 0.2 + 1.4}) {
    assert_true(above.inside({0.1 + 0.7, y, 0.3}) && below.inside({0.1 + 0.7, y, 0.3}));
    assert_true(above.inside({0.1 + 1.4, y, 0.3 + 1.4}));
    assert_true(!above.inside({0.1 + 0.69, y, 0.3}) && below.inside({0.1 + 0.69, y, 0.3}));
    assert_true(above.inside({0.1 + 0.71, y, 0.3}) && !below.inside({0.1 + 0.71, y, 0.3}));
    assert_true(!above.inside({0.1 + 1.41, y, 0.3}));
  }
}

/// No more than a cell's diagonal short of the nearest sample on the other side, or of the border.
void test_distances_are_near(void**) {
  const ImageFrame frame = turned_frame();
  const auto shape = make_ball(frame);
  const double diagonal = std::sqrt(3.0) * 0.5;
  Random random(7);
  for (size_t n = 0; n < test_count(5000); ++n) {
    const Vec3 u = random.in_box({{-20, -20, -20}, {50, 50, 50}});
    const double d = shape->distance(frame.rotation.apply(u * frame.spacing) + frame.origin);
    const double wanted = (length(u - middle) - radius) * 0.5;
    // The trilinear ball is smaller than the ball by a little.
    if (!(std::abs(d) <= std::abs(wanted) + 0.01 && std::abs(d) >= std::abs(wanted) - diagonal))
      fail_msg("%g voxels off the centre: %g, not %g", length(u - middle), d, wanted);
  }
}

/// A sample of great magnitude, as for missing data, does not make rays pass through solid in cells
/// that do not have it.
void test_rays_beside_missing_data(void**) {
  const ImageSize few{4, 4, 6};
  Random random(9);
  for (const double missing : {-9999.0, -3.4e38, 1e100}) {
    std::vector<double> values;
    for (uint64_t i = 0; i < 4 * 4 * 6; ++i) values.push_back(random.between(0, 255));
    values[21] = missing;
    const ImageFrame frame{{1, -2, 3}, {1.9, 2, 2.9}, skew_rotation()};
    const Voxels shape(make_image(values, few, frame), 120, Voxels::Solid::above);
    const Box3 around = shape.bounds().grown(2);
    for (size_t n = test_count(400); n > 0; --n) {
      Ray ray{random.in_box(around), {}};
      if (shape.inside(ray.origin)) continue;
      ray.direction = random.in_box(shape.bounds()) - ray.origin;
      double hit = 2;
      if (!shape.enter(ray, 0, 2, hit, nullptr)) hit = 2;
      for (int i = 0; i < 400; ++i)
        if (const double t = hit * (i / 400.0); t < hit - 1e-8 && shape.inside(ray.at(t)))
          fail_msg("missing data %g: solid at %g of a ray that hits at %g", missing, t, hit);
    }
  }
}

void test_facts(void**) {
  const auto shape = make_ball({{5, -2, 9}, {0.5, 0.25, 2}, {}});
  const ShapeFacts& facts = shape->facts();
  const double volume = 4 / 3.0 * 3.14159265358979 * std::pow(radius, 3) * 0.25;
  assert_true(std::abs(facts.volume / volume - 1) < 0.01);
  // The cells about the ball's samples.
  assert_true(facts.bounds.min == Vec3({5 + 2 * 0.5, -2 + 3 * 0.25, 9 + 3 * 2}));
  assert_true(facts.bounds.max == Vec3({5 + 28 * 0.5, -2 + 28 * 0.25, 9 + 29 * 2}));
  assert_true(!facts.is_mesh && facts.triangles == 0 && facts.closed);
  // A solid that fills its image is the box between the outermost samples.
  const Voxels full(make_image(std::vector<uint8_t>(60, 9), {3, 4, 5}, {{1, 1, 1}, {2, 2, 2}, {}}),
                    9, Voxels::Solid::above);
  assert_true(full.facts().volume == 4 * 6 * 8);
  assert_true(full.bounds().max == Vec3({5, 7, 9}));
  assert_true(full.distance({3, 4, 5}) < -2 + 1e-6 && full.distance({3, 4, 5}) >= -2);
  assert_true(full.distance({3, 4, 10}) > 1 - 1e-6 && full.distance({3, 4, 10}) <= 1);
}

void test_what_has_no_solid_is_refused(void**) {
  const std::vector<uint8_t> values(27, 5);
  for (const auto solid : {Voxels::Solid::above, Voxels::Solid::below}) try {
      const Voxels made(make_image(values, {3, 3, 3}, {}),
                        solid == Voxels::Solid::above ? 5.5 : 4.5, solid);
      fail_msg("made of nothing");
    } catch (const Error& error) {
      assert_true(error.status == Status::argument);
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_a_ball),
                              cmocka_unit_test(test_boundary_is_inside),
                              cmocka_unit_test(test_distances_are_near),
                              cmocka_unit_test(test_rays_beside_missing_data),
                              cmocka_unit_test(test_facts),
                              cmocka_unit_test(test_what_has_no_solid_is_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
