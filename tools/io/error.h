// SPDX-License-Identifier: Apache-2.0
// Errors inside msq_io are exceptions of one type. guard() turns them into statuses at the C ABI.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "msq_io.h"

namespace msq_io {

class Error : public std::runtime_error {
 public:
  Error(msq_status status, const std::string& message)
      : std::runtime_error(message), status(status) {}

  msq_status status;
};

#if defined(__GNUC__)
#define MSQ_IO_PRINTF __attribute__((format(printf, 2, 3)))
#else
#define MSQ_IO_PRINTF
#endif

/// Throws Error with a message formatted as by printf. Messages hold integers and strings alone, so
/// the locale does not matter; floating-point numbers come by text_of().
[[noreturn]] void fail(msq_status status, const char* format, ...) MSQ_IO_PRINTF;

/// Throws Error(MSQ_E_IO): "<what>: <reason of errno>: <path>".
[[noreturn]] void fail_io(const char* what, int code, const std::string& path);

/// Throws Error with the message of msq if the status of a call of msq is an error.
void check_msq(msq_status status);

/// A number as "%g" in the C locale, with so many significant digits.
std::string text_of(double value, int digits = 6);

/// Keeps the message for msq_io_error_message() on this thread and returns the status.
msq_status record(msq_status status, const char* message) noexcept;

/// An error that is kept. It needs no memory, so that a thread can keep that there is none.
struct Failure {
  msq_status status;
  char message[512];
};

/// The error that is being handled.
Failure current_failure() noexcept;

/// Throws the error that was kept.
[[noreturn]] void raise(const Failure& failure);

/// Runs the body of a function of the C ABI.
template <class Body>
msq_status guard(Body&& body) noexcept {
  try {
    body();
    return MSQ_OK;
  } catch (const Error& error) {
    return record(error.status, error.what());
  } catch (const std::bad_alloc&) {
    return record(MSQ_E_MEMORY, "out of memory");
  } catch (const std::length_error&) {
    return record(MSQ_E_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return record(MSQ_E_INTERNAL, error.what());
  } catch (...) {
    return record(MSQ_E_INTERNAL, "unknown exception");
  }
}

}  // namespace msq_io
