/* SPDX-License-Identifier: Apache-2.0
 * What every test includes: CMocka, for C and C++, and the checks that msq's own tests share. */
#ifndef MSQ_TEST_H
#define MSQ_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif
#include <cmocka.h>
#ifdef __cplusplus
}
/* CMocka's short macros would rewrite names of the inside of msq, such as msq::fail(). */
#undef fail
#undef skip
#undef fail_msg
#define fail_msg(...)          \
  do {                         \
    print_error(__VA_ARGS__);  \
    print_error("\n");         \
    _fail(__FILE__, __LINE__); \
  } while (0)
#endif

#include "msq.h"

static inline void msq_test_status_(msq_status got, msq_status wanted, const char* call,
                                    const char* file, int line) {
  if (got == wanted) return;
  print_error("%s\n  is %s (%d), not %s: \"%s\"\n", call, msq_status_name(got), (int)got,
              msq_status_name(wanted), got == MSQ_OK ? "" : msq_error_message());
  _fail(file, line);
}

static inline void msq_test_message_(const char* text, const char* file, int line) {
  if (strstr(msq_error_message(), text) != NULL) return;
  print_error("the message \"%s\" says nothing of \"%s\"\n", msq_error_message(), text);
  _fail(file, line);
}

/* The call returns this status; if not, the test fails and says the call's message. */
#define assert_status(call, status) msq_test_status_((call), (status), #call, __FILE__, __LINE__)
#define assert_ok(call) assert_status(call, MSQ_OK)

/* The last failure's message on this thread contains the text. */
#define assert_message_has(text) msq_test_message_((text), __FILE__, __LINE__)

/* Factor on the number of samples that a test draws: environment variable MSQ_TEST_SCALE,
 * default 1. Slow builds (sanitizers) run with less. */
static inline double test_scale(void) {
  const char* text = getenv("MSQ_TEST_SCALE");
  if (text == NULL || *text == 0) return 1;
  const double scale = strtod(text, NULL);
  if (!(scale > 0)) {
    print_error("MSQ_TEST_SCALE=%s is not a positive number\n", text);
    exit(2);
  }
  return scale;
}

/* A number of samples, scaled; at least 1. */
static inline size_t test_count(size_t full) {
  const double scaled = (double)full * test_scale();
  return scaled < 1 ? 1 : (size_t)scaled;
}

#endif
