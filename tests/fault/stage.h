// SPDX-License-Identifier: Apache-2.0
// One call of the public interface, made again and again while memory fails: what a scenario is
// played on. A scenario makes what it needs, watches the arguments that the call writes, and makes
// the call.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "failing_allocator.h"
#include "msq.h"

namespace msq::test {

/// What a check throws. CMocka's own leave by longjmp, past the destructors.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
void require(bool holds, const std::string& what);
/// Of the calls around the one in question.
void require_ok(msq_status status);

class Stage {
 public:
  /// Threads of the contexts that scenarios make.
  uint32_t threads = 1;

  // For the scenario:

  /// What the call writes: untouched where it fails, the same each time where it does not.
  void watch(void* data, size_t bytes) { add(data, bytes, true, true); }
  template <class T>
  void watch(T& output) {
    watch(&output, sizeof output);
  }
  template <class T>
  void watch(std::vector<T>& output) {
    watch(output.data(), output.size() * sizeof(T));
  }
  /// Output that may be partly written where the call fails.
  template <class T>
  void watch_part(std::vector<T>& output) {
    add(output.data(), output.size() * sizeof(T), false, true);
  }
  /// A handle: untouched where the call fails.
  template <class Handle>
  void watch_handle(Handle*& handle) {
    add(&handle, sizeof handle, true, false);
  }
  /// What finish() below writes.
  template <class T>
  void watch_probe(std::vector<T>& output) {
    add(output.data(), output.size() * sizeof(T), false, true);
  }

  /// The call in question, once a scenario. finish() is called after each success, with memory that
  /// does not fail: it probes what was made and releases it.
  void call(const std::function<msq_status()>& call, const std::function<void()>& finish = {});

  /// Memory that fails may come as MSQ_E_IO: libraries that read files do not say what went wrong.
  bool allows_io = false;
  /// Assimp and CGAL leak where memory fails.
  bool allows_leaks = false;
  /// The call needs more than a small stack: it enters Assimp or CGAL.
  bool needs_stack = false;

  // For whoever plays scenarios:

  /// The next scenario's call fails at no allocation; its outputs are what later ones are compared
  /// with.
  void set_reference();
  /// The next scenario's call fails at allocation k, and is made once more.
  void set_failing(uint64_t k, Failing failing);
  /// To be called before each scenario.
  void begin();
  /// Allocations of the last reference call.
  uint64_t allocations() const { return allocations_; }

 private:
  struct Output {
    unsigned char* data;
    size_t bytes;
    bool is_untouched, is_compared;
  };
  void add(void* data, size_t bytes, bool is_untouched, bool is_compared);
  void fill() const;
  void check_untouched() const;
  void store();
  void compare(const char* when) const;

  bool is_reference_ = true;
  uint64_t k_ = 0, allocations_ = 0;
  Failing failing_ = Failing::once;
  std::vector<Output> outputs_;
  std::vector<unsigned char> reference_;
};

struct Scenario {
  std::string name;
  std::function<void(Stage&)> play;
};

}  // namespace msq::test
