// SPDX-License-Identifier: Apache-2.0
#include "api/guard.h"

#include <cstdio>

namespace msq::api {

namespace {

struct LastError {
  char message[512] = "";
  int32_t host_code = 0;
};
thread_local LastError last_error;

}  // namespace

msq_status record(Status status, const char* message, int32_t host_code) noexcept {
  std::snprintf(last_error.message, sizeof last_error.message, "%s", message);
  if (status == Status::host) last_error.host_code = host_code;
  return static_cast<msq_status>(status);
}

}  // namespace msq::api

using namespace msq::api;

const char* msq_error_message(void) { return last_error.message; }

int32_t msq_error_host_code(void) { return last_error.host_code; }

const char* msq_status_name(msq_status status) {
  switch (status) {
    case MSQ_OK: return "MSQ_OK";
    case MSQ_E_ARGUMENT: return "MSQ_E_ARGUMENT";
    case MSQ_E_MEMORY: return "MSQ_E_MEMORY";
    case MSQ_E_CANCELLED: return "MSQ_E_CANCELLED";
    case MSQ_E_HOST: return "MSQ_E_HOST";
    case MSQ_E_IO: return "MSQ_E_IO";
    case MSQ_E_UNSUPPORTED: return "MSQ_E_UNSUPPORTED";
    case MSQ_E_MESH: return "MSQ_E_MESH";
    case MSQ_E_LIMIT: return "MSQ_E_LIMIT";
    case MSQ_E_INTERNAL: return "MSQ_E_INTERNAL";
    default: return "MSQ_E_UNKNOWN";
  }
}
