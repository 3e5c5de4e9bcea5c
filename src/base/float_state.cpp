// SPDX-License-Identifier: Apache-2.0
// fegetenv() and fesetenv() take 70 ns each on x86-64, since they store and load the whole x87
// unit. The registers that matter here take 8 ns to read and 1 ns to write.
#include "base/float_state.h"

namespace msq {

#if defined(__GNUC__) && defined(__x86_64__)

// SSE does msq's arithmetic. The x87 unit does long double, which msq does not use but libraries
// may. The C library's strtod and printf round as the x87 unit is set.

namespace {

constexpr uint32_t own_mxcsr = 0x1f80;  // to nearest, all masked, denormals kept
constexpr uint32_t mxcsr_flags = 0x3f;
constexpr uint32_t own_x87_control = 0x37f;  // to nearest, all masked, 64 bits of precision
constexpr uint32_t x87_flags = 0xff;         // of the status word, with derived bits
constexpr uint32_t x87_pending = 0x80;       // a raised flag is unmasked: the next instruction
                                             // traps

void write_x87_control(uint32_t value) {
  asm volatile("fldcw %0" : : "m"(value) : "memory");
}

uint32_t read_x87_status() {
  uint16_t status;
  asm volatile("fnstsw %0" : "=a"(status) : : "memory");
  return status;
}

uint32_t read_x87_control() {
  uint16_t control;
  asm volatile("fnstcw %0" : "=m"(control) : : "memory");
  return control;
}

/// The x87 unit in memory, without its registers.
struct X87Environment {
  uint16_t control, reserved_1, status, reserved_2;
  uint32_t rest[5];
};

}  // namespace

FloatState FloatState::read() noexcept {
  FloatState now;
  asm volatile("stmxcsr %0" : "=m"(now.mxcsr_) : : "memory");
  now.x87_control_ = read_x87_control();
  now.x87_status_ = read_x87_status();
  return now;
}

void FloatState::restore() const noexcept {
  // Faster than a test whether it differs: it usually differs, by a flag.
  asm volatile("ldmxcsr %0" : : "m"(mxcsr_) : "memory");
  if ((read_x87_status() ^ x87_status_) & x87_flags) {
    // No instruction sets single flags.
    X87Environment environment;
    asm volatile("fnstenv %0" : "=m"(environment) : : "memory");
    environment.control = static_cast<uint16_t>(x87_control_);
    environment.status =
        static_cast<uint16_t>((environment.status & ~x87_flags) | (x87_status_ & x87_flags));
    asm volatile("fldenv %0" : : "m"(environment) : "memory");
  } else if (read_x87_control() != x87_control_) {
    write_x87_control(x87_control_);
  }
}

void FloatState::enter_own() const noexcept {
  if ((mxcsr_ & ~mxcsr_flags) != own_mxcsr)
    asm volatile("ldmxcsr %0" : : "m"(own_mxcsr) : "memory");
  // A pending exception would trap at the first x87 instruction.
  if (x87_status_ & x87_pending) asm volatile("fnclex" : : : "memory");
  if (x87_control_ != own_x87_control) write_x87_control(own_x87_control);
}

#elif defined(__GNUC__) && defined(__aarch64__)

FloatState FloatState::read() noexcept {
  FloatState now;
  asm volatile("mrs %0, fpcr" : "=r"(now.control_) : : "memory");
  asm volatile("mrs %0, fpsr" : "=r"(now.status_) : : "memory");
  return now;
}

void FloatState::restore() const noexcept {
  const FloatState now = read();
  if (now.control_ != control_) asm volatile("msr fpcr, %0" : : "r"(control_) : "memory");
  if (now.status_ != status_) asm volatile("msr fpsr, %0" : : "r"(status_) : "memory");
}

void FloatState::enter_own() const noexcept {
  // 0: round to nearest, no traps, denormals kept.
  if (control_ != 0) asm volatile("msr fpcr, %0" : : "r"(uint64_t{0}) : "memory");
}

#else

FloatState FloatState::read() noexcept {
  FloatState now;
  std::fegetenv(&now.environment_);
  return now;
}

void FloatState::restore() const noexcept {
  std::fesetenv(&environment_);
}

void FloatState::enter_own() const noexcept {
  std::fesetenv(FE_DFL_ENV);
}

#endif

}  // namespace msq
