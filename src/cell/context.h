// SPDX-License-Identifier: Apache-2.0
// State that the objects of one host share: threads, memory limit and the cache of cell data.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "base/borrowed.h"
#include "base/host.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/ref.h"
#include "cell/cache.h"

namespace msq {

/// The host's function for warnings; the functions of src/api call it.
struct WarningHook {
  void (*fn)(void* user, int32_t code, const char* message) = nullptr;
  void* user = nullptr;
  std::atomic<bool> has_warned_of_cache{false};
};

class Context : public RefCounted {
 public:
  Context(unsigned threads, uint64_t cache_bytes, uint64_t memory_limit, bool beyond_cores = false,
          CachePolicy policy = CachePolicy::fifo, const HostLoop& loop = {})
      : executor(loop.parallel_for ? Executor(threads, loop) : Executor(threads, beyond_cores)),
        budget(std::make_shared<MemoryBudget>(memory_limit)),
        cache(cache_bytes, budget, policy) {
    // What is kept to save time, cached cells last, makes room for memory that a call requires. So
    // the success of a call does not depend on earlier calls.
    budget->set_reserve([this] { return spares_give_way() || cache.drop_oldest(); });
  }
  ~Context() override { budget->set_reserve(nullptr); }

  /// The threads that may evaluate an object.
  const Executor& executor_for(bool is_concurrent) const {
    return is_concurrent ? executor : serial;
  }

  /// A number that no other structure of this context has. It identifies the structure in the
  /// cache.
  uint64_t new_structure_id() { return next_id_.fetch_add(1, std::memory_order_relaxed); }

  /// Memory that goes before cached cells do. It is removed before it ends.
  void add_spare(SpareMemory& spare) {
    const std::lock_guard lock(spares_mutex_);
    spares_.push_back(&spare);
  }
  void remove_spare(SpareMemory& spare) {
    const std::lock_guard lock(spares_mutex_);
    std::erase(spares_, &spare);
  }

  /// Of the host's loop. It is released when all else is gone.
  HostUser loop_user;
  /// Of the host's function for warnings.
  HostUser warning_user;
  const Executor executor;
  /// The calling thread alone.
  const Executor serial{1};
  const std::shared_ptr<MemoryBudget> budget;
  CellCache cache;
  /// Set before the context is shared.
  WarningHook warnings;

 private:
  bool spares_give_way() {
    const std::lock_guard lock(spares_mutex_);
    for (SpareMemory* spare : spares_)
      if (spare->give_way()) return true;
    return false;
  }

  const KeepsMemory keeps_memory_;
  std::mutex spares_mutex_;
  std::vector<SpareMemory*> spares_;
  std::atomic<uint64_t> next_id_{1};
};

}  // namespace msq
