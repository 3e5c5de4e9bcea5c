// SPDX-License-Identifier: Apache-2.0
#include "failing_allocator.h"

#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

using msq::test::Failing;

constinit std::atomic<bool> is_armed{false};
constinit std::atomic<uint64_t> count{0}, fails_at{0};
constinit std::atomic<bool> goes_on{false};
constinit std::atomic<int64_t> live{0}, bytes_now{0}, bytes_peak{0};

bool fails() {
  if (!is_armed.load(std::memory_order_relaxed)) return false;
  const uint64_t n = count.fetch_add(1, std::memory_order_relaxed) + 1, k = fails_at;
  return k > 0 && (n == k || (n > k && goes_on));
}

void add_bytes(int64_t bytes) {
  const int64_t now = bytes_now.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  int64_t peak = bytes_peak.load(std::memory_order_relaxed);
  while (now > peak && !bytes_peak.compare_exchange_weak(peak, now)) {
  }
}

int64_t room_of(void* block) {
  return static_cast<int64_t>(malloc_usable_size(block));
}

void* counted(void* block) {
  if (!block) return nullptr;
  live.fetch_add(1, std::memory_order_relaxed);
  add_bytes(room_of(block));
  return block;
}

/// Before the block is freed.
bool released(void* block) {
  if (!block) return false;
  live.fetch_sub(1, std::memory_order_relaxed);
  add_bytes(-room_of(block));
  return true;
}

}  // namespace

namespace msq::test {

void arm(uint64_t k, Failing failing) {
  count = 0;
  fails_at = k;
  goes_on = failing == Failing::from_then_on;
  is_armed = true;
}

uint64_t disarm() {
  is_armed = false;
  return count;
}

int64_t live_blocks() {
  return live;
}

int64_t live_bytes() {
  return bytes_now;
}

int64_t peak_bytes() {
  return bytes_peak;
}

void forget_peak() {
  bytes_peak = bytes_now.load();
}

}  // namespace msq::test

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)

const bool msq::test::replaces_malloc = false;

namespace {

void* take(size_t bytes) {
  return fails() ? nullptr : counted(std::malloc(bytes ? bytes : 1));
}
void* take(size_t bytes, std::align_val_t alignment) {
  const auto align = static_cast<size_t>(alignment);
  return fails() ? nullptr
                 : counted(std::aligned_alloc(align, (bytes + align - 1) / align * align));
}
void* or_throw(void* block) {
  return block ? block : throw std::bad_alloc();
}
void give_back(void* block) {
  if (released(block)) std::free(block);
}

}  // namespace

void* operator new(size_t bytes) {
  return or_throw(take(bytes));
}
void* operator new[](size_t bytes) {
  return or_throw(take(bytes));
}
void* operator new(size_t bytes, std::align_val_t alignment) {
  return or_throw(take(bytes, alignment));
}
void* operator new[](size_t bytes, std::align_val_t alignment) {
  return or_throw(take(bytes, alignment));
}
void* operator new(size_t bytes, const std::nothrow_t&) noexcept {
  return take(bytes);
}
void* operator new[](size_t bytes, const std::nothrow_t&) noexcept {
  return take(bytes);
}
void operator delete(void* block) noexcept {
  give_back(block);
}
void operator delete[](void* block) noexcept {
  give_back(block);
}
void operator delete(void* block, size_t) noexcept {
  give_back(block);
}
void operator delete[](void* block, size_t) noexcept {
  give_back(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  give_back(block);
}
void operator delete[](void* block, std::align_val_t) noexcept {
  give_back(block);
}
void operator delete(void* block, size_t, std::align_val_t) noexcept {
  give_back(block);
}
void operator delete[](void* block, size_t, std::align_val_t) noexcept {
  give_back(block);
}
void operator delete(void* block, const std::nothrow_t&) noexcept {
  give_back(block);
}
void operator delete[](void* block, const std::nothrow_t&) noexcept {
  give_back(block);
}

#else

const bool msq::test::replaces_malloc = true;

#pragma GCC visibility push(default)  // libraries are to find these too
extern "C" {

void* __libc_malloc(size_t bytes);
void* __libc_calloc(size_t count, size_t bytes);
void* __libc_realloc(void* block, size_t bytes);
void* __libc_memalign(size_t alignment, size_t bytes);
void __libc_free(void* block);

void* malloc(size_t bytes) {
  if (!fails()) return counted(__libc_malloc(bytes));
  errno = ENOMEM;
  return nullptr;
}

void* calloc(size_t n, size_t bytes) {
  if (!fails()) return counted(__libc_calloc(n, bytes));
  errno = ENOMEM;
  return nullptr;
}

void* realloc(void* block, size_t bytes) {
  if (!block) return malloc(bytes);
  if (fails()) {
    errno = ENOMEM;
    return nullptr;
  }
  const int64_t room = room_of(block);
  void* moved = __libc_realloc(block, bytes);
  if (moved)
    add_bytes(room_of(moved) - room);
  else if (bytes == 0) {
    live.fetch_sub(1, std::memory_order_relaxed);
    add_bytes(-room);
  }
  return moved;
}

void* memalign(size_t alignment, size_t bytes) {
  if (!fails()) return counted(__libc_memalign(alignment, bytes));
  errno = ENOMEM;
  return nullptr;
}

void* aligned_alloc(size_t alignment, size_t bytes) {
  return memalign(alignment, bytes);
}

int posix_memalign(void** block, size_t alignment, size_t bytes) {
  void* made = memalign(alignment, bytes);
  if (!made) return ENOMEM;
  *block = made;
  return 0;
}

void free(void* block) {
  released(block);
  __libc_free(block);
}

}  // extern "C"

#pragma GCC visibility pop

#endif
