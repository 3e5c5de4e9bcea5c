// SPDX-License-Identifier: Apache-2.0
// The memory budget: held, peak, limit, and reservations that give back.
#include <thread>

#include "base/memory.h"
#include "msq_test.h"

using namespace msq;

namespace {

/// Whether take() refuses, with a message that names what and the limit.
bool refuses(MemoryBudget& budget, uint64_t bytes) {
  try {
    budget.take(bytes, "a thing");
  } catch (const Error& error) {
    assert_int_equal(static_cast<int>(error.status), static_cast<int>(Status::limit));
    assert_non_null(strstr(error.what(), "a thing"));
    assert_non_null(strstr(error.what(), "memory_limit of 100"));
    return true;
  }
  return false;
}

void test_limit(void**) {
  MemoryBudget budget(100);
  assert_false(refuses(budget, 100));
  assert_true(refuses(budget, 1));
  assert_false(budget.try_take(1));
  assert_int_equal(budget.held(), 100);
  budget.give_back(60);
  assert_true(refuses(budget, 61));
  assert_true(refuses(budget, UINT64_MAX));  // no overflow
  assert_false(budget.try_take(UINT64_MAX - 10));
  assert_true(budget.try_take(60));
  budget.give_back(100);
  assert_int_equal(budget.held(), 0);
  assert_int_equal(budget.peak(), 100);
  assert_int_equal(budget.limit(), 100);
}

void test_no_limit(void**) {
  MemoryBudget budget(0);
  budget.take(uint64_t{1} << 60, "a thing");
  assert_true(budget.try_take(uint64_t{1} << 60));
  assert_true(budget.held() == uint64_t{1} << 61);
}

void test_reservation(void**) {
  const auto budget = std::make_shared<MemoryBudget>(uint64_t{100});
  {
    Reservation first(budget, 30, "a thing");
    Reservation second(std::move(first));
    assert_int_equal(budget->held(), 30);
    Reservation third;
    third = std::move(second);
    assert_int_equal(budget->held(), 30);
    third = Reservation(budget, 50, "a thing");
    assert_int_equal(budget->held(), 50);
    assert_int_equal(budget->peak(), 80);
    third = {};
    assert_int_equal(budget->held(), 0);
    bool is_thrown = false;
    try {
      Reservation fourth(budget, 101, "a thing");
    } catch (const Error&) {
      is_thrown = true;
    }
    assert_true(is_thrown);
    assert_int_equal(budget->held(), 0);
    third = Reservation(budget, 7, "a thing");
  }
  assert_int_equal(budget->held(), 0);
}

void test_threads(void**) {
  MemoryBudget budget(1000);
  std::thread threads[4];
  for (std::thread& thread : threads)
    thread = std::thread([&] {
      for (int n = 0; n < 20000; ++n)
        if (budget.try_take(400)) budget.give_back(400);
    });
  for (std::thread& thread : threads) thread.join();
  assert_int_equal(budget.held(), 0);
  assert_in_range(budget.peak(), 400, 800);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_limit), cmocka_unit_test(test_no_limit),
                              cmocka_unit_test(test_reservation), cmocka_unit_test(test_threads)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
