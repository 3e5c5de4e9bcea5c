// SPDX-License-Identifier: Apache-2.0
// The cell cache: first in, first out, never over its limit nor the memory limit, from many
// threads.
#include <atomic>
#include <thread>
#include <vector>

#include "cell/cache.h"
#include "msq_test.h"
#include "random.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Data final : CellData {
  Data(uint64_t size, uint64_t mark) : size(size), mark(mark) {}
  uint64_t bytes() const override { return size; }
  uint64_t size, mark;
};

uint64_t mark_of(uint64_t structure, CellIndex cell) {
  return structure * 1000003 + static_cast<uint64_t>(cell.x * 101 + cell.y * 10007 + cell.z * 1009);
}

/// Fetches; says whether the cell was built.
bool fetch(CellCache& cache, uint64_t structure, CellIndex cell, uint64_t size) {
  bool is_built = false;
  const auto data = cache.fetch(structure, cell, [&] {
    is_built = true;
    return std::make_shared<const Data>(size, mark_of(structure, cell));
  });
  assert_true(static_cast<const Data&>(*data).mark == mark_of(structure, cell));
  return is_built;
}

std::shared_ptr<MemoryBudget> budget(uint64_t limit = 0) {
  return std::make_shared<MemoryBudget>(limit);
}

/// Bytes of an entry, what the cache adds included: found out, not assumed.
uint64_t entry_bytes(uint64_t size) {
  CellCache cache(1 << 20, budget());
  fetch(cache, 1, {0, 0, 0}, size);
  const uint64_t bytes = cache.counters().bytes;
  assert_true(bytes >= size);
  return bytes;
}

void test_drop(void**) {
  const uint64_t entry = entry_bytes(100);
  const auto shared = budget();
  CellCache cache(6 * entry, shared);
  for (int i = 0; i < 6; ++i) fetch(cache, i % 2 ? uint64_t{1} : uint64_t{2}, {i, 0, 0}, 100);
  cache.drop(1);
  assert_int_equal(cache.counters().bytes, 3 * entry);
  assert_int_equal(shared->held(), 3 * entry);
  for (int i = 0; i < 6; i += 2) assert_false(fetch(cache, 2, {i, 0, 0}, 100));
  for (int i = 1; i < 6; i += 2) assert_true(fetch(cache, 1, {i, 0, 0}, 100));
  assert_true(fetch(cache, 3, {0, 0, 0}, 100));
  assert_true(fetch(cache, 2, {0, 0, 0}, 100));  // evicted, as the first that was left
  cache.drop(4);
  assert_int_equal(cache.counters().bytes, 6 * entry);
}

void test_order(void**) {
  const uint64_t entry = entry_bytes(100);
  CellCache cache(4 * entry, budget());
  for (int i = 0; i < 4; ++i) assert_true(fetch(cache, 1, {i, 0, 0}, 100));
  assert_int_equal(cache.counters().bytes, 4 * entry);
  // Used last, but the first in is the first out.
  assert_false(fetch(cache, 1, {0, 0, 0}, 100));
  assert_true(fetch(cache, 1, {4, 0, 0}, 100));
  for (int i = 1; i < 5; ++i) assert_false(fetch(cache, 1, {i, 0, 0}, 100));
  assert_true(fetch(cache, 1, {0, 0, 0}, 100));  // evicts cell 1
  assert_true(fetch(cache, 1, {1, 0, 0}, 100));  // evicts cell 2
  assert_false(fetch(cache, 1, {3, 0, 0}, 100));
  const CellCache::Counters counters = cache.counters();
  assert_int_equal(counters.misses, 7);
  assert_int_equal(counters.hits, 6);
  assert_int_equal(counters.evictions, 3);
  assert_int_equal(counters.peak_bytes, 4 * entry);
  // A large entry takes the place of several.
  assert_true(fetch(cache, 1, {9, 0, 0}, 100 + 2 * entry));
  assert_int_equal(cache.counters().evictions, 6);
  assert_int_equal(cache.counters().bytes, 4 * entry);
}

void test_keys(void**) {
  CellCache cache(1 << 20, budget());
  const CellIndex cells[] = {{1, 2, 3}, {3, 2, 1}, {-1, 2, 3}, {1, -2, 3}, {1, 2, -3}, {0, 0, 0}};
  for (uint64_t structure : {1, 2})
    for (CellIndex cell : cells) assert_true(fetch(cache, structure, cell, 10));
  for (uint64_t structure : {1, 2})
    for (CellIndex cell : cells) assert_false(fetch(cache, structure, cell, 10));
}

