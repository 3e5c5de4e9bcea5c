// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <thread>

namespace msq {

struct Executor::Arena {
  Arena(int slots, bool beyond_cores) : arena(slots) {
    if (beyond_cores)
      allowed.emplace(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(slots));
  }
  std::optional<tbb::global_control> allowed;
  tbb::task_arena arena;
};

Executor::Executor(unsigned threads, bool beyond_cores) : threads_(threads) {
  if (threads_ == 1) return;
  const unsigned cores = static_cast<unsigned>(std::max(1, tbb::info::default_concurrency()));
  if (threads_ == 0 || (threads_ > cores && !beyond_cores)) threads_ = cores;
  if (threads_ > 1) arena_ = std::make_unique<Arena>(static_cast<int>(threads_), beyond_cores);
}

Executor::~Executor() = default;

void Executor::for_each(uint64_t count, const std::function<void(uint64_t)>& body) const {
  if (!arena_ || count < 2) {
    for (uint64_t i = 0; i < count; ++i) body(i);
    return;
  }
  arena_->arena.execute([&] {
    // Isolated: a thread that waits here may not take up other work of the arena. It could be a
    // wait for the very task that this loop is part of (Task::wait, handed over by a caller who
    // found the arena full), which would then never end.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(tbb::blocked_range<uint64_t>(0, count, 1),
                        [&](const tbb::blocked_range<uint64_t>& range) {
                          for (uint64_t i = range.begin(); i != range.end(); ++i) body(i);
                        });
    });
  });
}

struct Executor::Task::State {
  const Executor* executor = nullptr;
  std::function<void()> body;
  tbb::task_group group;
  std::exception_ptr error;
  bool done = false;
};

Executor::Task::Task(const Executor& executor, std::function<void()> body)
    : state_(std::make_unique<State>()) {
  State* state = state_.get();
  state->executor = &executor;
  state->body = std::move(body);
  if (!executor.arena_) return;
  // The exception is carried by hand: a task group that rethrows would also cancel its siblings.
  executor.arena_->arena.execute([state] {
    state->group.run([state] {
      try {
        state->body();
      } catch (...) {
        state->error = std::current_exception();
      }
    });
  });
}

Executor::Task::~Task() {
  if (!state_->done && state_->executor->arena_)
    state_->executor->arena_->arena.execute([this] { state_->group.wait(); });
}

void Executor::Task::wait() {
  state_->done = true;
  if (!state_->executor->arena_) {
    state_->body();
    return;
  }
  state_->executor->arena_->arena.execute([this] { state_->group.wait(); });
  if (state_->error) std::rethrow_exception(state_->error);
}

}  // namespace msq
