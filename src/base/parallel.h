// SPDX-License-Identifier: Apache-2.0
// The only file that uses the thread library (oneTBB) is parallel.cpp, behind this interface.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace msq {

/// A bounded set of threads. With one thread, everything runs on the caller and the thread library
/// is not used. Otherwise the count is clamped to the machine's cores, since oneTBB warns on stderr
/// if an arena asks for more. Bodies run in msq's floating-point environment. The host's callbacks
/// run in the environment of the thread that made the call, on any thread.
class Executor {
 public:
  /// `beyond_cores`: do not clamp. For tests of many threads on few cores.
  explicit Executor(unsigned threads, bool beyond_cores = false);
  ~Executor();

  unsigned threads() const { return threads_; }

  /// Calls body(i) for i in [0, count), in any order, on up to threads() threads, including the
  /// caller's; on fewer if threads cannot be started. Rethrows the first exception, after all
  /// running bodies have ended.
  void for_each(uint64_t count, const std::function<void(uint64_t)>& body) const;

  /// Work that runs beside the caller, until wait().
  class Task {
   public:
    Task(const Executor& executor, std::function<void()> body);
    /// Waits if wait() was not called. Then an exception is dropped, and work that has not begun is
    /// not done.
    ~Task();
    /// Helps with the work until it is done. Rethrows its exception.
    void wait();

   private:
    void finish();

    struct State;
    std::unique_ptr<State> state_;
    bool is_finished_ = false;
  };

 private:
  class Arena;
  unsigned threads_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace msq
