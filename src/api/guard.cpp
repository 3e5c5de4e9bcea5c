// SPDX-License-Identifier: Apache-2.0
#include "api/guard.h"

#include <cstring>

namespace msq::api {

namespace {

struct LastError {
  char message[512] = "";
  int32_t host_code = 0;
};
thread_local LastError last_error;

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

/// Copies whole characters as far as they fit; bytes that are none, as paths may have, become '?'.
void copy_utf8(const char* from, char* to, size_t room) {
  const auto* s = reinterpret_cast<const unsigned char*>(from);
  size_t used = 0;
  while (*s) {
    const size_t length = character_length(s), taken = length ? length : 1;
    if (used + taken >= room) break;
    if (length)
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
  copy_utf8(message, last_error.message, sizeof last_error.message);
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

const char* msq_status_name(msq_status status) {
  switch (status) {
    case MSQ_OK:
      return "MSQ_OK";
    case MSQ_E_ARGUMENT:
      return "MSQ_E_ARGUMENT";
    case MSQ_E_MEMORY:
      return "MSQ_E_MEMORY";
    case MSQ_E_CANCELLED:
      return "MSQ_E_CANCELLED";
    case MSQ_E_HOST:
      return "MSQ_E_HOST";
    case MSQ_E_IO:
      return "MSQ_E_IO";
    case MSQ_E_UNSUPPORTED:
      return "MSQ_E_UNSUPPORTED";
    case MSQ_E_MESH:
      return "MSQ_E_MESH";
    case MSQ_E_LIMIT:
      return "MSQ_E_LIMIT";
    case MSQ_E_INTERNAL:
      return "MSQ_E_INTERNAL";
    default:
      return "MSQ_E_UNKNOWN";
  }
}
