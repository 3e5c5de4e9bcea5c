// SPDX-License-Identifier: Apache-2.0
// Loops and tasks on several threads: each part once, exceptions, loops within loops.
#include "base/parallel.h"

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/job.h"
#include "base/status.h"
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

using Body = void (*)(void* task, uint64_t i);

/// What a loop of the host does.
struct Host {
  int32_t (*loop)(uint64_t count, Body body, void* task);
  std::atomic<uint64_t> loops = 0, most_tasks = 0;  // of loops within loops, from several threads

  static int32_t call(void* user, uint64_t count, Body body, void* task) {
    auto& host = *static_cast<Host*>(user);
    ++host.loops;
    uint64_t most = host.most_tasks;
    while (most < count && !host.most_tasks.compare_exchange_weak(most, count)) continue;
    return host.loop(count, body, task);
  }
  Executor executor(unsigned threads) { return Executor(threads, msq::HostLoop{call, this}); }
};

int32_t in_order(uint64_t count, Body body, void* task) {
  for (uint64_t i = 0; i < count; ++i) body(task, i);
  return 0;
}

int32_t backwards(uint64_t count, Body body, void* task) {
  for (uint64_t i = count; i-- > 0;) body(task, i);
  return 0;
}

int32_t by_threads(uint64_t count, Body body, void* task) {
  std::vector<std::thread> threads;
  for (uint64_t i = 1; i < count; ++i) threads.emplace_back(body, task, i);
  body(task, 0);
  for (std::thread& thread : threads) thread.join();
  return 0;
}

/// Not what is asked of a host, and harmless.
int32_t one_alone(uint64_t count, Body body, void* task) {
  body(task, count / 2);
  return 0;
}

int32_t none(uint64_t, Body, void*) {
  return 0;
}

int32_t fails(uint64_t, Body, void*) {
  return -3;
}

int32_t fails_after_all(uint64_t count, Body body, void* task) {
  in_order(count, body, task);
  return 4;
}

void test_loops_of_the_host(void**) {
  for (const auto loop : {in_order, backwards, by_threads, one_alone, none}) {
    Host host{loop};
    const Executor executor = host.executor(5);
    assert_int_equal(executor.threads(), 5);
    for (const uint64_t count : {0, 1, 2, 3, 4, 5, 16, 17, 1000}) {
      std::vector<std::atomic<int>> done(count);
      executor.for_each(count, [&](uint64_t i) { ++done[i]; });
      for (const std::atomic<int>& times : done) assert_int_equal(times, 1);
    }
    assert_int_equal(host.loops, 7);  // those of two parts or more
    assert_int_equal(host.most_tasks, 5);
  }
}

void test_threads_of_the_host(void**) {
  Host host{by_threads};
  assert_int_equal(host.executor(0).threads(), std::max(1u, std::thread::hardware_concurrency()));
  assert_int_equal(host.executor(5000).threads(), 1024);
  // Each of more tasks than there are shares gets parts: they wait for each other.
  std::atomic<int> begun{0};
  host.executor(40).for_each(40, [&](uint64_t) {
    ++begun;
    while (begun < 40) std::this_thread::yield();
  });
  assert_int_equal(begun, 40);
}

void test_failures_of_the_host(void**) {
  for (const auto loop : {fails, fails_after_all}) {
    Host host{loop};
    const Executor executor = host.executor(3);
    const int32_t code = loop == fails ? -3 : 4;
    int done = 0;
    bool is_thrown = false;
    try {
      executor.for_each(10, [&](uint64_t) { ++done; });
    } catch (const msq::Error& error) {
      is_thrown = error.status == msq::Status::host && error.host_code == code;
      assert_string_equal(error.what(), code == 4 ? "the callback parallel_for returned 4"
                                                  : "the callback parallel_for returned -3");
    }
    assert_true(is_thrown);
    assert_int_equal(done, code == 4 ? 10 : 0);
  }
  // What fails in a part goes before the code.
  Host host{fails_after_all};
  bool is_thrown = false;
  try {
    host.executor(3).for_each(10, [](uint64_t i) {
      if (i == 7) throw std::runtime_error("part 7");
    });
  } catch (const std::runtime_error& error) {
    is_thrown = std::string(error.what()) == "part 7";
  }
  assert_true(is_thrown);
}

void test_the_call_on_threads_of_the_host(void**) {
  for (const auto loop : {in_order, by_threads}) {
    Host host{loop};
    const Executor executor = host.executor(4);
    const msq::CallScope call;
    msq::Job job;
    const msq::CurrentJob current(&job);
    std::atomic<int> wrong{0};
    executor.for_each(100, [&](uint64_t) { wrong += msq::current_job() != &job; });
    assert_int_equal(wrong, 0);
    std::atomic<int> within{0};
    executor.for_each(4, [&](uint64_t) {
      executor.for_each(30, [&](uint64_t) { within += msq::current_job() == &job; });
    });
    assert_int_equal(within, 120);
    assert_ptr_equal(msq::current_job(), &job);
  }
}

// A call that msq makes itself has the job of the call that it is part of; one that a callback
// makes has none.
void test_calls_within_calls(void**) {
  const msq::CallScope call;
  msq::Job job;
  const msq::CurrentJob current(&job);
  {
    const msq::CallScope own;
    assert_ptr_equal(msq::current_job(), &job);
    const msq::JobScope without(nullptr);
    assert_ptr_equal(msq::current_job(), &job);
    job.cancel();
    bool is_cancelled = false;
    try {
      const msq::JobScope again(nullptr);
    } catch (const msq::Error& error) {
      is_cancelled = error.status == msq::Status::cancelled;
    }
    assert_true(is_cancelled);
  }
  {
    const msq::HostScope callback;
    const msq::CallScope of_host;
    assert_null(msq::current_job());
  }
  assert_ptr_equal(msq::current_job(), &job);
}

void test_tasks_beside_loops_of_the_host(void**) {
  Host host{by_threads};
  const Executor executor = host.executor(4);
  int done = 0;
  Executor::Task task(executor, [&] { executor.for_each(1, [&](uint64_t) { ++done; }); });
  assert_int_equal(done, 0);
  task.wait();
  assert_int_equal(done, 1);
  const Executor::Task left(executor, [&] { ++done; });
  assert_int_equal(done, 1);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_each_part_once),
                              cmocka_unit_test(test_one_thread_does_all),
                              cmocka_unit_test(test_exceptions),
                              cmocka_unit_test(test_loops_within_loops),
                              cmocka_unit_test(test_tasks),
                              cmocka_unit_test(test_loops_of_the_host),
                              cmocka_unit_test(test_threads_of_the_host),
                              cmocka_unit_test(test_failures_of_the_host),
                              cmocka_unit_test(test_the_call_on_threads_of_the_host),
                              cmocka_unit_test(test_calls_within_calls),
                              cmocka_unit_test(test_tasks_beside_loops_of_the_host)};
  return cmocka_run_group_tests_name("parallel", tests, nullptr, nullptr);
}
