// SPDX-License-Identifier: Apache-2.0
// Memory that fails, at every allocation: the status, what the host sees of it, and the next call.
#include "scenarios.h"

// Assimp loses memory where memory fails (docs/decisions/007-mesh-files.md). LeakSanitizer calls
// this.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libassimp\n";
}

int main() {
  return msq::test::run_with_failing_memory("memory_files", msq::test::file_scenarios());
}
