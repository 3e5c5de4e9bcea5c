// SPDX-License-Identifier: Apache-2.0
// Working memory of a call that counts against the context's memory limit while it grows. Lists
// find the account through the thread, as loops find the job (base/call.h): no function passes it
// on.
//
//   WorkingMemory   is opened by the call, on the thread that does all of its work
//   CountedVector   is any list of that work, also within an element of another
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "base/attributes.h"
#include "base/memory.h"

namespace msq {

/// The account of the calling thread's work until this ends. Lists that are made meanwhile must not
/// outlive it, and no other thread may change them. Bytes are taken from the budget in steps, since
/// threads share the budget and most lists are small.
class WorkingMemory {
 public:
  /// `what`: named by the error if the bytes exceed the limit.
  WorkingMemory(MemoryBudget& budget, const char* what) noexcept;
  ~WorkingMemory();
  WorkingMemory(const WorkingMemory&) = delete;
  WorkingMemory& operator=(const WorkingMemory&) = delete;

  /// The account of the calling thread, or null.
  static WorkingMemory* current() noexcept { return of_thread; }

  /// Changes what the error names.
  void call_it(const char* what) { what_ = what; }
  /// Throws Error(limit).
  void take(uint64_t bytes) {
    if (bytes > taken_ - used_) take_from_budget(bytes - (taken_ - used_));
    used_ += bytes;
  }
  void give_back(uint64_t bytes) noexcept {
    used_ -= bytes;
    if (taken_ - used_ >= 2 * step) give_to_budget();
  }

 private:
  /// Taken from the budget at once, where it has so much.
  static constexpr uint64_t step = uint64_t{1} << 16;

  void take_from_budget(uint64_t bytes);
  void give_to_budget() noexcept;

  /// TLS that exists from the start of the thread, as in base/borrowed.h.
  MSQ_INITIAL_EXEC static constinit thread_local WorkingMemory* of_thread;

  MemoryBudget& budget_;
  const char* what_;
  WorkingMemory* const outer_;
  uint64_t used_ = 0, taken_ = 0;
};

/// Takes what it allocates from the account under which it was made. Without an account it counts
/// nothing.
template <class T>
class CountedAllocator {
 public:
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  CountedAllocator() noexcept : account_(WorkingMemory::current()) {}
  template <class U>
  CountedAllocator(const CountedAllocator<U>& other) noexcept : account_(other.account()) {}

  T* allocate(size_t count) {
    if (account_) account_->take(bytes(count));
    try {
      return std::allocator<T>().allocate(count);
    } catch (...) {
      if (account_) account_->give_back(bytes(count));
      throw;
    }
  }
  void deallocate(T* block, size_t count) noexcept {
    std::allocator<T>().deallocate(block, count);
    if (account_) account_->give_back(bytes(count));
  }

  WorkingMemory* account() const noexcept { return account_; }
  template <class U>
  friend bool operator==(const CountedAllocator& a, const CountedAllocator<U>& b) noexcept {
    return a.account() == b.account();
  }

 private:
  /// What the heap needs for a block, beside rounding, is counted too: paths are many and short.
  static constexpr uint64_t block_bytes = 16;
  static uint64_t bytes(size_t count) noexcept { return count * sizeof(T) + block_bytes; }

  WorkingMemory* account_;
};

template <class T>
using CountedVector = std::vector<T, CountedAllocator<T>>;

}  // namespace msq
