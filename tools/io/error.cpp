// SPDX-License-Identifier: Apache-2.0
#include "error.h"

#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace msq_io {

namespace {

// In thread-local storage without a destructor: a thread that ends frees it by itself.
thread_local char last_message[512];

/// Copies a message, without the bytes of a last character that does not fit.
void keep(const char* message) {
  size_t length = std::strlen(message);
  if (length >= sizeof last_message) {
    length = sizeof last_message - 1;
    while (length > 0 && (static_cast<unsigned char>(message[length]) & 0xc0) == 0x80) --length;
  }
  std::memcpy(last_message, message, length);
  last_message[length] = 0;
}

}  // namespace

void fail(msq_status status, const char* format, ...) {
  char text[sizeof last_message];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  throw Error(status, text);
}

void fail_io(const char* what, int code, const std::string& path) {
  throw Error(MSQ_E_IO,
              std::string(what) + ": " + std::generic_category().message(code) + ": " + path);
}

void check_msq(msq_status status) {
  if (status != MSQ_OK) throw Error(status, msq_error_message());
}

std::string text_of(double value) {
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6).ptr;
  return {text, end};
}

msq_status record(msq_status status, const char* message) noexcept {
  keep(message);
  return status;
}

Error current_error() {
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return {MSQ_E_MEMORY, "out of memory"};
  } catch (const std::length_error&) {
    return {MSQ_E_MEMORY, "out of memory"};
  } catch (const std::exception& error) {
    return {MSQ_E_INTERNAL, error.what()};
  } catch (...) {
    return {MSQ_E_INTERNAL, "unknown exception"};
  }
}

}  // namespace msq_io

uint32_t msq_io_version(void) {
  return MSQ_VERSION;
}

const char* msq_io_error_message(void) {
  return msq_io::last_message;
}
