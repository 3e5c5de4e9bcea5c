// SPDX-License-Identifier: Apache-2.0
// Fill lines of large walls under memory limits: what is allocated stays within the limit and a
// slack, a call that is refused leaves nothing behind, and the next call is right.
#include <algorithm>
#include <cstring>
#include <string>

#include "failing_allocator.h"
#include "suite.h"
#include "world.h"

namespace msq::test {

namespace {

/// What is allocated outside of the limit: buffers of rows, cells of a tree of seeds, the error.
constexpr int64_t slack = 1 << 20;

struct Section {
  std::string name;
  int64_t cells;  ///< along a side of the polygon
};

char message[512];

msq_context* context_of(uint64_t limit) {
  msq_context_def def = make_def(msq_context_def_init);
  def.threads = 1;
  def.cache_bytes = 0;
  def.memory_limit = limit;
  msq_context* context;
  require_ok(msq_context_create(&def, &context));
  return context;
}

msq_memory_report memory_of(msq_context* context) {
  msq_memory_report report{};
  report.struct_size = sizeof report;
  require_ok(msq_context_memory(context, &report));
  return report;
}

/// Of a square of so many cells, whose size is 1.
msq_status fill(msq_context* context, const msq_structure* structure, int64_t cells,
                msq_fill** made) {
  const int64_t side = 1000 * cells, corners[4][2] = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  const msq_ring ring{corners, 4};
  msq_fill_def def = make_def(msq_fill_def_init);
  def.rings = &ring;
  def.ring_count = 1;
  def.scale = 1e-3;
  def.z = 0.7;
  return msq_fill_lines(context, structure, &def, made, nullptr);
}

/// The points of a small polygon.
std::vector<int64_t> small_fill(msq_context* context, const msq_structure* structure) {
  msq_fill* made;
  require_ok(fill(context, structure, 3, &made));
  msq_fill_report report{};
  report.struct_size = sizeof report;
  require_ok(msq_fill_info(made, &report));
  const auto* points = static_cast<const int64_t*>(report.points);
  std::vector<int64_t> all(points, points + 2 * report.point_count);
  msq_fill_release(made);
  return all;
}

msq_structure* make(World& world, const std::string& name) {
  for (const Kind& kind : kinds())
    if (kind.name == name) return kind.make(world);
  if (name != "gyroid outside of a lattice") throw Failure("no structure is called " + name);
  const msq_structure* members[2] = {make(world, "gyroid"), make(world, "lattice")};
  msq_structure* made;
  require_ok(msq_structure_boolean(MSQ_BOOLEAN_DIFFERENCE, members, 2, &made));
  return world.keep(made);
}

void require_within(int64_t bytes, int64_t limit, const std::string& what) {
  require(bytes <= limit + slack, what + ": " + std::to_string(bytes) +
                                      " bytes are allocated; the limit is " +
                                      std::to_string(limit));
}

void check(const Section& section) {
  Stage stage;
  stage.begin();
  World world(stage);
  const msq_structure* structure = make(world, section.name);
  msq_context* free_context = context_of(0);
  const std::vector<int64_t> wanted = small_fill(free_context, structure);

  msq_fill* whole;
  const int64_t before = live_bytes();
  forget_peak();
  require_ok(fill(free_context, structure, section.cells, &whole));
  const auto counted = static_cast<int64_t>(memory_of(free_context).peak_bytes);
  const int64_t allocated = peak_bytes() - before;
  print_message("%s: %lld bytes are allocated, %lld counted\n", section.name.c_str(),
                static_cast<long long>(allocated), static_cast<long long>(counted));
  require(counted > 4 * slack, "the section is too small for a test");
  require_within(allocated, counted, "without a limit");
  require(counted <= allocated + allocated / 2 + slack, "more is counted than is allocated");
  msq_fill_release(whole);
  require(memory_of(free_context).bytes == 0, "bytes stay counted");
  msq_context_release(free_context);

  for (const int64_t parts : {75, 50, 25, 10, 3}) {
    const int64_t limit = counted / 100 * parts;
    msq_context* context = context_of(static_cast<uint64_t>(limit));
    msq_fill* made = nullptr;
    const std::string what = "with " + std::to_string(parts) + " %";
    const int64_t blocks = live_blocks(), bytes = live_bytes();
    forget_peak();
    const msq_status status = fill(context, structure, section.cells, &made);
    const int64_t allocated_now = peak_bytes() - bytes, left = live_blocks() - blocks;
    require(status == MSQ_E_LIMIT && !made, what + " it is not refused");
    require(std::strstr(msq_error_message(), ("memory_limit of " + std::to_string(limit)).c_str()),
            what + ": " + msq_error_message());
    require_within(allocated_now, limit, what);
    require(left <= 0, what + " " + std::to_string(left) + " blocks are left");
    require(memory_of(context).bytes == 0, what + " bytes stay counted");
    // A small section fits in all limits but the least.
    if (limit > 2 * slack)
      require(small_fill(context, structure) == wanted, what + " the next call is wrong");
    msq_context_release(context);
  }
}

void test_section(void** state) {
  message[0] = 0;
  try {
    check(*static_cast<const Section*>(*state));
  } catch (const std::exception& error) {
    snprintf(message, sizeof message, "%s", error.what());
  }
  if (message[0]) fail_msg("%s", message);
}

void test_calibration(void**) {
  message[0] = 0;
  try {
    Stage stage;
    stage.begin();
    World world(stage);
    const msq_structure* structure = make(world, "foam");
    double cell[3] = {-1, -1, -1};
    constexpr int64_t limit = 100000;
    for (const int64_t of : {limit, int64_t{0}}) {
      msq_context* context = context_of(static_cast<uint64_t>(of));
      const int64_t blocks = live_blocks(), bytes = live_bytes();
      forget_peak();
      const msq_status status = msq_fill_calibrate(context, structure, 0.4, 0.2, cell, nullptr);
      const int64_t allocated = peak_bytes() - bytes, left = live_blocks() - blocks;
      require(status == (of ? MSQ_E_LIMIT : MSQ_OK), "the calibration returns another status");
      if (of) {
        require(std::strstr(msq_error_message(), "memory_limit of 100000"), msq_error_message());
        require(cell[0] == -1, "a refused calibration writes");
        require_within(allocated, of, "the calibration");
      }
      require(left <= 0, "blocks are left");
      require(memory_of(context).bytes == 0, "bytes stay counted");
      require(of || memory_of(context).peak_bytes > 4 * limit, "a calibration counts nothing");
      msq_context_release(context);
    }
    require(cell[0] > 0, "the calibration finds nothing");
  } catch (const std::exception& error) {
    disarm();
    snprintf(message, sizeof message, "%s", error.what());
  }
  if (message[0]) fail_msg("%s", message);
}

}  // namespace

}  // namespace msq::test

int main() {
  using namespace msq::test;
  // The memory of the thread's message is there then.
  msq_context_create(nullptr, nullptr);
  std::vector<Section> sections = {{"foam", 100},
                                   {"stretched walls", 80},
                                   {"gyroid", 80},
                                   {"warped gyroid", 80},
                                   {"waves", 60},
                                   {"plate lattice", 80},
                                   {"gyroid outside of a lattice", 80}};
  const int failed = run_for_each("limit_fill", sections, test_section);
  const CMUnitTest tests[] = {cmocka_unit_test(test_calibration)};
  return failed + cmocka_run_group_tests(tests, nullptr, nullptr);
}