void test_too_large(void**) {
  const uint64_t entry = entry_bytes(100);
  CellCache cache(entry, budget());
  assert_true(fetch(cache, 1, {0, 0, 0}, 101));
  assert_true(fetch(cache, 1, {0, 0, 0}, 101));
  assert_int_equal(cache.counters().bytes, 0);
  assert_true(fetch(cache, 1, {0, 0, 0}, 100));
  assert_false(fetch(cache, 1, {0, 0, 0}, 100));
  CellCache none(0, budget());
  assert_true(fetch(none, 1, {0, 0, 0}, 0));
  assert_true(fetch(none, 1, {0, 0, 0}, 0));
  assert_int_equal(none.counters().peak_bytes, 0);
}

void test_budget(void**) {
  const uint64_t entry = entry_bytes(100);
  const auto shared = budget(3 * entry);
  {
    CellCache cache(10 * entry, shared);
    for (int i = 0; i < 5; ++i) assert_true(fetch(cache, 1, {i, 0, 0}, 100));
    assert_int_equal(cache.counters().bytes, 3 * entry);
    assert_int_equal(shared->held(), 3 * entry);
    assert_int_equal(cache.counters().evictions, 2);
    cache.clear();
    assert_int_equal(shared->held(), 0);
    assert_int_equal(cache.counters().bytes, 0);
    assert_int_equal(cache.counters().misses, 5);
    // Others hold nearly all: nothing can be kept, and that is no failure.
    shared->take(2 * entry + 1, "others");
    assert_true(fetch(cache, 1, {0, 0, 0}, 100));
    assert_true(fetch(cache, 1, {0, 0, 0}, 100));
    assert_int_equal(cache.counters().bytes, 0);
    shared->give_back(2 * entry + 1);
    assert_true(fetch(cache, 1, {0, 0, 0}, 100));
  }
  assert_int_equal(shared->held(), 0);  // the cache gave back what it held
}

void test_failing_build(void**) {
  CellCache cache(1 << 20, budget());
  bool is_thrown = false;
  try {
    cache.fetch(1, {0, 0, 0}, []() -> std::shared_ptr<const CellData> { throw 5; });
  } catch (int) {
    is_thrown = true;
  }
  assert_true(is_thrown);
  assert_int_equal(cache.counters().bytes, 0);
  assert_true(fetch(cache, 1, {0, 0, 0}, 1));
}

/// Many threads under a cache limit and a memory limit, of which either binds.
void check_threads(uint64_t limit, uint64_t memory_limit) {
  const auto shared = budget(memory_limit);
  CellCache cache(limit, shared);
  std::atomic<uint64_t> wrong{0}, over{0}, fetched{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 6; ++t)
    threads.emplace_back([&, t] {
      Random random(t);
      for (size_t n = test_count(20000); n > 0; --n) {
        const CellIndex cell{static_cast<int32_t>(random.below(30)), -1, 5};
        const uint64_t structure = 1 + random.below(2);
        const auto data = cache.fetch(structure, cell, [&] {
          return std::make_shared<const Data>(50 + random.below(200), mark_of(structure, cell));
        });
        wrong += static_cast<const Data&>(*data).mark != mark_of(structure, cell);
        const CellCache::Counters counters = cache.counters();
        over += counters.bytes > limit || counters.peak_bytes > limit;
        over += shared->held() > memory_limit;
        ++fetched;
        if (n % 1000 == 0) cache.clear();
      }
    });
  for (std::thread& thread : threads) thread.join();
  assert_int_equal(wrong.load(), 0);
  assert_int_equal(over.load(), 0);
  const CellCache::Counters counters = cache.counters();
  assert_int_equal(counters.hits + counters.misses, fetched.load());
  assert_int_equal(counters.bytes, shared->held());
  assert_true(counters.hits > 0 && counters.evictions > 0);
}

void test_threads(void**) {
  const uint64_t limit = 20 * entry_bytes(100);
  check_threads(limit, limit / 2);
  check_threads(limit, 2 * limit);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_order),  cmocka_unit_test(test_drop),
                              cmocka_unit_test(test_keys),   cmocka_unit_test(test_too_large),
                              cmocka_unit_test(test_budget), cmocka_unit_test(test_failing_build),
                              cmocka_unit_test(test_threads)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
