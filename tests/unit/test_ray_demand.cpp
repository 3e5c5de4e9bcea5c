// SPDX-License-Identifier: Apache-2.0
// When rays through a foam are worth the edges about them.
#include "msq_test.h"
#include "structure/foam/rays/ray_demand.h"

using namespace msq;

namespace {

constexpr size_t worth = 40, many = 100000;

/// How many rays it takes, one by one.
size_t rays_until_worth(RayDemand& demand, CellIndex brick, size_t most = many) {
  for (size_t rays = 0;; ++rays) {
    if (demand.pays(brick, worth) || rays == 1000) return rays;
    demand.add(brick, 1, worth, most);
  }
}

void counts_brick_by_brick(void**) {
  RayDemand demand;
  double sum = 0;
  constexpr int bricks = 1000;
  for (int i = 0; i < bricks; ++i) {
    const size_t rays = rays_until_worth(demand, {i, -3 * i, 7});
    // 0: it shares its place with one before.
    if (rays > 0) assert_in_range(rays, worth / 2, worth + worth / 2);
    sum += static_cast<double>(rays);
  }
  assert_in_range(sum / bricks, worth - worth / 10, worth + worth / 10);
  assert_true(demand.pays({3, -9, 7}, worth));
}

void many_at_once_are_worth_it(void**) {
  RayDemand demand;
  assert_false(demand.pays({1, 2, 3}, worth));
  demand.add({1, 2, 3}, 2 * worth, worth, 0);
  assert_true(demand.pays({1, 2, 3}, worth));
  demand.add({1, 2, 4}, 1 << 20, worth, 0);
  assert_true(demand.pays({1, 2, 4}, worth));
}

void begins_anew_where_the_cache_holds_no_more(void**) {
  RayDemand demand;
  constexpr int most = 10;
  for (int i = 0; i < most; ++i) rays_until_worth(demand, {i, 0, 0}, most);
  for (int i = 0; i < most; ++i) assert_true(demand.pays({i, 0, 0}, worth));
  // The next one forgets them, and the last of them comes to be worth it first again.
  for (size_t n = 0; n < 2 * worth && demand.pays({most - 1, 0, 0}, worth); ++n)
    demand.add({most, 0, 0}, 1, worth, most);
  for (int i = 0; i <= most; ++i) assert_false(demand.pays({i, 0, 0}, worth));
  assert_in_range(rays_until_worth(demand, {most - 1, 0, 0}, most), worth / 2, 2 * worth);
}

void rays_far_apart_never_are(void**) {
  RayDemand demand;
  size_t paid = 0;
  for (int frame = 0; frame < 20; ++frame)
    for (int i = 0; i < 500; ++i)
      for (int j = 0; j < 500; ++j) {
        demand.add({i, j, 0}, 1, worth, many);
        paid += demand.pays({i, j, 0}, worth);
      }
  // Four bricks share a place, and drive each other out.
  assert_in_range(paid, 0, 20 * 500 * 500 / 5);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(counts_brick_by_brick),
      cmocka_unit_test(many_at_once_are_worth_it),
      cmocka_unit_test(begins_anew_where_the_cache_holds_no_more),
      cmocka_unit_test(rays_far_apart_never_are),
  };
  return cmocka_run_group_tests_name("ray_demand", tests, nullptr, nullptr);
}
