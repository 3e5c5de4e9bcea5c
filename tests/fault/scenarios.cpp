// SPDX-License-Identifier: Apache-2.0
#include "scenarios.h"

#include <algorithm>
#include <cstdlib>

#include "suite.h"

namespace msq::test {

std::vector<Scenario> all_scenarios() {
  std::vector<Scenario> all;
  for (auto* make :
       {small_scenarios, create_scenarios, file_scenarios, point_scenarios, set_scenarios,
        slice_scenarios, ray_scenarios, statistic_scenarios, fill_scenarios, contour_scenarios,
        strut_scenarios, printability_scenarios, surface_scenarios, document_scenarios})
    for (Scenario& scenario : make()) all.push_back(std::move(scenario));
  return all;
}

namespace {

/// What a failing scenario says of itself. CMocka's longjmp must pass no destructor.
char message[512];

/// Nothing that a scenario made is left.
void play(const Scenario& scenario, Stage& stage, bool counts_blocks) {
  int64_t left = 0;
  // What a failure makes the process allocate once is there the second time.
  for (int times = 0; times == 0 || (counts_blocks && left > 0 && times < 2); ++times) {
    const int64_t before = live_blocks();
    stage.begin();
    scenario.play(stage);
    left = live_blocks() - before;
  }
  require(!counts_blocks || left <= 0 || stage.allows_leaks,
          std::to_string(left) + " blocks of memory are left");
}

/// Allocations of 1 to `count` that fail, one a run: all if there are few or the environment has
/// MSQ_FAULT_ALL, else the first ones and some of the others. (MSQ_FAULT_ONLY: scenarios whose
/// names have that text.)
std::vector<uint64_t> chosen(uint64_t count) {
  const uint64_t most = std::getenv("MSQ_FAULT_ALL") ? count : test_count(12);
  std::vector<uint64_t> all;
  for (uint64_t k = 1; k <= count; ++k) all.push_back(k);
  uint64_t state = 11;
  for (uint64_t i = most / 2; i < most && i < count; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    std::swap(all[i], all[i + (state >> 33) % (count - i)]);
  }
  all.resize(std::min(count, most));
  return all;
}

void play_with_failing_memory(const Scenario& scenario) {
  Stage stage;
  std::string what;
  try {
    // What is allocated once is there then: by libraries, and for the message of a thread.
    msq_context_create(nullptr, nullptr);
    what = "with all memory: ";
    stage.set_reference();
    play(scenario, stage, false);
    play(scenario, stage, true);
    // First with no memory left: what a failure loads once, such as libgcc for exceptions that pass
    // functions of C, is not there yet.
    for (const Failing failing : {Failing::from_then_on, Failing::once})
      for (const uint64_t k : chosen(stage.allocations())) {
        what = "allocation " + std::to_string(k) + " of " + std::to_string(stage.allocations()) +
               (failing == Failing::once ? " fails: " : " and all after it fail: ");
        stage.set_failing(k, failing);
        play(scenario, stage, true);
      }
  } catch (const std::exception& error) {
    disarm();
    snprintf(message, sizeof message, "%s%s", what.c_str(), error.what());
  }
}

void test_scenario(void** state) {
  message[0] = 0;
  play_with_failing_memory(*static_cast<const Scenario*>(*state));
  if (message[0]) fail_msg("%s", message);
}

}  // namespace

int run_with_failing_memory(const char* group, std::vector<Scenario> scenarios) {
  if (const char* only = std::getenv("MSQ_FAULT_ONLY"))
    std::erase_if(scenarios, [only](const Scenario& scenario) {
      return scenario.name.find(only) == std::string::npos;
    });
  if (!replaces_malloc)
    print_message("sanitizers have their own malloc: operator new alone fails here\n");
  return run_for_each(group, scenarios, test_scenario);
}

}  // namespace msq::test
