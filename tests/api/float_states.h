/* SPDX-License-Identifier: Apache-2.0
 * Floating-point environments that a host may have, and calls that are made in them. */
#ifndef FLOAT_STATES_H
#define FLOAT_STATES_H

#include <fenv.h>
#include <pthread.h>

#include "fixtures.h"

/* What a thread's floating-point unit is set to, and the flags that are raised. */
typedef struct float_state {
  uint64_t control, flags;
} float_state;

static inline float_state read_state(void) {
  float_state state;
#if defined(__GNUC__) && defined(__x86_64__)
  uint32_t sse;
  uint16_t x87, x87_status;
  __asm__ volatile("stmxcsr %0" : "=m"(sse));
  __asm__ volatile("fnstcw %0" : "=m"(x87));
  __asm__ volatile("fnstsw %0" : "=m"(x87_status));
  state.control = (sse & ~UINT32_C(0x3f)) | (uint64_t)x87 << 32;
  state.flags = (sse & 0x3f) | (uint64_t)(x87_status & 0x7f) << 32;
#elif defined(__GNUC__) && defined(__aarch64__)
  __asm__ volatile("mrs %0, fpcr" : "=r"(state.control));
  __asm__ volatile("mrs %0, fpsr" : "=r"(state.flags));
#else
  state.control = (uint64_t)fegetround();
  state.flags = (uint64_t)fetestexcept(FE_ALL_EXCEPT);
#endif
  return state;
}

/* Denormal operands and results count as 0. */
static inline void flush_denormals(void) {
#if defined(__GNUC__) && defined(__x86_64__)
  uint32_t sse;
  __asm__ volatile("stmxcsr %0" : "=m"(sse));
  sse |= 0x8040;
  __asm__ volatile("ldmxcsr %0" : : "m"(sse));
#elif defined(__GNUC__) && defined(__aarch64__)
  uint64_t control;
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  control |= UINT64_C(1) << 24;
  __asm__ volatile("msr fpcr, %0" : : "r"(control));
#endif
}

/* Every exception kills the program, in the x87 unit too. */
static inline void trap_all(void) {
#if defined(__GNUC__) && defined(__x86_64__)
  uint32_t sse;
  uint16_t x87;
  __asm__ volatile("stmxcsr %0" : "=m"(sse));
  __asm__ volatile("fnstcw %0" : "=m"(x87));
  sse &= ~UINT32_C(0x1f80);
  x87 = (uint16_t)(x87 & ~0x3f);
  __asm__ volatile("ldmxcsr %0" : : "m"(sse));
  __asm__ volatile("fldcw %0" : : "m"(x87));
#elif defined(__GNUC__) && defined(__aarch64__)
  uint64_t control; /* stays as it was where the processor has no traps */
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  control |= UINT64_C(0x1f) << 8;
  __asm__ volatile("msr fpcr, %0" : : "r"(control));
#endif
}

/* Long doubles have the precision of doubles. */
static inline void shorten_x87(void) {
#if defined(__GNUC__) && defined(__x86_64__)
  uint16_t x87;
  __asm__ volatile("fnstcw %0" : "=m"(x87));
  x87 = (uint16_t)((x87 & ~0x300) | 0x200);
  __asm__ volatile("fldcw %0" : : "m"(x87));
#endif
}

enum { state_count = 9 };
static const char* const state_names[state_count] = {
    "default",   "upward",    "downward",
    "to zero",   "flushes",   "traps",
    "short x87", "has flags", "upward, flushes and traps"};

/* Turns from the default environment to another. No arithmetic until leave_state()! */
static inline void enter_state(int which) {
  feclearexcept(FE_ALL_EXCEPT);
  if (which == 1 || which == 8) fesetround(FE_UPWARD);
  if (which == 2) fesetround(FE_DOWNWARD);
  if (which == 3) fesetround(FE_TOWARDZERO);
  if (which == 6) shorten_x87();
  if (which == 7) feraiseexcept(FE_DIVBYZERO | FE_UNDERFLOW);
  if (which == 4 || which == 8) flush_denormals();
  if (which == 5 || which == 8) trap_all();
}

static inline void leave_state(void) {
  fesetenv(FE_DFL_ENV);
}

/* The environment that calls are made in. */
static int host_state;
/* The first call after which it was another. */
static const char* wrong_call;

static inline void check_same_state(float_state before, const char* call) {
  const float_state after = read_state();
  if (!wrong_call && (after.control != before.control || after.flags != before.flags))
    wrong_call = call;
}

/* Makes a call in the host's environment. */
#define IN_STATE(call)                        \
  do {                                        \
    enter_state(host_state);                  \
    const float_state before_ = read_state(); \
    call;                                     \
    check_same_state(before_, #call);         \
    leave_state();                            \
  } while (0)

/* ---- what calls answer ----------------------------------------------------------------------- */

enum { max_answers = 1 << 20 };
static unsigned char answers[2][max_answers]; /* in the default environment, in another */
static size_t answer_bytes[2];
static int is_other;

static inline void note(const void* data, size_t bytes) {
  if (answer_bytes[is_other] + bytes > max_answers) fail_msg("too many answers");
  memcpy(answers[is_other] + answer_bytes[is_other], data, bytes);
  answer_bytes[is_other] += bytes;
}

/* Whether messages are noted. With more threads than one, any of the callbacks that fail may be the
 * one that a message names. */
static int notes_messages = 1;

/* Makes a call and notes its status, and what it says where it fails. */
#define CALL(call)                                            \
  do {                                                        \
    msq_status status_;                                       \
    IN_STATE(status_ = (call));                               \
    note(&status_, sizeof status_);                           \
    if (status_ != MSQ_OK && notes_messages)                  \
      note(msq_error_message(), strlen(msq_error_message())); \
  } while (0)

#define NOTE(value) note(&(value), sizeof(value))

/* ---- what callbacks see -----------------------------------------------------------------------
 */

static int is_wrong_state, was_elsewhere; /* callbacks set them on several threads at once */
static pthread_t host_thread;

/* To begin a callback with: notes whether it is in the host's environment, and whether it is on
 * another thread than the call. */
static inline void check_state(void) {
  const float_state now = read_state();
  float_state wanted;
  if (!pthread_equal(pthread_self(), host_thread))
    __atomic_store_n(&was_elsewhere, 1, __ATOMIC_RELAXED);
  enter_state(host_state);
  wanted = read_state();
  if (now.control != wanted.control || now.flags != wanted.flags)
    __atomic_store_n(&is_wrong_state, 1, __ATOMIC_RELAXED);
}

static inline void assert_right_states(void) {
  const char* const wrong = wrong_call;
  const int is_wrong = is_wrong_state;
  wrong_call = NULL;
  is_wrong_state = 0;
  if (wrong)
    fail_msg("%s: environment \"%s\" is another afterwards", wrong, state_names[host_state]);
  if (is_wrong) fail_msg("a callback was not in environment \"%s\"", state_names[host_state]);
}

#endif
