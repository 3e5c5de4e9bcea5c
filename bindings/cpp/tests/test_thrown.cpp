// SPDX-License-Identifier: Apache-2.0
// msq.hpp: exceptions of callbacks wait until their calls return, also among many others.
#include <msq.hpp>

#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "msq_test.h"
#include "thrown_by.h"

namespace {

struct Odd : std::exception {
  const char* what() const noexcept override { return "odd"; }
};

/// A model whose radius throws.
template <class Throw>
msq::Model throwing_model(const msq::Context& context, Throw throws) {
  msq::HostFieldDef def;
  def.low = 0.1;
  def.high = 0.5;
  def.lipschitz = 0.1;
  def.concurrent = 1;
  const msq::Field radius =
      msq::Field::host(context, def, [throws](const double*, uint64_t count, double* values) {
        throws();
        std::fill(values, values + count, 0.3);
      });
  msq::FoamDef foam;
  for (double& size : foam.grid.cell_size) size = 2;
  foam.radius = msq::param(radius);
  return {context,
          {msq::Shape::box(context, {0, 0, 0}, {10, 10, 10}), msq::Structure::foam(context, foam)}};
}

/// Another callback of the call runs on after the throw, and catches exceptions of calls of its
/// own.
void an_exception_outlives_many_others(void**) {
  const msq::Context context, inner_context;
  const msq::Model inner = throwing_model(inner_context, [] { throw Odd(); });
  std::atomic<int> entered{0}, caught{0};
  const auto wait_for = [&](int count) {
    for (int i = 0; i < 500 && entered < count; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
  };
  const msq::Model outer = throwing_model(context, [&] {
    const int place = ++entered;
    wait_for(2);  // a context with one thread goes on alone
    if (place == 1) throw std::runtime_error("the first");
    if (place > 2) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    for (int i = 0; i < 1000; ++i) {
      try {
        inner.inside({1, 1, 1});
      } catch (const Odd&) {
        ++caught;
      }
    }
  });
  msq::SlicerDef plan;
  plan.pitch[0] = plan.pitch[1] = 0.05;
  plan.layer_height = 0.5;
  const msq::Slicer slicer(outer, plan);
  assert_string_equal(thrown_by([&] { slicer.layer(3); }).c_str(), "the first");
  if (entered > 1) assert_int_equal(caught.load(), 1000);
}

/// What frees it throws, too.
struct Nested {
  ~Nested() {
    msq::detail::result_of([] { throw Odd(); });
  }
};

int32_t kept_code(int number) {
  return msq::detail::result_of([&] { throw std::runtime_error(std::to_string(number)); });
}

std::string taken_text(int32_t code) {
  const std::exception_ptr found = msq::detail::Thrown::take(code);
  return found ? thrown_by([&] { std::rethrow_exception(found); }) : "none";
}

void many_exceptions_wait(void**) {
  constexpr int count = msq::detail::Thrown::max_kept;
  std::vector<int32_t> codes;
  for (int i = 0; i <= count; ++i) codes.push_back(kept_code(i));
  assert_string_equal(taken_text(codes[0]).c_str(), "none");  // the oldest gave way
  for (int i = 1; i < count; i += count / 3)
    assert_string_equal(taken_text(codes[static_cast<size_t>(i)]).c_str(),
                        std::to_string(i).c_str());
  assert_string_equal(taken_text(codes[1]).c_str(), "none");  // thrown already
  assert_string_equal(taken_text(codes.back()).c_str(), std::to_string(count).c_str());
  for (const int32_t code : {0, -1, -(1 << 30), std::numeric_limits<int32_t>::min()})
    assert_true(msq::detail::Thrown::take(code) == nullptr);
  // An exception that gives way is freed where others may be thrown.
  msq::detail::result_of([] { throw std::make_shared<Nested>(); });
  for (int i = 0; i <= count; ++i) kept_code(i);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(an_exception_outlives_many_others),
                              cmocka_unit_test(many_exceptions_wait)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
