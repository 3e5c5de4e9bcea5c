// SPDX-License-Identifier: Apache-2.0
#include "base/working_memory.h"

#include <utility>

namespace msq {

constinit thread_local WorkingMemory* WorkingMemory::of_thread = nullptr;

WorkingMemory::WorkingMemory(MemoryBudget& budget, const char* what) noexcept
    : budget_(budget), what_(what), outer_(std::exchange(of_thread, this)) {}

WorkingMemory::~WorkingMemory() {
  of_thread = outer_;
  budget_.give_back(taken_);
}

void WorkingMemory::take_from_budget(uint64_t bytes) {
  const uint64_t rounded = (bytes + step - 1) / step * step;
  if (budget_.try_take(rounded)) {
    taken_ += rounded;
  } else {
    budget_.take(bytes, what_);
    taken_ += bytes;
  }
}

void WorkingMemory::give_to_budget() noexcept {
  const uint64_t bytes = taken_ - used_ - step;
  budget_.give_back(bytes);
  taken_ -= bytes;
}

}  // namespace msq
