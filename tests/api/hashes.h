/* SPDX-License-Identifier: Apache-2.0
 * Which values of a definition its hash depends on. A test prepares a definition and varies it, one
 * value in each row:
 *
 *   HASHES(context, "sphere", &def, sizeof def, hash_sphere) {
 *     CHANGES(def.radius, def.radius = 2);
 *     KEEPS(def.name, def.name = "another");
 *     NOT_HASHED(def.user);
 *   }
 *
 * The block runs once. CHANGES: the hash differs from that of the definition as it was, and from
 * that of every other such row. KEEPS: it is the same. A byte of the definition that no row names
 * fails the test: a field that is added to a struct needs a row here and a line in describe(). */
#ifndef HASHES_H
#define HASHES_H

#include "definitions.h"

enum { hash_bytes = 16, hash_rows_room = 128 };

/* Makes the object of a definition, hashes it and releases it. */
typedef void (*hash_fn)(msq_context* context, const void* def, uint8_t hash[hash_bytes]);

typedef struct hash_rows {
  msq_context* context;
  const char* name;
  void* def;
  size_t size;
  hash_fn hash;
  struct_bytes before;
  unsigned char named[struct_room];
  uint8_t known[hash_rows_room][hash_bytes]; /* the first: of the definition as it was */
  const char* rows[hash_rows_room];
  int count, is_done;
} hash_rows;

static inline int hashes_next(hash_rows* rows) {
  if (!rows->is_done) {
    rows->is_done = 1;
    assert_true(rows->size <= sizeof rows->before);
    memcpy(&rows->before, rows->def, rows->size);
    rows->hash(rows->context, rows->def, rows->known[0]);
    rows->rows[0] = "as it was";
    rows->count = 1;
    return 1;
  }
  for (size_t i = 0; i < rows->size; ++i)
    if (!rows->named[i]) fail_msg("%s: no row names byte %zu", rows->name, i);
  return 0;
}

static inline void name_bytes(hash_rows* rows, const void* field, size_t size) {
  const unsigned char *first = (const unsigned char*)rows->def, *at = (const unsigned char*)field;
  if (at < first || at + size > first + rows->size) return; /* behind a pointer */
  memset(rows->named + (at - first), 1, size);
}

/* After a row has varied the definition. */
static inline void hash_row(hash_rows* rows, const char* row, int changes) {
  uint8_t hash[hash_bytes], again[hash_bytes];
  rows->hash(rows->context, rows->def, hash);
  rows->hash(rows->context, rows->def, again);
  assert_memory_equal(hash, again, hash_bytes);
  memcpy(rows->def, &rows->before, rows->size);
  if (!changes) {
    if (memcmp(hash, rows->known[0], hash_bytes) != 0)
      fail_msg("%s: another hash after %s", rows->name, row);
    return;
  }
  for (int i = 0; i < rows->count; ++i)
    if (memcmp(hash, rows->known[i], hash_bytes) == 0)
      fail_msg("%s: %s has the same hash as: %s", rows->name, row, rows->rows[i]);
  assert_true(rows->count < hash_rows_room);
  memcpy(rows->known[rows->count], hash, hash_bytes);
  rows->rows[rows->count++] = row;
}

#define HASHES(context, name, def, size, hash)                                               \
  for (hash_rows all_rows = {context, name, def, size, hash, {0}, {0}, {{0}}, {NULL}, 0, 0}, \
                 *rows = &all_rows;                                                          \
       hashes_next(rows);)

#define HASH_ROW(field, changes, ...)          \
  do {                                         \
    name_bytes(rows, &(field), sizeof(field)); \
    __VA_ARGS__;                               \
    hash_row(rows, #__VA_ARGS__, changes);     \
  } while (0)

#define CHANGES(field, ...) HASH_ROW(field, 1, __VA_ARGS__)
#define KEEPS(field, ...) HASH_ROW(field, 0, __VA_ARGS__)
#define NOT_HASHED(field) name_bytes(rows, &(field), sizeof(field))

/* The same for a number that the definition points to. */
#define CHANGES_BEHIND(type, value, other)  \
  do {                                      \
    type kept_value = (value);              \
    (value) = (other);                      \
    hash_row(rows, #value " = " #other, 1); \
    (value) = kept_value;                   \
  } while (0)

/* All numbers of a grid; what is varied is valid for structures and images. */
#define GRID_CHANGES(grid)                                         \
  do {                                                             \
    CHANGES((grid).origin[0], (grid).origin[0] = 0.125);           \
    CHANGES((grid).origin[1], (grid).origin[1] = 0.125);           \
    CHANGES((grid).origin[2], (grid).origin[2] = 0.125);           \
    KEEPS((grid).origin[0], (grid).origin[0] = -(grid).origin[0]); \
    CHANGES((grid).cell_size[0], (grid).cell_size[0] = 1.25);      \
    CHANGES((grid).cell_size[1], (grid).cell_size[1] = 1.25);      \
    CHANGES((grid).cell_size[2], (grid).cell_size[2] = 1.25);      \
    CHANGES((grid).rotation, turn((grid).rotation, 0));            \
    CHANGES((grid).rotation, turn((grid).rotation, 1));            \
    CHANGES((grid).rotation, turn((grid).rotation, 2));            \
  } while (0)

/* A parameter: one field in place of the number, and another. */
#define PARAM_CHANGES(param, one, other)                   \
  do {                                                     \
    CHANGES((param).field, (param).field = one);           \
    CHANGES((param).field, (param).field = other);         \
    name_bytes(rows, &(param).value, sizeof(param).value); \
  } while (0)

/* Callbacks of host objects, which hashes do not see: a function of value 0.5, and its range. */
static inline int32_t half(void* user, const double* points, uint64_t count, double* values) {
  (void)user;
  (void)points;
  for (uint64_t i = 0; i < count; ++i) values[i] = 0.5;
  return 0;
}

static inline int32_t range_of_half(void* user, const double min[3], const double max[3],
                                    double* low, double* high) {
  (void)user;
  (void)min;
  (void)max;
  *low = *high = 0.5;
  return 0;
}

static inline void no_release(void* user) {
  (void)user;
}

/* What all definitions of host objects share. */
#define HOST_ROWS(def)                                 \
  do {                                                 \
    KEEPS((def).user, (def).user = &rows->count);      \
    KEEPS((def).release, (def).release = no_release);  \
    CHANGES((def).hash_key[0], (def).hash_key[0] = 8); \
    CHANGES((def).hash_key[1], (def).hash_key[1] = 8); \
  } while (0)

/* The hash is this one. Those of the tests were computed from the bytes that src/base/hash_input.h
 * describes by tests/golden/make_hashes.py. */
static inline void assert_hash(const uint8_t hash[hash_bytes], const char* wanted) {
  char text[2 * hash_bytes + 1];
  for (int i = 0; i < hash_bytes; ++i) snprintf(text + 2 * i, 3, "%02x", hash[i]);
  assert_string_equal(text, wanted);
}

/* A quarter turn about an axis. */
static inline void turn(double rotation[9], int axis) {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  for (int i = 0; i < 9; ++i) rotation[i] = i == 4 * axis;
  rotation[3 * b + c] = -1;
  rotation[3 * c + b] = 1;
}

#endif
