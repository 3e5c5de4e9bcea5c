// SPDX-License-Identifier: Apache-2.0
// The floating-point environment of a thread: rounding, treatment of denormal numbers, traps, and
// the raised exception flags. msq computes in its own environment: round to nearest, keep
// denormals, no traps. src/base/call.h says which code enters it and when.
#pragma once

#include <cstdint>
#if !defined(__GNUC__) || (!defined(__x86_64__) && !defined(__aarch64__))
#include <cfenv>
#endif

namespace msq {

class FloatState {
 public:
  /// The state of the calling thread.
  static FloatState read() noexcept;
  /// Sets this state, including its flags, on the calling thread.
  void restore() const noexcept;
  /// Sets msq's own settings on the calling thread, whose state this is. Flags stay raised: msq
  /// ignores them.
  void enter_own() const noexcept;

 private:
#if defined(__GNUC__) && defined(__x86_64__)
  uint32_t mxcsr_, x87_control_, x87_status_;
#elif defined(__GNUC__) && defined(__aarch64__)
  uint64_t control_, status_;
#else
  std::fenv_t environment_;
#endif
};

}  // namespace msq
