// SPDX-License-Identifier: Apache-2.0
// The last failure of each thread. A thread has pointers to it in TLS (base/borrowed.h says why no
// more), and the message is allocated with the first failure and freed with the thread. Where there
// is no memory for that, the message is a constant that names the status alone.
#include <cstdlib>
#include <cstring>

#include "api/guard.h"
#include "base/attributes.h"

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

/// Bytes of the UTF-8 character that begins here; 0 if it is not one.
size_t character_length(const unsigned char* s) {
  const size_t length = s[0] < 0x80                   ? 1
                        : s[0] >= 0xc2 && s[0] < 0xe0 ? 2
                        : (s[0] & 0xf0) == 0xe0       ? 3
                        : s[0] >= 0xf0 && s[0] < 0xf5 ? 4
                                                      : 0;
  for (size_t i = 1; i < length; ++i)
    if ((s[i] & 0xc0) != 0x80) return 0;
  if ((s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xed && s[1] > 0x9f) ||
      (s[0] == 0xf0 && s[1] < 0x90) || (s[0] == 0xf4 && s[1] > 0x8f))
    return 0;  // overlong, a surrogate, or beyond Unicode
  return length;
}

/// Copies whole characters as far as they fit. Bytes that are none, as paths may have, become '?',
/// and so do control characters, which names in files may have: a message is one line in any log or
/// terminal.
void copy_utf8(const char* from, char* to, size_t room) {
  const auto* s = reinterpret_cast<const unsigned char*>(from);
  size_t used = 0;
  while (*s) {
    const size_t length = character_length(s), taken = length ? length : 1;
    if (used + taken >= room) break;
    if (length && *s >= ' ' && *s != 0x7f)
      std::memcpy(to + used, s, length);
    else
      to[used] = '?';
    used += taken;
    s += taken;
  }
  to[used] = 0;
}

}  // namespace

msq_status record(Status status, const char* message, int32_t host_code) noexcept {
  if (char* room = message_room()) {
    copy_utf8(message, room, message_bytes);
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
