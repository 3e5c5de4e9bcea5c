// SPDX-License-Identifier: Apache-2.0
#include "error.h"

#include <cerrno>
#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <new>
#include <system_error>

#include "../../src/base/one_line.h"

namespace msq_io {

namespace {

// In thread-local storage without a destructor: a thread that ends frees it by itself.
thread_local char last_message[512];

Failure failure_of(msq_status status, const char* message) {
  Failure failure{status, {}};
  msq::copy_one_line(message, failure.message, sizeof failure.message);
  return failure;
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
  if (code == ENOMEM) throw std::bad_alloc();
  throw Error(MSQ_E_IO,
              std::string(what) + ": " + std::generic_category().message(code) + ": " + path);
}

void check_msq(msq_status status) {
  if (status != MSQ_OK) throw Error(status, msq_error_message());
}

std::string text_of(double value, int digits) {
  char text[32];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return {text, end};
}

msq_status record(msq_status status, const char* message) noexcept {
  msq::copy_one_line(message, last_message, sizeof last_message);
  return status;
}

Failure current_failure() noexcept {
  try {
    throw;
  } catch (const Error& error) {
    return failure_of(error.status, error.what());
  } catch (const std::bad_alloc&) {
    return failure_of(MSQ_E_MEMORY, "out of memory");
  } catch (const std::length_error&) {
    return failure_of(MSQ_E_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return failure_of(MSQ_E_INTERNAL, error.what());
  } catch (...) {
    return failure_of(MSQ_E_INTERNAL, "unknown exception");
  }
}

void raise(const Failure& failure) {
  throw Error(failure.status, failure.message);
}

}  // namespace msq_io

uint32_t msq_io_version(void) {
  return MSQ_VERSION;
}

const char* msq_io_error_message(void) {
  return msq_io::last_message;
}
