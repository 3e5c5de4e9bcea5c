// SPDX-License-Identifier: Apache-2.0
// Loops and tasks on several threads: each part once, exceptions, loops within loops.
#include "base/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include "base/work_shares.h"
#include "msq_test.h"

namespace {

using msq::Executor;

void test_each_part_once(void**) {
  const Executor executor(4, true);
  for (const uint64_t count : {0, 1, 2, 3, 4, 5, 16, 17, 1000}) {
    std::vector<std::atomic<int>> done(count);
    executor.for_each(count, [&](uint64_t i) { ++done[i]; });
    for (const std::atomic<int>& times : done) assert_int_equal(times, 1);
  }
}

void test_one_thread_does_all(void**) {
  // As where no other thread comes.
  std::vector<int> done(100);
  const std::function<void(uint64_t)> body = [&](uint64_t i) { ++done[i]; };
  msq::WorkShares shares(done.size(), 40, body);
  shares.work(3);
  shares.work(0);
  shares.rethrow();
  for (const int times : done) assert_int_equal(times, 1);
}

void test_exceptions(void**) {
  const Executor executor(4, true);
  std::atomic<int> done{0};
  bool is_thrown = false;
  try {
    executor.for_each(100000, [&](uint64_t i) {
      if (i == 17) throw std::runtime_error("part 17");
      ++done;
    });
  } catch (const std::runtime_error& error) {
    is_thrown = std::string(error.what()) == "part 17";
  }
  assert_true(is_thrown);
  assert_true(done < 100000);
}

void test_loops_within_loops(void**) {
  const Executor executor(4, true);
  std::atomic<int> done{0};
  executor.for_each(20, [&](uint64_t) { executor.for_each(50, [&](uint64_t) { ++done; }); });
  assert_int_equal(done, 1000);
}

void test_tasks(void**) {
  for (const unsigned threads : {1, 3}) {
    const Executor executor(threads, true);
    for (int i = 0; i < 200; ++i) {
      std::atomic<int> done{0};
      Executor::Task task(executor, [&] { executor.for_each(30, [&](uint64_t) { ++done; }); });
      if (i % 2) executor.for_each(10, [](uint64_t) {});
      task.wait();
      assert_int_equal(done, 30);
    }
    bool is_thrown = false;
    Executor::Task task(executor, [] { throw std::runtime_error("of the task"); });
    try {
      task.wait();
    } catch (const std::runtime_error&) {
      is_thrown = true;
    }
    assert_true(is_thrown);
    // Left without a wait: begun or not, it is over.
    std::atomic<bool> is_over{false};
    {
      const Executor::Task left(executor, [&] { assert_false(is_over); });
    }
    is_over = true;
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_each_part_once), cmocka_unit_test(test_one_thread_does_all),
      cmocka_unit_test(test_exceptions), cmocka_unit_test(test_loops_within_loops),
      cmocka_unit_test(test_tasks)};
  return cmocka_run_group_tests_name("parallel", tests, nullptr, nullptr);
}
