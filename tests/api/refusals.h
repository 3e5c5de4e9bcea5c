/* SPDX-License-Identifier: Apache-2.0
 * Tables of refused calls. A table prepares arguments that the function accepts. Each row makes one
 * of them wrong and names the status and the words of the message:
 *
 *   REFUSALS("msq_shape_from_sphere") {
 *     double center[3] = {1, 2, 3}, radius = 1;
 *     msq_shape** shape = output(0);
 *     WRONG(ARGUMENT, "radius is -1", radius = -1);
 *     RIGHT(radius = 1e75);
 *     if (TRY(msq_shape_from_sphere(context, center, radius, shape))) msq_shape_release(*shape);
 *   }
 *
 * The block runs once without a row, which must succeed, and then once for each row. A refused call
 * must leave its outputs as they were. A row that sets a pointer to NULL comes after those that use
 * it. check_refused.py fails if a function has no table. */
#ifndef REFUSALS_H
#define REFUSALS_H

#include <inttypes.h>

#include "definitions.h"

enum { output_count = 4, output_bytes = 8192, definition_count = 4 };

typedef struct refusals {
  const char* function;
  int row, next; /* the row being tried, from 1; the number of rows that came by */
  int failures;
  int is_called;
  const char* wrong; /* what the row does; NULL: nothing */
  msq_status status;
  char words[256]; /* that the message has, separated by '|' */
} refusals;

typedef union refusal_outputs {
  double alignment;
  unsigned char bytes[output_count][output_bytes];
} refusal_outputs;

static refusal_outputs written, before;
static int refusal_count; /* of all tables of this program */

/* Room for an output of the call. */
static inline void* output(int number) {
  return written.bytes[number];
}

/* Room for a definition, which may grow. Bytes behind it are not zero. */
static inline void* definition(int number) {
  static struct_bytes rooms[definition_count];
  memset(&rooms[number], struct_pattern, sizeof rooms[number]);
  return &rooms[number];
}

/* A text of a row made from numbers; valid until the next but seven. */
static inline const char* words_of(const char* format, ...) {
  static char texts[8][128];
  static int last;
  va_list arguments;
  last = (last + 1) % 8;
  va_start(arguments, format);
  vsnprintf(texts[last], sizeof texts[last], format, arguments);
  va_end(arguments);
  return texts[last];
}

static inline void refusal_fails(refusals* table, const char* reason) {
  ++table->failures;
  print_error("%s, %s (\"%s\"):\n  %s: \"%s\"\n", table->function,
              table->wrong ? table->wrong : "nothing wrong", table->words, reason,
              msq_error_message());
}

static inline int refusals_next(refusals* table) {
  if (table->next >= 0) {
    if (!table->is_called) fail_msg("%s: the table has no TRY", table->function);
    if (table->wrong == NULL && table->row > 0) {
      refusal_count += table->next;
      print_message("%s: %d rows\n", table->function, table->next);
      if (table->failures) fail_msg("%s: %d rows failed", table->function, table->failures);
      return 0;
    }
    ++table->row;
  }
  table->next = 0;
  table->words[0] = 0;
  table->is_called = 0;
  table->wrong = NULL;
  table->status = MSQ_OK;
  memset(&written, struct_pattern, sizeof written);
  return 1;
}

static inline int refusal_begins(refusals* table, const char* wrong, msq_status status,
                                 const char* words) {
  if (++table->next != table->row) return 0;
  table->wrong = wrong;
  table->status = status;
  snprintf(table->words, sizeof table->words, "%s", words);
  return 1;
}

/* Whether the call succeeded. */
static inline int refusal_ends(refusals* table, msq_status status) {
  char words[sizeof table->words];
  table->is_called = 1;
  if (status != table->status) {
    refusal_fails(table, msq_status_name(status));
  } else if (status != MSQ_OK) {
    memcpy(words, table->words, sizeof words);
    for (char* word = strtok(words, "|"); word; word = strtok(NULL, "|"))
      if (!strstr(msq_error_message(), word)) refusal_fails(table, word);
    for (const char* c = msq_error_message(); *c; ++c)
      if ((unsigned char)*c < ' ' || *c == 0x7f) refusal_fails(table, "not one line");
    if (memcmp(&written, &before, sizeof before) != 0) refusal_fails(table, "an output changed");
  }
  return status == MSQ_OK;
}

#define REFUSALS(function)                                                                \
  for (refusals all_rows = {function, 0, -1, 0, 0, NULL, MSQ_OK, ""}, *table = &all_rows; \
       refusals_next(table);)

/* A row: the call is refused with the status MSQ_E_<status> and these words, separated by '|'. */
#define WRONG(status, words, ...)                                     \
  do {                                                                \
    if (refusal_begins(table, #__VA_ARGS__, MSQ_E_##status, words)) { \
      __VA_ARGS__;                                                    \
    }                                                                 \
  } while (0)

/* A row: the call is accepted all the same, at a limit for example. */
#define RIGHT(...)                                         \
  do {                                                     \
    if (refusal_begins(table, #__VA_ARGS__, MSQ_OK, "")) { \
      __VA_ARGS__;                                         \
    }                                                      \
  } while (0)

/* Makes the call; whether it succeeded, for the outputs to be released. */
#define TRY(...) (memcpy(&before, &written, sizeof before), refusal_ends(table, (__VA_ARGS__)))

#endif
