// SPDX-License-Identifier: Apache-2.0
// The last failure of each thread. A thread has pointers to it in TLS (base/borrowed.h says why no
// more), and the message is allocated with the first failure and freed with the thread. Where there
// is no memory for that, the message is a constant that names the status alone.
#include <cstdlib>

#include "api/guard.h"
#include "base/attributes.h"
#include "base/one_line.h"

// The last of all: it defines words such as `near`.
#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <pthread.h>
#endif

namespace msq::api {

namespace {

constexpr size_t message_bytes = 512;

struct LastError {
  const char* message = "";
  char* room = nullptr;
  int32_t host_code = 0;
};
MSQ_INITIAL_EXEC constinit thread_local LastError last_error;

/// Frees the messages of threads that end.
class MessageKey {
 public:
#ifdef _WIN32
  MessageKey() : key_(FlsAlloc(free_message)), is_made_(key_ != FLS_OUT_OF_INDEXES) {}
  ~MessageKey() {
    if (is_made_) FlsFree(key_);
    is_made_ = false;
  }
  bool set(char* room) const {
    return is_made_ && FlsSetValue(key_, room);
  }
#else
  MessageKey() : is_made_(pthread_key_create(&key_, free_message) == 0) {}
  ~MessageKey() {
    if (is_made_) pthread_key_delete(key_);
    is_made_ = false;
  }
  bool set(char* room) const {
    return is_made_ && pthread_setspecific(key_, room) == 0;
  }
#endif

 private:
#ifdef _WIN32
  using Key = DWORD;
  static void WINAPI free_message(void* room) {
#else
  using Key = pthread_key_t;
  static void free_message(void* room) {
#endif
    last_error = {};
    std::free(room);
  }

  Key key_;
  bool is_made_;
} message_key;

/// Room for a message of the calling thread, or null.
char* message_room() {
  if (last_error.room) return last_error.room;
  char* room = static_cast<char*>(std::malloc(message_bytes));
  if (room && !message_key.set(room)) {
    std::free(room);
    room = nullptr;
  }
  return last_error.room = room;
}

const char* without_message(Status status) {
  if (status == Status::memory) return "out of memory";
  return "out of memory for the message of this failure";
}

}  // namespace

msq_status record(Status status, const char* message, int32_t host_code) noexcept {
  if (char* room = message_room()) {
    copy_one_line(message, room, message_bytes);
    last_error.message = room;
  } else {
    last_error.message = without_message(status);
  }
  if (status == Status::host) last_error.host_code = host_code;
  return static_cast<msq_status>(status);
}

}  // namespace msq::api

using namespace msq::api;

const char* msq_error_message(void) {
  return last_error.message;
}

int32_t msq_error_host_code(void) {
  return last_error.host_code;
}
