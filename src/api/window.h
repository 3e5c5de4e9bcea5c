// SPDX-License-Identifier: Apache-2.0
// Index windows, read from the host's definitions.
#pragma once

#include "api/guard.h"

namespace msq::api {

inline SampleWindow read_window(const msq_window& window) {
  SampleWindow read;
  for (size_t axis = 0; axis < 3; ++axis) {
    read.first[axis] = window.first[axis];
    read.count[axis] = window.count[axis];
  }
  return read;
}

}  // namespace msq::api
