// SPDX-License-Identifier: Apache-2.0
// Runs one fuzzer, MSQ_FUZZER, as libFuzzer and AFL++ call it.
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  msq::fuzz::MSQ_FUZZER(data, size);
  return 0;
}
