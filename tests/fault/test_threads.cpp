// SPDX-License-Identifier: Apache-2.0
// Threads of the host that come, go, work at once and within each other's calls.
#include <atomic>
#include <cstring>
#include <thread>

#include "suite.h"
#include "world.h"

namespace {

using namespace msq::test;

/// What one thread does: a call that fails, and calls that answer.
uint64_t work(const msq_model* model) {
  int32_t inside = 0;
  if (msq_point_membership(model, nullptr, nullptr, &inside) != MSQ_E_ARGUMENT) return 0;
  if (!std::strstr(msq_error_message(), "point")) return 0;
  uint64_t answers = 1;
  const std::vector<double> points = some_points(40);
  for (size_t i = 0; i < points.size(); i += 3) {
    if (msq_point_membership(model, &points[i], nullptr, &inside) != MSQ_OK) return 0;
    answers = answers * 3 + static_cast<uint64_t>(inside);
  }
  double distance;
  if (msq_point_distance(model, points.data(), nullptr, &distance) != MSQ_OK) return 0;
  return answers;
}

void come_and_go() {
  const Stage stage;
  World world(stage);
  const msq_model* model = world.model(world.box(), kinds()[4].make(world));
  const uint64_t expected = work(model);
  assert_true(expected != 0);
  int64_t first = 0;
  for (int i = 0; i < 300; ++i) {
    uint64_t answers = 0;
    std::thread([&] { answers = work(model); }).join();
    assert_int_equal(answers, expected);
    if (i == 0) first = live_blocks();
  }
  // Memory kept for the next call goes from thread to thread.
  assert_true(live_blocks() <= first + 8);
}

void test_threads_leave_nothing(void**) {
  // What the process allocates once is there then.
  come_and_go();
  const int64_t before = live_blocks();
  come_and_go();
  assert_int_equal(live_blocks(), before);
}

void test_threads_at_once(void**) {
  const Stage stage;
  World world(stage);
  const msq_model* model = world.model(world.box(), kinds()[4].make(world));
  const uint64_t expected = work(model);
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  // More than there are places for what is kept.
  for (int t = 0; t < 80; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 20; ++i) {
        wrong += work(model) != expected;
        if (t % 8) continue;
        // Another context begins and ends.
        const Stage other;
        World inner(other);
        wrong += work(inner.model(inner.box(), kinds()[4].make(inner))) != expected;
      }
    });
  for (std::thread& thread : threads) thread.join();
  assert_int_equal(wrong, 0);
}

/// A radius that asks another model of the same kind: the call begins again within itself.
int32_t asking_values(void* user, const double* points, uint64_t count, double* values) {
  const auto* model = static_cast<const msq_model*>(user);
  for (uint64_t i = 0; i < count; ++i) {
    int32_t inside;
    const double elsewhere[3] = {points[3 * i + 1], points[3 * i + 2], points[3 * i]};
    if (msq_point_membership(model, elsewhere, nullptr, &inside) != MSQ_OK) return -1;
    values[i] = inside ? 0.2 : 0.1;
  }
  return 0;
}

void test_calls_within_calls(void**) {
  for (const bool is_nested : {false, true}) {
    static std::vector<uint8_t> expected;
    const Stage stage;
    World world(stage);
    const msq_model* inner = world.model(world.box(), kinds()[4].make(world));
    msq_host_field_def field_def = make_def(msq_host_field_def_init);
    field_def.evaluate = asking_values;
    field_def.user = const_cast<msq_model*>(inner);
    field_def.low = 0.1;
    field_def.high = 0.2;
    msq_field* field;
    assert_ok(msq_field_host(world.context, &field_def, &field));
    world.keep(field);
    msq_foam_def def = make_def(msq_foam_def_init);
    def.radius.field = field;
    msq_structure* structure;
    assert_ok(msq_structure_foam(world.context, &def, &structure));
    const msq_model* model = world.model(world.box(), world.keep(structure));
    const std::vector<double> points = some_points(200);
    std::vector<uint8_t> inside(200);
    if (is_nested) {
      const msq_points_def array = array_of(points);
      assert_ok(msq_set_membership(model, &array, nullptr, inside.data(), inside.size(), nullptr));
      assert_memory_equal(inside.data(), expected.data(), inside.size());
      continue;
    }
    for (size_t i = 0; i < inside.size(); ++i) {
      int32_t one;
      assert_ok(msq_point_membership(model, &points[3 * i], nullptr, &one));
      inside[i] = static_cast<uint8_t>(one);
    }
    expected = inside;
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_threads_leave_nothing),
                              cmocka_unit_test(test_threads_at_once),
                              cmocka_unit_test(test_calls_within_calls)};
  return cmocka_run_group_tests_name("threads", tests, nullptr, nullptr);
}
