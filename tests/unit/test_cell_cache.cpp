// SPDX-License-Identifier: Apache-2.0
// The cell cache: which cell goes, who waits for whom, never over its limit nor the memory limit,
// from many threads.
#include <algorithm>
#include <atomic>
#include <future>
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

/// A look at a cell is no fetch.
void test_keeps(void**) {
  const uint64_t entry = entry_bytes(100);
  for (const CachePolicy policy : {CachePolicy::fifo, CachePolicy::segmented}) {
    CellCache cache(4 * entry, budget(), policy);
    assert_false(cache.keeps(1, {0, 0, 0}));
    for (int i = 0; i < 4; ++i) fetch(cache, 1, {i, 0, 0}, 100);
    const CellCache::Counters before = cache.counters();
    for (int i = 0; i < 4; ++i) assert_true(cache.keeps(1, {i, 0, 0}));
    assert_false(cache.keeps(1, {4, 0, 0}));
    assert_false(cache.keeps(2, {0, 0, 0}));
    const CellCache::Counters after = cache.counters();
    assert_int_equal(after.hits, before.hits);
    assert_int_equal(after.misses, before.misses);
    // It spares none: the oldest goes first.
    fetch(cache, 1, {4, 0, 0}, 100);
    assert_false(cache.keeps(1, {0, 0, 0}));
    for (int i = 1; i < 5; ++i) assert_true(cache.keeps(1, {i, 0, 0}));
    cache.clear();
    assert_false(cache.keeps(1, {1, 0, 0}));
  }
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

void test_segmented(void**) {
  const uint64_t entry = entry_bytes(100);
  const auto fetch_row = [&](CellCache& cache, int first, int end) {
    int built = 0;
    for (int i = first; i < end; ++i) built += fetch(cache, 1, {i, 0, 0}, 100);
    return built;
  };
  CellCache cache(20 * entry, budget(), CachePolicy::segmented);
  assert_int_equal(fetch_row(cache, 0, 20), 20);
  assert_int_equal(fetch_row(cache, 3, 9), 0);
  // Many that are fetched once leave those that were fetched again, and go themselves.
  assert_int_equal(fetch_row(cache, 100, 200), 100);
  assert_int_equal(fetch_row(cache, 3, 9), 0);
  assert_int_equal(fetch_row(cache, 0, 3), 3);
  assert_int_equal(cache.counters().cells, 20);
  assert_int_equal(cache.counters().bytes, 20 * entry);
  // So do those that came back soon after they went. Of 0, 1 and 2, newcomers again, 0 is let go.
  assert_int_equal(fetch_row(cache, 300, 318), 18);
  assert_int_equal(fetch_row(cache, 0, 3), 3);
  assert_int_equal(fetch_row(cache, 400, 500), 100);
  assert_int_equal(fetch_row(cache, 0, 9), 0);
  // Newcomers have a tenth, and no more go than come.
  CellCache share(40 * entry, budget(), CachePolicy::segmented);
  for (int built : {40, 0}) assert_int_equal(fetch_row(share, 0, 40), built);
  assert_int_equal(fetch_row(share, 100, 104), 4);
  assert_int_equal(fetch_row(share, 100, 104), 0);
  assert_int_equal(fetch_row(share, 4, 40), 0);
}

std::shared_ptr<const CellData> hold(CellCache& cache, CellIndex cell, uint64_t size) {
  return cache.fetch(1, cell, [&] { return std::make_shared<const Data>(size, mark_of(1, cell)); });
}

void test_in_use(void**) {
  const uint64_t entry = entry_bytes(100);
  for (const CachePolicy policy : {CachePolicy::fifo, CachePolicy::segmented}) {
    CellCache cache(3 * entry, budget(), policy);
    auto held = hold(cache, {0, 0, 0}, 100);
    for (int i = 1; i < 4; ++i) assert_true(fetch(cache, 1, {i, 0, 0}, 100));
    assert_false(fetch(cache, 1, {0, 0, 0}, 100));  // the oldest, but 1 went
    assert_true(fetch(cache, 1, {1, 0, 0}, 100));
    // All in use: what comes now is not kept.
    const std::shared_ptr<const CellData> all[] = {hold(cache, {1, 0, 0}, 100),
                                                   hold(cache, {3, 0, 0}, 100)};
    const uint64_t unkept = cache.counters().unkept;
    assert_true(fetch(cache, 1, {7, 0, 0}, 100));
    assert_true(fetch(cache, 1, {7, 0, 0}, 100));
    assert_int_equal(cache.counters().unkept, unkept + 2);
    assert_int_equal(cache.counters().bytes, 3 * entry);
    // But the rest of the context gets what it needs.
    for (int i = 0; i < 3; ++i) assert_true(cache.drop_oldest());
    assert_false(cache.drop_oldest());
    assert_int_equal(cache.counters().bytes, 0);
    assert_int_equal(cache.counters().cells, 0);
    held.reset();
    assert_true(fetch(cache, 1, {7, 0, 0}, 100));
    assert_false(fetch(cache, 1, {7, 0, 0}, 100));
  }
}

void test_room_while_building(void**) {
  const uint64_t entry = entry_bytes(100);
  const auto shared = budget();
  CellCache cache(4 * entry, shared);
  const auto expect_room = [&](CellIndex cell, uint64_t bytes, uint64_t size, uint64_t hint) {
    bool is_asked = false;
    cache.fetch(
        1, cell,
        [&] {
          is_asked = true;
          assert_int_equal(cache.counters().building_bytes, bytes);
          assert_true(cache.counters().bytes >= bytes);
          assert_true(cache.counters().bytes <= cache.limit());
          assert_int_equal(cache.counters().bytes, shared->held());
          return std::make_shared<const Data>(size, 0);
        },
        hint);
    assert_true(is_asked);
    assert_int_equal(cache.counters().building_bytes, 0);
  };
  expect_room({0, 0, 0}, entry, 150, 100);  // the caller's guess, while nothing is known
  assert_int_equal(cache.counters().bytes, entry + 50);
  expect_room({1, 0, 0}, entry + 50, 100, 100);  // then the cache's own
  assert_int_equal(cache.counters().bytes, 2 * entry + 50);
  expect_room({2, 0, 0}, entry + 50 - 50 / 16, 100, 100);  // a little less, since that was less
  for (int i = 3; i < 9; ++i) assert_true(fetch(cache, 1, {i, 0, 0}, 100));
  // Room is made before the cell is there.
  cache.fetch(1, {20, 0, 0}, [&] {
    assert_int_equal(cache.counters().cells, 3 - 1);
    return std::make_shared<const Data>(100, 0);
  });
  assert_int_equal(cache.counters().cells, 3);
  // Cells within cells, up to more than there is room for.
  cache.fetch(1, {30, 0, 0}, [&] {
    cache.fetch(1, {31, 0, 0}, [&] {
      cache.fetch(1, {32, 0, 0}, [&] {
        cache.fetch(1, {33, 0, 0}, [&] { return std::make_shared<const Data>(100, 0); });
        return std::make_shared<const Data>(100, 0);
      });
      return std::make_shared<const Data>(100, 0);
    });
    return std::make_shared<const Data>(100, 0);
  });
  assert_true(cache.counters().bytes <= cache.limit());
  assert_int_equal(cache.counters().building_bytes, 0);
  // Whoever needs the memory takes the room, and the cell still comes.
  assert_true(fetch(cache, 2, {0, 0, 0}, 50));
  const auto data = cache.fetch(1, {40, 0, 0}, [&] {
    while (cache.drop_oldest()) continue;
    assert_int_equal(cache.counters().bytes, 0);
    assert_int_equal(shared->held(), 0);
    return std::make_shared<const Data>(100, 77);
  });
  assert_int_equal(static_cast<const Data&>(*data).mark, 77);
  assert_int_equal(cache.counters().bytes, entry);
  // Room goes back if the build fails.
  try {
    cache.fetch(1, {50, 0, 0}, [&]() -> std::shared_ptr<const CellData> {
      assert_true(cache.counters().building_bytes > 0);
      throw 5;
    });
  } catch (int) {
  }
  assert_int_equal(cache.counters().building_bytes, 0);
  assert_int_equal(cache.counters().bytes, shared->held());
}

/// One huge cell does not make all later ones push out many for good.
void test_room_shrinks(void**) {
  const uint64_t entry = entry_bytes(100);
  CellCache cache(40 * entry, budget());
  assert_true(fetch(cache, 1, {0, 0, 0}, 39 * entry));
  for (int i = 1; i < 200; ++i) fetch(cache, 1, {i, 0, 0}, 100);
  assert_in_range(cache.counters().cells, 37, 40);
}

/// While a cell is built, other cells are found, built, dropped, and the same one is built again.
void test_builders_bar_nobody(void**) {
  CellCache cache(1 << 20, budget());
  fetch(cache, 1, {1, 0, 0}, 10);
  std::promise<void> begun, go_on;
  const auto kept = std::async(std::launch::async, [&] {
    return cache.fetch(1, {0, 0, 0}, [&] {
      begun.set_value();
      go_on.get_future().wait();
      return std::make_shared<const Data>(10, 1);
    });
  });
  begun.get_future().wait();
  assert_false(fetch(cache, 1, {1, 0, 0}, 10));
  assert_true(fetch(cache, 1, {2, 0, 0}, 10));
  cache.drop(1);
  assert_true(cache.counters().building_bytes > 0);
  const auto first = cache.fetch(1, {0, 0, 0}, [] { return std::make_shared<const Data>(10, 2); });
  assert_int_equal(cache.counters().duplicates, 0);
  go_on.set_value();
  kept.wait();
  // The first to finish is kept, and is what both have from then on.
  assert_int_equal(cache.counters().duplicates, 1);
  const auto again = hold(cache, {0, 0, 0}, 10);
  assert_ptr_equal(again.get(), first.get());
  assert_int_equal(static_cast<const Data&>(*again).mark, 2);
}

/// Data that counts itself from before it is built until it is gone.
struct CountedData final : CellData {
  CountedData(uint64_t size, std::atomic<uint64_t>& alive, uint64_t counted)
      : size(size), alive(alive), counted(counted) {}
  ~CountedData() override { alive -= counted; }
  uint64_t bytes() const override { return size; }
  const uint64_t size;
  std::atomic<uint64_t>& alive;
  const uint64_t counted;
};

/// All cells that there are at any moment, under construction, kept or in use, are within the
/// limit. Six threads that hold up to two cells each and build a third; a seventh watches.
void check_all_within(CachePolicy policy) {
  constexpr int threads = 6;
  const uint64_t sizes[] = {100, 300, 700}, overhead = entry_bytes(100) - 100;
  const uint64_t limit = 3 * threads * (700 + overhead) + 500;
  const auto shared = budget();
  CellCache cache(limit, shared, policy);
  std::atomic<uint64_t> alive{0}, most{0}, over{0}, fetched{0};
  std::atomic<bool> is_over{false};
  std::thread watcher([&] {
    while (!is_over) {
      const CellCache::Counters c = cache.counters();
      over += alive > limit || c.bytes > limit || c.building_bytes > c.bytes;
      over += c.peak_bytes < c.bytes || c.peak_bytes > limit;
    }
  });
  std::vector<std::thread> workers;
  for (int t = 0; t < threads; ++t)
    workers.emplace_back([&, t] {
      Random random(t);
      std::shared_ptr<const CellData> held[2];
      for (size_t n = test_count(30000); n > 0; --n) {
        const uint64_t kind = random.below(3), size = sizes[kind];
        const CellIndex cell{static_cast<int32_t>(random.below(40)), 0, 0};
        held[n % 2].reset();
        held[n % 2] = cache.fetch(
            kind, cell,
            [&] {
              const uint64_t counted = size + overhead, now = alive += counted;
              if (now > limit) ++over;
              for (uint64_t m = most; m < now && !most.compare_exchange_weak(m, now);) continue;
              return std::make_shared<const CountedData>(size, alive, counted);
            },
            size);
        over += static_cast<const CountedData&>(*held[n % 2]).size != size;
        ++fetched;
      }
    });
  for (std::thread& worker : workers) worker.join();
  is_over = true;
  watcher.join();
  const CellCache::Counters c = cache.counters();
  assert_int_equal(over.load(), 0);
  assert_int_equal(c.unkept, 0);
  assert_int_equal(c.hits + c.misses, fetched.load());
  assert_int_equal(c.misses, c.cells + c.evictions + c.duplicates);
  assert_int_equal(c.bytes, alive.load());
  assert_int_equal(c.bytes, shared->held());
  assert_true(c.hits > 0 && c.evictions > 0);
  assert_true(most > limit * 9 / 10);
}

void test_all_within(void**) {
  check_all_within(CachePolicy::fifo);
  check_all_within(CachePolicy::segmented);
}

/// Many threads under a cache limit and a memory limit, of which either binds.
void check_threads(uint64_t limit, uint64_t memory_limit, CachePolicy policy) {
  const auto shared = budget(memory_limit);
  CellCache cache(limit, shared, policy);
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
        if (n % 1000 == 500) cache.drop(structure);
        if (n % 100 == 0) cache.drop_oldest();
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
  for (const CachePolicy policy : {CachePolicy::fifo, CachePolicy::segmented}) {
    check_threads(limit, limit / 2, policy);
    check_threads(limit, 2 * limit, policy);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_order),        cmocka_unit_test(test_segmented),
      cmocka_unit_test(test_drop),         cmocka_unit_test(test_keys),
      cmocka_unit_test(test_keeps),        cmocka_unit_test(test_too_large),
      cmocka_unit_test(test_budget),       cmocka_unit_test(test_failing_build),
      cmocka_unit_test(test_in_use),       cmocka_unit_test(test_room_while_building),
      cmocka_unit_test(test_room_shrinks), cmocka_unit_test(test_builders_bar_nobody),
      cmocka_unit_test(test_all_within),   cmocka_unit_test(test_threads)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
