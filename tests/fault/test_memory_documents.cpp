// SPDX-License-Identifier: Apache-2.0
// Memory that fails, at every allocation: the status, what the host sees of it, and the next call.
#include "scenarios.h"

int main() {
  return msq::test::run_with_failing_memory("memory_documents", msq::test::document_scenarios());
}
