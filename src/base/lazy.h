// SPDX-License-Identifier: Apache-2.0
// A part of an immutable object that is made at its first use, on the thread that uses it first.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>

#include "base/job.h"

namespace msq {

template <class T>
class Lazy {
 public:
  /// make() returns a unique_ptr<const T>. If it throws, the next call tries again. A thread that
  /// waits while another one makes the part polls the current job.
  template <class Make>
  const T& get(Make&& make) const {
    if (const T* made = made_.load(std::memory_order_acquire)) return *made;
    const std::unique_lock lock = lock_or_cancel();
    if (!owned_) owned_ = make();
    made_.store(owned_.get(), std::memory_order_release);
    return *owned_;
  }

 private:
  std::unique_lock<std::mutex> lock_or_cancel() const {
    if (!current_job()) return std::unique_lock(mutex_);
    std::unique_lock lock(mutex_, std::try_to_lock);
    while (!lock.owns_lock()) {
      check_cancelled();
      std::this_thread::sleep_for(std::chrono::microseconds(200));
      (void)lock.try_lock();
    }
    return lock;
  }

  mutable std::mutex mutex_;
  mutable std::unique_ptr<const T> owned_;
  mutable std::atomic<const T*> made_{nullptr};
};

}  // namespace msq
