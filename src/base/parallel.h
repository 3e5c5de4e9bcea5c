// SPDX-License-Identifier: Apache-2.0
// The only door to the thread library (oneTBB, in parallel.cpp).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace msq {

/// A bounded set of threads. With one thread the thread library is never touched: everything runs
/// on the caller. Otherwise the count is clamped to the machine's cores, since oneTBB warns on
/// stderr where an arena asks for more.
class Executor {
 public:
  /// `beyond_cores`: do not clamp. For tests of many threads on few cores.
  explicit Executor(unsigned threads, bool beyond_cores = false);
  ~Executor();

  unsigned threads() const { return threads_; }

  /// Calls body(i) for i in [0, count), in any order, on up to threads() threads, the caller's
  /// included. Rethrows the first exception, after all running bodies have ended.
  void for_each(uint64_t count, const std::function<void(uint64_t)>& body) const;

  /// Work that goes on beside the caller, until wait().
  class Task {
   public:
    Task(const Executor& executor, std::function<void()> body);
    /// Waits if wait() was not called; an exception is then dropped.
    ~Task();
    /// Helps with the work until it is done; rethrows its exception.
    void wait();

   private:
    struct State;
    std::unique_ptr<State> state_;
  };

 private:
  struct Arena;
  unsigned threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace msq
