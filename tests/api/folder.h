/* SPDX-License-Identifier: Apache-2.0
 * A folder for the files of a test. For POSIX: define _POSIX_C_SOURCE 200809L before all includes.
 */
#ifndef MSQ_TEST_FOLDER_H
#define MSQ_TEST_FOLDER_H

#include <stdlib.h>
#include <unistd.h>

#include "fixtures.h"

static char folder[512];

/* Returns 0 if it is there. */
static inline int make_folder(void) {
  const char* parent = getenv("TMPDIR");
  snprintf(folder, sizeof folder, "%s/msq-test-XXXXXX", parent && *parent ? parent : "/tmp");
  return mkdtemp(folder) ? 0 : -1;
}

/* The path of a file in it, until the next call. */
static inline const char* path_of(const char* name) {
  static char path[1024];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return path;
}

static inline const char* write_file(const char* name, const void* data, size_t bytes) {
  const char* path = path_of(name);
  FILE* file = fopen(path, "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(data, 1, bytes, file), bytes);
  assert_int_equal(fclose(file), 0);
  return path;
}

#endif
