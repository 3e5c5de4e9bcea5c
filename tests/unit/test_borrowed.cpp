// SPDX-License-Identifier: Apache-2.0
// What is kept between calls: whole or not at all, one object for each that works, no more.
#include "base/borrowed.h"

#include <atomic>
#include <stdexcept>
#include <thread>

#include "msq_test.h"

namespace {

using msq::Borrowed;
using msq::KeptType;

std::atomic<int> living{0};

struct Counted {
  Counted() { ++living; }
  ~Counted() { --living; }
  int value = 0;
};

struct Large {
  size_t bytes() const { return size; }
  size_t size = 0;
};

void test_is_kept(void**) {
  KeptType::clear_all();
  { Borrowed<Counted>()->value = 7; }
  assert_int_equal(living, 1);
  assert_int_equal(KeptType::count_all(), 1);
  const Counted* first;
  {
    const Borrowed<Counted> again;
    assert_int_equal(again->value, 7);
    first = &*again;
    // Work within the work.
    const Borrowed<Counted> inner;
    assert_ptr_not_equal(&*inner, first);
    assert_int_equal(inner->value, 0);
  }
  assert_int_equal(living, 2);
  for (int i = 0; i < 100; ++i) {
    const Borrowed<Counted> a, b;
    assert_ptr_not_equal(&*a, &*b);
  }
  assert_int_equal(living, 2);
  KeptType::clear_all();
  assert_int_equal(living, 0);
  assert_int_equal(KeptType::count_all(), 0);
}

void test_is_dropped_after_exceptions(void**) {
  { Borrowed<Counted>()->value = 7; }
  try {
    const Borrowed<Counted> half;
    half->value = 8;
    throw std::runtime_error("in the middle of work");
  } catch (const std::runtime_error&) {
  }
  assert_int_equal(living, 0);
  assert_int_equal(Borrowed<Counted>()->value, 0);
  // Not where it is borrowed while another exception is on its way.
  struct Leaving {
    ~Leaving() { Borrowed<Counted>()->value = 9; }
  };
  try {
    const Leaving leaving;
    throw std::runtime_error("past it");
  } catch (const std::runtime_error&) {
  }
  assert_int_equal(Borrowed<Counted>()->value, 9);
  KeptType::clear_all();
}

void test_large_ones_are_not_kept(void**) {
  KeptType::clear_all();
  Borrowed<Large>()->size = msq::max_kept_bytes;
  assert_int_equal(KeptType::count_all(), 1);
  Borrowed<Large>()->size = msq::max_kept_bytes + 1;
  assert_int_equal(KeptType::count_all(), 0);
  (*Borrowed<std::vector<double>>()).resize(msq::max_kept_bytes / sizeof(double) + 1);
  assert_int_equal(KeptType::count_all(), 0);
}

void test_threads(void**) {
  KeptType::clear_all();
  // One after the other: the memory of those that ended serves the next.
  for (int i = 0; i < 200; ++i) std::thread([] { ++Borrowed<Counted>()->value; }).join();
  assert_int_equal(living, 1);
  assert_int_equal(Borrowed<Counted>()->value, 200);
  // At once, while it is cleared: nobody shares.
  std::atomic<int> shared{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 100; ++t)
    threads.emplace_back([&shared, t] {
      for (int i = 0; i < 200; ++i) {
        const Borrowed<Counted> mine;
        const int value = mine->value = 1000 * t + i;
        if (i % 64 == 0) KeptType::clear_all();
        std::this_thread::yield();
        shared += mine->value != value;
      }
    });
  for (std::thread& thread : threads) thread.join();
  assert_int_equal(shared, 0);
  assert_true(living <= 64);
  KeptType::clear_all();
  assert_int_equal(living, 0);
}

void test_goes_with_the_last(void**) {
  {
    const msq::KeepsMemory outer;
    {
      const msq::KeepsMemory inner;
      Borrowed<Counted>()->value = 1;
    }
    assert_int_equal(living, 1);
  }
  assert_int_equal(living, 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_is_kept), cmocka_unit_test(test_is_dropped_after_exceptions),
      cmocka_unit_test(test_large_ones_are_not_kept), cmocka_unit_test(test_threads),
      cmocka_unit_test(test_goes_with_the_last)};
  return cmocka_run_group_tests_name("borrowed", tests, nullptr, nullptr);
}
