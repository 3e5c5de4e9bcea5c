// SPDX-License-Identifier: Apache-2.0
// Stands for all of msq's sources where a test is about the build alone. Like them it needs oneTBB
// and Highway at the link.
#include <hwy/aligned_allocator.h>
#include <msq.h>
#include <tbb/info.h>

uint32_t msq_version(void) {
  return MSQ_VERSION;
}

const char* msq_error_message(void) {
  return "none";
}

msq_status msq_build_info(msq_build_report* report) {
  const auto memory = hwy::AllocateAligned<float>(8);
  if (!memory || tbb::info::default_concurrency() < 1) return MSQ_E_INTERNAL;
  report->licence = "Apache-2.0";
  return MSQ_OK;
}
