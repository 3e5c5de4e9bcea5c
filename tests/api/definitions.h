/* SPDX-License-Identifier: Apache-2.0
 * What msq.h promises of struct_size, checked for any definition and any report. */
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

/* Wraps msq_<name>_init as init_<name>. */
#define DEFINE_INIT(name)                                 \
  static msq_status init_##name(void* def, size_t size) { \
    return msq_##name##_init((msq_##name*)def, size);     \
  }

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

/* def_init of a struct that has `known` bytes, and had `first` when it was published. */
static inline void check_grown_def_init(init_fn init, size_t first, size_t known) {
  const size_t refused[] = {0, 1, sizeof(void*), first - 1, 4097};
  struct_bytes all, def;
  assert_true(known + struct_tail <= struct_room);
  assert_refused(init(NULL, known), MSQ_E_ARGUMENT, "NULL");

  memset(&def, struct_pattern, sizeof def);
  for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
    assert_status(init(&def, refused[i]), MSQ_E_ARGUMENT);
    assert_message_has_number(refused[i]);
    assert_filled(&def, sizeof def, struct_pattern);
  }
#if SIZE_MAX > UINT32_MAX
  assert_refused(init(&def, (size_t)UINT32_MAX + 1), MSQ_E_ARGUMENT, "4294967296");
  assert_filled(&def, sizeof def, struct_pattern);
#endif

  assert_ok(init(&all, known));
  assert_int_equal(all.struct_size, known);
  for (size_t size = first; size <= known + struct_tail; ++size) {
    const size_t shared = size < known ? size : known;
    memset(&def, struct_pattern, sizeof def);
    assert_ok(init(&def, size));
    assert_int_equal(def.struct_size, size);
    assert_memory_equal(def.bytes + 4, all.bytes + 4, shared - 4);
    assert_filled(def.bytes + shared, size - shared, 0);
    assert_filled(def.bytes + size, sizeof def - size, struct_pattern);
  }
}
static inline void check_def_init(init_fn init, size_t known) {
  check_grown_def_init(init, known, known);
}

/* A definition that is valid as it stands, and by its first fields alone, passed with every kind of
 * struct_size. */
static inline void check_grown_def_sizes(const void* valid, size_t first, size_t known, use_fn use,
                                         void* env) {
  const uint32_t refused[] = {0, 4, sizeof(void*), (uint32_t)first - 1, 4097, UINT32_MAX};
  struct_bytes def;
  memset(&def, struct_pattern, sizeof def);
  memcpy(&def, valid, known);
  def.struct_size = (uint32_t)known;
  assert_ok(use(env, &def));
  def.struct_size = (uint32_t)first;
  assert_ok(use(env, &def));

  for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
    def.struct_size = refused[i];
    assert_refused(use(env, &def), MSQ_E_ARGUMENT, "struct_size");
    assert_message_has_number(refused[i]);
  }

  def.struct_size = (uint32_t)(known + struct_tail);
  memset(def.bytes + known, 0, struct_tail);
  assert_ok(use(env, &def));
  for (size_t i = 0; i < struct_tail; i += struct_tail - 1) {
    memset(def.bytes + known, 0, struct_tail);
    def.bytes[known + i] = 1;
    assert_refused(use(env, &def), MSQ_E_ARGUMENT, "byte");
    assert_message_has_number(known + i);
  }
}
static inline void check_def_sizes(const void* valid, size_t known, use_fn use, void* env) {
  check_grown_def_sizes(valid, known, known, use, env);
}

/* A report that has `known` bytes, and had `first` when it was published, asked for with every
 * struct_size. */
static inline void check_grown_report_sizes(size_t first, size_t known, use_fn read, void* env) {
  const uint32_t refused[] = {0, 4, sizeof(void*), (uint32_t)first - 1, 4097, UINT32_MAX};
  struct_bytes all, report;
  assert_true(known + struct_tail <= struct_room);
  assert_refused(read(env, NULL), MSQ_E_ARGUMENT, "report is NULL");

  memset(&report, struct_pattern, sizeof report);
  for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
    report.struct_size = refused[i];
    assert_refused(read(env, &report), MSQ_E_ARGUMENT, "struct_size");
    assert_message_has_number(refused[i]);
    assert_filled(report.bytes + 4, sizeof report - 4, struct_pattern);
  }

  all.struct_size = (uint32_t)known;
  assert_ok(read(env, &all));
  for (size_t size = first; size <= known + struct_tail; ++size) {
    const size_t shared = size < known ? size : known;
    memset(&report, struct_pattern, sizeof report);
    report.struct_size = (uint32_t)size;
    assert_ok(read(env, &report));
    assert_int_equal(report.struct_size, size);
    assert_memory_equal(report.bytes + 4, all.bytes + 4, shared - 4);
    assert_filled(report.bytes + shared, size - shared, 0);
    assert_filled(report.bytes + size, sizeof report - size, struct_pattern);
  }
}
static inline void check_report_sizes(size_t known, use_fn read, void* env) {
  check_grown_report_sizes(known, known, read, env);
}

#endif
