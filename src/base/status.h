// SPDX-License-Identifier: Apache-2.0
// Errors inside the engine are exceptions of one type; src/api turns them into statuses.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "base/attributes.h"

namespace msq {

enum class Status : int32_t {
  ok = 0,
  argument = -1,
  memory = -2,
  cancelled = -3,
  host = -4,
  io = -5,
  unsupported = -6,
  mesh = -7,
  limit = -8,
  internal = -9,
};

class Error : public std::runtime_error {
 public:
  Error(Status status, const std::string& message, int32_t host_code = 0)
      : std::runtime_error(message), status(status), host_code(host_code) {}

  Status status;
  int32_t host_code;
};

/// Throws Error with a message formatted as by printf.
[[noreturn]] void fail(Status status, const char* format, ...) MSQ_PRINTF_FORMAT(2, 3);

}  // namespace msq
