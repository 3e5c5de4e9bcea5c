// SPDX-License-Identifier: Apache-2.0
// The only file that uses the thread library (oneTBB) is parallel.cpp, behind this interface.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace msq {

/// The host's own way to run the tasks of a loop; see msq_parallel_for_fn.
struct HostLoop {
  int32_t (*parallel_for)(void* user, uint64_t count, void (*body)(void* task, uint64_t i),
                          void* task) = nullptr;
  void* user = nullptr;
};

/// A bounded set of threads. With one thread, everything runs on the caller and the thread library
/// is not used. Otherwise the count is clamped to the machine's cores, since oneTBB warns on stderr
/// if an arena requests more. Bodies run in msq's floating-point environment. The host's callbacks
/// run in the environment of the thread that made the call, on any thread.
class Executor {
 public:
  /// `beyond_cores`: clamp to 1024 in place of the cores. For tests of many threads on few cores.
  explicit Executor(unsigned threads, bool beyond_cores = false);
  /// Threads of the host, `threads` at once, 0 for one per core. The thread library is not used.
  Executor(unsigned threads, const HostLoop& host);
  ~Executor();

  unsigned threads() const { return threads_; }
  /// Whether loops are run by the host, and may fail.
  bool is_of_host() const { return host_.parallel_for != nullptr; }

  /// Calls body(i) for i in [0, count), in any order, on up to threads() threads, including the
  /// caller's; on fewer if threads cannot be started. Rethrows the first exception, after all
  /// running bodies have ended. Throws Error(host) if the host's loop fails.
  void for_each(uint64_t count, const std::function<void(uint64_t)>& body) const;

  /// Work that runs beside the caller, until wait(). With one thread, and with a loop of the host,
  /// which runs nothing beside its caller, wait() does all of it: the work is a sequence of loops,
  /// and each of them is shared by all threads then.
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
  void share_by_host(class WorkShares& shares, uint64_t tasks) const;

  unsigned threads_;
  HostLoop host_;
  std::unique_ptr<Arena> arena_;
};

}  // namespace msq
