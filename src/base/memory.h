// SPDX-License-Identifier: Apache-2.0
// Counts the large allocations of a context against its memory limit.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "base/status.h"

namespace msq {

class MemoryBudget {
 public:
  explicit MemoryBudget(uint64_t limit) : limit_(limit) {}

  /// Sets the function that gives bytes back when take() needs them. It is called by one thread at
  /// a time, and returns whether it gave any back. After this returns, the one before is not used.
  void set_reserve(std::function<bool()> give_way) {
    const std::lock_guard lock(give_way_mutex_);
    give_way_ = std::move(give_way);
  }

  /// Throws Error(limit), which names `what`, if the bytes exceed the limit even after the reserve
  /// gave bytes back.
  void take(uint64_t bytes, const char* what) {
    while (!try_take(bytes))
      if (!give_back_any())
        fail(
            Status::limit,
            "%s of %llu bytes, with %llu bytes held, would pass the context's memory_limit of %llu",
            what, static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(held()),
            static_cast<unsigned long long>(limit_));
  }
  /// Returns false if the bytes exceed the limit.
  bool try_take(uint64_t bytes) {
    std::lock_guard lock(mutex_);
    if (limit_ && (bytes > limit_ || held_ > limit_ - bytes)) return false;
    held_ += bytes;
    if (held_ > peak_) peak_ = held_;
    return true;
  }
  void give_back(uint64_t bytes) {
    std::lock_guard lock(mutex_);
    held_ -= bytes;
  }

  uint64_t limit() const { return limit_; }
  uint64_t held() const {
    std::lock_guard lock(mutex_);
    return held_;
  }
  uint64_t peak() const {
    std::lock_guard lock(mutex_);
    return peak_;
  }

 private:
  bool give_back_any() {
    const std::lock_guard lock(give_way_mutex_);
    return give_way_ && give_way_();
  }

  const uint64_t limit_;
  std::mutex give_way_mutex_;
  std::function<bool()> give_way_;
  mutable std::mutex mutex_;
  uint64_t held_ = 0, peak_ = 0;
};

/// Memory that only saves time and goes when a call needs it.
class SpareMemory {
 public:
  /// Gives some back. Returns whether there was any.
  virtual bool give_way() = 0;

 protected:
  virtual ~SpareMemory() = default;
};

/// Bytes taken from a budget for as long as this lives.
class Reservation {
 public:
  Reservation() = default;
  Reservation(std::shared_ptr<MemoryBudget> budget, uint64_t bytes, const char* what)
      : budget_(std::move(budget)), bytes_(bytes) {
    budget_->take(bytes_, what);
  }
  /// Of bytes that try_take() has taken.
  static Reservation adopt(std::shared_ptr<MemoryBudget> budget, uint64_t bytes) {
    Reservation made;
    made.budget_ = std::move(budget);
    made.bytes_ = bytes;
    return made;
  }
  Reservation(Reservation&& other) noexcept
      : budget_(std::move(other.budget_)), bytes_(std::exchange(other.bytes_, 0)) {
    other.budget_.reset();
  }
  Reservation& operator=(Reservation&& other) noexcept {
    std::swap(budget_, other.budget_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Reservation() {
    if (budget_) budget_->give_back(bytes_);
  }

  /// Takes what is missing to so many bytes, if anything is.
  void grow_to(uint64_t bytes, const char* what) {
    if (bytes <= bytes_) return;
    budget_->take(bytes - bytes_, what);
    bytes_ = bytes;
  }

 private:
  std::shared_ptr<MemoryBudget> budget_;
  uint64_t bytes_ = 0;
};

}  // namespace msq
