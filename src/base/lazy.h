// SPDX-License-Identifier: Apache-2.0
// A part of an immutable object that is made when it is first asked for, on whichever thread asks.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

namespace msq {

template <class T>
class Lazy {
 public:
  /// make() returns a unique_ptr<const T>. Where it throws, the next call tries again.
  template <class Make>
  const T& get(Make&& make) const {
    if (const T* made = made_.load(std::memory_order_acquire)) return *made;
    std::lock_guard lock(mutex_);
    if (!owned_) owned_ = make();
    made_.store(owned_.get(), std::memory_order_release);
    return *owned_;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::unique_ptr<const T> owned_;
  mutable std::atomic<const T*> made_{nullptr};
};

}  // namespace msq
