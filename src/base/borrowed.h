// SPDX-License-Identifier: Apache-2.0
// Working memory that outlives a call. Everything that msq keeps between calls lives here, except
// the cell cache.
//
// Work that needs memory borrows an object and gives it back to a table of the process. In the
// table, each thread has one place per type. So the next call of a thread finds warm memory. Work
// that begins again within itself (callbacks of the host may call msq) gets another object.
//
// An object that an exception passes by is deleted, so that every kept object is whole.
//
// Why a table and not thread_local objects: glibc aborts if memory fails at the first touch of a
// thread_local object that has a destructor; the bytes of such objects are taken from the stacks of
// all threads of the host; and the objects live as long as the thread. Here a thread has only a
// number, and nothing happens when it ends. Atomic exchanges empty and fill the places. A thread
// whose place is empty takes an object from another place, so no more objects exist than were ever
// borrowed at once. At most `places` objects of a type are kept, each of at most max_kept_bytes.
// All are deleted with the last context of the process, and when the library is unloaded.
//
// Cost: two atomic exchanges on a cache line that no other thread uses, about 15 ns.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include "base/attributes.h"

namespace msq {

/// Objects whose bytes() is larger are deleted, not kept.
constexpr size_t max_kept_bytes = size_t{16} << 20;

/// The kept objects of one type. It has no destructor: objects may be given back while the process
/// ends.
class KeptType {
 public:
  /// Deletes all kept objects of all types. Any thread may call it at any time.
  static void clear_all();
  /// The number of kept objects of all types.
  static size_t count_all();

 protected:
  /// Maximum number of kept objects of a type. If there are more threads, they share places.
  static constexpr uint32_t places = 64;
  // One cache line each.
  struct alignas(64) Place {
    std::atomic<void*> object{nullptr};
  };

  /// Null if there is none.
  void* take() {
    const uint32_t own = own_place();
    if (void* object = take_from(own)) return object;
    return take_from_others();
  }
  /// Returns false if there is no room. `free` deletes an object of the type.
  bool keep(void* object, void (*free)(void*)) {
    if (!is_listed_.load(std::memory_order_relaxed)) list(free);
    const uint32_t own = own_place();
    return keep_at(own, object) || keep_elsewhere(own, object);
  }

 private:
  /// The number of the calling thread's place, plus 1; 0 before its first use.
  static uint32_t own_place();
  static uint32_t new_place();

  void* take_from(uint32_t i) { return at_[i].object.exchange(nullptr, std::memory_order_acquire); }
  bool keep_at(uint32_t i, void* object) {
    void* none = nullptr;
    return at_[i].object.compare_exchange_strong(none, object, std::memory_order_release,
                                                 std::memory_order_relaxed);
  }
  void* take_from_others();
  bool keep_elsewhere(uint32_t own, void* object);
  void list(void (*free)(void*));

  // All zero at first, so that the tables take no room in the file.
  Place at_[places];
  std::atomic<bool> is_listed_{false};
  void (*free_)(void*) = nullptr;
  KeptType* next_ = nullptr;
};

/// The only state of a thread. It is TLS that exists from the start of the thread: TLS that is made
/// at its first touch may fail without a way to report it.
MSQ_INITIAL_EXEC extern constinit thread_local uint32_t place_of_thread;

inline uint32_t KeptType::own_place() {
  const uint32_t place = place_of_thread;
  return (place ? place : new_place()) - 1;
}

template <class T>
class Kept : public KeptType {
 public:
  /// Null if there is none.
  std::unique_ptr<T> take() { return std::unique_ptr<T>(static_cast<T*>(KeptType::take())); }
  /// Keeps the object if it is not too large and there is room.
  void give(std::unique_ptr<T>& object) {
    if (bytes_of(*object) <= max_kept_bytes && keep(object.get(), free)) object.release();
  }

 private:
  static void free(void* object) { delete static_cast<T*>(object); }
  template <class Object>
  static size_t bytes_of(const Object& object) {
    if constexpr (requires { object.bytes(); })
      return object.bytes();
    else
      return 0;
  }
  template <class Element>
  static size_t bytes_of(const std::vector<Element>& object) {
    return object.capacity() * sizeof(Element);
  }
};
template <class T>
inline constinit Kept<T> kept;

/// A T that no other thread uses: a new one, or one in the state in which its last user left it.
template <class T>
class Borrowed {
 public:
  Borrowed() : object_(kept<T>.take()) {
    if (!object_) object_ = std::make_unique<T>();
  }
  Borrowed(const Borrowed&) = delete;
  Borrowed& operator=(const Borrowed&) = delete;
  ~Borrowed() {
    if (std::uncaught_exceptions() == exceptions_) kept<T>.give(object_);
  }

  T& operator*() const { return *object_; }
  T* operator->() const { return object_.get(); }

 private:
  const int exceptions_ = std::uncaught_exceptions();
  std::unique_ptr<T> object_;
};

/// Kept objects are reused as long as one of these lives.
class KeepsMemory {
 public:
  KeepsMemory() { count_.fetch_add(1, std::memory_order_relaxed); }
  KeepsMemory(const KeepsMemory&) = delete;
  KeepsMemory& operator=(const KeepsMemory&) = delete;
  ~KeepsMemory() {
    if (count_.fetch_sub(1, std::memory_order_acq_rel) == 1) KeptType::clear_all();
  }

 private:
  static inline constinit std::atomic<uint64_t> count_{0};
};

}  // namespace msq
