// SPDX-License-Identifier: Apache-2.0
#include "engine.h"

#include <msq.h>

#include <cstdio>

const char* engine_backend() {
  static char text[100];
  msq_build_report report{};
  report.struct_size = sizeof report;
  if (msq_build_info(&report) != MSQ_OK) return msq_error_message();
  std::snprintf(text, sizeof text, "msq %u %s", msq_version(), report.licence);
  return text;
}
