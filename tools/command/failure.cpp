// SPDX-License-Identifier: Apache-2.0
#include "failure.h"

namespace command {

void check(msq_status status) {
  if (status == MSQ_OK) return;
  if (status == MSQ_E_CANCELLED) throw Interrupted();
  throw Failure(msq_error_message());
}

void check(msq_status status, const std::string& subject) {
  if (status == MSQ_OK) return;
  if (status == MSQ_E_CANCELLED) throw Interrupted();
  throw Failure(subject + ": " + msq_error_message());
}

}  // namespace command
