// SPDX-License-Identifier: Apache-2.0
// Every function of the public interface, called by a thread with a stack of 64 KiB.
#include <algorithm>

#include "scenarios.h"
#include "small_stack.h"
#include "suite.h"

namespace {

using namespace msq::test;

constexpr size_t promised = 64 * 1024, large = 1024 * 1024;

char message[512];
size_t max_used = 0;

void play(const Scenario& scenario, uint32_t threads, size_t stack_bytes) {
  std::string error;
  const size_t used = run_on_stack(stack_bytes, [&] {
    try {
      Stage stage;
      stage.threads = threads;
      stage.set_reference();
      stage.begin();
      scenario.play(stage);
    } catch (const std::exception& thrown) {
      error = thrown.what();
    }
  });
  require(error.empty(), error);
  require(used <= promised, "it takes " + std::to_string(used) + " bytes of stack");
  max_used = std::max(max_used, used);
}

/// Variants of kinds that are asked too, and go the same way.
[[maybe_unused]] bool is_variant(const Scenario& scenario) {
  for (const char* words : {"stretched", "of graded period", "warped"})
    if (scenario.name.find(words) != std::string::npos) return true;
  return false;
}

bool needs_stack(const Scenario& scenario) {
  Stage stage;
  stage.begin();
  scenario.play(stage);
  return stage.needs_stack;
}

[[maybe_unused]] void test_scenario(void** state) {
  const auto& scenario = *static_cast<const Scenario*>(*state);
  message[0] = 0;
  bool is_left_out = false;
  try {
    is_left_out = needs_stack(scenario);
    // On a large stack first, which says how much is missing.
    if (!is_left_out)
      for (const size_t bytes : {large, promised})
        for (const uint32_t threads : {1, 2}) play(scenario, threads, bytes);
  } catch (const std::exception& error) {
    snprintf(message, sizeof message, "%s", error.what());
  }
  if (message[0]) fail_msg("%s", message);
  if (is_left_out) _skip(__FILE__, __LINE__);
}

}  // namespace

int main() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__OPTIMIZE__)
  print_message("frames are larger under sanitizers and without optimisation: left out\n");
  return 0;
#else
  std::vector<Scenario> scenarios = all_scenarios();
  std::erase_if(scenarios, is_variant);
  const int failed = run_for_each("small_stacks", scenarios, test_scenario);
  print_message("at most %zu bytes of stack were used\n", max_used);
  return failed;
#endif
}
