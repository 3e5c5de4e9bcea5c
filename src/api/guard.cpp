// SPDX-License-Identifier: Apache-2.0
#include "api/guard.h"

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
