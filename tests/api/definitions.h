/* SPDX-License-Identifier: Apache-2.0
 * Definitions of any kind as bytes, and the calls that take them. */
#ifndef DEFINITIONS_H
#define DEFINITIONS_H

#include "fixtures.h"

enum { struct_room = 512, struct_tail = 24, struct_pattern = 0xa5 };

/* A struct of any kind, with room behind it. */
typedef union struct_bytes {
  uint64_t alignment;
  uint32_t struct_size;
  unsigned char bytes[struct_room];
} struct_bytes;

typedef msq_status (*init_fn)(void* def, size_t size);
/* Passes the definition or report to the function under test, and releases what that makes. */
typedef msq_status (*use_fn)(void* env, void* structure);

/* Makes msq_<constructor> a use_fn, create, in a context: a refusal leaves the handle alone. */
#define DEFINE_CREATE(object, constructor, definition)                             \
  static msq_status create(void* env, void* def) {                                 \
    msq_##object* made = (msq_##object*)untouched();                               \
    const msq_status status =                                                      \
        msq_##constructor((msq_context*)env, (const msq_##definition*)def, &made); \
    if (status == MSQ_OK)                                                          \
      msq_##object##_release(made);                                                \
    else                                                                           \
      assert_ptr_equal(made, untouched());                                         \
    return status;                                                                 \
  }

#endif
