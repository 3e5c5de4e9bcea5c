// SPDX-License-Identifier: Apache-2.0
// Starts of rays in vectors, against those of single rays: the same bits in all instruction sets.
#include <hwy/highway.h>

#include <vector>

#include "msq_test.h"
#include "random.h"
#include "ray/cast.h"
#include "ray/ray_starts.h"
#include "shape/primitive.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Into, beside and away from a box, some along axes and some from so far away that their numbers
/// do not tell the place.
RaySearch any_search(Random& random, const Box3& box) {
  RaySearch search;
  Vec3 d = random.direction();
  if (random.below(3) == 0) d[static_cast<int>(random.below(3))] = 0;
  if (random.below(5) == 0) d = Vec3{0, random.below(2) ? 1.0 : -1.0, 0};
  search.ray.direction = d * (1 / length(d));
  Vec3 target = random.in_box(box);
  if (random.below(4) == 0) target[static_cast<int>(random.below(3))] = box.max.y;
  if (random.below(8) == 0) {  // through an edge, about as far as the tolerance
    const double depth = std::exp2(random.between(-38, -32));
    target = box.max - Vec3{depth, depth, depth};
    search.ray.direction = Vec3{std::sqrt(0.5), -std::sqrt(0.5), 0};
  }
  const double away = random.below(8) == 0 ? std::exp2(random.between(20, 60)) : 2;
  search.ray.origin = target - search.ray.direction * (away * random.between(-0.3, 1));
  search.from = random.below(4) == 0 ? random.between(0, 2) : 0;
  search.to = random.below(6) == 0 ? random.between(0, 2) : std::numeric_limits<double>::infinity();
  return search;
}

bool crosses(const BoxShape& shape, const Ray& ray, double end, double& enter, double& leave) {
  return shape.cross(ray, 0, end, enter, leave, nullptr) && enter <= end;
}

void starts_have_the_bits_of_single_rays(void**) {
  Random random(1);
  size_t begun = 0, known = 0;
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    for (size_t n = test_count(20000); n > 0; --n) {
      const Vec3 low = random.in_box({{-2, -2, -2}, {2, 2, 2}});
      const BoxShape shape({low, low + random.in_box({{0.1, 0.1, 0.1}, {2, 2, 2}})});
      StartBoxes boxes;
      boxes.tolerance = shape.ray_tolerance();
      boxes.bounds = shape.bounds().grown(boxes.tolerance);
      boxes.near = boxes.bounds.grown(boxes.tolerance);
      boxes.beyond = random.below(2) ? 1e-3 : 0;
      boxes.has_box = random.below(4) != 0;
      boxes.box = shape.bounds();
      const bool is_all_space = random.below(8) == 0;  // of which rays have ends
      if (is_all_space) {
        boxes.has_box = false;
        const double far = std::numeric_limits<double>::infinity();
        boxes.bounds = boxes.near = {{-far, -far, -far}, {far, far, far}};
      }
      std::vector<RaySearch> searches(1 + random.below(RayStarts::most));
      for (RaySearch& search : searches) {
        search = any_search(random, shape.bounds());
        if (is_all_space) search.to = std::min(search.to, 100.0);
      }
      RayStarts starts;
      start_rays(searches.data(), searches.size(), boxes, starts);
      for (size_t i = 0; i < searches.size(); ++i) {
        RaySearch search = searches[i];
        double first = search.from, last = search.to + boxes.beyond;
        const bool meets =
            search.from <= search.to && clip_to_box(search.ray, boxes.bounds, first, last);
        const Vec3 place = search.ray.at(first);
        const bool begins = meets && boxes.near.contains(place);
        assert_int_equal(starts.miss >> i & 1, !meets);
        assert_int_equal(starts.begin >> i & 1, begins);
        if (!begins) {
          assert_false(starts.crosses >> i & 1);
          continue;
        }
        ++begun;
        double offset, end;
        assert_true(
            move_to_box(boxes.bounds, boxes.near, first, last, boxes.beyond, search, offset, end));
        assert_true(starts.offset[i] == offset && starts.end[i] == end);
        for (int axis = 0; axis < 3; ++axis)
          assert_true(starts.origin[axis][i] == search.ray.origin[axis]);
        double enter, leave;
        const bool is_met = crosses(shape, search.ray, end, enter, leave);
        if (!(starts.crosses >> i & 1)) {
          known += !boxes.has_box || !is_met;
          continue;
        }
        ++known;
        assert_true(boxes.has_box && is_met);
        assert_true(starts.enter[i] == enter && starts.leave[i] == leave);
      }
    }
    hwy::SetSupportedTargetsForTest(0);
  }
  // Few are left to be settled one by one.
  assert_true(10 * known > 9 * begun);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(starts_have_the_bits_of_single_rays)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
