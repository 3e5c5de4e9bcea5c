// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "base/call.h"
#include "base/status.h"
#include "base/work_shares.h"

namespace msq {

namespace {

/// Maximum number of tasks that a loop of the host gets.
constexpr unsigned max_host_tasks = 1024;

/// A task of the host's loop: a part of the call's work, on any thread of the host.
struct HostTask {
  WorkShares& shares;
  const CallState call;

  static void run(void* task, uint64_t i) noexcept {
    auto& of = *static_cast<HostTask*>(task);
    const TaskScope scope(of.call);
    of.shares.work(i % of.shares.shares());
  }
};

}  // namespace

class Executor::Arena {
 public:
  Arena(int slots, bool beyond_cores) : slots_(slots), arena_(slots) {
    // Fewer than oneTBB's own number would hold for all contexts of the process.
    if (beyond_cores && slots > tbb::info::default_concurrency())
      allowed_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(slots));
  }

  /// Runs body(), which does not throw, as a thread of the arena, or lets one of its threads run
  /// it.
  template <class Body>
  void execute(const Body& body) {
    start();
    arena_.execute(body);
  }

 private:
  // Starts the arena explicitly. If the start at the first use fails, the second use never ends.
  void start() {
    if (arena_.is_active()) return;
    std::lock_guard lock(starting_);
    if (!arena_.is_active()) arena_.initialize(slots_);
  }

  const int slots_;
  std::mutex starting_;
  std::optional<tbb::global_control> allowed_;
  tbb::task_arena arena_;
};

Executor::Executor(unsigned threads, bool beyond_cores) : threads_(threads) {
  if (threads_ == 1) return;
  const unsigned cores = static_cast<unsigned>(std::max(1, tbb::info::default_concurrency()));
  if (threads_ == 0 || (threads_ > cores && !beyond_cores)) threads_ = cores;
  threads_ = std::min(threads_, std::max(cores, max_host_tasks));
  if (threads_ > 1) arena_ = std::make_unique<Arena>(static_cast<int>(threads_), beyond_cores);
}

Executor::Executor(unsigned threads, const HostLoop& host)
    : threads_(threads ? std::min(threads, max_host_tasks)
                       : std::max(1u, std::thread::hardware_concurrency())),
      host_(host) {}

Executor::~Executor() = default;

void Executor::for_each(uint64_t count, const std::function<void(uint64_t)>& body) const {
  if (threads_ == 1 || count < 2) {
    for (uint64_t i = 0; i < count; ++i) body(i);
    return;
  }
  WorkShares shares(count, threads_, body);
  // There are fewer shares than threads on a machine of many cores.
  const uint64_t tasks = std::min<uint64_t>(count, threads_);
  if (host_.parallel_for) return share_by_host(shares, tasks);
  const CallState call;
  const auto share_out = [&] {
    tbb::parallel_for(
        tbb::blocked_range<uint64_t>(0, tasks, 1),
        [&](const tbb::blocked_range<uint64_t>& range) {
          const TaskScope scope(call);
          for (uint64_t s = range.begin(); s != range.end(); ++s) shares.work(s % shares.shares());
        },
        tbb::simple_partitioner());
  };
  // An exception of the thread library itself, for example if a thread cannot be started, leaves
  // the work to the existing threads.
  try {
    arena_->execute([&] {
      // Isolated: a thread that waits here must not take other work of the arena. That work could
      // wait for the very task that this loop is part of (Task::wait, which a caller passes to the
      // arena when the arena is full), and would then never end.
      try {
        tbb::this_task_arena::isolate(share_out);
      } catch (...) {
      }
    });
  } catch (...) {
  }
  shares.work(0);
  shares.rethrow();
}

void Executor::share_by_host(WorkShares& shares, uint64_t tasks) const {
  HostTask task{shares, CallState()};
  const int32_t code =
      call_host(host_.parallel_for, host_.user, tasks, &HostTask::run, static_cast<void*>(&task));
  shares.rethrow();
  if (code != 0)
    throw Error(Status::host, "the callback parallel_for returned " + std::to_string(code), code);
  // Nothing is left unless the host left out all tasks.
  shares.work(0);
  shares.rethrow();
}

/// The first to come does the work: a thread of the library, or the thread that waits for it.
struct Executor::Task::State {
  const Executor* executor = nullptr;
  std::function<void()> body;
  std::atomic<bool> is_taken{false};
  std::exception_ptr error;
  tbb::task_group group;

  void work() noexcept {
    if (is_taken.exchange(true)) return;
    try {
      body();
    } catch (...) {
      error = std::current_exception();
    }
  }
};

Executor::Task::Task(const Executor& executor, std::function<void()> body)
    : state_(std::make_unique<State>()) {
  State* state = state_.get();
  state->executor = &executor;
  state->body = std::move(body);
  if (!executor.arena_) return;
  bool is_left = false;
  executor.arena_->execute([state, &is_left, call = CallState()] {
    try {
      state->group.run([state, call] {
        const TaskScope scope(call);
        state->work();
      });
    } catch (const std::bad_alloc&) {
      is_left = true;
    } catch (...) {
      // A thread cannot be started: the existing ones do the work.
    }
  });
  if (!is_left) return;
  // The group would wait forever for the allocation that failed: it is left as it is.
  state_.release();
  throw std::bad_alloc();
}

Executor::Task::~Task() {
  if (is_finished_) return;
  state_->is_taken = true;  // work that has not begun never will
  finish();
}

void Executor::Task::wait() {
  state_->work();
  finish();
  is_finished_ = true;
  if (state_->error) std::rethrow_exception(std::exchange(state_->error, nullptr));
}

void Executor::Task::finish() {
  if (state_->executor->arena_) state_->executor->arena_->execute([this] { state_->group.wait(); });
}

}  // namespace msq
