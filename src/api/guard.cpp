// SPDX-License-Identifier: Apache-2.0
#include "api/guard.h"

void msq::api::require_apart(const void* input, uint64_t input_bytes, const char* input_name,
                             const void* output, uint64_t bytes, const char* name) {
  if (!input || !output || input_bytes == 0 || bytes == 0) return;
  const auto read = reinterpret_cast<uintptr_t>(input),
             written = reinterpret_cast<uintptr_t>(output);
  const bool is_before = written < read;
  const uint64_t apart = is_before ? read - written : written - read;
  if (apart >= (is_before ? bytes : input_bytes)) return;
  fail(Status::argument, "%s begins %llu bytes %s %s, which has %llu bytes; they must not overlap",
       name, static_cast<unsigned long long>(apart), is_before ? "before" : "after", input_name,
       static_cast<unsigned long long>(input_bytes));
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
