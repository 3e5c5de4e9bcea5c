// SPDX-License-Identifier: Apache-2.0
#include "base/borrowed.h"

namespace msq {

namespace {

constinit std::atomic<KeptType*> first_type{nullptr};
constinit std::atomic<uint32_t> thread_count{0};

/// Runs when the library is unloaded or the process ends.
struct Unloading {
  ~Unloading() { KeptType::clear_all(); }
} unloading;

}  // namespace

constinit thread_local uint32_t place_of_thread = 0;

uint32_t KeptType::new_place() {
  place_of_thread = thread_count.fetch_add(1, std::memory_order_relaxed) % places + 1;
  return place_of_thread;
}

void* KeptType::take_from_others() {
  for (uint32_t i = 0; i < places; ++i)
    if (at_[i].object.load(std::memory_order_relaxed))
      if (void* object = take_from(i)) return object;
  return nullptr;
}

bool KeptType::keep_elsewhere(uint32_t own, void* object) {
  for (uint32_t i = 1; i < places; ++i)
    if (keep_at((own + i) % places, object)) return true;
  return false;
}

void KeptType::list(void (*free)(void*)) {
  if (is_listed_.exchange(true, std::memory_order_relaxed)) return;
  free_ = free;
  next_ = first_type.load(std::memory_order_relaxed);
  while (!first_type.compare_exchange_weak(next_, this, std::memory_order_release,
                                           std::memory_order_relaxed)) {
  }
}

void KeptType::clear_all() {
  for (KeptType* type = first_type.load(std::memory_order_acquire); type; type = type->next_)
    for (uint32_t i = 0; i < places; ++i)
      if (void* object = type->take_from(i)) type->free_(object);
}

size_t KeptType::count_all() {
  size_t count = 0;
  for (const KeptType* type = first_type.load(std::memory_order_acquire); type; type = type->next_)
    for (const Place& place : type->at_)
      count += place.object.load(std::memory_order_relaxed) != nullptr;
  return count;
}

}  // namespace msq
