// SPDX-License-Identifier: Apache-2.0
// Products of sizes that report overflow.
#pragma once

#include <cstdint>
#include <cstdlib>

#include "base/status.h"

namespace msq {

inline uint64_t checked_product(uint64_t a, uint64_t b, const char* what) {
  if (b > 0 && a > UINT64_MAX / 2 / b)
    fail(Status::limit, "%s: %llu times %llu is more than 2^63", what,
         static_cast<unsigned long long>(a), static_cast<unsigned long long>(b));
  return a * b;
}

}  // namespace msq
